"""Reads the record of a sweep: quantities over the varied parameters, windows of single cases."""

import tomllib
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from tribodyn.errors import harmless
from tribodyn.record import schema
from tribodyn.record.open_record import OpenRecord, attributes, harmless_data, open_file
from tribodyn.record.reader import Record
from tribodyn.record.sweep_schema import DONE, FAILED, OF_MESH, SWEEP, WAITING, VariedKey
from tribodyn.record.withheld_efficiency import warnings_in

#: A peak stands out by this share of its curve's range.
PROMINENCE = 0.05


class SweepRecord(OpenRecord):
    """The record of a sweep; cases that are not done hold NaN."""

    kind = SWEEP
    _made_by = "run the sweep again"

    def _check(self) -> None:
        if self._file.attrs.get("kind") != SWEEP:
            raise self.refused("not the record of a sweep", "name the record of a sweep")
        shape = tuple(self._file[name].shape[0] for name in self.dims)
        for name in (*self._of_cases, "status", "message"):
            dataset = self._file[name]
            if dataset.shape[: len(shape)] != shape:
                raise ValueError(f"{name} does not lie along {', '.join(self.dims)}")
            for dim, length in zip(dataset.dims, dataset.shape, strict=True):
                if dim[0].shape != (length,):
                    raise ValueError(f"{name} does not fit its scales")
            _ = self.units(name), self.long_name(name)
        schema.require_head(self.attrs)
        _ = self.message, self.parameters, self.directions, self.settings, self.scenario, self.summary
        _ = self.samples_per_cycle if "samples_per_cycle" in self.attrs else None

    def __getitem__(self, name: str) -> np.ndarray:
        """Return one dataset in SI units: the cases' dimensions first, in the order of `dims`."""
        return self._read(name)

    def of_cases(self, name: str) -> np.ndarray:
        """A dataset as it stands in the record, in a view of one mesh too."""
        return SweepRecord._read(self, name)

    def case(self, name: str, place: tuple[int, ...]) -> np.ndarray:
        """Return a dataset of the case at one place, without reading the others."""
        return self._read(name, place)

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the datasets over the cases."""
        yield from self._of_cases

    @cached_property
    def _of_cases(self) -> tuple[str, ...]:
        """Names of the datasets over the cases; a record of 0.1.0 does not list them."""
        if "datasets" in self.attrs:
            return tuple(str(self.attrs["datasets"]).split())
        return tuple(
            name
            for name, item in self._file.items()
            if isinstance(item, h5py.Dataset)
            and not item.is_scale
            and tuple(str(dim[0].name).lstrip("/") for dim in item.dims)[: len(self.dims)] == self.dims
        )

    @cached_property
    def quantities(self) -> tuple[str, ...]:
        """Names of the datasets that hold one number per case."""
        one_each = (name for name in self if self._file[name].ndim == len(self.dims))
        return tuple(name for name in one_each if self._file[name].dtype.kind == "f")

    @cached_property
    def kind_of_study(self) -> str:
        """Kind of the study that was swept."""
        return str(self.scenario.get("kind", ""))

    def meanings(self, name: str) -> dict[int, str]:
        """Words that the whole numbers of a dataset stand for."""
        attrs = self._file[name].attrs
        values, words = attrs["flag_values"], str(attrs["flag_meanings"]).split()
        return {int(value): word for value, word in zip(values, words, strict=True)}

    @cached_property
    def dims(self) -> tuple[str, ...]:
        """Names of the cases' dimensions."""
        return tuple(str(dim[0].name).lstrip("/") for dim in self._file["status"].dims)

    @cached_property
    def parameters(self) -> tuple[VariedKey, ...]:
        """The varied parameters, in the order of the dimensions."""
        return tuple(
            VariedKey(name, harmless(str(self._file[name].attrs["key"])), self.units(name), self._read(name))
            for name in self.dims
            if name != "direction"
        )

    @cached_property
    def listed(self) -> dict[str, np.ndarray]:
        """What is told of every case where these stand in a list, as in a data set; else nothing."""
        return {name: self._read(name) for name in str(self.attrs.get("coordinates", "")).split()}

    @cached_property
    def directions(self) -> tuple[str, ...]:
        """Senses in which the first parameter was followed; none where every case began by itself."""
        return tuple(self._read("direction")) if "direction" in self.dims else ()

    @cached_property
    def samples_per_cycle(self) -> int:
        """Samples in a mesh cycle of the window."""
        return int(self.attrs["samples_per_cycle"])

    @cached_property
    def settings(self) -> dict[str, Any]:
        """How the cases were brought to their windows."""
        return harmless_data(tomllib.loads(str(self.attrs["sweep"])))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Quantities of the whole sweep."""
        return attributes(self._file["summary"])

    def count(self) -> dict[str, int]:
        """Count cases by what became of them."""
        status = self["status"]
        states = {"done": DONE, "failed": FAILED, "waiting": WAITING}
        return {"cases": status.size, **{name: int(np.sum(status == code)) for name, code in states.items()}}

    def failures(self) -> list[tuple[dict[str, Any], str]]:
        """Give parameters and reason of every case that failed."""
        places = np.argwhere(self["status"] == FAILED)
        return [(self.at(tuple(place)), str(self.case("message", tuple(place)))) for place in places]

    def warnings(self) -> dict[str, int]:
        """What the cases' remarks warn of, and in how many cases."""
        return warnings_in(self["message"][self["status"] == DONE].tolist())

    def peaks(self) -> list[dict[str, Any]]:
        """Peaks of the quantities that a refined sweep watched, curve after curve, the highest first.

        Each has its `quantity`, where it is (`at`), its `value`, and `within`: how far from it, in the first
        parameter, the next values are. Values at the ends of the range are no peaks. None of other sweeps.
        """
        from scipy.signal import find_peaks

        maxima = []
        x = self.parameters[0].values
        for name in self.settings.get("refine", {}).get("by", []):
            curves = np.where(self["status"] == DONE, self[name], np.nan)
            for lane in np.ndindex(curves.shape[1:]):
                curve = curves[(slice(None), *lane)]
                finite = np.flatnonzero(np.isfinite(curve))
                if finite.size < 3:
                    continue
                least = PROMINENCE * max(np.ptp(curve[finite]), 1e-300)
                tops, _ = find_peaks(curve[finite], prominence=least)
                for top in sorted(tops, key=lambda top: -curve[finite[top]]):
                    before, place, after = finite[top - 1 : top + 2]
                    within = float(max(abs(x[place] - x[before]), abs(x[after] - x[place])))
                    at, value = self.at((int(place), *lane)), float(curve[place])
                    maxima.append({"quantity": name, "at": at, "value": value, "within": within})
        return maxima

    def at(self, place: tuple[int, ...]) -> dict[str, Any]:
        """Return the parameters, and the direction, of the case at a place."""
        scales = [*(parameter.values for parameter in self.parameters), np.array(self.directions)]
        return {
            name: scale[index].item() for name, scale, index in zip(self.dims, scales, place, strict=False)
        }


class SweepOfMesh(SweepRecord):
    """A sweep as one of its meshes sees it; it shares the open file of its record.

    Datasets are without the axis of meshes; those that are of every mesh too are of this one.
    """

    def __init__(self, record: SweepRecord, mesh: int) -> None:
        vars(self).update(vars(record))
        self._mesh = mesh

    def _read(self, name: str, part: Any = ...) -> np.ndarray:
        of_mesh = f"{name}{OF_MESH}"
        name = of_mesh if of_mesh in self else name
        values = super()._read(name, part)
        dims = self.dims_of(name)
        return values.take(self._mesh, dims.index("mesh") - len(dims)) if "mesh" in dims else values


def sweeps_of_meshes(records: Sequence[SweepRecord]) -> dict[str, list[SweepRecord]]:
    """The sweeps of every mesh by its name; under "" those of one mesh, and as older versions wrote them."""
    found: dict[str, list[SweepRecord]] = {}
    for record in records:
        if "mesh" not in record.dims_of("poincare_error"):
            found.setdefault("", []).append(record)
            continue
        for m, name in enumerate(map(str, record["mesh"])):
            found.setdefault(name, []).append(SweepOfMesh(record, m))
    return found


AnyRecord = Record | SweepRecord
"""A record of a run or of a sweep."""


def is_sweep(path: str | Path) -> bool:
    """Whether a file is the record of a sweep; InputError where it cannot be read at all."""
    with open_file(Path(path)) as file:
        named = [str(file.attrs.get(name)) for name in ("format", "kind")]  # whatever stands there
        return named == [schema.FORMAT, SWEEP]


def open_any(path: str | Path) -> AnyRecord:
    """Open a record of a run or of a sweep."""
    return SweepRecord(path) if is_sweep(path) else Record(path)
