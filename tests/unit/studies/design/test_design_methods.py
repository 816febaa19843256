"""Methods on functions whose minima are known; nothing is evaluated twice."""

from concurrent.futures import Future
from contextlib import suppress
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

from tests.support.soak_parameters import all_in_soak
from tribodyn.errors import InputError
from tribodyn.studies.design.candidates.archive import Archive, SpentError
from tribodyn.studies.design.candidates.candidates import start_of
from tribodyn.studies.design.methods import METHODS, method_of
from tribodyn.studies.design.outcome import chosen_best, headline
from tribodyn.studies.design.scenario import loaded_search

KEYS = ("drive.pinion.profile_shift", "drive.gear.profile_shift")
#: Figures of a load contact study that stand for values of functions.
F, G, H = "face_load_factor", "contact_ratio", "torque_residual"


class Formulas:
    """A pool that evaluates formulas of the free keys instead of teeth."""

    def __init__(self, **formulas: Any) -> None:
        self.formulas = formulas
        self.asked: list[tuple[float, ...]] = []

    def submit(self, several: Any) -> "Future[Any]":
        found: list[Any] = []
        for overrides in several:
            x = tuple(float(overrides.get(key, 0.0)) for key in KEYS)
            self.asked.append(x)
            values = {name: formula(*x) for name, formula in self.formulas.items()}
            found.append("undercut" if any(np.isnan(v) for v in values.values()) else values)
        future: Future[Any] = Future()
        future.set_result(found)
        return future


def archive_of(formulas: Formulas, **design: Any) -> tuple[Archive, list[Any]]:
    free = [{"key": key, "from": -1.0, "to": 1.0} for key in KEYS]
    keys = {"free": free, **({} if "maximise" in design else {"minimise": F}), **design}
    case = loaded_search("load-contact-18-36", keys, {}).case
    kept: list[Any] = []
    return Archive(case, formulas, kept.append), kept  # pyright: ignore[reportArgumentType]


def search(formulas: Formulas, **design: Any) -> tuple[Archive, list[Any]]:
    archive, kept = archive_of(formulas, **design)
    case = archive.case
    with suppress(SpentError):
        archive.score(start_of(case))
        METHODS[method_of(case)[0]](archive, start_of(case))
    return archive, kept


def values_of(candidate: Any) -> list[float]:
    return [float(candidate.values[key]) for key in KEYS]


def bowl(x: float, y: float) -> float:
    return 1.0 + (x - 0.3) ** 2 + 3.0 * (y + 0.4) ** 2 + (x - 0.3) * (y + 0.4)


@pytest.mark.parametrize(
    ("method", "most"),
    [
        ("cobyqa", 400),
        ("slsqp", 400),
        ("trust-constr", 120),
        ("differential-evolution", 300),
        ("cma-es", 300),
    ],
)
def test_the_minimum_of_a_bowl(method: str, most: int):
    if method == "cma-es":
        pytest.importorskip("cma")
    formulas = Formulas(**{F: bowl})
    archive, kept = search(formulas, method=method, evaluations=most)
    best = archive.best()
    assert best is not None
    np.testing.assert_allclose(values_of(best), [0.3, -0.4], atol=0.02)
    assert best.score.objectives[0] == pytest.approx(1.0, abs=1e-3)
    # each candidate once, kept in the order in which it came, and no more than allowed
    assert len(set(formulas.asked[1:])) == len(formulas.asked) - 1 == len(kept) <= most
    assert archive.evaluations == kept


@pytest.mark.parametrize("method", all_in_soak(["cobyqa", "slsqp", "differential-evolution"], ["slsqp"]))
def test_a_minimum_on_a_constraint(method: str):
    """Of x² + y² where x + y ≥ 1: both a half."""
    formulas = Formulas(**{F: lambda x, y: 1.0 + x * x + y * y, G: lambda x, y: 2.0 + x + y})
    archive, _ = search(formulas, method=method, evaluations=400, subject_to=[f"{G} >= 3.0"])
    best = archive.best()
    assert best is not None
    assert best.score.quantities[G] >= 3.0 - 1e-8
    np.testing.assert_allclose(values_of(best), [0.5, 0.5], atol=0.06)
    assert best.score.objectives[0] == pytest.approx(1.5, abs=0.02)


def test_candidates_that_cannot_be_made_do_not_end_it():
    formulas = Formulas(**{F: lambda x, y: float("nan") if x > 0.1 else bowl(x, y)})
    archive, _ = search(formulas, evaluations=120)
    best = archive.best()
    assert best is not None
    assert values_of(best)[0] <= 0.1
    assert best.score.objectives[0] == pytest.approx(bowl(0.1, -0.4 + 0.2 / 6), abs=0.03)
    assert {candidate.score.message for candidate in archive.evaluations} == {"", "undercut"}


def test_the_best_of_a_kinked_figure():
    """A maximum of slopes has its minimum on two kinks."""
    formulas = Formulas(**{F: lambda x, y: 2.0 + max(abs(x - 0.2), abs(x + y))})
    archive, _ = search(formulas, evaluations=300)
    best = archive.best()
    assert best is not None
    np.testing.assert_allclose(values_of(best), [0.2, -0.2], atol=0.02)


def test_more_of_a_figure():
    formulas = Formulas(**{G: lambda x, y: 5.0 - bowl(x, y)})
    archive, _ = search(formulas, maximise=G)
    found = headline(archive.case, archive, archive)
    assert found["objective"] == pytest.approx(4.0, abs=1e-3)
    assert found["objective_start"] == 5.0 - bowl(0.0, 0.0)


def test_a_weighted_sum_is_relative_to_the_start():
    formulas = Formulas(**{F: lambda x, y: 2.0 + x, G: lambda x, y: 4.0 - x})
    weighted = [{"quantity": F, "weight": 3.0}, {"quantity": G, "weight": 1.0}]
    archive, _ = search(formulas, minimise=weighted)
    found = headline(archive.case, archive, archive)
    assert found["objective_start"] == 4.0
    assert found["objective"] == pytest.approx(3.0 * 0.5 + 5.0 / 4.0, abs=0.01)


@pytest.mark.parametrize(
    ("method", "most", "count", "within"),
    [("epsilon-constraint", 500, 8, 0.08), ("nsga2", 400, 11, 0.15)],
)
def test_a_front(method: str, most: int, count: int, within: float):
    """Of (x² + y², (x − 1)² + y²): the segment between both minima, √f + √g = 1."""
    if method == "nsga2":
        pytest.importorskip("pymoo")
    formulas = Formulas(
        **{F: lambda x, y: 1e-3 + x * x + y * y, H: lambda x, y: 1e-3 + (x - 1.0) ** 2 + y * y}
    )
    archive, _ = search(formulas, minimise=[F, H], method=method, evaluations=most)
    points = archive.front()
    objectives = np.array([point.score.objectives for point in points]) - 1e-3
    assert len(points) >= count
    np.testing.assert_allclose(np.sqrt(objectives).sum(axis=1), 1.0, atol=within)
    if method == "epsilon-constraint":
        assert objectives.min(axis=0).max() < 0.01
        best = chosen_best(archive.case, archive)
        assert best is not None
        np.testing.assert_allclose(values_of(best), [0.5, 0.0], atol=0.2)


def test_the_front_is_what_nothing_is_better_than():
    """Of whole numbers, so that some are equal; those with x + y < -0.5 miss the constraint."""
    formulas = Formulas(
        **{
            F: lambda x, _: 7.0 + round(5.0 * x),
            H: lambda x, y: 9.0 - round(5.0 * x) + round(3.0 * y),
            G: lambda x, y: x + y,
        }
    )
    archive, _ = archive_of(formulas, minimise=[F, H], subject_to=[f"{G} >= -0.5"])
    archive.score_all(list(np.random.default_rng(5).random((60, 2))))
    feasible = [candidate for candidate in archive.evaluations if sum(values_of(candidate)) >= -0.5]
    objectives = {candidate.score.objectives for candidate in feasible}
    expected = {
        pair
        for pair in objectives
        if not any(other != pair and other[0] <= pair[0] and other[1] <= pair[1] for other in objectives)
    }
    found = archive.front()
    assert [candidate.score.objectives for candidate in found] == sorted(expected)
    assert 3 < len(expected) < len(objectives) < len(feasible) < 60
    for candidate in found:  # of equal ones the first
        assert candidate.numbers == min(
            other.numbers for other in feasible if other.score.objectives == candidate.score.objectives
        )


def test_whole_numbers_are_all_tried_or_evolved():
    free = [{"key": f"drive.{side}.teeth", "from": 17, "to": 19} for side in ("pinion", "gear")]
    case = loaded_search("load-contact-18-36", {"free": free, "minimise": F}, {}).case
    assert method_of(case)[0] == "every"
    many = loaded_search("load-contact-18-36", {"free": free, "minimise": F, "evaluations": 8}, {}).case
    assert method_of(many)[0] == "differential-evolution"


@pytest.mark.parametrize(
    ("design", "said"),
    [
        ({"method": "nsga2"}, "needs two objectives"),
        ({"method": "slsqp", "minimise": [F, G]}, "takes one objective"),
        ({"method": "every"}, "more values than"),
    ],
)
def test_a_method_that_does_not_fit(design: dict[str, Any], said: str):
    free = [{"key": KEYS[0], "from": -1.0, "to": 1.0}]
    case = loaded_search("load-contact-18-36", {"free": free, "minimise": F, **design}, {}).case
    with pytest.raises(InputError, match=said):
        method_of(case)


@pytest.mark.parametrize(("method", "package"), [("cma-es", "cma"), ("nsga2", "pymoo")])
def test_a_package_that_is_not_installed_is_named(method: str, package: str):
    if find_spec(package):
        pytest.skip("it is installed")
    free = [{"key": KEYS[0], "from": -1.0, "to": 1.0}]
    wanted = {"free": free, "minimise": [F, H] if method == "nsga2" else F, "method": method}
    case = loaded_search("load-contact-18-36", wanted, {}).case
    with pytest.raises(InputError, match=f"the package {package} is not installed"):
        method_of(case)
