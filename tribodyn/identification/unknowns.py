"""Unknowns: keys of a scenario with their ranges, as shares of these and as values."""

import math
import tomllib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.input.names import same_key
from tribodyn.input.units import Kind, to_si_at
from tribodyn.input.vary import given_at, in_si, kind_at
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies import study_of
from tribodyn.studies.protocol.load import load_data

#: Unknowns at most: each takes two runs for a derivative.
MOST = 32


class Unknown(NamedTuple):
    """A number of the scenario, which one or several of its keys have."""

    name: str  # as it was given
    keys: tuple[str, ...]
    low: float  # SI
    high: float
    units: str  # SI; "1" of plain numbers
    start: float | None  # the scenario's own value, where that lies in the range

    def value(self, share: float) -> float:
        """The value at a share of the range."""
        return self.low + float(share) * (self.high - self.low)


def unknowns_of(case: Any, wanted: Mapping[Any, Any]) -> tuple[Unknown, ...]:
    """Read unknowns: key, or a tuple of keys that have one value, to a range (lowest, highest).

    Raises InputError for what is none, and for a key that the scenario does not know.
    """
    if not isinstance(wanted, Mapping) or not wanted:
        raise InputError("unknowns", None, "nothing is sought", 'write {"mesh.damping_ratio": (0.01, 0.2)}')
    if len(wanted) > MOST:
        raise InputError("unknowns", len(wanted), "too many at once", f"seek at most {MOST}")
    data = tomllib.loads(case.toml)
    table = study_of(data).table(data)
    unknowns = tuple(_unknown(key, limits, data, table) for key, limits in wanted.items())
    every = [same_key(key) for unknown in unknowns for key in unknown.keys]
    if twice := next((key for key in every if every.count(key) > 1), ""):
        raise InputError("unknowns", quoted(twice), "is sought twice", "name it once")
    case_at(case, unknowns, shares_of(unknowns))  # raises where the scenario does not know a key
    return unknowns


def _unknown(key: Any, limits: Any, data: Mapping[str, Any], table: Any) -> Unknown:
    keys = (key,) if isinstance(key, str) else key
    if not isinstance(keys, tuple) or not keys or not all(isinstance(each, str) for each in keys):
        remedy = 'write "mesh.damping_ratio", or a tuple of keys that have one value'
        raise InputError("unknowns", quoted(key), "is no key of a scenario", remedy)
    name = ", ".join(keys)
    limits = limits.tolist() if isinstance(limits, np.ndarray) else limits
    if not isinstance(limits, Sequence) or isinstance(limits, str) or len(limits) != 2:
        rule = "is due as (lowest, highest)"
        raise InputError(name, quoted(limits), f"its range {rule}", 'write ("0 um", "30 um")')
    kinds = [kind_at(table, each) for each in keys]
    kind = kinds[0]
    if any(each != kind for each in kinds):
        raise InputError(name, None, "keys of one unknown have one unit", "seek them apart")
    low, high = (_in_si(name, end, kind) for end in limits)
    if not low < high:
        raise InputError(name, f"{low:g} to {high:g}", "the range is empty", "write the lower end first")
    value = given_at(data, keys[0])
    try:
        start = None if value is None else _in_si(name, value, kind)
    except InputError:
        start = None
    units = kind.si.replace("**", "") if isinstance(kind, Kind) else "1"
    return Unknown(name, keys, low, high, units, start if start and low < start < high else None)


def _in_si(key: str, value: Any, kind: Any) -> float:
    value = value.item() if isinstance(value, np.generic) else value
    if isinstance(kind, Kind):
        # zero as the lower end of what has to be positive is as good a bound as any
        return to_si_at(key, value, kind._replace(allowed="any"))
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        with suppress(OverflowError):
            if math.isfinite(value):
                return float(value)
    raise InputError(key, quoted(value), "a number is due", "only numbers can be sought")


def case_at(case: Any, unknowns: Sequence[Unknown], shares: Float[Array, " unknown"]) -> Any:
    """The case with its unknowns at shares of their ranges; raises InputError as the scenario does."""
    changes = {
        key: in_si(unknown.value(share), unknown.units)
        for unknown, share in zip(unknowns, shares, strict=True)
        for key in unknown.keys
    }
    return load_data(tomllib.loads(case.toml), case.name, changes).case


def shares_of(unknowns: Sequence[Unknown]) -> Float[Array, " unknown"]:
    """Where the scenario's own values lie in the ranges; the middle where one lies outside."""
    return np.array(
        [0.5 if one.start is None else (one.start - one.low) / (one.high - one.low) for one in unknowns]
    )
