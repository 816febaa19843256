"""Batches: every case as if it were alone."""

import numpy as np
import pytest

from tests.support.states import LAG, PAIR, SLIP, TURN_G, altered
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator

RTOL, SAMPLES = 1e-6, 40


@pytest.fixture(scope="module")
def cases(prepared):
    """Eleven speeds of one drive, its inertia and its load: models and states."""
    model = prepared("crc-23-47-300").model
    base = float(model.operation.nominal_speed)
    models = [
        altered(
            model,
            operation={"nominal_speed": base * (0.4 + 0.17 * i)},
            bodies={"load": model.bodies.load * (1 + 0.03 * i)},
        )
        for i in range(11)
    ]
    return models, np.array([static_equilibrium(model) for model in models])


def test_a_batch_agrees_with_single_runs(cases, prepared):
    high = prepared("high-contact-ratio").model
    assert high.meshes[0].table.in_contact.shape == (2, 3)  # three pairs in two segments
    models, states = [*cases[0], high], np.vstack([cases[1], static_equilibrium(high)])
    found = march(models, states, cycles=7, window=2, samples=SAMPLES, rtol=RTOL)
    assert np.all(found.status == Status.DONE)
    assert np.all(found.reached == 7)
    for case, model in enumerate(models):
        # exact to five orders more: the difference is the batch's own error
        tolerances = tolerances_from(model, states[case], 1e-11, 10**6)
        part = make_integrator("dopri5", model, SAMPLES, tolerances).integrate(states[case], 0, 7)
        turn = found.samples[case, :, TURN_G]
        assert np.max(np.abs(turn - part.samples[-2 * SAMPLES :, TURN_G])) < 2e-4 * np.ptp(turn)
        assert found.state[case, TURN_G] == pytest.approx(part.state[TURN_G], rel=1e-4)
        assert found.state[case, LAG] == pytest.approx(part.state[LAG], abs=1e-9)


def test_bits_depend_neither_on_order_nor_company_nor_workers(cases):
    models, states = cases
    settings = {"cycles": 4, "window": 1, "samples": SAMPLES, "rtol": RTOL, "extremes": True}
    whole = march(models, states, workers=1, **settings)
    order = [3, 7, 0, 10, 1, 9, 2, 8, 4, 6, 5]
    shuffled = march([models[i] for i in order], states[order], workers=2, **settings)
    alone = [march(models[i : i + 1], states[i : i + 1], **settings) for i in (0, 5)]
    for name, expected in arrays_of(whole).items():
        np.testing.assert_array_equal(arrays_of(shuffled)[name], expected[order], err_msg=name)
        for i, ensemble in zip((0, 5), alone, strict=True):
            np.testing.assert_array_equal(arrays_of(ensemble)[name][0], expected[i], err_msg=name)


def arrays_of(ensemble):
    """The arrays of a batch's result, over cases."""
    return {**ensemble._asdict(), **ensemble.extremes._asdict()} | {"extremes": ensemble.status}


def test_a_march_goes_on_where_it_stopped(cases):
    models, states = cases
    settings = {"samples": SAMPLES, "rtol": 1e-9}
    whole = march(models, states, cycles=6, window=3, **settings)
    first = march(models, states, cycles=3, window=0, **settings)
    second = march(models, first.state, cycles=3, window=3, started=True, first_cycle=3, **settings)
    assert first.samples.shape == (11, 0, PAIR.states)
    scale = np.ptp(whole.samples[..., TURN_G], axis=1).max()
    assert np.max(np.abs(second.samples - whole.samples)[..., TURN_G]) < 1e-6 * scale


@pytest.mark.parametrize("method", ["dopri5", "rodas4"])
def test_extremes_are_those_of_the_window(cases, method: str):
    """The start from rest, whose loads are higher than those of the window, has no part in them."""
    models, states = cases[0][:2], cases[1][:2] + 0.0
    states[:, TURN_G] *= 1.5
    settings = {"samples": SAMPLES, "rtol": 1e-9, "method": method}
    whole = march(models, states, cycles=6, window=1, extremes=True, **settings)
    before = march(models, states, cycles=5, window=0, **settings)
    last = march(
        models, before.state, cycles=1, window=1, started=True, first_cycle=5, extremes=True, **settings
    )
    every = march(models, states, cycles=6, window=6, extremes=True, **settings)
    measure = whole.extremes.measure
    np.testing.assert_allclose(measure, last.extremes.measure, rtol=1e-6)
    assert np.all(every.extremes.measure >= measure - 1e-9 * np.abs(measure))
    assert np.any(every.extremes.measure > 1.01 * np.abs(measure))


def test_a_march_over_no_cycle_leaves_everything_as_it_is(cases):
    models, states = cases
    for method in ("auto", "rodas4", "tsit5"):
        still = march(models, states, cycles=0, window=0, samples=16, rtol=1e-6, method=method)
        np.testing.assert_array_equal(still.state, states)
        assert still.samples.shape == (len(models), 0, PAIR.states)
        assert (still.status == Status.DONE).all()
        assert (still.reached == 0.0).all()


def test_a_failed_case_says_why_and_leaves_the_others_alone(cases, prepared):
    """One pinion driven by too small a torque comes to rest; another may take no more than ten steps."""
    models, states = list(cases[0]), cases[1].copy()
    settings = {"cycles": 3, "window": 3, "samples": SAMPLES, "rtol": RTOL}
    alone = march(models, states, **settings)
    weak = prepared("crc-23-47", **{"operating.source": "torque", "operating.pinion_torque": "20 N*m"}).model
    models[4] = weak
    states[4] = 0.0
    found = march(models, states, **settings)
    assert found.status[4] == Status.STALLED
    assert 0 < found.reached[4] < 3
    assert weak.operation.nominal_speed + found.state[4, SLIP] > 0
    kept = np.isfinite(found.samples[4, :, TURN_G])
    assert kept.sum() == np.floor(found.reached[4] * SAMPLES) + 1
    assert kept[: kept.sum()].all()
    others = [i for i in range(11) if i != 4]
    np.testing.assert_array_equal(found.samples[others], alone.samples[others])
    hurried = march(models[:2], states[:2], max_steps=10, **settings)
    assert np.all(hurried.status == Status.TOO_MANY_STEPS)
    assert np.all(hurried.steps == 10)


def test_progress_rises_to_one(cases):
    reported = []
    settings = {"cycles": 1, "window": 0, "samples": 4, "rtol": 1e-4, "workers": 1}
    march(cases[0][:3], cases[1][:3], progress=reported.append, **settings)
    assert reported == sorted(reported)
    assert reported[-1] == 1.0


def test_states_and_window_must_fit(cases):
    models, states = cases
    with pytest.raises(ValueError, match="3 models"):
        march(models[:3], states, cycles=1, window=0, samples=4, rtol=1e-4)
    with pytest.raises(ValueError, match="window"):
        march(models, states, cycles=1, window=2, samples=4, rtol=1e-4)
