"""Drawn shafts and matrices of a train's bodies under the mean loads of their meshes.

A mesh is seen as a pair of gears is drawn: x along its pitch tangent, y from the driver's axis to the driven
one's, the driver turning clockwise. Where it turns counter-clockwise, seen from +z, that is the view from -z.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.data import BearingData, in_space
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.gears.drawn_system import DrawnSystem, ShaftData, check_room_of_shafts, starts
from tribodyn.gears.supports import (
    STILL,
    Five,
    GearSupport,
    GearSupports,
    matrix_support,
    mean_loads,
)
from tribodyn.geometry.modification import misalignment_of_tilts
from tribodyn.input.tables.bearings import DEFAULT, Bearing, bearing_of
from tribodyn.input.tables.drawn_shafts import DrawnShaft
from tribodyn.input.tables.housing_matrices import element_of
from tribodyn.input.tables.shafts import drawn_shafts, listed
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.drivetrain.duty import TrainDuty
from tribodyn.studies.motion.drivetrain.placed_train import PlacedTrain, TrainKinematics, tip_radius
from tribodyn.studies.motion.drivetrain.structure import OF_DRIVE, Structure
from tribodyn.studies.motion.planetary.in_space import on_pin
from tribodyn.train.elastic.superelement import SuperElement
from tribodyn.train.positions import frame_of

#: c_γ over the width, N/m²: 20 N/(mm µm) of steel, ISO 6336-1.
MESH_STIFFNESS = 20e9
#: Difference of the places of seats and bearings, over the distance of the bearings.
MISPLACED = 0.1


def supports_of_bodies(
    scenario: Any, train: TrainKinematics, placed: PlacedTrain, torques: tuple[float, ...]
) -> dict[int, GearSupport]:
    """What holds bodies whose bearings are matrices, or that tilt on pins, by their numbers.

    In x, y, z of the train; `torques` are those on the driven gears of all meshes, N m. Raises InputError
    where a body is not held under the load of its gears.
    """
    matrices = {
        number: (f"bearings.{train.parts.bodies[body].name}.matrix", bearing_of(bearing))
        for number, body in enumerate(train.motion.bodies)
        if (bearing := bearings_by_body(scenario, train.parts)[body]) is not None
        and bearing.matrix is not None
    }
    pinned = {
        train.numbers[planet]: on_pin(bearing_of(bearing), gearset.face_width)
        for gearset in train.parts.sets
        if gearset.table.helix_angle
        for planet in gearset.planets
        if (bearing := bearings_by_body(scenario, train.parts)[planet]) is not None
    }
    if not matrices and not pinned:
        return {}
    loads = _loads(train, placed, torques)
    held = {
        body: _on_pin(data, loads[body], _resisting(train, placed, body)) for body, data in pinned.items()
    }
    return held | {body: matrix_support(*support, loads[body]) for body, support in matrices.items()}


def _on_pin(data: BearingData, load: Float[Array, "5"], teeth: Float[Array, "2 2"]) -> GearSupport:
    """A planet of a helical set on its pin: what its teeth tilt it by, against which they lie too."""
    stiffness = np.array(in_space(data, 0.0)[0])
    tilts = np.linalg.solve(np.diag(stiffness[3:]) + teeth, load[3:])
    return GearSupport(data, (*(load[:3] / stiffness[:3]).tolist(), *tilts.tolist()))


def _resisting(train: TrainKinematics, placed: PlacedTrain, body: int) -> Float[Array, "2 2"]:
    """Stiffness of the meshes of a body against its tilts about x and y, N m/rad: c_γ b³/12 each.

    Of faces that carry over their whole width: a tilt opens the flanks by its part along the normal.
    """
    stiffness = np.zeros((2, 2))
    for mesh, ends in enumerate(zip(train.motion.driver, train.motion.driven, strict=True)):
        if body in ends:
            assembly, turn = placed.assemblies[mesh], _view(train, placed, mesh)
            angle = float(assembly.path.pressure_angle(0.0))
            normal = np.cos(angle) * turn[0] + np.sin(angle) * turn[1]
            opens = np.array([-normal[1], normal[0]])
            stiffness += MESH_STIFFNESS * float(assembly.common_width) ** 3 / 12.0 * np.outer(opens, opens)
    return stiffness


def drawn_system(
    scenario: Any, train: TrainKinematics, placed: PlacedTrain, duty: TrainDuty
) -> DrawnSystem | None:
    """The shafts that are drawn, under the mean loads; None: none.

    Raises InputError where a shaft penetrates a gear of another.
    """
    parts, motion, new = train.parts, train.motion, train.numbers
    drawn = drawn_shafts(scenario.shaft)
    _require_seats(scenario, list(drawn.values()))
    if not drawn:
        return None
    names = {shaft.gears[0]: shaft.name for shaft in listed(scenario.shaft)}
    carried = [
        {new[parts.body(name)]: place for name, place in drawing.placed(gear).items()}
        for gear, (_, drawing) in drawn.items()
    ]
    begin = starts(carried, list(zip(motion.driver, motion.driven, strict=True)))
    speed = duty.speed / float(motion.ratio[motion.input])
    shafts = []
    for (gear, (key, drawing)), bodies, start in zip(drawn.items(), carried, begin, strict=True):
        first = next(iter(bodies))
        x, y = placed.places.centres[first]
        turning = motion.sense[first], float(motion.ratio[first]) * speed
        points = tuple(bodies.items())
        name, centre = names.get(gear, gear), (float(x), float(y))
        shafts.append(ShaftData(name, key, drawing, points, centre, start, *turning))
    gears = [
        (
            gear.name,
            new[gear.body],
            tip_radius(train, placed.assemblies, number),
            float(gear.table.face_width),
        )
        for number, gear in enumerate(parts.gears)
    ]
    check_room_of_shafts(shafts, gears, placed.places.centres)
    loads = _loads(train, placed, duty.torques.driven)
    on_points = tuple(tuple(loads[body].tolist()) for shaft in shafts for body, _ in shaft.points)
    if scenario.housing is None or scenario.housing.matrices is None:
        return DrawnSystem(tuple(shafts), on_points)
    housing = element_of(scenario.housing)
    for shaft in shafts:
        for number, bearing in enumerate(shaft.drawing.bearing):
            if bearing.seat is not None and bearing.seat not in housing.seats:
                key = f"{shaft.key}.bearing.{number}.seat"
                raise unknown_name(key, bearing.seat, housing.seats, "seat of the housing")
    _check_places(shafts, housing)
    settings = scenario.housing.modes_up_to, scenario.housing.radiation_efficiency
    return DrawnSystem(tuple(shafts), on_points, housing, housing.digest, *settings)


def _check_places(shafts: Sequence[ShaftData], housing: SuperElement) -> None:
    """Raise InputError where seats are not as far apart, in x, y and z of the train, as their bearings."""
    places = dict(zip(housing.seats, housing.places, strict=True))
    found = [
        (f"{shaft.key}.bearing.{number}.seat", bearing.seat, (*shaft.centre, shaft.start + bearing.position))
        for shaft in shafts
        for number, bearing in enumerate(shaft.drawing.bearing)
        if bearing.seat is not None
    ]
    bearings = np.array([place for *_, place in found])
    seats = np.array([places[seat] for _, seat, _ in found])
    between = (seats - seats[0]) - (bearings - bearings[0])
    span = float(np.max(np.linalg.norm(bearings - bearings[0], axis=1)))
    worst = int(np.argmax(np.linalg.norm(between, axis=1)))
    if np.linalg.norm(between[worst]) <= MISPLACED * span:
        return
    key, seat, _ = found[worst]
    there, due = (
        ", ".join(f"{1e3 * value:.4g}" for value in each[worst] - each[0]) for each in (seats, bearings)
    )
    rule = f"is {there} mm from the seat {found[0][1]} in x, y, z, and its bearing {due} mm from that one"
    raise InputError(key, quoted(seat), rule, "give the housing in the axes of the train, z along the shafts")


def _require_seats(scenario: Any, drawn: list[tuple[str, DrawnShaft]]) -> None:
    """Raise InputError for seats without a housing by matrices, and for such a housing without seats."""
    seats = [
        f"{key}.bearing.{number}.seat"
        for key, drawing in drawn
        for number, bearing in enumerate(drawing.bearing)
        if bearing.seat is not None
    ]
    there = scenario.housing is not None and scenario.housing.matrices is not None
    if seats and not there:
        rule = "is a seat of a housing that is not given"
        raise InputError(seats[0], None, rule, 'add [housing] with matrices = "housing.h5", or leave it out')
    if there and not seats:
        rule = "no bearing sits in it"
        remedy = 'add seat = "A" to a [[shaft.drawn.bearing]], or leave the matrices out'
        raise InputError("housing.matrices", None, rule, remedy)


def supports_of_mesh(
    held: Mapping[int, GearSupport], train: TrainKinematics, placed: PlacedTrain, mesh: int
) -> GearSupports:
    """The same of the bodies of a mesh, as its pair of gears sees them; their bearings are the train's."""
    if not held:
        return GearSupports()
    turn = _view(train, placed, mesh)
    ends = [held.get(body) for body in (train.motion.driver[mesh], train.motion.driven[mesh])]
    moved = [_turned(turn, STILL if one is None else one.displacement) for one in ends]
    angle = float(placed.assemblies[mesh].path.pressure_angle(0.0))
    seen = [one and one._replace(displacement=moved[end], bearings=()) for end, one in enumerate(ends)]
    return GearSupports(seen[0], seen[1], misalignment_of_tilts((one[3:] for one in moved), angle), angle)


def _loads(train: TrainKinematics, placed: PlacedTrain, torques: tuple[float, ...]) -> Float[Array, "body 5"]:
    """Mean loads of all meshes on the bodies, at the middles of the gears' faces."""
    motion = train.motion
    loads = np.zeros((len(motion.bodies), 5))
    for mesh, torque in enumerate(torques):
        turn = _view(train, placed, mesh)
        both = mean_loads(placed.assemblies[mesh], torque)
        for body, load in zip((motion.driver[mesh], motion.driven[mesh]), both, strict=True):
            loads[body] += _turned(turn.T, load)
    return loads


def _view(train: TrainKinematics, placed: PlacedTrain, mesh: int) -> Float[Array, "3 3"]:
    """Directions of a mesh's pair of gears in those of the train, its rows; mirrored where a ring drives."""
    sense = train.motion.sense[train.motion.driver[mesh]]
    inwards = 1 if placed.assemblies[mesh].path.pinion_pitch_radius > 0.0 else -1
    along, across = frame_of(placed.places.azimuths[mesh], sense * inwards)
    return np.array([[*along, 0.0], [*across, 0.0], [0.0, 0.0, -float(sense)]])


def _turned(turn: Float[Array, "3 3"], values: Any) -> Five:
    """Three components of a vector, and the first two of a rotation whose third is 0, in other directions."""
    mirrored = np.sign(np.linalg.det(turn))
    one, two = turn @ np.asarray(values[:3]), mirrored * (turn @ np.array([*values[3:], 0.0]))
    return (*map(float, one), *map(float, two[:2]))


def bearings_by_body(scenario: Any, parts: Structure) -> list[Bearing | None]:
    """The bearings of every body: its own, else "default", else the gear's of a bearings file; None: none."""
    by_name = scenario.bearings.by_name
    default = by_name.get(DEFAULT, by_name.get(OF_DRIVE[1]))
    bearings: list[Bearing | None] = [default] * len(parts.bodies)
    for name, bearing in by_name.items():
        for body in parts.places.get(name, ()):
            bearings[body] = bearing
    return bearings
