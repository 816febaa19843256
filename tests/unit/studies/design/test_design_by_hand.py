"""What a search makes of figures, written out in plain loops; its methods on formulas, step by step."""

import math
from concurrent.futures import Future
from dataclasses import replace
from functools import cache
from importlib import import_module
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.special import ndtr

from tribodyn.errors import InputError
from tribodyn.studies.design import methods
from tribodyn.studies.design.candidates import evaluation as evaluating
from tribodyn.studies.design.candidates.archive import Archive, Evaluation, SpentError
from tribodyn.studies.design.candidates.candidates import (
    chosen,
    number_of,
    samples_of,
    share_of,
    start_of,
    value_at,
)
from tribodyn.studies.design.candidates.worth import Judge, Judged
from tribodyn.studies.design.case import Constraint, DesignCase, Duty, Free, Objective, Robust, Tolerance
from tribodyn.studies.design.layout import LOWER, UPPER
from tribodyn.studies.design.methods import front as fronts
from tribodyn.studies.design.methods import population
from tribodyn.studies.design.methods.every import count_of_all, every
from tribodyn.studies.design.methods.local import RADIUS, first_look, rounds, slopes_of, sobol, together
from tribodyn.studies.design.methods.views import Scalar
from tribodyn.studies.design.outcome import chosen_best, headline
from tribodyn.studies.design.run import _about, _why_none
from tribodyn.studies.design.short_form import loaded_search

KEYS = ("drive.pinion.profile_shift", "drive.gear.profile_shift")
F, G, H = "face_load_factor", "contact_ratio", "torque_residual"
NAMES = "abc"
LOCAL = import_module(first_look.__module__)


class Formulas:
    """Stands for the pool: figures are formulas of two keys; a text where one is not a number."""

    name, workers = "formulas", 1

    def __init__(self, **formulas: Any) -> None:
        self.formulas = formulas
        self.asked: list[tuple[float, ...]] = []

    def submit(self, several: Any) -> "Future[Any]":
        found: list[Any] = []
        for one in several:
            x = tuple(float(one.get(key, 0.0)) for key in KEYS)
            self.asked.append(x)
            values = {name: formula(*x) for name, formula in self.formulas.items()}
            found.append("undercut" if any(np.isnan(v) for v in values.values()) else values)
        future: Future[Any] = Future()
        future.set_result(found)
        return future


@cache
def loaded() -> DesignCase:
    free = [{"key": key, "from": -1.0, "to": 3.0} for key in KEYS]
    return loaded_search("load-contact-18-36", {"free": free, "minimise": F}, {}).case


def case_with(**changed: Any) -> DesignCase:
    search = replace_search(loaded(), changed.pop("search", {}))
    return replace(search, **changed)


def replace_search(case: DesignCase, changed: dict[str, Any]) -> DesignCase:
    return replace(case, search=case.search._replace(**changed))


def archive_of(formulas: Formulas, **changed: Any) -> Archive:
    case = case_with(**changed)
    judge = Judge(case, formulas.submit([{}] * len(case.duties)).result())
    archive = Archive(case, judge, formulas, lambda _: None, ())  # pyright: ignore[reportArgumentType]
    archive._shaped = False
    return archive


def x_of(one: Evaluation) -> tuple[float, ...]:
    return tuple(float(one.values[key]) for key in KEYS)


def shares_of(*x: float) -> np.ndarray:
    return (np.array(x) + 1.0) / 4.0


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


def test_shares_at_which_a_scenario_stands():
    case = case_with()
    expected = [
        (float(case.base["drive"][side].get("profile_shift", 0.0)) + 1.0) / 4.0 for side in ("pinion", "gear")
    ]
    found = start_of(case)
    assert found == pytest.approx(expected) or 0.5 in found
    assert chosen(case, [0.25, 0.75]) == {KEYS[0]: 0.0, KEYS[1]: 2.0}


def test_a_sobol_sequence_fills_the_cube_evenly():
    found = sobol(2, 16, 3)
    assert found.shape == (16, 2)
    for axis in (0, 1):  # one in each of sixteen parts
        assert sorted((found[:, axis] * 16).astype(int)) == list(range(16))
    assert sobol(3, 11, 3).shape == (11, 3)
    assert sobol(1, 1, 3).shape == (1, 1)
    assert not np.allclose(found, sobol(2, 16, 4))


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
    duties = tuple(Duty(weight, {}, "") for weight in WEIGHTS)
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
        robust=Robust(over, share, 4, 0),
    )
    judge = Judge(case, rows_of(START))
    found = judge.judged(rows_of(FOUND), 0.3)

    def figure(values: np.ndarray, name: str, sign: float) -> float:
        place = NAMES.index(name)
        each = [over_samples(list(duty[:, place]), over, share, sign) for duty in values]
        if over_duties == "mean":
            return sum(w * one for w, one in zip(WEIGHTS, each, strict=True)) / sum(WEIGHTS)
        return max(each) if sign > 0 else min(each)

    def first_at(values: np.ndarray) -> float:
        a = over_samples(list(values[:, 0]), over, share, 1.0) / figure(START, "a", 1.0)
        b = over_samples(list(values[:, 1]), over, share, -1.0) / figure(START, "b", 1.0)
        return 0.7 * a - 1.3 * b

    first = 0.7 * figure(FOUND, "a", 1.0) / figure(START, "a", 1.0)
    first -= 1.3 * figure(FOUND, "b", -1.0) / figure(START, "b", 1.0)
    assert found.objectives == pytest.approx((first, -2.0 * figure(FOUND, "c", -1.0)))
    assert found.by_duty == pytest.approx([first_at(one) for one in FOUND])
    assert found.figures == pytest.approx({name: figure(FOUND, name, 1.0) for name in NAMES})
    assert judge.at_start == pytest.approx({name: figure(START, name, 1.0) for name in NAMES})

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
    assert found.violation == pytest.approx(sum(max(0.0, -one) for one in margins))
    assert not found.feasible
    assert found.shape == 0.3
    assert judge.constrained(rows_of(FOUND)) == pytest.approx(
        {
            "a <= 3.1": worst(FOUND, "a", 1.0),
            "b >= 2.2": worst(FOUND, "b", -1.0),
            "c <= start": worst(FOUND, "c", 1.0),
        }
    )


def test_what_has_no_figures_is_worth_less_than_anything():
    constraints = (Constraint("b <= start", "b", 1.0, "start"), Constraint("a >= 0", "a", -1.0, 0.0))
    case = case_with(objectives=(Objective("a", (("a", 1.0),)),), constraints=constraints)
    judge = Judge(case, ["no teeth"])
    assert math.isinf(judge.limit(constraints[0]))
    good = judge.judged([{"a": -0.5, "b": 9.0}])
    assert (good.objectives, good.margins) == ((-0.5,), (1.0, -0.5))  # no limit is one that holds; a zero one
    assert good.violation == 0.5
    none = judge.judged(["undercut"], -0.25)
    assert (none.message, none.violation, none.feasible) == ("undercut", 10.25, False)
    assert np.all(np.isnan([*none.objectives, *none.by_duty]))
    assert none.margins == (-10.0, -10.0)
    assert judge.judged(["undercut"], 0.25).violation == 10.0
    assert judge.judged([{"a": 1.0}]).message == "it has no b"
    assert judge.constrained(["undercut"]) == {}
    assert judge.rows([{"a": 1.0, "b": 2.0}, {"b": 3.0, "c": 4.0}]) == [[{"b": 2.0}, {"b": 3.0}]]
    for missed, holds in ((0.9e-6, True), (1.2e-6, False)):
        assert Judged((0.0,), (3.0, -missed), (0.0,), {}).feasible is holds


def test_one_objective_under_a_bound_of_the_other():
    formulas = Formulas(**{F: lambda x, y: 4.0 + x, G: lambda x, y: -2.0 + x * y, H: lambda x, y: 5.0 + y})
    archive = archive_of(
        formulas,
        objectives=(Objective(F, ((F, 1.0),)), Objective(G, ((G, 1.0),))),
        constraints=(Constraint("h", H, 1.0, 8.0),),
    )
    archive.ask(shares_of(1.0, 2.0))  # 5, 0: a zero is no scale
    archive.ask(shares_of(-1.0, 2.5))
    view, other = Scalar(archive, 0, bound=-3.0), Scalar(archive, 1)
    assert view.scales == [5.0, 4.5]
    found = archive.ask(shares_of(2.0, 2.5))
    assert view.value(found) == pytest.approx(6.0 / 5.0)
    assert other.value(found) == pytest.approx(3.0 / 4.5)
    assert view.margins(found) == pytest.approx([(8.0 - 7.5) / 8.0, (-3.0 - 3.0) / 4.5])
    assert other.margins(found) == pytest.approx([0.5 / 8.0])
    assert view.merit(found) == pytest.approx(1e6 + 6.0 / 4.5, abs=1e-6)
    assert other.merit(found) == pytest.approx(3.0 / 4.5)
    two = Scalar(archive, 1, bound=6.5)
    assert two.margins(found)[-1] == pytest.approx((6.5 - 6.0) / 5.0)
    assert two.merits([shares_of(1.0, 2.0), shares_of(1.0, 1.0)]) == pytest.approx([0.0, -1.0 / 4.5])
    gone = Judged((math.nan, math.nan), (-10.0,), (math.nan,), {}, "undercut", -0.3)
    assert view.value(gone) > 1.0
    assert view.margins(gone) == [-0.3, -0.3, -0.3]
    assert view.merit(gone) == 1e6 + 10.3
    assert view.margins(gone._replace(shape=None)) == [-10.0, -10.0]
    assert view.margins(gone._replace(shape=0.2)) == [0.0, 0.2, 0.0]


def test_slopes_by_differences_are_those_of_linear_figures():
    """At both ends of a range too, where there is room on one side only; the range of a key is 4."""
    formulas = Formulas(**{F: lambda x, y: 4.0 + x - 3.0 * y, G: lambda x, y: 2.0 + 0.5 * x + 0.25 * y})
    archive = archive_of(formulas, constraints=(Constraint("g", G, -1.0, 1.6),))
    archive.ask(shares_of(0.0, 0.0))
    value, margins = slopes_of(Scalar(archive), None)
    for x in ((0.5, 0.3), (3.0, -1.0), (3.0, 2.0)):
        np.testing.assert_allclose(value(shares_of(*x)), np.array([4.0, -12.0]) / 4.0, rtol=1e-6)
        np.testing.assert_allclose(margins(shares_of(*x)), [[2.0 / 1.6, 1.0 / 1.6]], rtol=1e-6)
    taken = np.array(formulas.asked[2:]).reshape(3, 3, 2)
    away = taken[:, 1:] - taken[:, :1]
    assert np.all(np.abs(away) <= 0.02)
    assert np.all(away[1:, 0, 0] < 0.0)


def evaluations(count: int, feasible: bool = False) -> list[Evaluation]:
    """Made up: coarse numbers, so that some are equal."""
    rng = np.random.default_rng(5)
    found = []
    for number in range(count):
        first = float(rng.integers(2, 12))
        objectives = first, 14.0 - first + float(rng.integers(0, 4))
        margin = 1.0 if feasible or rng.uniform() > 0.3 else -0.5
        judged = Judged(objectives, (margin,), objectives[:1], {})
        found.append(Evaluation({"n": number}, (float(number),), [], judged))
    return found


def test_the_front_is_what_nothing_is_better_than():
    some = evaluations(60)
    feasible = {one.judged.objectives for one in some if one.judged.margins[0] > 0}
    expected = {
        one
        for one in feasible
        if not any(other != one and other[0] <= one[0] and other[1] <= one[1] for other in feasible)
    }
    found = fronts.front(some)
    assert [one.judged.objectives for one in found] == sorted(expected)
    assert len(expected) > 3
    for one in found:  # of equal ones the first
        assert one.numbers == min(
            i.numbers for i in some if i.judged.objectives == one.judged.objectives and i.judged.feasible
        )


def test_the_chosen_of_a_front_is_nearest_to_the_best_of_both():
    case = case_with(objectives=(Objective("a", (("a", 1.0),)), Objective("-b", (("b", -1.0),))))
    some = [
        Evaluation({KEYS[0]: n, KEYS[1]: 0.0}, (float(n),), [], Judged(objectives, (), (0.0,), {}))
        for n, objectives in enumerate([(1.0, 900.0), (1.35, 500.0), (1.5, 380.0), (2.0, 300.0)])
    ]
    judge = Judge(case, [{"a": 3.0, "b": 7.0}])
    archive: Any = SimpleNamespace(evaluations=some, judge=judge)
    # squares of the distances: 1, 0.1225 + 0.1111, 0.25 + 0.0178, 1
    best = chosen_best(case, archive)
    assert best is some[1]
    found = headline(case, archive)
    assert (found["objective_start"], found["objective"]) == ([3.0, 7.0], [1.35, -500.0])
    assert found["objective_name"] == "a and b"
    assert found["front"] == {
        "points": 4,
        "objective": [1.0, 1.35, 1.5, 2.0],
        "objective_2": [900.0, 500.0, 380.0, 300.0],
    }
    archive.evaluations = some[2:3]
    assert chosen_best(case, archive) is some[2]
    archive.evaluations = []
    assert chosen_best(case, archive) is None


def test_a_summary_counts_what_was_evaluated():
    def f(x: float, y: float) -> float:
        return math.nan if x > 2.0 else 4.0 + x + y

    duties = (Duty(1.0, {}, ""), Duty(3.0, {}, ""))
    archive = archive_of(Formulas(**{F: f}), duties=duties, constraints=(Constraint("f", F, 1.0, 6.5),))
    for x in ((0.0, 0.0), (2.5, 0.0), (2.0, 2.0), (1.0, 1.0), (-0.5, 0.25), (3.0, 1.0)):
        archive.ask(shares_of(*x))
    found = headline(archive.case, archive)
    assert (found["evaluations"], found["evaluations_without_figures"]) == (6, 2)
    assert found["evaluations_feasible"] == 3
    assert found["without_figures_message"] == "undercut"
    assert (found["objective_start"], found["objective"]) == (4.0, 3.75)
    assert found["duties"] == {"start": [4.0, 4.0], "best": [3.75, 3.75]}
    assert found["constraints_best"] == {"f": 3.75}
    assert found["figures_start"] == {F: 4.0}
    best, nearest = archive.best(), archive.nearest()
    assert best is not None
    assert nearest is not None
    assert x_of(best) == (-0.5, 0.25)
    assert nearest.judged.violation == 0.0


def test_why_there_is_no_best():
    formulas = Formulas(**{F: lambda x, y: 4.0 + x, G: lambda x, y: 2.0 + y})
    constraints = (Constraint("f low", F, 1.0, 2.0), Constraint("g high", G, -1.0, 1.0))
    archive = archive_of(formulas, constraints=constraints)
    assert "none was evaluated" in _why_none(archive.case, archive)
    for x in (2.0, -1.0, 1.0):
        archive.ask(shares_of(x, 0.5))
    said = _why_none(archive.case, archive)  # 3 where 2 is the most
    assert said.endswith(f"{KEYS[0]} = -1.0, {KEYS[1]} = 0.5, misses f low by 50 %")
    without: Any = [
        SimpleNamespace(judged=Judged((), (), (), {}, message)) for message in ("pointed", "undercut")
    ]
    archive.evaluations[:] = without
    assert _why_none(archive.case, archive) == "no candidate has figures: undercut"


def test_about_the_best_every_key_and_tolerance_moves_alone():
    formulas = Formulas(**{F: lambda x, y: 4.0 + x + 10.0 * y})
    tolerances = (Tolerance(KEYS[0], "x", 0.5, "", "uniform"), Tolerance(KEYS[1], "y", 0.25, "", "uniform"))
    archive = archive_of(formulas, tolerances=tolerances, confirm={KEYS[1]: 2.0}, sensitivities=True)
    archive.ask(shares_of(1.0, 3.0))
    best = archive.evaluations[0]
    put: dict[tuple[int, str], float] = {}
    record: Any = SimpleNamespace(put=lambda place, row: put.update({(place, n): v for n, v in row.items()}))
    known = {(0, LOWER): 123.0}
    pool: Any = formulas
    confirmed = _about(archive.case, archive, pool, best, known, record)
    assert put.pop((0, LOWER)) == 123.0
    middle = best.judged.objectives[0]  # over samples whose mean is not zero
    moved = put[0, UPPER] - middle
    assert 0.0 < moved < 1.0
    # as far to the lower side, ten times as steep; no room above
    assert put[1, LOWER] == pytest.approx(middle - 10.0 * moved, rel=1e-6)
    assert put[1, UPPER] == middle
    assert [put[2, LOWER], put[2, UPPER], put[3, LOWER], put[3, UPPER]] == pytest.approx(
        [34.5, 35.5, 32.5, 37.5]
    )
    assert len(put) == 7
    assert (confirmed["objective_start_confirmed"], confirmed["objective_confirmed"]) == (
        pytest.approx(4.0 + 20.0 + middle - 35.0),
        pytest.approx(5.0 + 20.0 + middle - 35.0),
    )


def test_the_first_look_takes_the_best_apart_from_each_other():
    def f(x: float, y: float) -> float:
        return 5.0 + math.sin(3.0 * x) + math.cos(2.0 * y + 1.0) + 0.1 * x

    for most, starts in ((40, 3), (400, 4)):
        formulas = Formulas(**{F: f})
        archive = archive_of(formulas, search={"evaluations": most, "starts": starts})
        places = first_look(Scalar(archive), shares_of(0.2, -0.3))
        asked = formulas.asked[1:]
        assert len(asked) == min(round(0.3 * most), 20)  # ten per key at most
        assert asked[0] == pytest.approx((0.2, -0.3))
        taken: list[np.ndarray] = []
        for x in sorted(asked, key=lambda one: f(*one)):
            if all(max(abs(shares_of(*x) - other)) > 0.225 for other in taken):
                taken.append(shares_of(*x))
        np.testing.assert_allclose(places, taken[:starts], atol=1e-5)


def test_searches_from_the_best_go_on_as_long_as_they_gain(monkeypatch: pytest.MonkeyPatch):
    """Each at half the radius; one that gains a thousandth no more is the last."""
    archive = archive_of(Formulas(**{F: lambda x, y: 4.0 + x}), search={"accuracy": 1e-3})
    archive.ask(shares_of(0.0, 0.0))
    steps = iter([0.5, 0.8, 0.801, 0.9])
    seen: list[Any] = []

    def minimise(name: str, view: Scalar, place: np.ndarray, radius: float) -> None:
        seen.append((name, *place * 4.0 - 1.0, radius))
        view.archive.ask(shares_of(-next(steps), 0.0))

    monkeypatch.setattr(LOCAL, "minimise", minimise)
    rounds("some", Scalar(archive))
    assert [one[0] for one in seen] == ["some"] * 3
    np.testing.assert_allclose([one[1] for one in seen], [0.0, -0.5, -0.8], atol=1e-6)
    radii = np.array([one[3] for one in seen])
    np.testing.assert_allclose(radii[:-1] / radii[1:], 2.0)
    assert radii[0] == RADIUS / 2.0


def test_searches_from_the_best_end_at_the_accuracy(monkeypatch: pytest.MonkeyPatch):
    archive = archive_of(Formulas(**{F: lambda x, y: 4.0 + x}), search={"accuracy": RADIUS / 5.0})
    archive.ask(shares_of(0.0, 0.0))
    seen: list[float] = []

    def minimise(_: str, view: Scalar, __: np.ndarray, radius: float) -> None:
        seen.append(radius)
        view.archive.ask(shares_of(-0.1 * len(seen), 0.0))

    monkeypatch.setattr(LOCAL, "minimise", minimise)
    rounds("some", Scalar(archive))
    assert seen == [RADIUS / 2.0, RADIUS / 4.0]


def test_side_by_side_searches_have_equal_shares():
    archive = archive_of(Formulas(**{F: lambda x, y: 4.0 + x}), search={"evaluations": 21})
    archive.ask(shares_of(0.0, 0.0))
    taken: dict[int, int] = {}

    def greedy(number: int) -> Any:
        def search() -> None:
            for step in range(30):
                archive.ask(shares_of(0.01 * step, 0.1 * number + 0.05))
                taken[number] = step + 1

        return search

    together(archive, [greedy(number) for number in range(3)])
    assert taken == {0: 7, 1: 7, 2: 6}
    assert archive.room == 0
    with pytest.raises(SpentError):
        archive.ask(shares_of(0.9, 0.9))
    archive.ask(shares_of(0.0, 0.0))  # what is known costs nothing


def test_bounds_between_the_ends_of_a_front(monkeypatch: pytest.MonkeyPatch):
    """Evenly between the second objectives of both ends; a search begins at the best that keeps its bound."""
    formulas = Formulas(**{F: lambda x, y: 4.0 + x, H: lambda x, y: 6.0 - x + abs(y)})
    archive = archive_of(
        formulas,
        objectives=(Objective(F, ((F, 1.0),)), Objective(H, ((H, 1.0),))),
        search={"evaluations": 80, "points": 5},
    )
    seen: list[Any] = []

    def minimise(name: str, view: Scalar, place: np.ndarray, most: int) -> None:
        seen.append((name, view.objective, view.bound, *(place * 4.0 - 1.0), most))
        if view.bound is None:
            x = -1.0 if view.objective == 0 else 3.0
            view.archive.ask(shares_of(x, 0.0))

    monkeypatch.setattr(fronts, "minimise", minimise)
    fronts.epsilon_constraint(archive, shares_of(0.2, 0.1))
    assert [one[:3] for one in seen[:2]] == [("cobyqa", 0, None), ("cobyqa", 1, None)]
    found = fronts.front(archive.evaluations)
    assert (found[0].judged.objectives, found[-1].judged.objectives) == ((3.0, 7.0), (7.0, 3.0))
    assert [one[2] for one in seen[2:]] == pytest.approx([6.0, 5.0, 4.0])
    assert {one[-1] for one in seen} == {80 // 6}
    for _, objective, bound, x, y, _ in seen[2:]:
        keeping = [one for one in found if one.judged.objectives[1] <= bound]
        best = min(keeping, key=lambda one: one.judged.objectives[0])
        assert objective == 0
        assert (x, y) == pytest.approx(x_of(best), abs=1e-6)


def test_every_combination_is_tried_once():
    free = (
        Free((KEYS[0],), "x", 2.0, 5.0, whole=True),
        Free((KEYS[1],), "y", 0.0, 2.0, choices=("0.5", "1.5", "2.5")),
    )
    formulas = Formulas(**{F: lambda x, y: 4.0 + x})
    archive = archive_of(formulas, free=free)
    assert count_of_all(archive.case) == 12
    assert count_of_all(loaded()) == math.inf
    every(archive, np.zeros(2))
    expected = {(x, y) for x in (2.0, 3.0, 4.0, 5.0) for y in (0.5, 1.5, 2.5)}
    assert set(formulas.asked[1:]) == expected
    assert len(formulas.asked) == 13


def test_numbers_and_shares_of_values():
    whole = Free(("k",), "k", 17.0, 21.0, whole=True)
    choice = Free(("k",), "k", 0.0, 2.0, choices=("a", "b", "c"))
    length = Free(("k",), "k", 2.0, 7.0, "mm", 1e-3, "m")
    plain = Free(("k",), "k", -0.5, 1.5)
    assert [value_at(whole, one) for one in (-1.0, 0.0, 0.3, 0.5, 0.9, 2.0)] == [17, 17, 18, 19, 21, 21]
    assert [share_of(whole, one) for one in (16, 18, 21, 30)] == [0.0, 0.25, 1.0, 1.0]
    assert [value_at(choice, one) for one in (0.0, 0.32, 0.34, 0.66, 0.67, 1.0)] == list("aabbcc")
    assert [share_of(choice, one) for one in "abcd"] == pytest.approx([1 / 6, 0.5, 5 / 6, 0.5])
    assert [number_of(choice, one) for one in "abc"] == [0.0, 1.0, 2.0]
    assert value_at(length, 0.3) == "3.5 mm"
    assert number_of(length, "3.5 mm") == pytest.approx(3.5e-3)
    assert share_of(length, "0.35 cm") == pytest.approx(0.3)
    assert share_of(length, None) == 0.5
    assert (value_at(plain, 0.25), number_of(plain, 0.4), share_of(plain, 0.5)) == (0.0, 0.4, 0.5)
    fine = Free(("k",), "k", 0.0, 3e-5)
    assert value_at(fine, 1 / 3) == pytest.approx(1e-5, rel=1e-6)


def test_samples_fill_their_distributions_evenly():
    tolerances = tuple(Tolerance("k", "k", 1.0, "", one) for one in ("uniform", "normal", "ends"))
    case = case_with(tolerances=tolerances, robust=Robust(samples=10, seed=4))
    uniform, normal, ends = np.array(samples_of(case)).T
    assert sorted(((uniform + 1.0) * 5.0).astype(int)) == list(range(10))
    assert sorted((ndtr(3.0 * normal) * 10.0).astype(int)) == list(range(10))
    assert sorted(ends) == [-1.0] * 5 + [1.0] * 5
    assert samples_of(case_with(tolerances=()))[0].size == 0


METHODS = [
    ("auto", 2, 1, "", "cobyqa"),
    ("auto", 7, 1, "", "cobyqa"),
    ("auto", 7, 1, "slopes", "slsqp"),
    ("auto", 6, 1, "slopes", "cobyqa"),
    ("auto", 2, 2, "", "epsilon-constraint"),
    ("auto", 2, 2, "whole", "nsga2"),
    ("auto", 2, 1, "whole", "every"),
    ("auto", 2, 1, "many", "differential-evolution"),
    ("auto", 2, 1, "mixed", "differential-evolution"),
    ("slsqp", 2, 1, "", "slsqp"),
    ("slsqp", 2, 2, "", "takes one objective|one objective"),
    ("nsga2", 2, 1, "", "needs two objectives"),
    ("nsga2", 2, 2, "", "nsga2"),
    ("every", 2, 2, "whole", "every"),
    ("every", 2, 1, "many", "more values than"),
    ("cobyqa", 2, 1, "whole", "whole numbers and choices"),
    ("cma-es", 2, 1, "whole", "cma-es"),
]


@pytest.mark.parametrize(("wanted", "keys", "objectives", "what", "expected"), METHODS)
def test_the_method_that_fits(
    wanted: str, keys: int, objectives: int, what: str, expected: str, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(methods, "derivatives_of", lambda _: object() if what == "slopes" else None)
    monkeypatch.setattr(methods, "find_spec", lambda _: object())  # whether or not packages are installed
    free = [Free(("k",), "k", 0.0, 9.0, whole=what in ("whole", "many")) for _ in range(keys)]
    if what == "mixed":
        free[1] = Free(("k",), "k", 0.0, 1.0, choices=("a", "b"))
    case = case_with(
        free=tuple(free),
        objectives=tuple(Objective(n, ((n, 1.0),)) for n in "ab"[:objectives]),
        search={"method": wanted, "evaluations": 99 if what == "many" else 100},
    )
    if " " in expected:
        with pytest.raises(InputError, match=expected):
            methods.method_of(case)
    else:
        assert methods.method_of(case)[0] == expected


def test_a_generation_has_the_start_in_it():
    """Of differential evolution; and no candidate comes from outside the ranges."""
    formulas = Formulas(**{F: lambda x, y: 4.0 + (x - 1.0) ** 2 + y * y})
    archive = archive_of(formulas, search={"evaluations": 50})
    population.differential_evolution(archive, shares_of(0.3, 0.7))
    assert formulas.asked[1] == pytest.approx((0.3, 0.7))
    assert len(formulas.asked) == 51
    assert all(-1.0 <= one <= 3.0 for x in formulas.asked for one in x)


def test_what_is_given_takes_the_place_of_what_stands_there(monkeypatch: pytest.MonkeyPatch):
    """A speed or a load that is given takes the place of that of the base scenario."""
    base = {"kind": "gear-pair", "operating": {"pinion_speed": "3 rad/s", "gear_torque": "4 N*m"}}
    seen: list[Any] = []
    monkeypatch.setattr(evaluating, "resolve_table", lambda data, *rest: seen.append((data, rest[1])))
    monkeypatch.setattr(evaluating, "loaded_from", lambda *_: "loaded")
    for key, left in (("pinion_rpm", None), ("gear_torque", {"pinion_speed": "3 rad/s"})):
        name = next((one for one in evaluating.SPEEDS if one != "pinion_speed"), key) if left is None else key
        assert evaluating.loaded_case(base, {f"operating.{name}": 1}) == "loaded"
        assert seen[-1][0]["operating"] == (left or {"gear_torque": "4 N*m"})
    assert len(base["operating"]) == 2
