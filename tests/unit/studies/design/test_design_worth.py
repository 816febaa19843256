"""What a search makes of quantities, in plain loops: objectives, margins, samples."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.special import ndtr

from tribodyn.studies.design.candidates.candidates import samples_of
from tribodyn.studies.design.candidates.scoring import Scoring
from tribodyn.studies.design.case import (
    Constraint,
    DesignCase,
    Objective,
    RobustTable,
    Tolerance,
    WeightedDuty,
)
from tribodyn.studies.design.scenario import loaded_search

KEYS = ("drive.pinion.profile_shift", "drive.gear.profile_shift")
NAMES = "abc"


@cache
def loaded() -> DesignCase:
    free = [{"key": key, "from": -1.0, "to": 3.0} for key in KEYS]
    return loaded_search("load-contact-18-36", {"free": free, "minimise": "face_load_factor"}, {}).case


def case_with(**changed: Any) -> DesignCase:
    return replace(loaded(), **changed)


def linear_quantile(values: list[float], share: float) -> float:
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = min(int(place), len(ordered) - 2)
    return ordered[low] + (place - low) * (ordered[low + 1] - ordered[low])


def over_samples(values: list[float], over: str, share: float, sign: float) -> float:
    if over == "mean":
        return sum(values) / len(values)
    if over == "worst":
        return max(values) if sign > 0 else min(values)
    return linear_quantile(values, share if sign > 0 else 1.0 - share)


RNG = np.random.default_rng(17)


START, FOUND = (RNG.uniform(0.6, 4.0, (3, 4, 3)) for _ in range(2))
WEIGHTS = (1.0, 2.0, 3.5)


def rows_of(values: np.ndarray) -> list[dict[str, float]]:
    return [dict(zip(NAMES, map(float, row), strict=True)) for duty in values for row in duty]


@pytest.mark.parametrize("over", ["mean", "worst", "quantile"])
@pytest.mark.parametrize("over_duties", ["mean", "worst"])
def test_objectives_and_margins_in_plain_loops(over: str, over_duties: str):
    """Three duties of unequal weight, four samples, three figures; larger is worse for positive weights."""
    share = 0.7
    duties = tuple(WeightedDuty(weight, {}, "") for weight in WEIGHTS)
    objectives = (Objective("both", (("a", 0.7), ("b", -1.3))), Objective("-c", (("c", -2.0),)))
    constraints = (
        Constraint("a <= 3.1", "a", 1.0, 3.1),
        Constraint("b >= 2.2", "b", -1.0, 2.2),
        Constraint("c <= start", "c", 1.0, "start"),
    )
    case = case_with(
        duties=duties,
        over_duties=over_duties,
        objectives=objectives,
        constraints=constraints,
        robust=RobustTable(over=over, quantile=share, samples=4, seed=0),
    )
    scoring = Scoring(case, rows_of(START))
    found = scoring.score(rows_of(FOUND), 0.3)

    def figure(values: np.ndarray, name: str, sign: float) -> float:
        place = NAMES.index(name)
        each = [over_samples(list(duty[:, place]), over, share, sign) for duty in values]
        if over_duties == "mean":
            return sum(w * value for w, value in zip(WEIGHTS, each, strict=True)) / sum(WEIGHTS)
        return max(each) if sign > 0 else min(each)

    def first_at(values: np.ndarray) -> float:
        a = over_samples(list(values[:, 0]), over, share, 1.0) / figure(START, "a", 1.0)
        b = over_samples(list(values[:, 1]), over, share, -1.0) / figure(START, "b", 1.0)
        return 0.7 * a - 1.3 * b

    first = 0.7 * figure(FOUND, "a", 1.0) / figure(START, "a", 1.0)
    first -= 1.3 * figure(FOUND, "b", -1.0) / figure(START, "b", 1.0)
    assert found.objectives == pytest.approx((first, -2.0 * figure(FOUND, "c", -1.0)))
    assert found.by_duty == pytest.approx([first_at(values) for values in FOUND])
    assert found.quantities == pytest.approx({name: figure(FOUND, name, 1.0) for name in NAMES})
    assert scoring.at_start == pytest.approx({name: figure(START, name, 1.0) for name in NAMES})

    def worst(values: np.ndarray, name: str, sign: float) -> float:
        way = "quantile" if over == "quantile" else "worst"
        each = [over_samples(list(duty[:, NAMES.index(name)]), way, share, sign) for duty in values]
        return max(each) if sign > 0 else min(each)

    limit = worst(START, "c", 1.0)
    margins = [
        (3.1 - worst(FOUND, "a", 1.0)) / 3.1,
        (worst(FOUND, "b", -1.0) - 2.2) / 2.2,
        (limit - worst(FOUND, "c", 1.0)) / limit,
    ]
    assert found.margins == pytest.approx(margins)
    assert found.violation == pytest.approx(sum(max(0.0, -margin) for margin in margins))
    assert not found.feasible
    assert found.shape == 0.3
    assert scoring.constrained(rows_of(FOUND)) == pytest.approx(
        {
            "a <= 3.1": worst(FOUND, "a", 1.0),
            "b >= 2.2": worst(FOUND, "b", -1.0),
            "c <= start": worst(FOUND, "c", 1.0),
        }
    )


def test_samples_fill_their_distributions_evenly():
    tolerances = tuple(
        Tolerance("k", "k", 1.0, "", distribution) for distribution in ("uniform", "normal", "ends")
    )
    case = case_with(tolerances=tolerances, robust=RobustTable(samples=10, seed=4))
    uniform, normal, ends = np.array(samples_of(case)).T
    assert sorted(((uniform + 1.0) * 5.0).astype(int)) == list(range(10))
    assert sorted((ndtr(3.0 * normal) * 10.0).astype(int)) == list(range(10))
    assert sorted(ends) == [-1.0] * 5 + [1.0] * 5
    assert samples_of(case_with(tolerances=()))[0].size == 0
