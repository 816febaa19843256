"""A run of a gear pair with stand-ins for what it is made of: what its record and its summary hold."""

from collections.abc import Sequence
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.dynamics.parameters import (
    STATES,
    WORK_DAMPING,
    WORK_FRICTION,
    WORK_IN,
    WORK_OUT,
    WORK_PARAMETRIC,
)
from tribodyn.dynamics.recorded import UNRECORDED
from tribodyn.errors import SimulationError
from tribodyn.solve.transient import SampledStates, Stop
from tribodyn.studies.gear_pair import assumptions, settled
from tribodyn.studies.gear_pair import run as running
from tribodyn.studies.gear_pair.assumptions import judge_balance, quantities_of
from tribodyn.studies.gear_pair.run import AVERAGED, REGULAR, RunStatistics, window_of
from tribodyn.studies.gear_pair.settled import at_own_temperature
from tribodyn.studies.gear_pair.summary import RECORDED, RunningExtremes, steady_figures

SIDE = np.array([1.0, 1.0, 1.0, -1.0, -1.0])
CYCLE: Any = SimpleNamespace(side=SIDE, front_pairs=3, contact_ratio=2.4, pitch_angle=0.2)
SAMPLES = 4


def block_of(rng: np.random.Generator, count: int, rise: float = 0.0) -> dict[str, np.ndarray]:
    """What is recorded of some states: random numbers, all of which are told apart."""
    pairs = (
        *(name for name, _ in RECORDED.values()),
        *("transmission_error", "pressure_angle", "mesh_stiffness", "friction_coefficient", *UNRECORDED),
    )
    block = {name: rng.normal(size=(count, len(SIDE))) for name in pairs}
    block |= {
        name: rng.normal(size=count) + rise for name in ("transmission_error_rotational", "stored_energy")
    }
    block["normal_load"] = np.abs(block["normal_load"]) + rise
    block["displacement"] = rng.normal(size=(count, 6))
    return block | {"time": np.cumsum(rng.uniform(0.1, 0.2, count))}


def test_extremes_in_plain_loops(rng: np.random.Generator):
    """Of every quantity and both kinds of flanks; the last slot of either side is its newest pair."""
    count = 30
    block, cycles = block_of(rng, count), np.arange(30) / 7.0
    block["film_parameter"][:, :] = np.nan
    found = RunningExtremes(CYCLE)
    for part in (slice(0, 11), slice(11, 11), slice(11, 30)):
        found.add(cycles[part], {name: values[part] for name, values in block.items()})

    def extreme(values: Sequence[tuple[float, int, int | None]], sign: int) -> tuple[Any, ...]:
        value, row, pair = max(values, key=lambda one: sign * one[0])
        return value, block["time"][row], cycles[row], pair

    expected = {}
    for name, (dataset, sign) in RECORDED.items():
        if dataset != "film_parameter":
            # slots 0, 1, 2 are pairs −1, 0, 1; those of back flanks go on from 2
            every = [(float(block[dataset][k, q]), k, q - 1) for k in range(count) for q in range(5)]
            assert sign == (-1 if name.endswith("_min") else 1)
            expected[name] = extreme(every, sign)
    for word, sign in (("max", 1), ("min", -1)):
        whole = [(float(value), k, None) for k, value in enumerate(block["transmission_error_rotational"])]
        expected[f"transmission_error_rotational_{word}"] = extreme(whole, sign)
        for prefix, newest in (("", 2), ("back_", 4)):
            of_pair = [(float(block["transmission_error"][k, newest]), k, None) for k in range(count)]
            expected[f"{prefix}transmission_error_{word}"] = extreme(of_pair, sign)
    for prefix, slots in (("", (0, 1, 2)), ("back_", (3, 4))):
        forces = [
            (sum(block["normal_load"][k, q] * np.cos(block["pressure_angle"][k, q]) for q in slots), k, None)
            for k in range(count)
        ]
        expected[f"{prefix}mesh_force_max"] = extreme(forces, 1)
    assert set(found.by_name) == set(expected)
    for name, (value, time, cycle, pair) in expected.items():
        one = found.by_name[name]
        assert (one.value, one.time, one.mesh_cycle) == pytest.approx((value, time, cycle), rel=1e-14), name
        assert one.pair == pair
    spread = expected["transmission_error_max"][0] - expected["transmission_error_min"][0]
    assert found.spread("transmission_error") == pytest.approx(spread)
    assert np.isnan(found.spread("no_error"))
    assert "film_parameter_min" not in found.values()


@pytest.mark.parametrize(("side", "way"), [(SIDE, 1.0), (SIDE, -1.0), (np.ones(5), -1.0)])
def test_errors_are_of_the_newest_pair_that_works(side: np.ndarray, way: float, rng: np.random.Generator):
    """Of the back flanks where the gear drives; without any, of those that there are."""
    count = 3 * SAMPLES
    cycle: Any = SimpleNamespace(
        side=side,
        front_pairs=int(np.sum(side > 0)),
        pitch_angle=0.2,
        pinion_pitch_radius=0.03,
        gear_pitch_radius=0.05,
        roll_start=-0.1,
    )
    block = block_of(rng, count) | {
        "friction_force": rng.normal(size=(count, 5)),
        "sliding_speed": rng.normal(size=(count, 5)),
        "closure_in_range": np.ones((count, 5)),
        "friction_in_range": np.ones((count, 5)),
    }
    cycles = np.arange(count) / SAMPLES
    extremes = RunningExtremes(cycle)
    extremes.add(cycles, block)
    work = np.zeros(STATES)
    work[WORK_OUT], work[WORK_IN] = way * 3.0, way * 3.1
    found = steady_figures(block, work, cycle, SAMPLES, 90.0, extremes)
    back = way < 0.0 and side[-1] < 0.0
    newest = 4 if back or side[-1] > 0.0 else 2
    mean = sum(float(block["transmission_error"][k, newest]) for k in range(count)) / count
    assert found["transmission_error_mean"] == pytest.approx(mean)
    slots = [q for q in range(5) if (side[q] < 0.0) == back]
    force = max(
        sum(block["normal_load"][k, q] * np.cos(block["pressure_angle"][k, q]) for q in slots)
        for k in range(count)
    )
    # the load's work over the way of the pitch circle
    assert found["dynamic_factor"] == pytest.approx(force / (3.0 / (0.03 * 0.2 * 3.0)))
    assert found["mesh_frequency"] == pytest.approx(90.0 / 0.2)
    pairs = [float(value) for value in block["transmission_error"][:, newest]]
    assert found["transmission_error_peak_to_peak"] == pytest.approx(max(pairs) - min(pairs))


@pytest.mark.parametrize(("cycles", "window"), [(1, 1), (3, 1), (4, 1), (9, 2), (1600, 400), (4000, 400)])
def test_means_are_of_the_last_quarter(cycles: int, window: int):
    assert window_of(cycles) == window


def statistics_of(
    rng: np.random.Generator,
    monkeypatch: pytest.MonkeyPatch,
    ends: tuple[int, ...],
    total: int = 6,
    window: int = 2,
) -> tuple[RunStatistics, dict[str, np.ndarray], np.ndarray, np.ndarray, list[Any]]:
    """Statistics of a run of some samples, which arrives in parts; what went in; what was judged."""
    count = ends[-1]
    cycles = np.arange(count) / SAMPLES + np.where(np.arange(count) % 2, 4e-10, -4e-10)
    states = rng.normal(size=(count, STATES))
    block = block_of(rng, count)
    judged: list[Any] = []

    def judge(_: Any, at: np.ndarray, one: Any, of: Any, between_samples: bool = False) -> None:
        assert of.cycle is CYCLE
        judged.append((len(at), between_samples))

    monkeypatch.setattr(running, "judge_block", judge)
    prepared: Any = SimpleNamespace(cycle=CYCLE)
    statistics = RunStatistics(window, total, prepared)
    for begin, end in zip((0, *ends[:-1]), ends, strict=True):
        part = slice(begin, end)
        between = block_of(rng, 1, rise=9.0 if begin == 0 else 5.0)
        statistics.add(
            SampledStates(cycles[part], states[part], 0, 0),
            {name: values[part] for name, values in block.items()},
            between,
            np.array([cycles[begin] + 0.1]),
        )
    return statistics, block, states, cycles, judged


def test_a_run_arrives_in_parts(rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch):
    """The window is the last whole cycles, its last sample left out; the balance is of the whole run."""
    count, opening = 6 * SAMPLES + 1, 4 * SAMPLES
    ends = (9, opening, 21, count)
    statistics, block, states, cycles, judged = statistics_of(rng, monkeypatch, ends)
    assert judged == [
        (9, False),
        (1, True),
        (7, False),
        (1, True),
        (5, False),
        (1, True),
        (4, False),
        (1, True),
    ]
    assert statistics.written == count
    for name, values in statistics.window().items():
        np.testing.assert_array_equal(values, block[name][opening : count - 1])
    np.testing.assert_array_equal(statistics.window_work(), states[-1] - states[opening])
    found = statistics.figures(complete=True)
    works = states[-1] - states[0]
    balance = (
        works[WORK_IN] + works[WORK_PARAMETRIC] - works[WORK_OUT] - works[WORK_FRICTION] - works[WORK_DAMPING]
    )
    balance -= block["stored_energy"][-1] - block["stored_energy"][0]
    largest = max(
        abs(works[one]) for one in (WORK_IN, WORK_PARAMETRIC, WORK_OUT, WORK_FRICTION, WORK_DAMPING)
    )
    assert found["energy_residual"] == pytest.approx(balance / largest, rel=1e-12)
    # the first block between samples has the maximum of the run, the last two those of the window
    run, last = found["extremes"]["run"], found["extremes"]["last_cycles"]
    assert run["normal_load_max"]["value"] > 9.0 > last["normal_load_max"]["value"] > 5.0
    assert run["normal_load_max"]["mesh_cycle"] == pytest.approx(0.1)
    assert last["normal_load_max"]["mesh_cycle"] >= 4.0
    assert found["normal_load_max"] == last["normal_load_max"]["value"]
    assert statistics.figures(complete=False)["normal_load_max"] == run["normal_load_max"]["value"]
    assert cycles[opening] < 4.0 < cycles[opening] + 1e-9


def test_a_run_without_states_has_no_figures():
    assert RunStatistics(1, 4, SimpleNamespace(cycle=CYCLE)).figures(complete=False) == {}  # pyright: ignore[reportArgumentType]


def prepared_for(monkeypatch: pytest.MonkeyPatch, case: Any, averaged: int, parts: list[Any]) -> list[Any]:
    """Stand-ins for the physics of a run, and what its record is given."""
    model = SimpleNamespace(options=SimpleNamespace(averaged=averaged))
    made = SimpleNamespace(
        case=case,
        cycle=CYCLE,
        model=model,
        masses=((1.5, 0.002), (9.5, 0.04)),
        assembly=SimpleNamespace(family=SimpleNamespace(involute=True)),
        thermal=None,
        lubricant="oil",
    )
    written: list[Any] = []

    class Writer:
        def write(self, at: int, values: dict[str, np.ndarray]) -> None:
            assert not set(UNRECORDED) & values.keys()
            written.append((at, len(values["time"])))

        def fail(self, message: str, summary: Any) -> str:
            written.append(("failed", message))
            return "path"

        def finish(self, summary: Any) -> str:
            written.append("finished")
            return "path"

    @contextmanager
    def writer(_: Any, path: Any, layout: Any, samples: int, **given: Any) -> Any:
        written.append((samples, given["force"]))
        yield Writer()

    def outputs(cycles: np.ndarray, states: np.ndarray, extremes: Any, model: Any) -> Any:
        seed = np.random.default_rng(len(cycles))
        return block_of(seed, len(cycles)), block_of(seed, 1), cycles[:1]

    simple: dict[str, Any] = {
        "prepare": lambda _: made,
        "natural_frequencies": lambda *_: [1.0],
        "single_pair": lambda cycle, torque: SimpleNamespace(stiffness=torque * 1e6),
        "compliance_remark": lambda *_: "",
        "law_figures": lambda _: {},
        "oil_data": lambda oil: oil,
        "as_arrays": lambda _: {},
        "geometry_arrays": lambda _: {},
        "scales_of": lambda _: {},
        "writer": writer,
        "initial_state": lambda model, name: np.zeros(STATES),
        "choose": lambda method, model, state: SimpleNamespace(method="chosen", reason="so"),
        "transient": lambda model, state, settings: written.append(settings) or iter(parts),
        "outputs_with_extremes": outputs,
        "judge_block": lambda *_, **__: None,
        "exceeded_limits": lambda case, *values: {"touching": [one.shape for one in values]},
        "steady_figures": lambda *given: {
            "power_in_mean": 1.0,
            "efficiency": 0.9,
            "friction_work_on_vibration": 0.02,
            "given": given[3:5],
        },
        "thermal_figures": lambda *_: {},
        "contact_figures": lambda *_: {},
        "rated": lambda *given: SimpleNamespace(
            dynamic=SimpleNamespace(factor=1.1, resonance_ratio=given[-1][0] / given[-1][1])
        ),
    }
    for name, stand_in in simple.items():
        monkeypatch.setattr(running, name, stand_in)
    return written


def case_with(**changed: Any) -> Any:
    """A case as far as a run reads it: 5 mesh cycles of 4 samples."""
    given = {
        "output": SimpleNamespace(samples_per_cycle=SAMPLES),
        "solver": SimpleNamespace(cycles=5, method="auto", rtol=1e-6, max_steps=70, initial="static"),
        "mesh": SimpleNamespace(backlash=None),
        "operating": SimpleNamespace(gear_torque=300.0, pinion_speed=60.0),
        "materials": (),
        "quality": None,
        "lubricant": "oil",
        "friction": SimpleNamespace(sliding="dynamic"),
    }
    return SimpleNamespace(**given | changed)


def parts_of(*counts: int) -> list[Any]:
    """Samples that a transient yields, the first of no length."""
    cycles, first, parts = np.arange(sum(counts)) / SAMPLES, 0, []
    for count in (0, *counts):
        parts.append(SampledStates(cycles[first : first + count], np.ones((count, STATES)), 0, 0))
        first += count
    return parts


@pytest.mark.parametrize("averaged", [0, 1])
def test_the_summary_of_a_run(monkeypatch: pytest.MonkeyPatch, averaged: int):
    case: Any = case_with(mesh=SimpleNamespace(backlash=4e-5))
    parts = [*parts_of(9, 8, 4), Stop(np.zeros(STATES), 5.0, 321, 654, "", 0.25)]
    written = prepared_for(monkeypatch, case, averaged, parts)
    told: list[float] = []
    made = running._run(case, "path", True, told.append)  # pyright: ignore[reportArgumentType]
    (room, force), settings, *blocks, last = written
    assert (room, force, last) == (5 * SAMPLES + 1, True, "finished")
    assert (settings.method, settings.cycles, settings.window, settings.samples) == ("chosen", 5, 1, SAMPLES)
    assert (settings.rtol, settings.max_steps, settings.extremes) == (1e-6, 70, True)
    assert blocks == [(0, 9), (9, 8), (17, 4)]
    assert told == [9 / 20, 17 / 20, 1.0]
    found = made.summary
    assert made.status == "complete"
    assert [found[f"{gear}_mass"] for gear in ("pinion", "gear")] == [1.5, 9.5]
    assert [found[f"{gear}_inertia"] for gear in ("pinion", "gear")] == [0.002, 0.04]
    assert found["pitch_point"] == (AVERAGED if averaged else REGULAR)
    assert found["normal_backlash"] == 4e-5
    assert found["compliance_remark"] is None
    assert found["stiffness_single_pair_at_pitch_point"] == 3e8
    assert (found["steps"], found["rhs_evaluations"], found["simulated_time"]) == (321, 654, 0.25)
    assert (found["cycles_done"], found["solver"], found["given"]) == (5.0, "chosen", (SAMPLES, 60.0))
    assert "friction feeds the vibration" in found["warning"]
    assert found["wall_time"] > 0.0
    # only where pairs touch
    assert all(shape == (SAMPLES * 5,) for shape in found["touching"])
    assert "dynamic_factor_iso" not in found


def test_a_run_that_stops_keeps_what_it_has(monkeypatch: pytest.MonkeyPatch):
    case = case_with()
    stop = Stop(np.zeros(STATES), 2.25, 30, 60, "too many steps", 0.125)
    written = prepared_for(monkeypatch, case, 0, [*parts_of(9), stop])
    made = running._run(case, "path", False, None)  # pyright: ignore[reportArgumentType]
    assert made.status == "failed"
    assert "too many steps" in made.message
    assert written[-1] == ("failed", made.message)
    assert made.summary["cycles_done"] == 2.25
    assert "normal_backlash" not in made.summary
    assert "efficiency" not in made.summary

    def none(model: Any, name: str) -> None:
        raise SimulationError("no equilibrium")

    monkeypatch.setattr(running, "initial_state", none)
    made = running._run(case, "path", False, None)  # pyright: ignore[reportArgumentType]
    assert (made.status, "no equilibrium" in made.message) == ("failed", True)


@pytest.mark.parametrize(
    ("quality", "involute", "torque", "said"),
    [
        ("6", True, 300.0, True),
        (None, True, 300.0, False),
        ("6", False, 300.0, False),
        ("6", True, 0.0, False),
        ("6", True, -5.0, False),
    ],
)
def test_the_standards_factor_is_of_a_driving_involute_pinion_of_a_quality(
    monkeypatch: pytest.MonkeyPatch, quality: str | None, involute: bool, torque: float, said: bool
):
    case = case_with(quality=quality, operating=SimpleNamespace(gear_torque=torque, pinion_speed=60.0))
    prepared_for(monkeypatch, case, 0, [])
    family = SimpleNamespace(involute=involute)
    prepared: Any = SimpleNamespace(case=case, assembly=SimpleNamespace(family=family), masses=())
    found = running._by_standard(prepared)
    assert found == ({"dynamic_factor_iso": 1.1, "resonance_ratio_iso": 60.0 / torque} if said else {})


@pytest.mark.parametrize(("settles", "runs"), [(0, 1), (2, 3), (9, 5)])
def test_a_case_is_run_until_its_own_temperature_five_times_at_most(
    monkeypatch: pytest.MonkeyPatch, settles: int, runs: int
):
    done: list[Any] = []

    def once(case: int, path: Any, force: bool, progress: Any) -> Any:
        done.append((case, force))
        summary = {"bulk_temperature": 300.0 + case, "power_friction_mean": 10.0 * case}
        return SimpleNamespace(status="complete", summary=summary)

    def again(case: int, temperature: float, lost: float) -> int | None:
        assert (temperature, lost) == (300.0 + case, 10.0 * case)
        return case + 1 if case < settles else None

    monkeypatch.setattr(running, "target", lambda *_: "path")
    monkeypatch.setattr(running, "_run", once)
    monkeypatch.setattr(running, "at_own_temperature", again)
    running.run(0)  # pyright: ignore[reportArgumentType]
    # what it wrote itself it may replace
    assert done == [(one, one > 0) for one in range(runs)]
    monkeypatch.setattr(running, "_run", lambda *_: done.append("failed") or SimpleNamespace(status="failed"))
    done.clear()
    running.run(0)  # pyright: ignore[reportArgumentType]
    assert done == ["failed"]


def test_a_tenth_of_a_kelvin_is_not_worth_another_motion(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(settled, "bulk_temperature_of_loss", lambda case, assembly, lost: 350.0 + lost)
    monkeypatch.setattr(settled, "replace", lambda one, **changed: changed)
    monkeypatch.setattr(settled, "assemble", lambda *_: None)
    asking: Any = SimpleNamespace(temperature="asked for", family="involute", drive=None)
    for off, again in ((0.09, False), (0.11, True), (-0.09, False), (-0.11, True)):
        found: Any = at_own_temperature(asking, 350.0 + off, 0.0)
        assert (found is not None) == again
    assert at_own_temperature(asking, 340.0, 5.0) == {"temperature": {"mesh_loss": 5.0}}
    assert at_own_temperature(asking, None, 5.0) is None
    assert at_own_temperature(asking, 340.0, -1.0) is None
    assert at_own_temperature(asking, 340.0, float("nan")) is None


def test_what_is_judged_of_states(rng: np.random.Generator):
    """Deflection is load over stiffness, of modules; the larger shift of both gears, of the clearance."""
    block = block_of(rng, 6)
    block["mesh_stiffness"][2, 3] = 0.0
    found = quantities_of(block, 0.003, 7e-4)
    for k in range(6):
        gears = [
            (block["displacement"][k, 2 * gear] ** 2 + block["displacement"][k, 2 * gear + 1] ** 2) ** 0.5
            for gear in (0, 1)
        ]
        assert found["bearing_displacement"][k] == pytest.approx(max(gears) / 7e-4)
        for q in range(5):
            stiffness = block["mesh_stiffness"][k, q]
            wanted = block["normal_load"][k, q] / stiffness / 0.003 if stiffness > 0.0 else np.nan
            assert found["deflection"][k, q] == pytest.approx(wanted, nan_ok=True)
    taken: list[Any] = []
    judge: Any = SimpleNamespace(take=lambda *given: taken.append(given))
    judge_balance(judge, {"energy_residual": -3e-5}, 1e-6)
    judge_balance(judge, {}, 1e-6)
    assert taken == [({"energy_residual": pytest.approx(30.0)},)]


def test_blocks_are_judged_by_the_numbers_of_their_pairs(
    rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
):
    clearances = {"pinion": 4e-4, "gear": 3e-4}
    monkeypatch.setattr(assumptions, "tip_clearance", lambda assembly, side: clearances[side])
    taken: list[Any] = []
    judge: Any = SimpleNamespace(take=lambda *given: taken.append(given))
    drive = SimpleNamespace(module=0.002)
    oil = SimpleNamespace(temperature=350.0)
    prepared: Any = SimpleNamespace(
        cycle=CYCLE, case=SimpleNamespace(drive=drive), assembly="assembly", lubricant=oil
    )
    block, cycles = block_of(rng, 3), np.array([0.5, 1.0, 1.5])
    assumptions.judge_block(judge, np.empty(0), {}, prepared)
    assumptions.judge_block(judge, cycles, block, prepared, between_samples=True)
    ((quantities, places, numbers, between),) = taken
    expected = quantities_of(block, 0.002, 3e-4)
    expected["contact_temperature"] = 350.0 + block["flash_temperature_rise"]
    for name, values in expected.items():
        np.testing.assert_array_equal(quantities[name], values)
    assert places["mesh_cycle"] is cycles
    assert (numbers, between) == ([-1, 0, 1, 2, 3], True)
