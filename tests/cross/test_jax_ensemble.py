"""Batches through JAX against batches in lanes."""

import numpy as np
import pytest

from tribodyn.dynamics.parameters import XI
from tribodyn.solve import ensemble, jax_ensemble
from tribodyn.solve.engine import DONE, STALLED, STEP_TOO_SMALL
from tribodyn.solve.initial import static_equilibrium

pytestmark = pytest.mark.slow


def test_jax_and_lanes_agree_and_tell_the_same_failure(prepared):
    """Three motors that carry their load and one that does not."""
    balanced = 500.0 * 23 / 47
    settings = {"cycles": 3, "window": 1, "samples": 12, "rtol": 1e-8}
    base = prepared("crc-23-47-300", **{"operating.source": "torque"}).model
    models = [
        base._replace(
            mechanics=base.mechanics._replace(
                nominal_speed=speed,
                drive_torque=torque,
                load_torque=500.0 * torque / balanced if torque > 100 else 500.0,
            )
        )
        for speed, torque in ((300.0, balanced), (420.0, 0.8 * balanced), (10.0, 20.0), (350.0, balanced))
    ]
    states = np.array([static_equilibrium(model) for model in models])
    states[2] = 0.0
    native = ensemble.march(models, states, **settings)
    jax = jax_ensemble.march(models, states, **settings)
    assert jax.status.tolist() == [DONE, DONE, STALLED, DONE]
    assert native.status[[0, 1, 3]].tolist() == [DONE, DONE, DONE]
    # the rates grow without bound towards rest, so that the step may vanish before the speed does
    assert native.status[2] in (STALLED, STEP_TOO_SMALL)
    assert 0 < native.reached[2] < 3
    # JAX tells the segment, lanes the phase
    assert 0 <= native.reached[2] - jax.reached[2] < 1
    for case in (0, 1, 3):
        ours, theirs = native.samples[case, :, XI], jax.samples[case, :, XI]
        assert np.max(np.abs(ours - theirs)) < 2e-5 * np.ptp(ours)
        assert jax.state[case, XI] == pytest.approx(native.state[case, XI], rel=1e-5)
