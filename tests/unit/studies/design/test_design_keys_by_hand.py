"""Keys, quantities and tolerances of a search one by one; exact slopes; what is handed to NSGA-II."""

import math
import sys
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError, SimulationError
from tribodyn.studies.design import run as running
from tribodyn.studies.design.candidates import archive as archiving
from tribodyn.studies.design.candidates import slopes as differentiating
from tribodyn.studies.design.candidates.archive import Archive, Evaluation
from tribodyn.studies.design.candidates.deviations import deviating
from tribodyn.studies.design.candidates.pool import Pool
from tribodyn.studies.design.candidates.slopes import Derivatives, _over_samples
from tribodyn.studies.design.candidates.sources import (
    in_unit,
    own,
    require_key,
    sources_of,
    split,
    standing,
    units_by_figure,
    unknown_part,
)
from tribodyn.studies.design.candidates.unfinished import NOTHING_LEFT, Left, left_in
from tribodyn.studies.design.candidates.worth import Judge, Judged
from tribodyn.studies.design.case import DRAWN, START, Constraint, DesignCase, Free, Objective, Tolerance
from tribodyn.studies.design.layout import LOWER, START_FIGURES, UPPER
from tribodyn.studies.design.methods import front as fronts
from tribodyn.studies.design.methods.front import nsga2
from tribodyn.studies.design.methods.local import slopes_of
from tribodyn.studies.design.methods.population import cma_es
from tribodyn.studies.design.methods.views import Scalar
from tribodyn.studies.design.naming import apart, flat, naming_key
from tribodyn.studies.design.outcome import HEAD, check_targets, chosen_best
from tribodyn.studies.design.parts import _constraint, _contradictions, _number, _objectives, _varied
from tribodyn.studies.design.short_form import loaded_search

KEYS = ("drive.pinion.profile_shift", "drive.gear.profile_shift")
F, G = "peak_to_peak", "contact_ratio"
SCENARIOS: Any = {
    "": {"kind": "load-contact", "drive": {"module": "3 mm", "gear": {"teeth": 36}}, "list": [4, {"x": 5}]},
    "losses": {"kind": "efficiency", "operating": {"pinion_speed": "9 rad/s"}},
}


def case_of(**design: Any) -> DesignCase:
    given = {"free": [{"key": key, "from": -1.0, "to": 3.0} for key in KEYS], "minimise": F} | design
    return loaded_search("load-contact-18-36", given, {}).case


@pytest.fixture(scope="module")
def case() -> DesignCase:
    return case_of()


def test_keys_belong_to_the_source_that_they_name():
    """A part takes those of the others that it knows too; its own take their place."""
    sources = sources_of(SCENARIOS)
    given = {
        "drive.module": 1,
        "mesh.slices": 2,
        "output.positions_per_cycle": 3,
        "losses.drive.module": 4,
        "losses.output.samples_per_cycle": 5,
        "losses": 6,
    }
    assert split("losses.drive.module", SCENARIOS) == ("losses", "drive.module")
    assert split("loss.drive.module", SCENARIOS) == ("", "loss.drive.module")
    assert split("losses", SCENARIOS) == ("", "losses")
    base = {"drive.module": 1, "mesh.slices": 2, "output.positions_per_cycle": 3, "losses": 6}
    assert own("", sources[""].schema, given, ["losses"]) == base
    found = own("losses", sources["losses"].schema, given, ["losses"])
    assert {name: found[name] for name in ("drive.module", "output.samples_per_cycle")} == {
        "drive.module": 4,
        "output.samples_per_cycle": 5,
    }
    assert found["mesh.slices"] == 2
    assert "output.positions_per_cycle" not in found
    assert require_key("place", "losses.output.samples_per_cycle", sources)[1] == "output.samples_per_cycle"
    with pytest.raises(InputError, match="positions_per_cycle"):
        require_key("place", "output.positions_per_cycl", sources)


def test_a_key_is_known_as_far_as_its_schema_says():
    schema = sources_of(SCENARIOS)[""].schema
    for key in ("drive.module", "drive.pinion.modification.pitch_errors.3", "friction.anything"):
        assert unknown_part(key, schema) is None or key.startswith("friction")
    above, name, known = unknown_part("drive.pinion.teth", schema) or ([], "", [])
    assert (above, name) == (["drive", "pinion"], "teth")
    assert "teeth" in known


def test_what_stands_at_a_key():
    for key, value in (
        ("drive.module", "3 mm"),
        ("drive.gear.teeth", 36),
        ("list.0", 4),
        ("list.1.x", 5),
        ("list.2", None),
        ("list.x", None),
        ("drive.module.x", None),
        ("drive.pinion.teeth", None),
        ("losses.operating.pinion_speed", "9 rad/s"),
        ("losses.drive.module", None),
    ):
        assert standing(SCENARIOS, key) == value


def test_numbers_in_a_unit():
    for value, unit, si, number in (
        (3, "mm", 1e-3, 3.0),
        (2.5, "", 1.0, 2.5),
        (True, "", 1.0, None),
        (None, "mm", 1e-3, None),
        ("40 um", "um", 1e-6, 40.0),
        ("0.04 mm", "um", 1e-6, 40.0),
        ("3 mm", "m", 1.0, 0.003),
        ("linear", "um", 1e-6, None),
    ):
        assert in_unit(value, unit, si) == pytest.approx(number)


def test_quantities_without_a_kind_keep_their_unit():
    assert _number("place", "3 mm", None) == (pytest.approx(0.003), "mm", "m")
    assert _number("place", "0.2 kN*m", None)[:2] == (pytest.approx(200.0), "kN*m")
    assert _number("place", 0.25, None) == (0.25, "", "1")
    with pytest.raises(InputError, match="neither a number"):
        _number("place", True, None)
    with pytest.raises(InputError, match="not a finite number"):
        _number("place", math.inf, None)


@pytest.mark.parametrize(
    "key", ["title", "kind", "output.positions_per_cycle", "losses.output.samples_per_cycle", "drive..module"]
)
def test_what_the_physics_does_not_depend_on_cannot_be_free(key: str):
    with pytest.raises(InputError, match="cannot be free"):
        _varied("place", key, sources_of(SCENARIOS))


def test_limits_are_read_with_sign_and_unit():
    studies = {"": sources_of(SCENARIOS)[""].study}
    units = units_by_figure(studies)

    def limit(text: str) -> Constraint:
        return _constraint("place", text, studies, units)

    for sign, value in {"<=": 1.0, "<": 1.0, "≤": 1.0, ">=": -1.0, ">": -1.0, "≥": -1.0}.items():
        one = limit(f"hertz_pressure_max {sign} 1.5 GPa")
        assert (one.figure, one.sign, one.limit) == ("hertz_pressure_max", value, pytest.approx(1.5e9))
        assert limit(f"{G} {sign} start")[1:] == (G, value, START)
        assert limit(f"{G} {sign} 2.25")[1:] == (G, value, 2.25)
    # one limit that only touches another does not contradict it
    for low, contradict in ((1.5, False), (1.6, True)):
        pair = [limit(f"{G} >= {low}"), limit(f"{G} <= 1.5")]
        assert bool(_contradictions(pair)) == bool(_contradictions(pair[::-1])) == contradict
    others = [
        limit(f"{G} >= 9"),
        limit("hertz_pressure_max <= 1 Pa"),
        limit(f"{G} <= start"),
        limit(f"{G} >= 8"),
    ]
    assert _contradictions(others) == []
    asked: Any = SimpleNamespace(maximise=None, minimise=[{"figure": G, "weight": -0.5}, {"figure": G}])
    (weighted,) = _objectives(asked, studies)
    assert weighted.terms == ((G, -0.5), (G, 1.0))


def test_more_of_a_figure_is_less_of_its_opposite():
    free: list[dict[str, Any]] = [{"key": KEYS[0], "from": -1.0, "to": 3.0}]
    free.append({"key": "drive.pinion.teeth", "choices": [17, 19, 23]})
    case = loaded_search("load-contact-18-36", {"free": free, "maximise": G}, {}).case
    (aim,) = case.objectives
    assert (aim.name, aim.terms) == (f"-{G}", ((G, -1.0),))
    # of choices their number is what is recorded
    assert (case.free[1].low, case.free[1].high, case.free[1].choices) == (0.0, 2.0, (17, 19, 23))


def test_duties_and_tolerances_are_named_and_in_their_units():
    duty = {"set": {"operating": {"gear_torque": "20 N*m"}, "mesh.slices": 3}, "weight": 2.5}
    tolerances = [
        {"key": "operating.gear_torque", "plus_minus": "0.02 kN*m", "distribution": "normal"},
        {"key": "mesh.deviation_sample"},
        {"key": "drive.pinion.addendum", "plus_minus": 0.05},
    ]
    case = case_of(duty=[duty], tolerance=tolerances)
    (one,) = case.duties
    assert (one.weight, one.name) == (2.5, "gear_torque 20 N*m, slices 3")
    assert one.set == {"operating.gear_torque": "20 N*m", "mesh.slices": 3}
    torque, sample, tip = case.tolerances
    assert torque[2:] == (pytest.approx(0.02), "kN*m", "normal")
    assert (sample.plus_minus, sample.unit, sample.distribution) == (0.0, "", DRAWN)
    assert tip[2:4] == (0.05, "")
    assert [name.name for name in case.tolerances] == ["gear_torque", "deviation_sample", "pinion_addendum"]


def test_shortest_names_and_dotted_keys():
    assert apart(["drive.module", "drive.pinion.teeth"]) == ["module", "pinion_teeth"]
    assert apart(["a.x", "b.x"]) == ["a_x", "b_x"]
    assert apart(["drive.pinion.relief.length", "drive.gear.relief.length"]) == [
        "pinion_length",
        "gear_length",
    ]
    assert apart(["p.q.x", "p.r.x", "s.q.x"]) == ["p_q_x", "p_r_x", "s_q_x"]
    assert naming_key(["drive.pinion.teeth", "drive.gear.teeth"]) == "drive.teeth"
    assert naming_key(["a.b", "c.d"]) == "a.b"
    assert naming_key("a.b") == "a.b"
    assert flat({"a": {"b": 1, "c": {"d": 2}}, "e": 3}) == {"a.b": 1, "a.c.d": 2, "e": 3}


def test_what_tolerances_make_of_values():
    """About what stands, in the unit of the tolerance; about zero where nothing stands."""
    standing_at: dict[str, Any] = {"torque": "0.3 kN*m", "addendum": 1.1, "gear.teeth": 5}
    path = SimpleNamespace(pinion_pitch_radius=0.027, gear_pitch_radius=0.054)
    nominal: Any = SimpleNamespace(
        at=standing_at.get, gears=SimpleNamespace(path=path, roll_limits=(-0.2, 0.3))
    )

    def moved(key: str, size: float, unit: str, deviation: float, distribution: str = "uniform") -> Any:
        ((found, value),) = deviating(
            Tolerance(key, "", size, unit, distribution), deviation, nominal
        ).items()
        assert found == key
        return value

    number, unit = moved("torque", 20.0, "N*m", -0.25).split()
    assert (float(number), unit) == (pytest.approx(295.0), "N*m")
    assert moved("addendum", 0.2, "", 0.5) == pytest.approx(1.2)
    assert moved("relief", 8.0, "um", 0.5) == "4.0 um"
    assert float(moved("drive.centre_distance", 40.0, "um", 0.5).split()[0]) == pytest.approx(81020.0)
    assert deviating(Tolerance("torque", "", 20.0, "N*m", "uniform"), 0.0, nominal) == {}
    errors = moved("gear.modification.pitch_errors", 6.0, "um", 0.3)
    values = [float(one.split()[0]) for one in errors]
    assert len(set(values)) == 5
    assert max(map(abs, values)) <= 6.0
    assert errors == moved("gear.modification.pitch_errors", 6.0, "um", 0.3)
    assert errors != moved("gear.modification.pitch_errors", 6.0, "um", 0.31)
    samples = {moved("mesh.deviation_sample", 0.0, "", one, DRAWN) for one in (-0.9, 0.1, 0.100001, 0.8)}
    assert len(samples) >= 3
    assert all(isinstance(one, int) and one > 0 for one in samples)
    curve = moved("gear.modification.profile_error", 3.0, "um", 0.4)
    np.testing.assert_allclose(
        curve["roll_angle"]["values"], [-0.325 + 0.125 * one for one in range(7)], atol=1e-15
    )
    assert max(map(abs, curve["error"]["values"])) <= 3.0
    nominal.gears = None
    assert deviating(Tolerance("x.profile_error", "", 3.0, "um", "uniform"), 0.4, nominal) == {}
    assert deviating(Tolerance("drive.centre_distance", "", 3.0, "mm", "uniform"), 0.5, nominal) == {
        "drive.centre_distance": "1.5 mm"
    }


def test_the_sample_of_a_quantile(rng: np.random.Generator):
    """The nearest in order: of eleven samples at 0.8 the ninth of those that a limit of this sign fears."""
    judge: Any = SimpleNamespace(case=SimpleNamespace(robust=SimpleNamespace(quantile=0.8)))
    values = rng.permutation(11).astype(float).tolist()
    slopes = [np.array([one, -one]) for one in values]
    for sign, over, wanted in (
        (1.0, "quantile", 8.0), (-1.0, "quantile", 2.0), (1.0, "worst", 10.0), (-1.0, "worst", 0.0),
        (1.0, "mean", 5.0),
    ):  # fmt: skip
        value, slope = _over_samples(judge, values, slopes, sign, over)
        assert (value, *slope) == (wanted, wanted, -wanted)


def test_derivatives_sum_over_the_keys_of_a_free_value(case: DesignCase, monkeypatch: pytest.MonkeyPatch):
    """Slopes by shares: by the range in SI times the sum over all keys that move together."""
    free = (
        Free(("a", "b"), "ab", -1.0, 3.0, "um", 1e-6),
        Free(("c",), "c", 2.0, 4.5),
    )
    both = Constraint("f", F, 1.0, 0.0), Constraint("g", G, 1.0, 0.0)
    aim = (Objective(F, ((F, 1.0),)),)
    two = replace(case, free=free, objectives=aim, constraints=both, duties=case.duties * 2)
    jacobian = np.array([[1.0, 20.0, 300.0], [4.0, 50.0, 600.0]])
    study = SimpleNamespace(batch=lambda: None, has_gears=True)
    made: list[Any] = []

    class Differentiable:
        at = "at"

        def __init__(self, number: int, table: str, names: Any, keys: Any) -> None:
            made.append((number, table, names, keys))
            self.number = number

        def jacobian(self, at: str) -> Any:
            assert at == "at"
            return None, jacobian * self.number

    def loaded(base: Any, overrides: int) -> Any:
        return SimpleNamespace(case=overrides, study=SimpleNamespace(table=lambda: "table"))

    monkeypatch.setattr(differentiating, "study_of", lambda _: study)
    monkeypatch.setattr(differentiating, "start_of", lambda _: "start")
    monkeypatch.setattr(differentiating, "chosen", lambda _, shares: shares)
    monkeypatch.setattr(differentiating, "cases_of", lambda _, values: [1, 2, 3, 4])
    monkeypatch.setattr(differentiating, "loaded_case", loaded)
    monkeypatch.setattr(differentiating, "Differentiable", Differentiable)
    derivatives = Derivatives(two)
    assert made == [(1, "table", (F, G), ("a", "b", "c"))]
    found = derivatives.at([0.5, 0.5])
    assert [len(row) for row in found] == [2, 2]
    for duty in range(2):
        for sample in range(2):
            number = 2 * duty + sample + 1
            np.testing.assert_allclose(found[duty][sample][F], [number * 4e-6 * 21.0, number * 2.5 * 300.0])
            np.testing.assert_allclose(found[duty][sample][G], [number * 4e-6 * 54.0, number * 2.5 * 600.0])
    refused = [
        replace(two, parts={"losses": {}}),
        replace(two, free=(free[0]._replace(choices=(1, 2)), free[1])),
    ]
    for one in refused:
        with pytest.raises(InputError, match="cannot be differentiated"):
            Derivatives(one)
    for changed in ({"batch": lambda: "batch"}, {"has_gears": False}):
        monkeypatch.setattr(
            differentiating, "study_of", lambda _, changed=changed: SimpleNamespace(**vars(study) | changed)
        )
        with pytest.raises(InputError, match="cannot be differentiated"):
            Derivatives(two)


class Linear:
    """Stands for the pool: 4 + x − 3 y and 2 + x/2 + y/4; nothing where x is above 2.5."""

    name, workers = "linear", 1

    def submit(self, several: Any) -> Any:
        found = []
        for one in several:
            x, y = (float(one.get(key, 0.0)) for key in KEYS)
            found.append({F: 4.0 + x - 3.0 * y, G: 2.0 + 0.5 * x + 0.25 * y} if x < 2.5 else "undercut")
        return SimpleNamespace(result=lambda: found)


def test_exact_slopes_are_used_where_there_are_figures(case: DesignCase):
    """Without figures and under a bound, by differences; the distance of shapes always."""
    constraint = Constraint("g", G, -1.0, 1.6)
    given = replace(
        case, objectives=(Objective(F, ((F, 1.0),)), Objective(G, ((G, 1.0),))), constraints=(constraint,)
    )
    pool: Any = Linear()
    archive = Archive(given, Judge(given, pool.submit([{}]).result()), pool, lambda _: None)
    archive._shaped = True
    # linear in the shares; of nothing that lies beyond, a distance of zero
    archive.shape_of = lambda values: 0.7 * values[KEYS[0]] - 0.2 * values[KEYS[1]]
    asked: list[Any] = []

    def at(shares: np.ndarray) -> Any:
        asked.append(tuple(shares))
        return [[{F: np.array([4.0, -12.0]), G: np.array([2.0, 1.0])}]]

    derivatives: Any = SimpleNamespace(at=at)
    here = np.array([0.5, 0.25])
    archive.ask(here)
    scale = archive.evaluations[0].judged.objectives[0]
    value, margins = slopes_of(Scalar(archive), derivatives)
    np.testing.assert_allclose(value(here), np.array([4.0, -12.0]) / scale, rtol=1e-9)
    np.testing.assert_allclose(margins(here), [[2.0 / 1.6, 1.0 / 1.6], [2.8, -0.8]], rtol=1e-6)
    assert set(asked) == {(0.5, 0.25)}
    evaluated = len(archive.evaluations)
    assert evaluated == 1
    # at the end of a range too, where there is room on one side only
    end = np.array([0.5, 1.0])
    np.testing.assert_allclose(margins(end), [[2.0 / 1.6, 1.0 / 1.6], [2.8, -0.8]], rtol=1e-6)
    asked.clear()
    gone = np.array([0.95, 0.25])
    assert value(gone).shape == (2,)
    np.testing.assert_allclose(
        slopes_of(Scalar(archive, 0, 5.0), derivatives)[0](here), [4.0 / scale, -12.0 / scale], rtol=1e-6
    )
    assert asked == []


@pytest.mark.parametrize(("resume", "force", "left", "forced"), [
    (False, False, False, False), (True, False, True, True), (True, False, False, False),
    (True, True, True, True), (False, True, True, True),
])  # fmt: skip
def test_a_search_that_goes_on_takes_the_place_of_its_record(
    case: DesignCase, monkeypatch: pytest.MonkeyPatch, resume: bool, force: bool, left: bool, forced: bool
):
    seen: list[Any] = []

    def target(_: Any, path: Any, given: bool) -> Any:
        seen.append((path.name, given))
        raise InputError("output", rule="seen")

    found = Left({}, {}, {}) if left else NOTHING_LEFT
    monkeypatch.setattr(running, "method_of", lambda _: ("cobyqa", ""))
    monkeypatch.setattr(running, "_left", lambda *_: found)
    monkeypatch.setattr(running, "target", target)
    with pytest.raises(InputError, match="seen"):
        running.run(case, "a/record.h5", force=force, resume=resume)
    assert seen == [("record.h5", forced)]


def test_nsga2_is_given_both_objectives_and_all_constraints(
    case: DesignCase, monkeypatch: pytest.MonkeyPatch
):
    """Constraints that hold are not positive to it; the last of them is that there are figures."""
    given = replace(
        case,
        objectives=(Objective(F, ((F, 1.0),)), Objective(G, ((G, 1.0),))),
        constraints=(Constraint("g", G, -1.0, 1.6),),
        search=case.search._replace(evaluations=100, seed=7),
    )
    pool: Any = Linear()
    archive = Archive(given, Judge(given, pool.submit([{}]).result()), pool, lambda _: None)
    archive._shaped = False
    asked: dict[str, Any] = {}

    class Problem:
        def __init__(self, **of: Any) -> None:
            asked.update(of)

    def minimize(problem: Any, algorithm: Any, until: Any, seed: int) -> None:
        asked.update(size=algorithm, until=until, seed=seed)
        out: dict[str, Any] = {}
        problem._evaluate(np.array([[0.5, 0.25], [0.25, 0.5], [0.99, 0.5]]), out)
        asked.update(out)

    parts = {
        "pymoo.algorithms.moo.nsga2": {"NSGA2": lambda pop_size: pop_size},
        "pymoo.core.problem": {"Problem": Problem},
        "pymoo.optimize": {"minimize": minimize},
    }
    for name in ("pymoo", "pymoo.algorithms", "pymoo.algorithms.moo", "pymoo.core"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))
    for name, content in parts.items():
        module = ModuleType(name)
        vars(module).update(content)
        monkeypatch.setitem(sys.modules, name, module)
    archive.ask(np.array([0.5, 0.25]))
    nsga2(archive, np.array([0.5, 0.5]))
    assert (asked["n_var"], asked["n_obj"], asked["n_ieq_constr"], asked["xl"], asked["xu"]) == (
        2,
        2,
        2,
        0.0,
        1.0,
    )
    assert (asked["until"], asked["seed"]) == (("n_gen", max(2, 100 // asked["size"])), 7)
    # x, y = 1, 0 and 0, 1; scales are the first values, 5 and 2.5
    np.testing.assert_allclose(asked["F"][:2], [[1.0, 1.0], [0.2, 0.9]], rtol=1e-12)
    np.testing.assert_allclose(asked["G"][:2], [[-0.9 / 1.6, 0.0], [-0.65 / 1.6, 0.0]], rtol=1e-12)
    assert np.all(asked["G"][2] > 0.0)


def test_the_distance_of_shapes_is_of_the_keys_of_the_gears(
    case: DesignCase, monkeypatch: pytest.MonkeyPatch
):
    """Keys of a part are not among them; without keys that shape the gears there is none."""
    seen: list[Any] = []
    pool: Any = Linear()
    given = replace(case, parts={"losses": {"kind": "efficiency"}})
    archive = Archive(given, Judge(case, pool.submit([{}]).result()), pool, lambda _: None)
    monkeypatch.setattr(
        archiving, "distance_from_limits", lambda base, keys: seen.append((base, keys)) or 0.4
    )
    values = {KEYS[0]: 0.5, "losses.operating.pinion_speed": "9 rad/s"}
    archive._shaped = True
    assert archive.shape_of(values) == 0.4
    assert seen == [(case.base, {KEYS[0]: 0.5})]
    archive._shaped = False
    assert archive.shape_of(values) is None


def test_a_front_of_two_is_searched_between(case: DesignCase, monkeypatch: pytest.MonkeyPatch):
    """And one of a single candidate has nothing between its ends."""
    pool: Any = Linear()
    two = replace(
        case,
        objectives=(Objective(F, ((F, 1.0),)), Objective(G, ((G, -1.0),))),
        search=case.search._replace(points=4, evaluations=60),
    )
    for ends, bounds in ((2, 2), (1, 0)):
        archive = Archive(two, Judge(two, pool.submit([{}]).result()), pool, lambda _: None)
        archive._shaped = False
        asked: list[Any] = []

        def minimise(name: str, view: Any, place: np.ndarray, most: int, asked: Any = asked) -> None:
            asked.append(view.bound)

        for share in (0.1, 0.6)[:ends]:
            archive.ask(np.array([share, 0.5]))
        monkeypatch.setattr(fronts, "first_look", lambda view, start: [start])
        monkeypatch.setattr(fronts, "minimise", minimise)
        fronts.epsilon_constraint(archive, np.array([0.5, 0.5]))
        assert [one is None for one in asked] == [True, True] + [False] * bounds


def test_a_process_that_evaluates_is_asked_by_lines():
    """The first thread has none of its own; one that answers nothing has ended."""
    pool = Pool.__new__(Pool)
    pool.scenarios, pool.workers = {"": {"kind": "load-contact"}}, 2
    written = BytesIO()
    process = SimpleNamespace(stdin=written, stdout=BytesIO(b'[{"a": 1.5}]\n'))
    pool._own = SimpleNamespace(process=process)  # pyright: ignore[reportAttributeAccessIssue]
    assert pool._evaluate([{"drive.module": "3 mm"}]) == [{"a": 1.5}]
    assert written.getvalue() == b'[{"drive.module": "3 mm"}]\n'
    with pytest.raises(SimulationError, match="ended"):
        pool._evaluate([{}])


@pytest.mark.parametrize(("workers", "threads"), [(1, None), (3, 1)])
def test_a_pool_of_one_has_all_cores(monkeypatch: pytest.MonkeyPatch, workers: int, threads: int | None):
    pool = Pool.__new__(Pool)
    pool.scenarios, pool.workers = {"": {"kind": "load-contact"}}, workers
    pool._own = SimpleNamespace(process=None)  # pyright: ignore[reportAttributeAccessIssue]
    monkeypatch.setattr("tribodyn.studies.design.candidates.pool.evaluate", lambda *given: given)
    assert pool._evaluate([{"a": 1}]) == (pool.scenarios, [{"a": 1}], threads)


def test_cma_es_begins_inside_and_is_told_merits(case: DesignCase, monkeypatch: pytest.MonkeyPatch):
    """Two generations of eight within 0 … 1; a start at an edge is moved off it."""
    pool: Any = Linear()
    given = replace(case, objectives=(Objective(F, ((F, 1.0),)),), search=case.search._replace(seed=6))
    archive = Archive(given, Judge(given, pool.submit([{}]).result()), pool, lambda _: None)
    archive._shaped = False
    told: list[Any] = []

    class Strategy:
        def __init__(self, start: np.ndarray, width: float, settings: dict[str, Any]) -> None:
            told.append((start.tolist(), width, settings))

        def stop(self) -> bool:
            return len(told) > 2

        def ask(self) -> list[np.ndarray]:
            return [np.array([0.5, 0.25]), np.array([0.25, 0.5])]

        def tell(self, candidates: Any, merits: list[float]) -> None:
            told.append(merits)

    module = ModuleType("cma")
    vars(module)["CMAEvolutionStrategy"] = Strategy
    monkeypatch.setitem(sys.modules, "cma", module)
    archive.ask(np.array([0.5, 0.25]))
    cma_es(archive, np.array([0.0, 1.0]))
    (start, width, settings), *merits = told
    assert start == [0.05, 0.95]
    assert 0.0 < width < 0.5
    assert (settings["bounds"], settings["seed"], settings["popsize"]) == ([0.0, 1.0], 7, 8)
    assert settings["tolx"] == given.search.accuracy
    # 5 and 1, over the first of them
    assert merits == [pytest.approx([1.0, 0.2])] * 2


def test_what_an_unfinished_search_left(case: DesignCase):
    """Candidates of which every case was worked out, or why not; numbers become values in their units."""
    free = (
        Free(("a", "b"), "module", 2.0, 6.0, "mm", 1e-3, "m"),
        Free(("c",), "shape", 0.0, 1.0, choices=("linear", "parabolic")),
    )
    nan = math.nan
    record: Any = {
        "figure": [b"one".decode(), "two"],
        "free_module": np.array([0.003, 0.0045, 0.006]),
        "free_shape": np.array([0.0, 1.0, 0.0]),
        "case_figures": np.array(
            [[[1.0, 2.0], [3.0, nan]], [[nan, nan], [5.0, 6.0]], [[nan, nan], [nan, nan]]]
        ),
        "message": ["", "undercut", ""],
        "refinement": np.array([1.0, 5.0, 5.0]),
        "level": np.array([1.0, 5.0]),
        START_FIGURES: np.array([[[7.0, 8.0], [9.0, nan]], [[7.5, 8.5], [nan, nan]]]),
        LOWER: np.array([nan, 0.5]),
        UPPER: np.array([0.25, nan]),
    }
    found = left_in(replace(case, free=free), record)
    assert found.known == {
        1: [({"a": "3.0 mm", "b": "3.0 mm", "c": "linear"}, [{"one": 1.0, "two": 2.0}, {"one": 3.0}])],
        5: [({"a": "4.5 mm", "b": "4.5 mm", "c": "parabolic"}, ["undercut", {"one": 5.0, "two": 6.0}])],
    }
    assert found.start == {1: [{"one": 7.0, "two": 8.0}, {"one": 9.0}]}
    assert found.moved == {(1, LOWER): 0.5, (0, UPPER): 0.25}


def test_the_nearest_of_a_front_by_shares_of_both_spans(case: DesignCase):
    """By the sum of squares: (0.1, 0.8) before (0.58, 0.58), wherever zero is, in any unit."""
    places = [(0.0, 1.0), (0.1, 0.8), (0.58, 0.58), (1.0, 0.0)]
    for (low, span), (other, width) in (((10.0, 2.0), (0.0, 1e-6)), ((-3.0, 0.5), (7.0, 40.0))):
        evaluations = [
            Evaluation({}, (u, v), [], Judged((low + span * u, other + width * v), (), (), {}))
            for u, v in places
        ]
        archive: Any = SimpleNamespace(evaluations=evaluations)
        two = replace(case, objectives=(Objective(F, ((F, 1.0),)), Objective(G, ((G, 1.0),))))
        assert chosen_best(two, archive) is evaluations[1]
        archive.evaluations = evaluations[:1]
        assert chosen_best(two, archive) is evaluations[0]
        archive.evaluations = []
        assert chosen_best(two, archive) is None


def test_only_what_no_search_wrote_is_in_the_way(case: DesignCase, tmp_path: Path):
    """A file with the best of an earlier search is replaced, also that of a part; another is not."""
    parted = replace(case, parts={"losses": {"kind": "efficiency"}})
    record = tmp_path / "found.h5"
    check_targets(parted, record)
    (tmp_path / "found-best.toml").write_text(f"{HEAD}an earlier one\n", encoding="utf-8")
    check_targets(parted, record)
    (tmp_path / "found-best-losses.toml").write_text("mine", encoding="utf-8")
    check_targets(case, record)
    with pytest.raises(InputError, match="the file exists"):
        check_targets(parted, record)
