"""Sweeps of gear pairs: settings and sizes by hand; what solvers are given and rows hold, with stand-ins."""

from importlib import import_module
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.dynamics.parameters import LAG, STATES, WORKS, XI, XI_RATE
from tribodyn.errors import InputError
from tribodyn.record.sweep_schema import DONE, FAILED
from tribodyn.solve.branch.end import BranchEnd
from tribodyn.solve.integrator import Status
from tribodyn.studies.gear_pair.batch import BATCH, figures, marched, steady, ways
from tribodyn.studies.gear_pair.batch import unstable as beyond
from tribodyn.studies.gear_pair.batch.evaluate import Settings
from tribodyn.studies.gear_pair.batch.marched import marched as march_all
from tribodyn.studies.gear_pair.batch.outcome import Outcome, Passage
from tribodyn.studies.gear_pair.batch.steady import steady as steady_all
from tribodyn.studies.gear_pair.sweep_layout import layout_of
from tribodyn.studies.sweeping import ends, unstable
from tribodyn.studies.sweeping.batch import Chunk, Way, batched
from tribodyn.studies.sweeping.between import NothingBetween

evaluating = import_module("tribodyn.studies.gear_pair.batch.evaluate")
SETTINGS = Settings(steady=True, cycles=30, window=4, points=5, samples=3, modes=6)


def case_of(number: int = 0, **changed: Any) -> Any:
    """A case of a sweep, as far as its batch reads it."""
    solver = SimpleNamespace(rtol=1e-6, method="explicit-5", max_steps=900, initial="static")
    given = {
        "number": number,
        "toml": "",
        "output": SimpleNamespace(samples_per_cycle=40),
        "operating": SimpleNamespace(shaft_stiffness=None, pinion_speed=50.0),
        "solver": solver,
        "friction": SimpleNamespace(sliding="dynamic"),
        "temperature": None,
    }
    return SimpleNamespace(**given | changed)


@pytest.mark.parametrize(
    ("cycles", "window", "points"), [(1, 1, 1), (3, 1, 1), (7, 1, 3), (8, 2, 4), (40, 10, 20), (900, 16, 256)]
)
def test_a_quarter_of_a_march_is_its_window_and_half_of_it_its_section(cycles: int, window: int, points: int):
    found = BATCH.settings([case_of()], cycles, "native")
    assert (found.steady, found.cycles, found.window, found.points) == (False, cycles, window, points)
    assert (found.samples, found.method, found.followed, found.unstable) == (40, "", False, False)
    with pytest.raises(InputError, match="--transient"):
        BATCH.with_unstable(found)
    assert not BATCH.followed(found).followed


def test_steady_states_are_sought_as_documented():
    """2000 mesh cycles, 256 points, whole periods of up to 8; a shaft has one mode more."""
    rigid, shaft = case_of(), case_of(operating=SimpleNamespace(shaft_stiffness=3e3))
    found = BATCH.settings([rigid, rigid], None, "native")
    assert (found.steady, found.cycles, found.window, found.points) == (True, 2000, 8, 256)
    assert BATCH.settings([rigid, shaft], None, "native").modes == found.modes + 1
    assert BATCH.settings([rigid], None, "jax").method == "tsit5"
    through = case_of(solver=SimpleNamespace(method="tsit5"))
    assert BATCH.settings([through], None, "jax").method == ""
    assert BATCH.followed(found).followed
    assert BATCH.with_unstable(found).unstable


def test_cases_evaluated_together():
    """As many as 64 MiB hold, at most 256; a sixteenth of the sweep, but no fewer than 32."""

    def together(total: int, width: int = 4, window: int = 16, samples: int = 200) -> int:
        return BATCH.size_of_chunk(SETTINGS._replace(window=window, samples=samples), total, width)

    # 16 · 200 states of 8 bytes: 512 000 bytes
    assert together(10**6) == 64 * 2**20 // (16 * 200 * STATES * 8) == 131
    assert together(10**6, samples=20) == 256
    assert together(1600) == 100
    assert together(40) == 32
    assert together(40, width=50) == 50
    assert together(10**6, width=1, samples=10**7) == 1


def test_legs_begin_at_the_neighbour_and_are_as_fine_as_they_cost(monkeypatch: pytest.MonkeyPatch):
    """Steps are as small as it takes between equal tables, and a quarter of the way between others."""
    first, same, other, law = (case_of(number) for number in range(4))

    def between(one: Any, another: Any, share: float) -> Any:
        assert (one, share) == (first, 0.5)
        if another is law:
            raise NothingBetween
        return another

    monkeypatch.setattr(ways, "case_between", between)
    monkeypatch.setattr(ways, "table_key", lambda case: case is other)
    cases = [
        (SimpleNamespace(case=one), np.full(STATES, 1.0 + one.number)) for one in (first, same, other, law)
    ]
    way = Way(first, 70.0, 30.0, 2, (-90.0, 10.0))
    found = ways.legs_of(cases, [None, way, way, way])  # pyright: ignore[reportArgumentType]
    assert [leg.line for leg in found] == [0, 1, 2, 3]
    assert [leg.state[0] for leg in found] == [1.0, 2.0, 3.0, 4.0]
    assert found[0][1:3] == (0.0, 0.0)
    assert found[0].period == 0
    for leg, finest in zip(found[1:], (0.0, 10.0, np.inf), strict=True):
        assert (leg.start, leg.target, leg.period, leg.finest, leg.reach) == (70.0, 30.0, 2, finest, 90.0)


def numbered(rows: int, first: float) -> np.ndarray:
    """States of which every number tells its row."""
    return np.arange(first, first + rows)[:, None] * np.ones(STATES)


@pytest.mark.parametrize(("cycles", "window", "points"), [(20, 4, 6), (20, 4, 2), (4, 4, 3), (5, 4, 3)])
def test_a_march_leads_to_its_window(monkeypatch: pytest.MonkeyPatch, cycles: int, window: int, points: int):
    """The second case stops on the way, the third in the window; of the others the last states are kept."""
    samples, calls = 3, []

    def march(models: Any, states: np.ndarray, **given: Any) -> Any:
        calls.append((models, states, given))
        done, kept, each = given["cycles"], given["window"], given["samples"]
        stopping = "led" if len(calls) == 1 else "ran"
        status = np.array([Status.TOO_MANY_STEPS if one == stopping else Status.DONE for one in models])
        first = 1000.0 * len(calls)
        taken = np.array([numbered(kept * each, first + 100.0 * row) for row in range(len(models))])
        end = states + done
        return SimpleNamespace(
            status=status,
            reached=np.where(status == Status.DONE, done, 1.5),
            samples=taken.reshape(len(models), kept * each, STATES),
            state=end,
            extremes="of all",
        )

    engaged: list[Any] = []

    def engage_next(state: np.ndarray, model: Any) -> None:
        engaged.append(model)
        state += 0.25

    monkeypatch.setattr(marched, "march", march)
    monkeypatch.setattr(marched, "engage_next", engage_next)
    monkeypatch.setattr(marched, "extremes_of", lambda all_of_them, row: (all_of_them, row))
    models: Any = ["a", "led", "ran", "b"]
    given = {"cycles": cycles, "window": window, "points": points, "samples": samples}
    first, failed, late, last = march_all(models, numbered(4, 10.0), **given, rtol=1e-5)
    before = cycles - window
    (_, begun, leading), (good, _, through) = calls
    np.testing.assert_array_equal(begun, numbered(4, 10.0))
    section_before = max(0, min(points, cycles) - window)
    assert leading == {"cycles": before, "window": section_before, "samples": 1, "rtol": 1e-5}
    assert good == ["a", "ran", "b"]
    assert through == {
        "cycles": window,
        "window": window,
        "samples": samples,
        "started": before > 0,
        "first_cycle": before,
        "extremes": True,
        "rtol": 1e-5,
    }
    assert failed.passage is None
    assert (failed.solution, failed.cycles, failed.state[0]) == ("failed", 1, 11.0 + before)
    assert "after 1.5 mesh cycles" in failed.message
    assert late.passage is None
    assert (late.cycles, late.state[0]) == (before + 1, 12.0 + before + window)
    assert f"after {before + 1.5:g} mesh cycles" in late.message
    assert engaged == ["a", "b"]
    for case, row_led, row_ran, outcome in ((10.0, 0, 0, first), (13.0, 3, 2, last)):
        passage = outcome.passage
        assert passage is not None
        assert passage.first_cycle == before
        assert passage.start[0] == case + before
        assert passage.end[0] == case + before + window
        assert passage.extremes == ("of all", row_ran)
        np.testing.assert_array_equal(passage.window, numbered(window * samples, 2000.0 + 100.0 * row_ran))
        assert (outcome.solution, outcome.cycles) == ("transient", cycles)
        assert outcome.state[XI] == case + cycles + 0.25
        assert not np.any(outcome.state[[LAG, *WORKS]])
        starts = [1000.0 + 100.0 * row_led + one for one in range(section_before)]
        starts += [2000.0 + 100.0 * row_ran + samples * one for one in range(window)]
        np.testing.assert_array_equal(outcome.section[:, XI], starts[-points:])


def steady_answer(kind: str, period: int, first: float) -> Any:
    """What the search for a steady state says of a case."""
    return SimpleNamespace(
        kind=kind,
        period=period,
        last=np.full(STATES, first),
        state=np.full(STATES, first + 0.5),
        end=np.full(STATES, first + 0.75),
        cycles=7,
        message=f"said {first:g}",
        samples=numbered(period * 3, first),
        extremes="extremes",
        multipliers=np.array([0.3 - 0.4j, 0.1]),
        stable=period == 1,
        residual=2e-9,
    )


@pytest.mark.parametrize("followed", [False, True])
def test_every_case_has_its_own_steady_state(monkeypatch: pytest.MonkeyPatch, followed: bool):
    """Motions without period are marched, some at a time; each case keeps its place."""
    count = 2 * steady.AT_A_TIME + 6
    kinds = ["period-1", "chaotic", "failed"] + ["chaotic"] * (count - 3)
    models: Any = list(range(count))
    refused = 4

    def refuse(model: int) -> None:
        if model == refused:
            raise InputError("operating", rule="varies with time")

    pending = [one for one in range(count) if one != refused]
    answers = [steady_answer(kinds[one], int(one == 0), float(one)) for one in pending]
    calls: list[Any] = []

    def marching(some: Any, states: np.ndarray, **given: Any) -> list[Outcome]:
        calls.append((some, states[:, XI].tolist(), given))
        return [
            Outcome(Passage(0, states, states[0], states[0]), state + 0.125, states, "transient", 99)
            for state in states
        ]

    def seek(some: Any, states: np.ndarray, **given: Any) -> Any:
        assert some == pending
        np.testing.assert_array_equal(states[:, XI], np.array(pending) + 100.0)
        assert given == {"samples": 3, "max_cycles": 30, "solver": "bdf", "rtol": 1e-5}
        return answers

    def follow(model_at: Any, legs: Any, unstable: Any, **given: Any) -> Any:
        assert (model_at, legs, unstable) == ("model at", pending, "span")
        assert given == {"samples": 3, "max_cycles": 30, "solver": "bdf", "rtol": 1e-5}
        carried = [np.full(STATES, 1000.0 + one) for one in pending]
        return [
            SimpleNamespace(
                steady=answer, arrival=SimpleNamespace(carried=state, ends=(place,)), continued=[place]
            )
            for place, answer, state in zip(pending, answers, carried, strict=True)
        ]

    monkeypatch.setattr(steady, "refuse_time_dependent", refuse)
    monkeypatch.setattr(steady, "marched", marching)
    monkeypatch.setattr(steady, "steady_states", seek)
    monkeypatch.setattr(steady, "followed_states", follow)
    legs: Any = {"legs": list(range(count)), "model_at": "model at", "unstable": "span"} if followed else {}
    found = steady_all(
        models, numbered(count, 100.0), cycles=30, points=9, samples=3, method="bdf", rtol=1e-5, **legs
    )
    assert len(found) == count
    assert found[refused].passage is None
    assert (found[refused].cycles, found[refused].state[0]) == (0, 104.0)
    assert "varies with time" in found[refused].message
    wandering = [one for one in pending if kinds[one] == "chaotic"]
    assert [one for call in calls for one in call[0]] == wandering
    assert [one for call in calls for one in call[1]] == wandering
    assert all(len(call[0]) <= steady.AT_A_TIME for call in calls)
    assert calls[0][2] == {
        "cycles": 16, "window": 16, "points": 9, "samples": 3, "method": "bdf", "rtol": 1e-5
    }  # fmt: skip
    for one in pending:
        outcome, kind = found[one], kinds[one]
        assert (outcome.solution, outcome.message) == (kind, f"said {one}")
        if followed:
            assert (outcome.state[XI], outcome.state[LAG]) == (1000.0 + one, 0.0)
            assert (outcome.ends, outcome.continued) == ((one,), (one,))
        if kind == "failed":
            assert (outcome.passage, outcome.cycles) == (None, 7)
            continue
        assert outcome.passage is not None
        assert outcome.cycles == (1 + 7 if one == 0 else 99 + 7)
        assert (outcome.period, outcome.stable) == ((1, 1) if one == 0 else (0, -1))
        assert outcome.multiplier_max == pytest.approx(0.5)


def ready_for_rows(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Figures without a solver: every one of a case is the last state of its window."""

    def of_window(prepared: Any, passage: Passage, samples: int) -> Any:
        assert samples == SETTINGS.samples
        value = float(passage.end[0])
        return dict.fromkeys(evaluating.layout_of(SETTINGS).figures.keys() & FIGURES, value), {}

    monkeypatch.setattr(evaluating, "window_figures", of_window)
    return SimpleNamespace(case=case_of())


FIGURES = figures.FIGURES.keys()
END = BranchEnd("period doubling", 40.0, 0.01, 2, -0.6 + 0.8j)


def test_an_outcome_fills_the_row_of_its_case(monkeypatch: pytest.MonkeyPatch):
    """Whole periods fill the window; a motion without period all of it; a failure says why."""
    prepared = ready_for_rows(monkeypatch)
    settings = SETTINGS._replace(followed=True)
    rows = layout_of(settings).empty_rows(4)
    room = SETTINGS.window * SETTINGS.samples
    state = np.arange(STATES) + 0.5

    def outcome(period: int, length: int) -> Outcome:
        window = numbered(length, 100.0)
        section = np.zeros((2, STATES))
        section[:, XI], section[:, XI_RATE] = (7.0, 8.0), (17.0, 18.0)
        passage = Passage(0, window, window[0], np.full(STATES, 3.25))
        return Outcome(passage, state, section, "sort", 12, "said", period, 1, 0.7, 1e-9, (END,))

    three = 3 * SETTINGS.samples
    evaluating._fill(rows, 1, prepared, outcome(3, three), settings)
    evaluating._fill(rows, 2, prepared, outcome(0, room), settings)
    lost = Outcome(None, state, np.empty((0, STATES)), "failed", 5, "why")
    evaluating._fill(rows, 3, prepared, lost, settings)
    error = rows["transmission_error_rotational"]
    # one period of three cycles fits into the window of four
    np.testing.assert_array_equal(error[1], [*range(100, 100 + three), *[np.nan] * (room - three)])
    np.testing.assert_array_equal(error[2], range(100, 100 + room))
    assert rows["status"].tolist() == [0, DONE, DONE, FAILED]
    assert rows["message"].tolist()[3] == "why"
    assert (rows["period"][3], rows["stable"][3]) == (0, -1)
    assert rows["cycles"].tolist() == [0, 12, 12, 5]
    assert rows["solution"].tolist() == ["", "sort", "sort", "failed"]
    assert (rows["period"][1], rows["stable"][1], rows["multiplier_max"][1]) == (3, 1, 0.7)
    np.testing.assert_array_equal(rows["poincare_error"][1], [7.0, 8.0, np.nan, np.nan, np.nan])
    np.testing.assert_array_equal(rows["poincare_rate"][1], [17.0, 18.0, np.nan, np.nan, np.nan])
    np.testing.assert_array_equal(rows["state"][1], state)
    assert rows["efficiency"][1] == 3.25
    # 3.25 is far more than the hundredth that friction may give to the vibration
    assert "friction feeds the vibration" in rows["message"][1]
    assert (rows["end_kind"][1, 0], rows["end_kind"][1, 1], rows["end_kind"][3, 0]) == (2, 0, 0)


def test_ends_of_branches_by_number():
    rows = layout_of(SETTINGS._replace(followed=True, unstable=True)).empty_rows(2)
    several = [END._replace(value=40.0 + one, kind=kind) for one, kind in enumerate(ends.KINDS)]
    ends.fill_ends(rows, 1, several)
    assert rows["end_kind"].tolist() == [[0] * 4, [1, 2, 3, 4]]
    assert rows["end_value"][1].tolist() == [40.0, 41.0, 42.0, 43.0]
    assert (rows["end_within"][1, 0], rows["end_period"][1, 0]) == (0.01, 2)
    assert rows["end_multiplier_modulus"][1, 2] == pytest.approx(1.0)
    assert rows["end_multiplier_angle"][1, 2] == pytest.approx(np.pi - np.arctan2(0.8, 0.6))
    described = ends.VARIABLES["end_kind"]
    for number, name in enumerate(ends.KINDS, 1):
        assert f"{number} {name}" in described.long_name
    assert described.fill == ends.VARIABLES["end_period"].fill == 0


def branch_of(values: list[float], finish: BranchEnd | None) -> Any:
    """An unstable branch through some values."""
    multipliers = np.array([[-1.5j * one, 0.2] for one in range(1, len(values) + 1)])
    return SimpleNamespace(
        values=np.array(values),
        period=2,
        finish=finish,
        multipliers=multipliers,
        residuals=np.array(values) * 1e-9,
    )


def test_unstable_motions_stand_behind_their_ends(monkeypatch: pytest.MonkeyPatch):
    settings = SETTINGS._replace(followed=True, unstable=True)
    rows = layout_of(settings).empty_rows(2)
    motion = SimpleNamespace(
        samples=numbered(6, 50.0), state=np.zeros(STATES), end=np.ones(STATES), extremes="extremes"
    )
    gone = SimpleNamespace(samples=np.empty((0, STATES)))

    def of_window(prepared: float, passage: Any, samples: int) -> Any:
        assert (passage.first_cycle, samples, passage.extremes) == (0, 3, "extremes")
        assert (passage.start[0], passage.end[0]) == (0.0, 1.0)
        return dict.fromkeys(beyond.UNSTABLE_FIGURES, prepared), {}

    monkeypatch.setattr(beyond, "window_figures", of_window)
    branches: Any = [
        (1, branch_of([31.0, 32.0, 33.0], END._replace(kind="fold", value=33.5)), [motion, gone, motion]),
        (ends.ENDS, branch_of([9.0], None), [motion]),
    ]
    at: Any = lambda value: 10.0 * value  # noqa: E731
    beyond.fill_unstable(rows, 1, branches, at, 3)
    assert rows["unstable_period"].tolist() == [[0] * 4, [0, 2, 0, 0]]
    assert rows["unstable_finish"].tolist() == [[0] * 4, [0, 1, 0, 0]]
    assert rows["unstable_finish_value"][1, 1] == 33.5
    nan = np.nan
    np.testing.assert_array_equal(rows["unstable_value"][1, 1, :4], [31.0, 32.0, 33.0, nan])
    np.testing.assert_allclose(rows["unstable_multiplier_modulus"][1, 1, :4], [1.5, 3.0, 4.5, nan])
    np.testing.assert_allclose(rows["unstable_multiplier_angle"][1, 1, :3], -np.pi / 2.0)
    np.testing.assert_allclose(rows["unstable_residual"][1, 1, :3], [31e-9, 32e-9, 33e-9])
    np.testing.assert_array_equal(rows["unstable_film_min"][1, 1, :4], [310.0, nan, 330.0, nan])
    np.testing.assert_array_equal(rows["unstable_poincare_error"][1, 1, 2, :3], [50.0, 53.0, nan])
    unstable.fill_branch(rows, 0, 3, branch_of([5.0], None))
    assert rows["unstable_finish"][0, 3] == 0
    assert rows["unstable_value"][0, 3, 0] == 5.0


def prepared_of(case: Any) -> Any:
    return SimpleNamespace(case=case, model=f"model {case.number}", cycle="cycle")


def test_cases_of_a_chunk_keep_their_rows(monkeypatch: pytest.MonkeyPatch):
    """Two tolerances are two batches; what cannot be made fails alone; a given state is kept."""
    ready_for_rows(monkeypatch)
    loose = SimpleNamespace(rtol=1e-3, method="bdf", max_steps=50, initial="static")
    cases: Any = [
        case_of(0),
        "has no teeth",
        case_of(2, solver=loose),
        case_of(3),
        case_of(4),
        case_of(5, solver=loose),
    ]

    def prepare(case: Any, table: Any) -> Any:
        assert table == f"table {case.number}"
        if case.number == 4:
            raise InputError("drive", rule="are pointed")
        return prepared_of(case)

    calls: list[Any] = []

    def solver(models: Any, states: np.ndarray, **given: Any) -> list[Outcome]:
        calls.append((models, states[:, 0].tolist(), given))
        return [
            Outcome(
                Passage(0, numbered(3, 0.0), states[0], np.full(STATES, state[0] / 1e4)),
                state,
                numbered(1, 0.0),
                model,
                4,
                period=1,
            )
            for model, state in zip(models, states, strict=True)
        ]

    monkeypatch.setattr(evaluating, "tabulated", lambda case: f"table {case.number}")
    monkeypatch.setattr(evaluating, "prepare", prepare)
    monkeypatch.setattr(
        evaluating, "_start", lambda prepared, settings: np.full(STATES, 1.0 + prepared.case.number)
    )
    monkeypatch.setattr(evaluating, "natural_frequencies", lambda model, cycle: np.array([11.0, 12.0]))
    monkeypatch.setattr(evaluating, "marched", solver)
    monkeypatch.setattr(steady, "steady", solver)
    states = np.full((6, STATES), np.nan)
    states[3] = 77.0
    chunk = Chunk(np.arange(6) + 10, tuple(cases), states)
    rows = evaluating.evaluate(chunk, SETTINGS._replace(steady=False), 2)
    assert rows["status"].tolist() == [DONE, FAILED, DONE, DONE, FAILED, DONE]
    assert rows["solution"].tolist() == ["model 0", "failed", "model 2", "model 3", "failed", "model 5"]
    assert rows["message"][1] == "has no teeth"
    assert "are pointed" in rows["message"][4]
    assert rows["state"][:, 0].tolist()[::3] == [1.0, 77.0]
    np.testing.assert_array_equal(rows["mode_frequency"][0, :3], [11.0, 12.0, np.nan])
    tight, other = calls
    assert tight[:2] == (["model 0", "model 3"], [1.0, 77.0])
    assert other[:2] == (["model 2", "model 5"], [3.0, 6.0])
    assert tight[2] == {
        "cycles": 30,
        "points": 5,
        "samples": 3,
        "rtol": 1e-6,
        "max_steps": 900,
        "method": "explicit-5",
        "workers": 2,
        "window": 4,
    }
    assert (other[2]["rtol"], other[2]["max_steps"], other[2]["method"]) == (1e-3, 50, "bdf")
    calls.clear()
    evaluating.evaluate(Chunk(np.arange(1), (cases[0],)), SETTINGS._replace(method="tsit5"), None)
    ((_, begun, given),) = calls
    assert begun == [1.0]
    assert given["method"] == "tsit5"
    assert not {"window", "legs", "unstable"} & given.keys()
    calls.clear()
    way = Way(cases[0], 1.0, 2.0, 1, (0.5, 9.0))
    monkeypatch.setattr(evaluating, "legs_of", lambda some, given: [given])
    monkeypatch.setattr(
        evaluating, "prepared_between", lambda *_: lambda line, value: prepared_of(case_of(line + value))
    )
    both = Chunk(np.arange(2), (cases[0], cases[3]), None, (None, way))
    evaluating.evaluate(both, SETTINGS._replace(followed=True, unstable=True), None)
    ((_, _, given),) = calls
    assert given["legs"] == [[None, way]]
    assert given["model_at"](3, 4) == "model 7"
    assert given["unstable"].span == (0.5, 9.0)


def test_cases_are_solved_again_at_the_temperature_of_their_motion(monkeypatch: pytest.MonkeyPatch):
    """Only those whose temperature moved, until none does or five were solved; followed ones stay."""
    warm = {"temperature": "asked for"}
    cases: Any = (
        case_of(0),
        case_of(10, **warm),
        "bad",
        case_of(20, **warm),
        case_of(30, **warm),
        case_of(40, **warm),
    )
    way = Way(cases[0], 1.0, 2.0, 1, (1.0, 2.0))
    rounds: list[Any] = []

    def solved(chunk: Chunk, settings: Any, workers: Any) -> dict[str, np.ndarray]:
        rounds.append((chunk.numbers.tolist(), None if chunk.states is None else chunk.states[:, 0].tolist()))
        numbers = [-1 if isinstance(one, str) else one.number for one in chunk.cases]
        return {
            "status": np.array([FAILED if one in (-1, 40) else DONE for one in numbers]),
            "bulk_temperature": np.array(numbers) + 0.5,
            "power_friction_mean": np.array(numbers) + 0.25,
        }

    def again(case: Any, temperature: float, lost: float) -> Any:
        assert (temperature, lost) == (case.number + 0.5, case.number + 0.25)
        last = {10: 12, 20: 29}[case.number // 10 * 10]
        return case_of(case.number + 1, **warm) if case.number < last else None

    monkeypatch.setattr(evaluating, "_evaluate", solved)
    monkeypatch.setattr(evaluating, "at_own_temperature", again)
    states = numbered(6, 60.0)
    chunk = Chunk(np.arange(6) * 2, cases, states, (None, None, None, None, way, None))
    rows = evaluating.evaluate(chunk, SETTINGS, None)
    # the second was solved three times, the fourth as often as any is
    assert [one[0] for one in rounds] == [[0, 2, 4, 6, 8, 10], [2, 6], [2, 6], [6], [6]]
    assert rounds[1][1] == [61.0, 63.0]
    assert rows["bulk_temperature"].tolist() == [0.5, 12.5, -0.5, 24.5, 30.5, 40.5]


def test_figures_of_cases_or_why_there_are_none():
    cases: Any = [1, "why not", 3]

    class Ours:
        def settings(self, made: Any, transient: Any, engine: str) -> Any:
            assert (made, transient, engine) == ([1, 3], None, "native")
            return "settings"

        def evaluate(self, chunk: Chunk, settings: str, workers: int) -> Any:
            assert (chunk.numbers.tolist(), chunk.cases) == ([0, 1, 2], tuple(cases))
            assert (settings, workers) == ("settings", 3)
            message = np.array(["", "why not", "lost"], dtype=object)
            return {"status": [DONE, FAILED, FAILED], "message": message, "loss": np.array([4.0, 5.0, 6.0])}

    ours: Any = Ours()
    assert batched(ours, cases, ["loss"], 3) == [{"loss": 4.0}, "why not", "lost"]
    assert batched(ours, ["no", "none"], ["loss"], 3) == ["no", "none"]


def test_an_equilibrium_is_sought_once(monkeypatch: pytest.MonkeyPatch):
    """In creep, without friction, whatever the speed; another table has another one."""
    sought: list[Any] = []

    class Numbers(tuple[Any, ...]):
        __slots__ = ()

        def _replace(self, **changed: Any) -> "Numbers":
            assert changed == {"nominal_speed": evaluating.CREEP}
            return Numbers(self[1:])

    class Model(SimpleNamespace):
        def _replace(self, **changed: Any) -> "Model":
            return Model(**vars(self) | changed)

    def equilibrium(model: Any) -> np.ndarray:
        sought.append(model.mechanics)
        return np.full(STATES, float(len(sought)))

    monkeypatch.setattr(evaluating, "_equilibria", type(evaluating._equilibria)())
    monkeypatch.setattr(evaluating, "frictionless", lambda model: model)
    monkeypatch.setattr(evaluating, "static_equilibrium", equilibrium)
    monkeypatch.setattr(evaluating, "initial_state", lambda model, name: name)
    tables = [SimpleNamespace(number=number) for number in range(40)]

    def start(table: int, speed: float, settings: Settings = SETTINGS, initial: str = "static") -> Any:
        model = Model(table=tables[table], options="options", mechanics=Numbers((speed, 7.0)))
        solver = SimpleNamespace(initial=initial)
        prepared: Any = SimpleNamespace(model=model, case=case_of(solver=solver))
        return evaluating._start(prepared, settings)

    assert start(0, 10.0)[0] == start(0, 20.0)[0] == 1.0
    assert start(1, 10.0)[0] == 2.0
    assert start(0, 30.0)[0] == 1.0
    changed = start(0, 30.0)
    changed += 5.0
    assert start(0, 30.0)[0] == 1.0
    assert sought == [(7.0,), (7.0,)]
    assert start(0, 10.0, SETTINGS._replace(steady=False)) == "static"
    assert start(0, 10.0, initial="unloaded") == "unloaded"
    # what was kept at this place belongs to another table
    evaluating._equilibria[next(iter(evaluating._equilibria))] = (tables[5], np.zeros(STATES))
    assert start(0, 10.0)[0] == 3.0
    for number in range(40):
        start(number, 10.0)
    assert len(evaluating._equilibria) < 40
    count = len(sought)
    start(39, 90.0)
    assert len(sought) == count


def test_a_table_is_made_once_for_cases_that_share_it(monkeypatch: pytest.MonkeyPatch):
    made: list[int] = []
    monkeypatch.setattr(evaluating, "_tables", type(evaluating._tables)())
    monkeypatch.setattr(evaluating, "table_key", lambda case: case // 2)
    monkeypatch.setattr(evaluating, "tables", lambda case: made.append(case) or f"table {case}")
    assert [evaluating.tabulated(case) for case in (0, 1, 2, 0)] == [
        "table 0",
        "table 0",
        "table 2",
        "table 0",
    ]
    for case in range(0, 100, 2):
        evaluating.tabulated(case)
        evaluating.tabulated(0)  # what is used stays
    assert made.count(0) == 1
    assert len(evaluating._tables) < 50
