"""A map of losses as its record holds it: drag over torque, speed and oil temperature, and the statics.

`torque` acts at the output: above 0 it resists the motion, below 0 the load drives. `speed` is the input's,
below 0 it turns the other way. `drag` is the loss as a torque at the input, power over |speed|, 0 or more. So
the input's torque in the direction of its motion is |ratio| × torque + drag, whichever end drives.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.record.open_record import OpenRecord

#: Axes of the drag behind that of sources.
AXES = ("oil_temperature", "torque", "speed")


class LossMap(NamedTuple):
    """Arrays in SI units; what a record does not hold is NaN or empty."""

    oil_temperature: np.ndarray  # K
    torque: np.ndarray  # N m
    speed: np.ndarray  # rad/s
    drag: np.ndarray  # (source, oil_temperature, torque, speed), N m at the input
    sources: tuple[str, ...]  # "P_VZP high: method"
    ratio: float  # speed of the output over that of the input, signed
    nominal_torque: float
    nominal_speed: float
    inertia_input: float  # of the whole gearbox, reflected
    inertia_output: float
    stiffness: np.ndarray  # (torque), N m/rad at the output with the input held
    backlash: float  # rad at the output
    meshes: tuple[str, ...]
    mesh_order: np.ndarray  # (mesh), cycles per turn of the input
    error_amplitude: np.ndarray  # (mesh, torque, harmonic), rad at the output
    error_phase: np.ndarray  # the same, rad
    interpolation: tuple[float, float]  # maximum and mean error of the map itself, share of the loss

    @property
    def total(self) -> np.ndarray:
        """Drag of all sources (oil_temperature, torque, speed), N m at the input."""
        return self.drag.sum(axis=0)

    @property
    def points(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Oil temperature, torque and speed at every point of `total`."""
        temperature, torque, speed = np.meshgrid(self.oil_temperature, self.torque, self.speed, indexing="ij")
        return temperature, torque, speed

    def at(self, oil_temperature: Any, torque: Any, speed: Any) -> np.ndarray:
        """Total drag between the points, linear along each axis; beyond an axis its end holds."""
        axes = self.oil_temperature, self.torque, self.speed
        return GridValues(axes, self.total)(oil_temperature, torque, speed)

    def torque_at_input(self) -> np.ndarray:
        """Torque at the input (oil_temperature, torque, speed), positive in the direction of its motion."""
        return abs(self.ratio) * self.torque[:, None] + self.total

    def efficiency(self) -> np.ndarray:
        """Power out over power in at every point, see `efficiency_of`."""
        return efficiency_of(abs(self.ratio) * self.torque[:, None], self.total)


def efficiency_of(load: Any, drag: Any) -> np.ndarray:
    """Power out over power in, whichever end drives; below 0: it drives from neither (self-locking).

    Of a load, reflected to the input as the drag is; below 0 it drives. NaN where no power is to be
    transmitted.
    """
    load, drag = np.broadcast_arrays(np.asarray(load, float), np.asarray(drag, float))
    with np.errstate(divide="ignore", invalid="ignore"):
        given = np.where(load > 0.0, load / (load + drag), (-load - drag) / -load)
    return np.where(load == 0.0, np.nan, given)


class GridValues(NamedTuple):
    """Values over a grid, as a function that is linear along each axis and constant beyond its ends."""

    axes: tuple[np.ndarray, ...]
    values: np.ndarray

    def __call__(self, *where: Any) -> np.ndarray:
        """Interpolate at places that broadcast."""
        places = np.broadcast_arrays(*(np.asarray(place, dtype=float) for place in where))
        corner, share = [], []
        for axis, place in zip(self.axes, places, strict=True):
            clipped = np.clip(place, axis[0], axis[-1])
            number = np.clip(np.searchsorted(axis, clipped, side="right") - 1, 0, max(len(axis) - 2, 0))
            width = np.diff(axis)[number] if len(axis) > 1 else 1.0
            corner.append(number)
            share.append((clipped - axis[number]) / width)
        result = np.zeros(places[0].shape)
        for corners in np.ndindex(*(min(len(axis), 2) for axis in self.axes)):
            weight = np.ones(places[0].shape)
            for upper, part in zip(corners, share, strict=True):
                weight = weight * (part if upper else 1.0 - part)
            result += weight * self.values[tuple(at + up for at, up in zip(corner, corners, strict=True))]
        return result


def is_map(record: OpenRecord) -> bool:
    """Whether a record holds a map of losses."""
    return "drag" in record and {"source", *AXES} <= set(record.dims_of("drag"))


def loss_map(record: Any) -> LossMap:
    """Read the map of a record; ValueError or KeyError where it is none, or not finite."""

    def array(name: str, *dims: str) -> np.ndarray:
        """A dataset with its axes in a given order."""
        have = record.dims_of(name)
        if sorted(have) != sorted(dims):
            raise ValueError(f"{name} has the axes {', '.join(have)}, not {', '.join(dims)}")
        return np.transpose(record[name], [have.index(dim) for dim in dims])

    def optional(name: str, *dims: str) -> np.ndarray:
        return array(name, *dims) if name in record else np.zeros((0,) * len(dims))

    def number(name: str) -> float:
        return float(record.attrs.get(name, np.nan))

    axes = {axis: array(axis, axis) for axis in AXES}
    drag = array("drag", "source", *AXES)
    for name, values in axes.items():
        if not len(values) or not np.all(np.diff(values) > 0.0):
            raise ValueError(f"{name} does not increase")
    if not np.all(np.isfinite(drag)) or np.any(drag < 0.0):
        raise ValueError("drag is not 0 or more throughout")
    ratio = number("ratio")
    if not np.isfinite(ratio) or ratio == 0.0:
        raise ValueError("the ratio is missing")
    texts = [array(f"source_{part}", "source") for part in ("term", "element", "method")]
    statics = ("mesh", "torque", "harmonic")
    return LossMap(
        axes["oil_temperature"],
        axes["torque"],
        axes["speed"],
        drag,
        tuple(f"{term} {element}: {method}" for term, element, method in zip(*texts, strict=True)),
        ratio,
        number("nominal_torque"),
        number("nominal_speed"),
        number("inertia_input"),
        number("inertia_output"),
        optional("stiffness_total", "torque"),
        float(record["backlash"]) if "backlash" in record else np.nan,
        tuple(map(str, optional("mesh", "mesh"))),
        optional("mesh_order", "mesh"),
        optional("transmission_error_output", *statics),
        optional("transmission_error_phase", *statics),
        (number("interpolation_error_max"), number("interpolation_error_mean")),
    )
