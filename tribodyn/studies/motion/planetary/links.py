"""Links of planetary sets: pins of the planets, what holds members, or keeps them at speeds of their own."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.dynamics.data import BearingData
from tribodyn.input.tables.bearings import bearing_of
from tribodyn.studies.motion.case import HOUSING, LinkData, SetData
from tribodyn.studies.motion.drivetrain.placed_train import PlacedTrain, TrainKinematics
from tribodyn.studies.motion.planetary.carriers import carrier_of
from tribodyn.studies.motion.planetary.in_space import along_axis, on_pin
from tribodyn.studies.motion.planetary.stages import SetPart, pin_offset
from tribodyn.train.elastic.ring import RimData
from tribodyn.train.planetary import CARRIER, RING
from tribodyn.train.structure import BRAKES, DRIVES

#: Stiffness on its pitch circle with which a member is held where none is given, N/m: of a stiff bearing.
USUAL_SUPPORT = 1e9
#: Damping ratio of what keeps a speed, where none is given.
USUAL_DAMPING = 0.02


def links_of_set(
    gearset: SetPart, train: TrainKinematics, placed: PlacedTrain, bearings: Sequence[Any]
) -> Iterator[LinkData]:
    """Pins of the planets, and what holds a member against rotation."""
    stage, new = gearset.table, train.numbers
    carrier, in_space = new[gearset.members[CARRIER]], bool(stage.helix_angle)
    sense, centre = train.motion.sense[carrier], placed.places.centres
    for number, body in enumerate(gearset.planets):
        bearing = bearings[body]
        if bearing is None:
            continue
        x, y = centre[new[body]] - centre[carrier]
        data = bearing_of(bearing)
        if stage.pin is not None:
            data = behind(data, stage.pin.rigidity)
        further = {"bearing": on_pin(data, gearset.face_width)} if in_space else {}
        yield LinkData.of_bearing(
            f"pin-{train.parts.bodies[body].name}",
            gearset.key,
            (new[body], carrier),
            data,
            lever=(-sense * float(y), sense * float(x)),
            offset=pin_offset(stage, number),
            **further,
        )
    for body in gearset.floating if in_space else ():
        data = along_axis(bearing_of(bearings[body]), gearset.face_width)
        name = f"bearing-{train.parts.bodies[body].name}"
        yield LinkData.of_bearing(name, "bearings", (new[body], HOUSING), data, bearing=data)
    if gearset.held >= 0:
        support = stage.support_stiffness, stage.support_damping_ratio
        yield _holding("support", gearset.key, gearset.held, support, train, placed)


def links_of_speeds(
    scenario: Any, train: TrainKinematics, placed: PlacedTrain, given: Sequence[float]
) -> Iterator[LinkData]:
    """What keeps bodies at speeds of their own; `given` are the torques (N m) with which it drives them."""
    keeping = [(number, load) for number, load in enumerate(scenario.load) if load.speed_ratio is not None]
    for (number, load), torque in zip(keeping, given, strict=True):
        ratio = USUAL_DAMPING if load.damping_ratio is None else load.damping_ratio
        body, support = train.parts.body(load.at), (load.stiffness, ratio)
        holds = DRIVES if torque >= 0.0 else BRAKES
        yield _holding("drive", f"load.{number}", body, support, train, placed, holds)


def _holding(
    what: str,
    key: str,
    body: int,
    support: tuple[float | None, float],
    train: TrainKinematics,
    placed: PlacedTrain,
    holds: int = DRIVES,
) -> LinkData:
    """What holds a body at its nominal speed, by a stiffness, if it is given, and a damping ratio."""
    stiffness, ratio = support
    if stiffness is None:
        stiffness = USUAL_SUPPORT * _radius(body, train, placed) ** 2
    name, ends = f"{what}-{train.parts.bodies[body].name}", (train.numbers[body], HOUSING)
    nothing = 0.0, 0.0, 0.0
    return LinkData(name, key, ends, (0.0, 0.0, stiffness), nothing, (0.0, 0.0, ratio), holds=holds)


def behind(data: BearingData, stiffness: float) -> BearingData:
    """A bearing in series with a pin of a stiffness, N/m, in x and y."""
    x, y = (
        each * stiffness / (each + stiffness) if each else 0.0
        for each in (data.stiffness_x, data.stiffness_y)
    )
    return replace(data, stiffness_x=x, stiffness_y=y)


def _rim(gearset: SetPart, members: Mapping[str, int], train: TrainKinematics) -> RimData | None:
    rim, motion = gearset.table.ring_rim, train.motion
    if rim is None:
        return None
    ring, carrier = members[RING], members[CARRIER]
    m = next(m for m, ends in enumerate(zip(motion.driver, motion.driven, strict=True)) if ring in ends)
    (teeth,) = (
        abs(train.parts.gears[gear].teeth)
        for gear, body in zip(motion.gears[m], (motion.driver[m], motion.driven[m]), strict=True)
        if body == ring
    )
    against = motion.sense[ring] * motion.ratio[ring] - motion.sense[carrier] * motion.ratio[carrier]
    pins = rim.pins or 0
    rate = motion.rate[m] * pins / teeth * (1 if against > 0 else -1)
    radial = (rim.stiffness or 0.0) * (rim.pins or 1)
    tangential = radial if rim.tangential_stiffness is None else rim.tangential_stiffness * (rim.pins or 1)
    return RimData(rim.orders, (radial, tangential), rim.damping_ratio, pins, rate)


def _radius(body: int, train: TrainKinematics, placed: PlacedTrain) -> float:
    """Radius (m) of the pitch circle of a body; of a carrier that on which the pins are, else the largest."""
    radii = {}
    for mesh, gears in enumerate(train.motion.gears):
        path = placed.assemblies[mesh].path
        for gear, radius in zip(gears, (path.pinion_pitch_radius, path.gear_pitch_radius), strict=True):
            radii.setdefault(train.parts.gears[gear].body, abs(float(radius)))
    centre, new = placed.places.centres, train.numbers
    for gearset in train.parts.sets:
        carrier = gearset.members[CARRIER]
        radii[carrier] = float(np.hypot(*(centre[new[gearset.planets[0]]] - centre[new[carrier]])))
    return radii.get(body, max(radii.values()))


def set_data(gearset: SetPart, train: TrainKinematics, placed: PlacedTrain) -> SetData:
    """The set in the numbers of the train's order."""
    new, stage, centre = train.numbers, gearset.table, placed.places.centres
    further = [
        centre[new[body]] - centre[new[gearset.members[CARRIER]]] for body in gearset.planets[stage.planets :]
    ]
    members = {name: new[body] for name, body in gearset.members.items()}
    planets = tuple(new[body] for body in gearset.planets)
    carrier = None
    if stage.flexible_carrier is not None:
        key = f"{gearset.key}.flexible_carrier"
        carrier = carrier_of(key, stage.flexible_carrier, len(planets))
    return SetData(
        stage.name,
        gearset.key,
        members,
        planets,
        (*stage.placed, *(float(np.arctan2(y, x)) for x, y in further)),
        gearset.teeth,
        stage.held or "",
        stage.frame_forces,
        bool(stage.helix_angle),
        _rim(gearset, members, train),
        carrier,
    )
