"""A run revolution by revolution of the gear that drives the first mesh: extremes and means, a row each.

Of whole revolutions from the start. Samples are even in the phase of the mesh, so that means are over it.
"""

from typing import Any

import numpy as np

from tribodyn.gears.motion.samples import Sampled
from tribodyn.numerics.parameter import Variable
from tribodyn.record.writer import RecordWriter

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


def described(*, of_train: bool) -> dict[str, Variable]:
    """Datasets of revolutions by name; of a train over its meshes too."""
    dims = ("revolution", "mesh") if of_train else ("revolution",)
    return {
        PREFIX + name: Variable(dims, unit, f"{text}, by revolution")
        for name, (_, _, unit, text) in _TAKEN.items()
    }


def scale(revolutions: int) -> dict[str, np.ndarray]:
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
