"""Sensors and the housing that they may sit on, in SI units."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float

#: Directions of a sensor, and their places.
DIRECTIONS = {"x": 0, "y": 1, "z": 2}


class SensorKind(NamedTuple):
    """What a sensor measures."""

    units: str  # SI
    about: str  # of a dataset; "{at}" stands for its place, "{direction}" for its direction
    place: str  # what its place is: the name of …
    directed: bool = False  # whether it has a direction


KINDS: dict[str, SensorKind] = {
    "acceleration": SensorKind(
        "m/s2", "acceleration of {at} in {direction}, at its bearing, in the housing's axes", "a body", True
    ),
    "force": SensorKind(
        "N",
        "force of {at} on its bearing in {direction}, in the housing's axes",
        "a body on a bearing or a bearing of a shaft",
        True,
    ),
    "housing": SensorKind("m/s2", "acceleration of the housing's point {at}", "a point of [housing]"),
    "ring": SensorKind(
        "N",
        "forces of the ring's meshes of {at} along the pitch tangent, each weighted by its planet's place",
        "a planetary stage",
    ),
    "encoder": SensorKind(
        "rad", "rotation of {at} less a uniform one at its nominal speed, in its own sense", "a body"
    ),
    "transmission-error": SensorKind(
        "m", "transmission error of {at}, of the rotations of both gears", "a mesh"
    ),
    "sound": SensorKind(
        "Pa",
        "sound pressure at 1 m from a point source in a free field that radiates the power of the {at}",
        "a housing by matrices with area or radiation",
    ),
    "torque": SensorKind("N*m", "torque at {at}", "drive, output or a shaft that gives way"),
}


@dataclass(frozen=True)
class SensorData:
    """A sensor: what it measures and where, and what its electronics make of it."""

    name: str
    kind: str  # of `KINDS`
    at: str | None  # its place; None: the only one that there is
    direction: str  # "x", "y", "z"
    rate: float  # samples per second
    filter: str  # "kaiser": anti-alias, see `signals.resampling`; "none": values at the moments alone
    angle: float = 0.0  # of a place at a ring, counter-clockwise from x, rad
    window: str = "hann"  # of planets that pass it, see `passing`
    noise: float = 0.0  # RMS, in the unit of the kind
    snr: float | None = None  # dB; the signal's RMS about its mean over the noise's, in place of `noise`
    seed: int = 0
    bits: int | None = None  # of the converter; None: exact
    full_scale: float | None = None  # magnitude at which it clips, in the unit of the kind


@dataclass(frozen=True)
class HousingMode:
    """A mode of a housing."""

    frequency: float  # Hz, undamped
    damping_ratio: float
    mass: float  # modal, kg, with the shape as given
    #: what the mode moves a bearing by in x, y (and z), by its body; of a planetary stage what it moves the
    #: ring by at the sensor, one number
    shape: Mapping[str, tuple[float, ...]]
    points: Mapping[str, float]  # and the points of sensors, in their directions


@dataclass(frozen=True)
class HousingTransfer:
    """A measured transfer function: acceleration of a point over a force on a bearing."""

    point: str
    at: str  # bearing, by its body
    direction: str
    frequency: tuple[float, ...]  # Hz, increasing
    response: tuple[complex, ...]  # 1/kg; nothing beyond its ends


@dataclass(frozen=True)
class HousingData:
    """Paths from the bearings to points of a housing, which does not act back on the gears."""

    modes: tuple[HousingMode, ...] = ()
    transfers: tuple[HousingTransfer, ...] = ()

    @property
    def points(self) -> tuple[str, ...]:
        """Names of the points."""
        named = [name for mode in self.modes for name in mode.points]
        return tuple(dict.fromkeys([*named, *(path.point for path in self.transfers)]))

    def inputs(self, point: str) -> tuple[tuple[str, int], ...]:
        """Forces that move a point: what they act on, and their direction (0, 1, 2); of a stage 0 alone."""
        of_modes = [
            (name, direction)
            for mode in self.modes
            if mode.points.get(point)
            for name, moved in mode.shape.items()
            for direction in range(len(moved))
            if moved[direction]
        ]
        measured = [(path.at, DIRECTIONS[path.direction]) for path in self.transfers if path.point == point]
        return tuple(dict.fromkeys([*of_modes, *measured]))

    def transfer(
        self, point: str, force: tuple[str, int], frequency: Float[Array, " line"]
    ) -> Complex[Array, " line"]:
        """Acceleration of a point over a force, 1/kg, at frequencies in Hz.

        Of a mode −ω² φ_force φ_point/(m (ω_0² − ω² + 2 i ζ ω_0 ω)).
        """
        accelerance = np.zeros(len(frequency), dtype=complex)
        name, direction = force
        for mode in self.modes:
            shape = mode.shape.get(name, ())
            if direction >= len(shape):
                continue
            moved = shape[direction] * mode.points.get(point, 0.0) / mode.mass
            over = mode.frequency**2 - frequency**2 + 2j * mode.damping_ratio * mode.frequency * frequency
            accelerance -= moved * frequency**2 / over
        for path in self.transfers:
            if (path.point, path.at, DIRECTIONS[path.direction]) == (point, name, direction):
                accelerance += np.interp(frequency, path.frequency, path.response, left=0.0, right=0.0)
        return accelerance

    def memory(self) -> float:
        """Seconds after which its modes have forgotten a force, to e^−8."""
        return max((8.0 / (2.0 * np.pi * m.damping_ratio * m.frequency) for m in self.modes), default=0.0)
