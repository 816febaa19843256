"""From shares of the free keys' ranges to values, and to the cases that a candidate is evaluated by."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.design.candidates.deviations import Nominal, deviating
from tribodyn.studies.design.candidates.sources import in_unit, standing
from tribodyn.studies.design.case import DesignCase, Free

#: Values are written to this share of their range, so that what is written is what was evaluated.
_FINEST = 1e-7

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
    return np.array([share_of(one, standing(case.scenarios, one.keys[0])) for one in case.free])


def chosen(case: DesignCase, shares: Sequence[float] | np.ndarray) -> Overrides:
    """Values of all free keys at shares of their ranges."""
    return {
        key: value_at(one, share) for one, share in zip(case.free, shares, strict=True) for key in one.keys
    }


def cases_of(
    case: DesignCase,
    free: Mapping[str, Any],
    more: Mapping[str, Any] | None = None,
    alone: tuple[int, float] | None = None,
) -> list[Overrides]:
    """Overrides of the base scenario for every duty, and for every sample of the tolerances within it.

    Parameters
    ----------
    free : values of free keys; none: the base scenario as it stands
    more : further keys, for all
    alone : (number of a tolerance, deviation), optional
        Takes the place of all samples: the others do not deviate.
    """
    found = []
    rows = samples_of(case)
    if alone is not None:
        rows = [np.where(np.arange(len(case.tolerances)) == alone[0], alone[1], 0.0)]
    for duty in case.duties:
        nominal = Nominal(case, {**free, **duty.set, **(more or {})})
        for row in rows:
            deviated = dict(nominal.keys)
            for one, deviation in zip(case.tolerances, row, strict=True):
                deviated |= deviating(one, float(deviation), nominal)
            found.append(deviated)
    return found


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
    for place, one in enumerate(case.tolerances):
        if one.distribution == "normal":
            rows[:, place] = ndtri(points[:, place]) / 3.0
        elif one.distribution == "ends":
            rows[:, place] = np.sign(rows[:, place])
    return list(rows)


def shapes_gears(case: DesignCase) -> bool:
    """Whether free keys change the gears, not what is taken off their flanks alone."""
    keys = (key for one in case.free for key in one.keys)
    return any(key.startswith("drive.") and ".modification." not in key for key in keys)
