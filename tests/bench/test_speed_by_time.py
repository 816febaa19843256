"""Speed of runs by time, as the ratio to SciPy's explicit solver on the same compiled right-hand side."""

from time import process_time

import numpy as np
import pytest

import tribodyn as td
from tribodyn.solve.in_time import transient_in_time
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import SampledStates, TransientSettings
from tribodyn.studies.motion.prepare import prepare

pytestmark = pytest.mark.bench

RTOL, SAMPLES = 1e-6, 200


def test_a_native_run_by_time_is_10_times_faster_than_scipy(capsys):
    """The shipped start from rest, no less exact than SciPy's at the same tolerance."""
    # a law whose machine code other tests make
    law = {"friction.law": "coulomb", "friction.coefficient": 0.05}
    prepared = prepare(td.scenario("start-from-rest", {"solver.duration": "20 ms", **law}))
    model, cycles = prepared.model, prepared.case.solver.cycles
    state = initial_state(model, "static")

    def run(method: str, rtol: float = RTOL, repeats: int = 1) -> tuple[np.ndarray, float]:
        settings = TransientSettings(method, rtol, cycles, 10**6, SAMPLES)
        taken = []
        for _ in range(repeats):
            begun = process_time()
            parts = list(transient_in_time(model, state, settings))
            taken.append(process_time() - begun)
        states = [part.states for part in parts if isinstance(part, SampledStates)]
        return np.concatenate(states)[:, : model.layout.mechanical], min(taken)

    exact, _ = run("dopri5", 1e-10)
    (ours, own), (theirs, peer) = run("dopri5", repeats=5), run("dop853", repeats=3)
    errors = [float(np.max(np.abs(found - exact) / np.ptp(exact, axis=0))) for found in (ours, theirs)]
    ratio = peer / own
    with capsys.disabled():
        print(
            f"\nstart from rest, 20 ms: native {own * 1e3:.1f} ms of one core (error {errors[0]:.1e}), "
            f"SciPy DOP853 {peer * 1e3:.0f} ms ({errors[1]:.1e}): {ratio:.0f} times"
        )
    assert errors[0] < 1e-4
    assert ratio >= 10.0
