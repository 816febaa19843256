"""From shares of the free keys' ranges to values, and to the cases, with tolerances, of a candidate."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.families import family
from tribodyn.input.units import base_units
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.design.candidates.evaluation import loaded_source
from tribodyn.studies.design.candidates.sources import BASE, in_unit, standing
from tribodyn.studies.design.case import DRAWN, DesignCase, Free, Tolerance

#: Values are written to this share of their range, so that what is written is what was evaluated.
_FINEST = 1e-7
#: Names at the end of keys whose values are lists and curves: errors of each tooth, and along the profile.
PITCH_ERRORS, PROFILE_ERROR = "pitch_errors", "profile_error"
#: End of the key of the distance of axes, which is that of nominal teeth where a pair does not say it.
CENTRE_DISTANCE = ".centre_distance"
#: Points of a profile that deviates, and by how much of the path they go beyond its ends on either side.
POINTS, BEYOND = 7, 0.25

Overrides = dict[str, Any]
"""Dotted key to value as TOML has it."""


def value_at(free: Free, share: float) -> Any:
    """Value of a free key, as TOML has it, at a share 0 … 1 of its range."""
    share = min(1.0, max(0.0, float(share)))
    if free.choices:
        return free.choices[min(int(share * len(free.choices)), len(free.choices) - 1)]
    if free.whole:
        return round(free.low + share * (free.high - free.low))
    digits = int(np.ceil(-np.log10(_FINEST * (free.high - free.low))))
    number = round(free.low + share * (free.high - free.low), digits)
    number = min(free.high, max(free.low, number))
    return f"{number!r} {free.unit}" if free.unit else number


def number_of(free: Free, value: Any) -> float:
    """Number of a value for the record: SI; of a choice its place among the choices."""
    if free.choices:
        return float(free.choices.index(value))
    if free.unit:
        return float(str(value).split(maxsplit=1)[0]) * free.si
    return float(value)


def share_of(free: Free, value: Any) -> float:
    """Share of its range at which a free key has a value; 0.5 for none, the nearest end for one outside."""
    if free.choices:
        place = free.choices.index(value) if value in free.choices else len(free.choices) // 2
        return (place + 0.5) / len(free.choices)
    number = in_unit(value, free.unit, free.si)
    if number is None:
        return 0.5
    return min(1.0, max(0.0, (number - free.low) / (free.high - free.low)))


def start_of(case: DesignCase) -> Float[Array, " free"]:
    """Shares at which the base scenario stands."""
    return np.array([share_of(free, standing(case.scenarios, free.keys[0])) for free in case.free])


def shares_of(case: DesignCase, values: Mapping[str, Any]) -> Float[Array, " free"]:
    """Shares of the free keys' ranges at which a candidate's values are."""
    return np.array([share_of(free, values[free.keys[0]]) for free in case.free])


def chosen(case: DesignCase, shares: Sequence[float] | np.ndarray) -> Overrides:
    """Values of all free keys at shares of their ranges."""
    values: Overrides = {}
    for free, share in zip(case.free, shares, strict=True):
        values |= dict.fromkeys(free.keys, value_at(free, share))
    return values


def cases_of(
    case: DesignCase,
    free: Mapping[str, Any],
    more: Mapping[str, Any] | None = None,
    alone: tuple[int, float] | None = None,
) -> list[Overrides]:
    """Overrides of the base scenario for every duty, and for every sample of the tolerances within it.

    `free` are values of free keys, none: the base scenario as it stands; `more` are further keys, for all;
    `alone` is number and deviation of the one tolerance that deviates, in place of all samples.
    """
    cases = []
    if alone is None:
        rows = samples_of(case)
    else:
        rows = [np.where(np.arange(len(case.tolerances)) == alone[0], alone[1], 0.0)]
    for duty in case.duties:
        nominal = Nominal(case, {**free, **duty.set, **(more or {})})
        for row in rows:
            deviated = dict(nominal.keys)
            for tolerance, deviation in zip(case.tolerances, row, strict=True):
                deviated |= deviating(tolerance, float(deviation), nominal)
            cases.append(deviated)
    return cases


def samples_of(case: DesignCase) -> list[Float[Array, "..."]]:
    """Deviations of the tolerances, −1 … 1, of every sample: the same for every candidate.

    Those of a tolerance of every tooth are drawn anew for each tooth from the seed in their place.
    """
    if not case.tolerances:
        return [np.empty(0)]
    from scipy.special import ndtri
    from scipy.stats import qmc

    count, robust = len(case.tolerances), case.robust
    points = qmc.LatinHypercube(count, rng=np.random.default_rng(robust.seed)).random(robust.samples)
    rows = 2.0 * points - 1.0
    for place, tolerance in enumerate(case.tolerances):
        if tolerance.distribution == "normal":
            rows[:, place] = ndtri(points[:, place]) / 3.0
        elif tolerance.distribution == "ends":
            rows[:, place] = np.sign(rows[:, place])
    return list(rows)


def shapes_gears(case: DesignCase) -> bool:
    """Whether free keys change the gears, not what is taken off their flanks alone."""
    keys = (key for free in case.free for key in free.keys)
    return any(key.startswith("drive.") and ".modification." not in key for key in keys)


@dataclass
class Nominal:
    """A candidate under one duty, before anything deviates: its keys and their values."""

    case: DesignCase
    keys: Overrides

    def at(self, key: str) -> Any:
        """The value of a key; None where there is none."""
        return self.keys.get(key, standing(self.case.scenarios, key))

    @cached_property
    def _loaded(self) -> Any:
        try:
            return loaded_source(self.case.scenarios, BASE, self.keys).case
        except InputError:
            return None

    def gears(self, key: str) -> Assembly | None:
        """The pair put together, of a train one whose gear or stage has the key.

        None where there is none, for the evaluation to say why.
        """
        pairs = [self._loaded] if hasattr(self._loaded, "drive") else []
        for mesh in () if pairs else getattr(self._loaded, "meshes", ()):
            owners = mesh.key, *(self._loaded.gears[number].key for number in mesh.gears)
            pairs += [mesh.pair] if key.startswith(tuple(f"{owner}." for owner in owners)) else []
        try:
            return assemble(family(pairs[0].family), pairs[0].drive) if pairs else None
        except InputError:
            return None


def deviating(tolerance: Tolerance, deviation: float, nominal: Nominal) -> dict[str, Any]:
    """The keys that a tolerance changes, and their values; none without deviation.

    The deviation is −1 … 1; of what is drawn point by point, or numbers samples, it stands for a seed.
    """
    if deviation == 0.0:
        return {}
    if tolerance.distribution == DRAWN:
        return {tolerance.key: int(abs(deviation) * 2**20)}
    draw = np.random.default_rng(int(abs(deviation) * 2**52))
    if tolerance.key.endswith(PITCH_ERRORS):
        teeth = int(nominal.at(tolerance.key.replace(f"modification.{PITCH_ERRORS}", "teeth")))
        errors = draw.uniform(-tolerance.plus_minus, tolerance.plus_minus, teeth)
        return {tolerance.key: [f"{float(error)!r} {tolerance.unit}" for error in errors]}
    if tolerance.key.endswith(PROFILE_ERROR):
        return _profile(tolerance, draw, nominal)
    si = base_units(f"1 {tolerance.unit}") if tolerance.unit else None
    factor = si[0] if si else 1.0
    number = in_unit(nominal.at(tolerance.key), tolerance.unit, factor)
    if number is None and tolerance.key.endswith(CENTRE_DISTANCE):
        if (gears := nominal.gears(tolerance.key)) is not None:
            number = abs(float(gears.path.pinion_pitch_radius + gears.path.gear_pitch_radius)) / factor
    value = (number or 0.0) + deviation * tolerance.plus_minus
    return {tolerance.key: f"{value!r} {tolerance.unit}" if tolerance.unit else value}


def _profile(tolerance: Tolerance, draw: np.random.Generator, nominal: Nominal) -> dict[str, Any]:
    """A profile with an error drawn at points of the path, linear between, added to the one that stands."""
    if (gears := nominal.gears(tolerance.key)) is None:
        return {}
    start, end = (float(limit) for limit in gears.roll_limits)
    roll = np.linspace(start - BEYOND * (end - start), end + BEYOND * (end - start), POINTS)
    error = draw.uniform(-tolerance.plus_minus, tolerance.plus_minus, POINTS)
    if isinstance(nominal_profile := nominal.at(tolerance.key), Mapping):
        error_table, errors = (nominal_profile[name] for name in ("roll_angle", "error"))
        at = np.array(error_table["values"], dtype=float) * base_units(f"1 {error_table['unit']}")[0]  # pyright: ignore
        every = np.union1d(roll, at)
        factor = base_units(f"1 {errors['unit']}")[0] / base_units(f"1 {tolerance.unit}")[0]  # pyright: ignore
        error = np.interp(every, roll, error) + np.interp(every, at, np.array(errors["values"])) * factor
        roll = every
    return {
        tolerance.key: {
            "roll_angle": {"unit": "rad", "values": roll.tolist()},
            "error": {"unit": tolerance.unit, "values": error.tolist()},
        }
    }
