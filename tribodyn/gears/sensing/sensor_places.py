"""What of a drive a sensor can be on, by name, and whether the sensors of a case are on it."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import pi
from typing import NamedTuple

from tribodyn.dynamics.parameters import Model
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.numerics.shapes import Array, Float
from tribodyn.sensing.data import DIRECTIONS, KINDS, HousingData, SensorData
from tribodyn.signals.lines import MESH, SignalLine
from tribodyn.signals.resampling import PASSED, REACH
from tribodyn.train.elastic.superelement import Radiation

#: Samples that a signal has at least.
FEWEST = 32
#: Places of a torque that every drive has.
DRIVE, OUTPUT, HOUSING = "drive", "output", "housing"


class RingPlaces(NamedTuple):
    """The planets of a stage as a ring, or the housing about it, sees them."""

    carrier: int  # body
    sense: int  # of its rotation, 1 counter-clockwise
    angles: tuple[float, ...]  # of the planets at the start, rad
    meshes: tuple[int, ...]  # of the ring with each


class Radiator(NamedTuple):
    """A housing that radiates."""

    moved: Float[Array, "own coordinate"]  # its coordinates by those of the model
    radiation: Radiation
    efficiency: float


@dataclass(frozen=True)
class Sensible:
    """What of a drive can be sensed, by name: numbers of bodies, links and meshes of its model."""

    bodies: Mapping[str, int]
    bearings: Mapping[str, int]  # links that hold bodies in the housing, by their bodies
    meshes: Mapping[str, int]
    shafts: Mapping[str, int]  # links that give way in rotation
    lines: tuple[SignalLine, ...]  # orders per turn of body 0
    reference: str  # name of body 0
    rings: Mapping[str, RingPlaces] = field(default_factory=dict)  # by stage
    #: of a housing by matrices: what moves its points and seats in x, y, z, (3, coordinate)
    structure: Mapping[str, Float[Array, "3 coordinate"]] = field(default_factory=dict)
    #: that radiates: what moves all its coordinates, and by what it does
    radiator: Radiator | None = None
    reactions: Mapping[str, int] = field(default_factory=dict)  # bearings of drawn shafts, by their names


class Placed(NamedTuple):
    """A sensor and the name of its place."""

    sensor: SensorData
    at: str


def placed(
    sensors: Sequence[SensorData],
    housing: HousingData,
    sensible: Sensible,
    model: Model,
    samples: int,
    cycles: int,
) -> tuple[Placed, ...]:
    """The sensors at their places.

    `samples` are those of a reference cycle, `cycles` of the run. Raises InputError for a place that is not
    there, a direction that its body does not move in, a rate that the mesh frequency or the run is not for.
    """
    placed_sensors = []
    for number, sensor in enumerate(sensors):
        key = f"sensor.{number}"
        placed_sensors.append(Placed(sensor, _place(key, sensor, housing, sensible)))
        _check_direction(key, placed_sensors[-1], sensible, model)
        _check_rate(key, sensor, sensible, model, samples, cycles)
    if any(sensor.kind == "housing" for sensor in sensors):
        _check_housing(housing, sensible, model)
    return tuple(placed_sensors)


def _places_of(sensor: SensorData, housing: HousingData, sensible: Sensible) -> Collection[str]:
    match sensor.kind:
        case "acceleration" | "encoder":
            return sensible.bodies
        case "force":
            return [*sensible.bearings, *sensible.reactions]
        case "housing":
            return dict.fromkeys([*sensible.structure, *housing.points])
        case "ring":
            return sensible.rings
        case "sound":
            return () if sensible.radiator is None else (HOUSING,)
        case "transmission-error":
            return sensible.meshes
        case _:
            return (DRIVE, OUTPUT, *sensible.shafts)


def _place(key: str, sensor: SensorData, housing: HousingData, sensible: Sensible) -> str:
    places, what = list(_places_of(sensor, housing, sensible)), KINDS[sensor.kind].place
    if sensor.at in places:
        return str(sensor.at)
    if not places:
        rule = f"needs {what}, and there is none"
        raise InputError(f"{key}.kind", quoted(sensor.kind), rule, "choose another kind of sensor")
    if sensor.at is not None:
        raise unknown_name(f"{key}.at", sensor.at, places, what.removeprefix("a ").removeprefix("an "))
    if len(places) > 1:
        rule = f"missing: the name of {what}"
        raise InputError(f"{key}.at", None, rule, f"name one of {', '.join(places)}")
    return places[0]


def _check_direction(key: str, placed: Placed, sensible: Sensible, model: Model) -> None:
    sensor, layout = placed.sensor, model.layout
    if sensor.kind not in ("acceleration", "force") or _on_shaft(placed.at, sensible, sensor.kind):
        return
    body = sensible.bodies[placed.at]
    moves = 3 if body < layout.spatial else 2 if body < layout.planar else 0
    if moves == 0:
        remedy = "give it a bearing, or use an encoder"
        raise InputError(f"{key}.at", quoted(placed.at), "only turns: no bearing holds it", remedy)
    if DIRECTIONS[sensor.direction] >= moves:
        rule = f"{placed.at} moves in x and y alone"
        raise InputError(f"{key}.direction", quoted(sensor.direction), rule, 'use "x" or "y"')


def _on_shaft(at: str, sensible: Sensible, kind: str = "force") -> bool:
    """Whether a place of forces is a bearing of a drawn shaft, which has one in every direction."""
    return kind == "force" and at not in sensible.bearings and at in sensible.reactions


def _check_rate(
    key: str, sensor: SensorData, sensible: Sensible, model: Model, samples: int, cycles: int
) -> None:
    shaft = model.operation.nominal_speed / (2.0 * pi)
    slowest = min(line.order * shaft for line in sensible.lines if line.sort == MESH)
    cycle = float(model.operation.pitch_angle / model.operation.nominal_speed)
    rate = f"{sensor.rate:g} Hz"
    if sensor.rate / 2.0 < slowest:
        rule = f"half of it is below the mesh frequency, {slowest:.5g} Hz: the teeth are not seen"
        least = _rounded_up(slowest / PASSED)
        raise InputError(f"{key}.rate", rate, rule, f'use at least "{least:g} Hz"')
    if samples / cycle < sensor.rate * (1.0 - 1e-9):
        rule = (
            f"gives {samples / cycle:.5g} samples of the motion in a second, fewer than the rate of the "
            f"sensor {sensor.name}, {rate}"
        )
        remedy = f"use at least {int(-(-sensor.rate * cycle // 1))}"
        raise InputError("output.samples_per_cycle", samples, rule, remedy)
    at_ends = 4.0 * REACH if sensor.filter == "kaiser" else 0.0
    if cycles * cycle * sensor.rate < FEWEST + at_ends:
        rule = f"last {cycles * cycle:.3g} s, too short for {FEWEST} samples at {rate} (sensor {sensor.name})"
        needed = int(-(-(FEWEST + at_ends) / (sensor.rate * cycle) // 1))
        raise InputError("solver.cycles", cycles, rule, f"run at least {needed}")


def _check_housing(housing: HousingData, sensible: Sensible, model: Model) -> None:
    for key, name, directions in _forces(housing):
        if name in sensible.rings:
            if directions != (0,):
                rule = "is a planetary stage, whose ring a mode moves by one number"
                raise InputError(key, quoted(name), rule, "give one number")
            continue
        if _on_shaft(name, sensible):
            continue
        if name not in sensible.bearings:
            places = [*sensible.bearings, *sensible.reactions, *sensible.rings]
            raise unknown_name(key, name, places, "body on a bearing")
        if 2 in directions and sensible.bodies[name] >= model.layout.spatial:
            raise InputError(key, quoted(name), f"{name} does not move along its axis", "give x and y alone")


def _forces(housing: HousingData) -> Iterator[tuple[str, str, tuple[int, ...]]]:
    for number, mode in enumerate(housing.modes):
        for name, shape in mode.shape.items():
            yield f"housing.mode.{number}.shape.{name}", name, tuple(range(len(shape)))
    for number, path in enumerate(housing.transfers):
        yield f"housing.transfer.{number}.at", path.at, (DIRECTIONS[path.direction],)


def _rounded_up(frequency: float) -> float:
    """A frequency with two digits that is no lower."""
    step = 10.0 ** (len(str(int(frequency))) - 2)
    return -(-frequency // step) * step
