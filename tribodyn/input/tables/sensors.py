"""Sensors of gears over time and the housing that they sit on: their tables, rules, and data in SI units."""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.fields import Angle, PartName
from tribodyn.input.quantity import (
    Column,
    CurveTable,
    InUnit,
    NotNegative,
    Number,
    Positive,
    Table,
    Text,
    csv_file,
    written,
)
from tribodyn.input.tables.housing_matrices import Matrices, SeatNames, SeatPlaces, Units
from tribodyn.input.units import Kind, NotAQuantity, to_si
from tribodyn.sensing.data import KINDS, HousingData, HousingMode, HousingTransfer, SensorData

MOST_SENSORS, MOST_MODES = 64, 200
Frequency = Annotated[float, InUnit(units.positive(units.ANGULAR_FREQUENCY), "20 kHz")]
#: Unit of a kind of sensor -> how a level of it is written.
_LEVELS = {
    "m/s2": Kind("acceleration", "m/s**2", "0.5 m/s**2", "not negative"),
    "N": units.not_negative(units.FORCE),
    "rad": units.not_negative(units.SMALL_ANGLE),
    "m": units.not_negative(units.DEVIATION),
    "N*m": units.not_negative(units.TORQUE),
    "Pa": units.not_negative(units.PRESSURE),
}
#: Names that a dataset beside the signals has.
_TAKEN = ("time", "reference_angle")


class Sensor(Table):
    """A sensor: what it measures, at what rate, and how noisy it is."""

    name: PartName
    kind: Literal[
        "acceleration", "force", "housing", "ring", "encoder", "transmission-error", "torque", "sound"
    ]
    at: Text | None = None
    direction: Literal["x", "y", "z"] = "y"
    angle: Angle = written("90 deg")
    window: Literal["hann", "hamming"] = "hann"
    rate: Frequency
    filter: Literal["kaiser", "none"] = "kaiser"
    noise: Text | None = Field(None, examples=["0.5 m/s**2"])
    snr: Annotated[float, Field(strict=True, ge=-300.0, le=300.0)] | None = None
    seed: Annotated[int, Field(strict=True, ge=0)] = 0
    full_scale: Text | None = Field(None, examples=["50 m/s**2"])
    bits: Annotated[int, Field(strict=True, ge=2, le=32)] | None = None


class Mode(Table):
    """A mode of the housing."""

    frequency: Annotated[float, InUnit(units.positive(units.ANGULAR_FREQUENCY), "1.2 kHz")]
    damping_ratio: Positive
    mass: Annotated[float, InUnit(units.positive(units.MASS), "30 kg")]
    shape: dict[PartName, tuple[Number, ...]]
    points: dict[PartName, Number]


class TransferTable(CurveTable):
    """A measured transfer function, real and imaginary part over frequency."""

    frequency: Annotated[Column, units.ANGULAR_FREQUENCY]
    real: Annotated[Column, units.ACCELERANCE]
    imaginary: Annotated[Column, units.ACCELERANCE]

    def response(self) -> tuple[tuple[float, ...], tuple[complex, ...]]:
        """Frequencies in Hz, and the complex response in 1/kg."""
        frequency, real, imaginary = self.in_si()
        return tuple((frequency / (2.0 * math.pi)).tolist()), tuple((real + 1j * imaginary).tolist())


class Transfer(Table):
    """A measured path from a bearing to a point."""

    point: PartName
    at: Text
    direction: Literal["x", "y", "z"]
    table: Annotated[TransferTable, csv_file("frequency", "real", "imaginary")]


class Housing(Table):
    """A housing by matrices, which acts back; or paths from bearings to its points, which do not."""

    matrices: Matrices | None = None
    units: Units | None = None
    seats: SeatNames = ()
    places: SeatPlaces = written({})
    held: SeatNames = ()
    damping_ratio: NotNegative = 0.02
    modes_up_to: Frequency = written("2 kHz")
    radiation_efficiency: Positive = 1.0
    mode: tuple[Mode, ...] = Field((), max_length=MOST_MODES)
    transfer: tuple[Transfer, ...] = Field((), max_length=MOST_MODES)


#: Its keys that have no meaning without `matrices`.
_OF_MATRICES = ("units", "seats", "places", "held", "damping_ratio", "modes_up_to", "radiation_efficiency")

Sensors = Annotated[tuple[Sensor, ...], Field(max_length=MOST_SENSORS)]


def level_in_si(sensor: Sensor, key: str) -> float | None:
    """A level of a sensor in the SI unit of its kind; raises NotAQuantity."""
    text = getattr(sensor, key)
    return None if text is None else to_si(text, _LEVELS[KINDS[sensor.kind].units])


def broken_sensor_rules(sensors: Sequence[Sensor], housing: Housing | None) -> Iterator[InputError]:
    """Go through what contradicts itself in the tables of sensors and housing."""
    names = [sensor.name for sensor in sensors]
    for number, sensor in enumerate(sensors):
        key = f"sensor.{number}"
        if sensor.name in _TAKEN or sensor.name in names[:number]:
            rule = "names a dataset beside the signals" if sensor.name in _TAKEN else "names two sensors"
            yield InputError(f"{key}.name", quoted(sensor.name), rule, "give it a name of its own")
        for level in ("noise", "full_scale"):
            try:
                if level_in_si(sensor, level) == 0.0 and level == "full_scale":
                    rule, remedy = "leaves nothing between −full_scale and full_scale", "leave it out"
                    yield InputError(f"{key}.{level}", quoted(sensor.full_scale or ""), rule, remedy)
            except NotAQuantity as error:
                yield InputError(f"{key}.{level}", quoted(getattr(sensor, level)), error.rule, error.remedy)
        if sensor.noise is not None and sensor.snr is not None:
            rule = "contradicts noise: one follows from the other"
            yield InputError(f"{key}.snr", f"{sensor.snr:g}", rule, "give the one or the other")
        if sensor.bits is not None and sensor.full_scale is None:
            rule = "missing: bits divide the range between −full_scale and full_scale"
            example = _LEVELS[KINDS[sensor.kind].units].example
            yield InputError(f"{key}.full_scale", None, rule, f'add full_scale = "{example}"')
        if sensor.kind == "housing" and (housing is None or not _has_points(housing)):
            rule = "missing: a sensor is on the housing"
            yield InputError("housing", None, rule, "add matrices, [[housing.mode]] or [[housing.transfer]]")
    if housing is not None and housing.matrices is None:
        for key in (key for key in _OF_MATRICES if key in housing.model_fields_set):
            rule = "is of a housing by matrices, and there is none"
            yield InputError(f"housing.{key}", None, rule, 'add matrices = "housing.h5", or leave it out')
    for number, mode in enumerate(housing.mode if housing else ()):
        for name, shape in mode.shape.items():
            if not 1 <= len(shape) <= 3:
                rule = f"has {len(shape)} numbers; a bearing moves in x, y and z"
                yield InputError(f"housing.mode.{number}.shape.{name}", None, rule, "give x and y")


def _has_points(housing: Housing) -> bool:
    return bool(housing.mode or housing.transfer or housing.matrices)


def sensors_of(sensors: Sequence[Sensor]) -> tuple[SensorData, ...]:
    """The sensors of a scenario that breaks no rule."""
    return tuple(
        SensorData(
            name=sensor.name,
            kind=sensor.kind,
            at=sensor.at,
            direction=sensor.direction,
            rate=float(f"{sensor.rate / (2.0 * math.pi):.12g}"),
            filter=sensor.filter,
            angle=sensor.angle,
            window=sensor.window,
            noise=level_in_si(sensor, "noise") or 0.0,
            snr=sensor.snr,
            seed=sensor.seed,
            bits=sensor.bits,
            full_scale=level_in_si(sensor, "full_scale"),
        )
        for sensor in sensors
    )


def housing_of(housing: Housing | None) -> HousingData:
    """The housing of a scenario that breaks no rule."""
    if housing is None:
        return HousingData()
    modes = tuple(
        HousingMode(
            mode.frequency / (2.0 * math.pi),
            mode.damping_ratio,
            mode.mass,
            dict(mode.shape),
            dict(mode.points),
        )
        for mode in housing.mode
    )
    paths = tuple(
        HousingTransfer(path.point, path.at, path.direction, *path.table.response())
        for path in housing.transfer
    )
    return HousingData(modes, paths)
