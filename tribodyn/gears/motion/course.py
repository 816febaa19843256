"""How a run whose speed changes goes: where over its course forces and transmission error are largest.

Means are of a few mesh cycles each, so that a torque which accelerates the load is no vibration.
"""

import math
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.recorded.outputs import Sampled
from tribodyn.numerics.parameter import Variable
from tribodyn.post.cycles import CHANGING, amplitude_spectrum
from tribodyn.record.writer import RecordWriter

#: Mesh cycles of the slowest mesh in a row at least: orders are told to a half.
_CYCLES = 2.0


class CourseRow(NamedTuple):
    """A mesh over a few of its cycles."""

    time: float  # s, in their middle
    speed: float  # of the gear that drives the first mesh, rad/s
    factor: float  # largest over mean force, NaN where the mean is none
    order: float  # of the mesh, with the largest amplitude of the force
    swing: float  # of the transmission error about its straight course, m, peak to peak
    swing_order: float  # with its largest amplitude
    apart: float  # share of the time without contact


class RunCourse:
    """Takes in blocks of samples and sums up every few cycles of the first mesh."""

    def __init__(self, rates: list[float], samples: int, pitch_angle: float):
        self._rates, self._samples, self._pitch = rates, samples, pitch_angle
        self._cycles = math.ceil(_CYCLES / min(rates))
        self._held: list[tuple[np.ndarray, ...]] = []
        self.rows: list[list[CourseRow]] = [[] for _ in rates]

    def add(self, block: Sampled) -> None:
        """Take in the next samples."""
        first, count, size = 0, len(block.cycles), self._cycles * self._samples
        while first < count:
            last = min(count, first + size + 1 - sum(len(part[0]) for part in self._held))
            self._held.append(_taken(block, slice(first, last)))
            first = last
            if sum(len(part[0]) for part in self._held) == size + 1:
                self._conclude()

    def _conclude(self) -> None:
        time, torque, error, touching = map(np.concatenate, zip(*self._held, strict=True))
        self._held = [(time[-1:], torque[-1:], error[-1:], touching[-1:])]  # which begins the next row
        speed = self._cycles * self._pitch / float(time[-1] - time[0])
        at = float(time[0] + time[-1]) / 2.0
        along = np.linspace(0.0, 1.0, len(time))
        for m, rate in enumerate(self._rates):
            load = torque[:-1, m]
            mean = float(np.mean(load))
            largest = float(np.max(load * np.sign(mean))) / abs(mean) if mean else math.nan
            # about the straight course from the first sample to that which closes the cycles
            shaking, swinging = (
                (values - along * (values[-1] - values[0]))[:-1] for values in (torque[:, m], error[:, m])
            )
            orders = (self._order(values) / rate for values in (shaking, swinging))
            lost = 1.0 - float(np.mean(touching[:-1, m]))
            self.rows[m].append(
                CourseRow(at, speed, largest, next(orders), float(np.ptp(swinging)), next(orders), lost)
            )

    def _order(self, values: np.ndarray) -> float:
        """Order of the first mesh with the largest amplitude."""
        spectrum = amplitude_spectrum(values, self._samples)
        return float(spectrum.orders[1:][np.argmax(spectrum.amplitudes[1:])])

    def summary(self, m: int) -> dict[str, Any]:
        """What is said of a mesh: ends, and where it is largest; nothing of a run at one speed."""
        rows = self.rows[m]
        speeds = [row.speed for row in rows]
        if len(rows) < 2 or max(speeds) - min(speeds) < CHANGING * max(map(abs, speeds)):
            return {}
        course: dict[str, Any] = {"first_speed": speeds[0], "last_speed": speeds[-1]}
        swings = "transmission_error_peak_to_peak"
        for name, field, order in (("dynamic_factor", "factor", "order"), (swings, "swing", "swing_order")):
            finite_rows = [row for row in rows if math.isfinite(getattr(row, field))]
            if finite_rows:
                row = max(finite_rows, key=attrgetter(field))
                course[name] = {"value": getattr(row, field), **_place(row), "order": getattr(row, order)}
        apart = [row for row in rows if row.apart > 0.0]
        if apart:
            row = max(apart, key=lambda row: row.apart)
            course["contact_loss_fraction"] = {"value": row.apart, **_place(row)}
        return {"course": course}


def _place(row: CourseRow) -> dict[str, float]:
    return {"time": row.time, "speed": row.speed}


def _taken(block: Sampled, part: slice) -> tuple[np.ndarray, ...]:
    """Time, and of every mesh torque on the driven gear, transmission error and whether it touches."""
    meshes = block.meshes
    return (
        block.whole["time"][part],
        np.stack([mesh["driven_torque"][part] for mesh in meshes], axis=-1),
        np.stack([mesh["transmission_error_rotational"][part] for mesh in meshes], axis=-1),
        np.stack([np.any(mesh["normal_load"][part] > 0.0, axis=1) for mesh in meshes], axis=-1),
    )


# A run revolution by revolution of the gear that drives the first mesh: extremes and means, a row each.
#
# Of whole revolutions from the start. Samples are even in the phase of the mesh, so that means are over it.


REVOLUTION = Variable(("revolution",), "1", "revolution of the gear that drives the first mesh, from 1 on")
_ERROR, _LOAD = "transmission_error_rotational", "normal_load"
#: What a row has of a mesh: dataset of the motion, how it is taken together over samples and pairs, unit and
#: meaning.
_TAKEN: dict[str, tuple[str, str, str, str]] = {
    "transmission_error_mean": (_ERROR, "mean", "m", "mean of the rotational transmission error"),
    "transmission_error_rms": (
        _ERROR,
        "rms",
        "m",
        "root mean square of the transmission error about its mean",
    ),
    "transmission_error_min": (_ERROR, "min", "m", "minimum of the rotational transmission error"),
    "transmission_error_max": (_ERROR, "max", "m", "maximum of the rotational transmission error"),
    "normal_load_max": (_LOAD, "max", "N", "maximum normal load of a pair"),
    "hertz_pressure_max": ("hertz_pressure", "max", "Pa", "maximum Hertz pressure"),
    "film_thickness_min": ("central_film_thickness", "min", "m", "minimum central film thickness"),
    "flash_temperature_max": ("flash_temperature_rise", "max", "K", "maximum flash temperature rise"),
    "power_friction_mean": ("mesh_power_friction", "mean", "W", "mean power lost to sliding friction"),
}
PREFIX = "revolution_"


def of_revolutions(*, of_train: bool) -> dict[str, Variable]:
    """Datasets of revolutions by name; of a train over its meshes too."""
    dims = ("revolution", "mesh") if of_train else ("revolution",)
    return {
        PREFIX + name: Variable(dims, unit, f"{text}, by revolution")
        for name, (_, _, unit, text) in _TAKEN.items()
    }


def revolution_scale(revolutions: int) -> dict[str, np.ndarray]:
    """Values along the axis of so many revolutions; nothing where there are none."""
    return {"revolution": np.arange(1.0, revolutions + 1.0)} if revolutions else {}


class ByRevolution:
    """Takes in blocks of samples and puts a row into the record for every revolution that is complete."""

    def __init__(self, record: RecordWriter, meshes: int, revolution: int, samples: int, of_train: bool):
        self._record, self._of_train = record, of_train
        self._size, self._row = revolution * samples, 0
        self._parts: dict[str, list[np.ndarray]] = {name: [] for name, *_ in _TAKEN.values()}
        self._held, self._meshes = 0, meshes

    def add(self, block: Sampled) -> None:
        """Take in the next samples, the one that closes the run included, which begins no revolution."""
        first, count = 0, len(block.cycles)
        while first < count:
            last = min(count, first + self._size - self._held)
            part = slice(first, last)
            for name, parts in self._parts.items():
                parts.append(np.stack([_of_pairs(mesh[name][part], name) for mesh in block.meshes], axis=-1))
            self._held, first = self._held + last - first, last
            if self._held == self._size:
                self._conclude()

    def _conclude(self) -> None:
        whole = {name: np.concatenate(parts) for name, parts in self._parts.items()}
        row: dict[str, Any] = {}
        for name, (of, how, *_) in _TAKEN.items():
            values = _together(whole[of], how)
            row[PREFIX + name] = values if self._of_train else values[0]
        self._record.put(self._row, row)
        self._row, self._held = self._row + 1, 0
        self._parts = {name: [] for name in self._parts}


def _of_pairs(values: np.ndarray, name: str) -> np.ndarray:
    """Of pairs the one that counts; NaN where none does."""
    if values.ndim == 1:
        return values
    take = np.fmin if name == "central_film_thickness" else np.fmax
    return take.reduce(values, axis=1)


def _together(values: np.ndarray, how: str) -> np.ndarray:
    """Values (sample, mesh) as one number per mesh."""
    if how in ("min", "max"):
        return (np.fmin if how == "min" else np.fmax).reduce(values, axis=0)
    mean = np.mean(values, axis=0)
    return mean if how == "mean" else np.sqrt(np.mean((values - mean) ** 2, axis=0))
