"""The temperature of the oil as an input: numbers of the laws over it, as cubics between points."""

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from tribodyn.dynamics.parameters import Model
from tribodyn.numerics.shapes import Array, Float

#: Error of a number between points, over the number, at most; of one that is a logarithm, of that.
TOLERANCE = 1e-6
#: Intervals at first and at most.
_FIRST, _MOST = 8, 64
#: Ratio of the largest to the smallest value from which a positive number is interpolated by its logarithm.
_STEEP = 2.0

#: Where a number stands in the model, and in C: (("meshes", 0, "film", "log_material"), …).
Path = tuple[str | int, ...]


class OilTable(NamedTuple):
    """Numbers of the model over the temperature of the oil."""

    nominal: float  # K; there the numbers are exact
    temperatures: Float[Array, " point"]  # evenly spaced, K
    paths: tuple[Path, ...]
    logarithmic: tuple[bool, ...]  # whether the values are logarithms of the numbers
    exact: Float[Array, " number"]  # the numbers at the nominal temperature
    values: Float[Array, "number point"]
    slopes: Float[Array, "number point"]  # of the values, 1/K
    error: float  # relative error of a number half-way between points, the largest

    def at(self, temperature: float) -> Float[Array, " number"]:
        """The numbers at a temperature, as the C code finds them."""
        if temperature == self.nominal:
            return self.exact
        found = CubicHermiteSpline(self.temperatures, self.values, self.slopes, axis=1)(temperature)
        return np.where(self.logarithmic, np.exp(found), found)


class UntabulatedError(Exception):
    """Why the temperature of the oil cannot be an input."""


def oil_table(
    model_at: Callable[[float], Model], nominal: float, limits: tuple[float, float], own: Model
) -> OilTable:
    """Tabulate the numbers that depend on the temperature; UntabulatedError where they are no numbers.

    `own` is the model at the nominal temperature. Intervals are halved until the numbers half-way between
    points, which become points then, are met.
    """
    exact = dict(_leaves(own))
    found: dict[float, dict[Path, Any]] = {}

    def read(temperatures: list[float]) -> None:
        for each in temperatures:
            found[each] = _numbers(model_at(each), exact)

    intervals = _FIRST
    read(np.linspace(*limits, intervals + 1).tolist())
    paths = tuple(path for path in next(iter(found.values())) if _varies(path, exact, found.values()))
    while True:
        table = _table(nominal, found, paths, exact)
        middles = (table.temperatures[1:] + table.temperatures[:-1]) / 2.0
        read(middles.tolist())
        error = 0.0
        for each in middles.tolist():
            there = np.array([found[each][path] for path in paths])
            off = np.abs(table.at(each) - there) / _magnitude(paths, there)
            error = max(error, float(np.max(off, initial=0.0)))
        intervals *= 2
        if error <= TOLERANCE or intervals > _MOST:
            return table._replace(error=error)


def _varies(path: Path, exact: dict[Path, Any], found: Iterable[dict[Path, Any]]) -> bool:
    """Whether a number depends on the temperature; one that is not there is NaN at all."""
    return any(each[path] != exact[path] and not math.isnan(each[path]) for each in found)


def _magnitude(paths: tuple[Path, ...], numbers: Float[Array, " number"]) -> Float[Array, " number"]:
    """What errors of numbers are over: the numbers themselves, 1 of those that are logarithms."""
    logarithms = [str(path[-1]).startswith("log_") for path in paths]
    return np.where(logarithms, 1.0, np.maximum(np.abs(numbers), 1e-300))


def _table(
    nominal: float, found: dict[float, dict[Path, Any]], paths: tuple[Path, ...], exact: dict[Path, Any]
) -> OilTable:
    temperatures = np.array(sorted(found))
    numbers = np.array([[found[each][path] for each in temperatures.tolist()] for path in paths])
    numbers = numbers.reshape(len(paths), len(temperatures))
    steep = tuple(bool(np.all(row > 0.0) and np.max(row) > _STEEP * np.min(row)) for row in numbers)
    values = numbers.copy()
    values[list(steep)] = np.log(numbers[list(steep)])
    slopes = CubicSpline(temperatures, values, axis=1)(temperatures, 1)
    own = np.array([exact[path] for path in paths])
    return OilTable(nominal, temperatures, paths, steep, own, values, slopes, math.nan)


def _numbers(model: Model, exact: dict[Path, Any]) -> dict[Path, float]:
    """Numbers of a model by their places; UntabulatedError where anything else differs from `exact`."""
    numbers: dict[Path, float] = {}
    found = dict(_leaves(model))
    if found.keys() != exact.keys():
        raise UntabulatedError("other laws are in use at other temperatures")
    for path, value in found.items():
        if np.ndim(value):
            if not np.array_equal(value, exact[path], equal_nan=True):
                raise UntabulatedError("the laws in use are tables of the solved contact")
        else:
            numbers[path] = float(value)
    return numbers


def _leaves(model: Model) -> Iterator[tuple[Path, Any]]:
    """Numbers and arrays of surfaces and laws, with their places."""

    def within(value: Any, path: Path) -> Iterator[tuple[Path, Any]]:
        if not isinstance(value, tuple):
            yield path, value
            return
        for name, item in zip(getattr(value, "_fields", range(len(value))), value, strict=True):
            yield from within(item, (*path, name))

    for number, mesh in enumerate(model.meshes):
        for part in ("surfaces", "film", "friction"):
            yield from within(getattr(mesh, part), ("meshes", number, part))
