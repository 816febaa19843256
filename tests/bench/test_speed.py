"""Speed as ratios to other programs in the same run, never as a time.

The case is the CRC drive at 300 rad/s over 20 mesh cycles at rtol 1e-6, kernel only: compilation, table and
files are outside.
"""

import subprocess
import sys
from functools import partial
from time import perf_counter, process_time

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.support.soak_parameters import all_in_soak
from tests.support.states import PAIR, TURN_G
from tests.support.timing import least
from tools.peers import steady
from tribodyn.dynamics.equations import derivatives
from tribodyn.solve.choice import choose
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.orbit.gear_map import GearMap, moving_states
from tribodyn.solve.orbit.motions import by_differences
from tribodyn.solve.right_hand_side import contacts_of, engage
from tribodyn.solve.tolerances import StepTolerances, tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

pytestmark = pytest.mark.bench

SAMPLES, RTOL = 200, 1e-6
#: Tolerance at which the native run is as exact as the peers are at theirs, i.e. to 2e-5 of the DTE's range.
NATIVE_RTOL = 1e-5
#: Processes that may be tried, and times that a sweep is taken again.
PROCESSES, TURNS = 4, 4


@pytest.fixture(scope="module")
def case(prepared):
    model = prepared("crc-23-47-300").model
    state = static_equilibrium(model)
    return model, state, tolerances_from(model, state, RTOL, 10**6)


def native(model, state, tolerances, cycles):
    """With tolerances for the peers; ours are `NATIVE_RTOL`."""
    ours = StepTolerances(NATIVE_RTOL, tolerances.atol * (NATIVE_RTOL / RTOL), tolerances.max_steps)
    return make_integrator("dopri5", model, SAMPLES, ours).integrate(state, 0, cycles).samples


def exactly(model, state, tolerances, cycles):
    tight = StepTolerances(1e-11, tolerances.atol * 1e-5, tolerances.max_steps)
    return make_integrator("dopri5", model, SAMPLES, tight).integrate(state, 0, cycles).samples


def scipy_bdf(model, state, tolerances, cycles):
    """What a user would write: SciPy BDF, the right-hand side on NumPy numbers, restarted at engagement."""
    boundary, mechanical = np.asarray(model.meshes[0].table.boundary), PAIR.mechanical
    y = state.copy()
    found = []
    for cycle in range(cycles):
        for segment in range(len(boundary) - 1):
            if cycle or segment:
                engage(segment, True, y, model, contacts_of(model), y)

            def fun(phase, moving, cycle=cycle, segment=segment):
                full = np.zeros(PAIR.states)
                full[:mechanical] = moving
                rates = {}
                derivatives(phase, cycle, segment, full, model, contacts_of(model), rates)
                return np.array([rates[i] for i in range(mechanical)])  # the audit costs it nothing

            at = np.arange(SAMPLES) / SAMPLES
            at = at[(at >= boundary[segment]) & (at < boundary[segment + 1])]
            solution = solve_ivp(
                fun,
                boundary[segment : segment + 2],
                y[:mechanical],
                method="BDF",
                rtol=RTOL,
                atol=tolerances.atol[:mechanical],
                t_eval=np.append(at, boundary[segment + 1]),
            )
            found.append(solution.y.T[:-1])
            y[:mechanical] = solution.y[:, -1]
    return np.concatenate(found)


def seconds(function, *arguments, repeats):
    times = []
    for _ in range(repeats):
        begun = perf_counter()
        function(*arguments)
        times.append(perf_counter() - begun)
    return float(np.median(times))


def test_native_run_is_300_times_faster_than_scipy_bdf(case, record_property, capsys):
    """Both on 6 cycles; the peer once, since it takes seconds and the bound is far away."""
    exact = exactly(*case, 6)[:, TURN_G]
    ours = native(*case, 6)[:, TURN_G]
    begun = perf_counter()
    theirs = scipy_bdf(*case, 6)[:, TURN_G]
    peer = perf_counter() - begun
    own = seconds(native, *case, 6, repeats=9)
    errors = [float(np.max(np.abs(x - exact)) / np.ptp(exact)) for x in (ours, theirs)]
    ratio = peer / own
    record_property("ratio", ratio)
    with capsys.disabled():
        print(
            f"\nCRC at 300 rad/s, 6 cycles: native {own * 1e3:.2f} ms (DTE error {errors[0]:.1e}), "
            f"SciPy BDF on NumPy {peer * 1e3:.0f} ms ({errors[1]:.1e}): {ratio:.0f} times"
        )
    assert errors[0] < 2e-5
    assert ratio >= 300.0


def test_native_run_is_faster_than_lsoda_on_the_compiled_right_hand_side(case, capsys):
    """An expert's baseline: SciPy's best multistep method, called back into the same machine code."""
    model, state, tolerances = case

    def lsoda():
        return make_integrator("lsoda", model, SAMPLES, tolerances).integrate(state, 0, 20)

    exact = exactly(*case, 20)[:, TURN_G]
    error = float(np.max(np.abs(lsoda().samples[:, TURN_G] - exact)) / np.ptp(exact))
    ratio = seconds(lsoda, repeats=5) / seconds(native, *case, 20, repeats=9)
    with capsys.disabled():
        print(
            "\nCRC at 300 rad/s, 20 cycles: SciPy LSODA on the compiled right-hand side "
            f"(DTE error {error:.1e}) takes {ratio:.1f} times the native run"
        )
    assert ratio > 10.0


@pytest.mark.soak  # LSODA marches for minutes
def test_a_steady_sweep_is_20_times_faster_than_marching_with_lsoda(capsys):
    """But for the compilation, against LSODA, given the cycles after which the motion repeats."""
    speeds = steady.grid(0.05, 32)
    steady.sweep(speeds)  # compiles
    ours = steady.sweep(speeds)
    theirs = steady.lsoda(speeds, [14], ours, 2e-5)
    for _ in range(TURNS):  # the least of each met the calmest machine
        ours = min(ours, steady.sweep(speeds), key=lambda run: run.seconds)
        theirs = min(theirs, steady.lsoda(speeds, [14], ours, 2e-5), key=lambda run: run.seconds[0])
    with capsys.disabled():
        print(
            f"\n32 steady speeds: {ours.seconds:.2f} s of one core, "
            f"{100 * steady.share(ours, theirs):.1f} % of LSODA's "
            f"for {theirs.cycles.mean():.0f} cycles (error {theirs.error:.0e}, "
            f"of the sweep {theirs.sweep_error:.0e})"
        )
    assert ours.solutions == {"period-1": 32}
    assert ours.residual <= 1e-7
    assert max(theirs.error, theirs.sweep_error) < 2e-5
    assert steady.share(ours, theirs) <= 0.05


def extremes_cost(name: str, overrides: dict[str, str], maximum: float) -> float:
    """Processor time of a run with extremes over that of one without."""
    model = prepare(load_scenario(name, overrides)).model
    state = static_equilibrium(model)
    tolerances = tolerances_from(model, state, RTOL, 10**6)
    method = choose("auto", model, state).method

    def marched(extremes: bool) -> None:
        integrator = make_integrator(method, model, SAMPLES, tolerances)
        integrator.extremes = extremes
        integrator.integrate(state, 0, 20)

    with_them, without = least([lambda: marched(True), lambda: marched(False)], 15, maximum)
    return with_them / without


@pytest.mark.parametrize(
    ("name", "overrides", "maximum"),
    all_in_soak(
        [
            ("crc-23-47", {}, 1.1),
            ("crc-23-47-300", {}, 1.1),
            ("involute-23-47", {"operating.pinion_speed": "100 rad/s"}, 1.1),
            ("crc-23-47", {"operating.pinion_speed": "100 rad/s", "friction.sliding": "dynamic"}, 1.1),
            # without friction the rest takes half the time
            ("crc-23-47", {"operating.pinion_speed": "300 rad/s", "friction.law": "none"}, 1.125),
        ],
        lambda case: case[0] == "crc-23-47" and "none" not in case[1].values(),
        names=3,
    ),
)
def test_extremes_cost_a_run_at_most_a_tenth(name, overrides, maximum):
    """In processes of their own: where one puts the machine code of a kernel decides on a twentieth."""
    call = f"extremes_cost({name!r}, {overrides!r}, {maximum})"
    code = f"from {__name__} import extremes_cost; print({call})"
    ratio = float("inf")
    for _ in range(PROCESSES):
        ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        ratio = min(ratio, float(ended.stdout))
        if ratio < maximum:
            break
    print(f"{name} {overrides}: a run with extremes takes {ratio:.3f} of one without")
    assert ratio < maximum


def test_native_kernel(case, benchmark):
    """For comparison over time with pytest-benchmark; asserts nothing about the clock."""
    samples = benchmark(native, *case, 20)
    assert samples.shape == (20 * SAMPLES, PAIR.states)


@pytest.mark.parametrize("law", ["none", "masjedi-khonsari"])
def test_a_derivative_costs_less_than_the_marches_of_its_differences(prepared, capsys, law):
    """Of one case, whose differences fill two vectors of lanes; processor time."""
    model = prepared("crc-23-47", **{"operating.pinion_speed": "400 rad/s", "friction.law": law}).model
    row, start = np.zeros(1, dtype=int), static_equilibrium(model)[None]
    settings = {"solver": "dopri5", "rtol": 1e-6, "fine_rtol": 1e-9, "max_steps": 10**6, "workers": 1}
    period_map = GearMap([model], start, moving_states(model), **settings)
    state = start[:, period_map.moving]

    def exact():
        return period_map.tangent(state, row, 4)

    def differences():
        return by_differences(period_map.march, state, row, 4, period_map.scale)

    difference = np.abs(exact().jacobian - differences().jacobian)
    assert np.max(difference * period_map.scale[:, None] / period_map.scale[:, :, None]) < 1e-2
    times = {function: [] for function in (exact, differences)}
    for _ in range(7):
        for function, found in times.items():
            before = process_time()
            function()
            found.append(process_time() - before)
    ratio = min(times[exact]) / min(times[differences])
    with capsys.disabled():
        print(f"\na derivative takes {ratio:.2f} of the time of {1 + state.shape[1]} marches ({law})")
    assert ratio < 1.0


def test_looking_up_single_teeth_costs_little(capsys):
    """The same motion, of teeth that are alike and of such as are looked up, with a formula that is 0."""
    changes = {"operating.pinion_speed": "300 rad/s", "solver.cycles": 1081}
    calls = []
    for own in ({"drive.pinion.modification.tooth_formula": "0*i"}, {}):
        model = prepare(load_scenario("crc-23-47", changes | own)).model
        state = static_equilibrium(model)
        integrator = make_integrator("dopri5", model, 0, tolerances_from(model, state, RTOL, 10**6))
        calls.append(partial(integrator.integrate, state, 0, 100))
    single, alike = least(calls, 5, enough=1.15)
    with capsys.disabled():
        print(f"\nlooking up single teeth takes {single / alike:.2f} of the time of teeth that are alike")
    assert single < 1.3 * alike
