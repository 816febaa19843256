"""What several meshes cost, as ratios to a pair and to other programs in the same run."""

import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
import tomli_w

from tests.support.planet_sets import planet_set
from tests.support.soak_parameters import all_in_soak
from tests.support.timing import least
from tests.support.train_scenarios import case_of_table, prepared_train, train_case
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import Model
from tribodyn.input.sources import find_scenario
from tribodyn.kernels.lanes import functions  # noqa: F401  (its import gives the laws their functions over lanes)
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.kernels.native import kernel
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.lanes.batch import lane_model, pack
from tribodyn.solve.orbit.periodic import steady_states
from tribodyn.solve.right_hand_side import work_array
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import rotational_error

pytestmark = pytest.mark.bench

REDUCER = "two-stage-reducer"
LAWS = "none", "masjedi-khonsari"
#: Places in a common period at which the right-hand side is evaluated, and how often over.
PLACES, OVER = 600, 40
#: Right-hand side of a train over the sum of those of its pairs, at most.
MOST = 1.3
#: Processes that may be tried.
PROCESSES = 4
CYCLES, SAMPLES = 20, 200
#: Largest error of the transmission errors over their range.
TARGET = 2e-5


@kernel
def _single(times, cycles, phases, intervals, y, model, work, dy):
    for _ in range(times):
        for n in range(phases.shape[0]):
            derivatives(phases[n], cycles[n], int(intervals[n]), y, model, work, dy)


@kernel
def _lanes(times, cycles, phases, intervals, y, model, work, dy):
    for _ in range(times):
        for n in range(phases.shape[0]):
            phase = rows_of(phases[n])[0]
            derivatives(phase, cycles[n], int(intervals[n]), rows_of(y), model, rows_of(work), rows_of(dy))


def model_of(law: str, folder: Path, stage: int | None = None) -> Model:
    """The reducer under a friction law, or one of its stages as a pair, at the speed and load that it has."""
    path = find_scenario(REDUCER)
    if stage is None:
        return prepared_train(REDUCER, **{"friction.law": law}).model
    data: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    part, mesh = data["stage"][stage], prepared_train(REDUCER).case.meshes[stage].pair.operating
    data["friction"]["law"] = law
    data["stage"], data["gear"] = [part], {name: data["gear"][name] for name in part["gears"]}
    del data["shaft"]
    first, second = part["gears"]
    data["operating"] |= {"input": first, "input_speed": f"{mesh.pinion_speed!r} rad/s"}
    data["operating"] |= {"output": second, "output_torque": f"{mesh.gear_torque!r} N*m"}
    alone = folder / f"stage-{stage}.toml"
    alone.write_text(tomli_w.dumps(data), encoding="utf-8")
    return prepare(train_case(alone)).model


def right_hand_sides(model: Model, lanes: bool) -> Callable[[], Any]:
    """What evaluates a right-hand side at `PLACES` over the common period, `OVER` times."""
    at = (np.arange(PLACES) + 0.5) * model.schedule.period / PLACES
    cycles, phases, intervals = interval_of(at, model.schedule)
    y, work = static_equilibrium(model), work_array(model)
    if not lanes:
        return lambda: _single(OVER, cycles, phases, intervals, y, model, work, np.zeros_like(y))
    over, _, _ = lane_model(pack([model] * WIDTH))
    wide = [np.repeat(values[..., None], WIDTH, axis=-1) for values in (phases[:, None], y, work, 0.0 * y)]
    return lambda: _lanes(OVER, cycles, wide[0], intervals, wide[1], over, *wide[2:])


def measured(law: str, lanes: bool) -> list[float]:
    """Times of a right-hand side of the train, and of both its stages as pairs, ns."""
    with TemporaryDirectory() as folder:
        models = [model_of(law, Path(folder), stage) for stage in (None, 0, 1)]
    times = least([right_hand_sides(model, lanes) for model in models], 15, MOST)
    return [1e9 * time / PLACES / OVER for time in times]


@pytest.mark.parametrize("lanes", [False, True])
@pytest.mark.parametrize("law", all_in_soak(LAWS, ("masjedi-khonsari",)))
def test_a_right_hand_side_costs_what_its_meshes_cost(law, lanes, capsys):
    """Of two meshes and three bodies no more than 1.3 times that of two pairs, which have four.

    By processes of their own: where one puts the machine code of a kernel may cost it half its speed.
    """
    code = f"from {__name__} import measured; print(*measured({law!r}, {lanes}))"
    ratio = float("inf")
    for _ in range(PROCESSES):
        ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        train, *pairs = map(float, ended.stdout.split())
        ratio = min(ratio, train / sum(pairs))
        if ratio < MOST:
            break
    with capsys.disabled():
        nanoseconds = ", ".join(f"{time:.0f}" for time in (train, *pairs))
        how = "lanes" if lanes else "single"
        print(f"\n{law}, {how}: train and its stages {nanoseconds} ns: {ratio:.2f}")
    assert ratio < MOST


@pytest.mark.parametrize("law", all_in_soak(LAWS, ("none",)))
def test_a_reducer_runs_in_five_times_the_time_of_its_faster_pair(law, tmp_path, capsys):
    """Over 20 cycles of the faster mesh; SciPy's LSODA on the same compiled right-hand side takes far longer.

    Tolerances are those at which each is within `TARGET` of a solution at 1e-11.
    """
    train, pair = model_of(law, tmp_path), model_of(law, tmp_path, 0)

    def run(model: Model, method: str, rtol: float) -> Callable[[], Any]:
        state = static_equilibrium(model)
        tolerances = tolerances_from(model, state, rtol, 10**6)
        return lambda: make_integrator(method, model, SAMPLES, tolerances).integrate(state, 0, CYCLES)

    exact = run(train, "dopri5", 1e-11)().samples

    def error(samples: np.ndarray) -> float:
        both = [[rotational_error(states, m, train) for m in range(2)] for states in (samples, exact)]
        return max(
            float(np.max(np.abs(one - other)) / np.ptp(other)) for one, other in zip(*both, strict=True)
        )

    ours, ours_of_pair, theirs = (
        run(train, "dopri5", 1e-5),
        run(pair, "dopri5", 1e-5),
        run(train, "lsoda", 1e-6),
    )
    errors = [error(solve().samples) for solve in (ours, theirs)]
    times = [*least([ours, ours_of_pair], 25), *least([theirs], 3)]
    to_pair, to_peer = times[0] / times[1], times[2] / times[0]
    with capsys.disabled():
        print(
            f"\n{law}: {CYCLES} cycles of the reducer {1e3 * times[0]:.2f} ms (error {errors[0]:.1e}), "
            f"{to_pair:.2f} times its first pair; LSODA ({errors[1]:.1e}) takes {to_peer:.0f} times that"
        )
    assert max(errors) < TARGET
    assert to_pair < 5.0
    assert to_peer > 10.0


#: Speeds of the sun, rpm, and planets of a set; its steady states per mesh over the pair's, at most: 1.7 for
#: the intervals, and 1.15 for sizes that are read at run time where the pair's are compiled in.
SUN_SPEEDS, PLANETS, MOST_STEADY = np.linspace(600.0, 3000.0, 8), 3, 1.7 * 1.15


def set_or_pair(speed: float, pair: bool) -> Model:
    """A planetary set, or its sun and one planet on bearings, under the load that a mesh of the set has."""
    table = planet_set(planets=PLANETS, operating={"input_speed": f"{speed!r} rpm"})
    if pair:
        teeth = {name: table["gear"][name]["teeth"] for name in ("sun", "planet", "ring")}
        torque = 600.0 / (1.0 + teeth["ring"] / teeth["sun"]) / PLANETS * teeth["planet"] / teeth["sun"]
        table["stage"] = [{"gears": ["sun", "planet"], "module": "3 mm", "pressure_angle": "20 deg"}]
        table["operating"] |= {"output": "planet", "output_torque": f"{torque!r} N*m"}
        del table["gear"]["ring"], table["body"]
    return prepare(case_of_table(table)).model


def test_steady_states_of_a_planetary_set_cost_what_its_meshes_cost(capsys):
    """Of six meshes and six bodies, whose intervals and reversals of friction are those of two meshes."""
    many, one = ([set_or_pair(speed, pair) for speed in SUN_SPEEDS.tolist()] for pair in (False, True))
    found = [steady_states(models, workers=1) for models in (many, one)]  # compiles
    assert all(steady.kind == "period-1" and steady.residual <= 1e-7 for part in found for steady in part)
    meshes = len(many[0].meshes) / len(one[0].meshes)
    calls = [lambda: steady_states(many, workers=1), lambda: steady_states(one, workers=1)]
    times = least(calls, 3, MOST_STEADY * meshes)
    per_mesh = times[0] / times[1] / meshes
    with capsys.disabled():
        print(
            f"\n{len(many)} steady states of a set of {PLANETS} planets {times[0]:.2f} s, of a pair "
            f"{times[1]:.3f} s: {per_mesh:.2f} times the number of meshes"
        )
    assert per_mesh < MOST_STEADY
