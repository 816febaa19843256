"""Unstable branches of the oscillator and of gear pairs against harmonic balance and SciPy's DOP853."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from tests.support.foreign_marching import gear_march, oscillator_march
from tests.support.harmonic_balance import HarmonicBalance, turning_points
from tribodyn.errors import InputError
from tribodyn.gears.tabulated import tables
from tribodyn.solve.branch.arclength import FOLD, MERGING, PERIOD_DOUBLING
from tribodyn.solve.branch.continuation import Leg
from tribodyn.solve.branch.gear_pairs import GearLines, UnstableRange, followed_states
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.orbit.gear_map import moving_states
from tribodyn.solve.tolerances import state_scales
from tribodyn.studies.backlash_oscillator.response import DOWN, UP, frequency_response
from tribodyn.studies.backlash_oscillator.scenario import BacklashOscillatorCase
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

#: Central differences of the state.
SHIFTS = 1e-6 * np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])


def response(frequencies, error, variation):
    given = 0.05, 0.1, error, variation, tuple(map(float, frequencies))
    return frequency_response(BacklashOscillatorCase("", "", "", "", "", *given, unstable=True))


def test_between_the_folds_the_oscillator_is_that_of_harmonic_balance():
    found = response(np.arange(0.6, 1.0, 0.1), 0.05, 0.0)
    # closest about the folds, where a parabola is laid through three of them
    parts = (0.03, 0.11, 16), (0.112, 0.12, 9), (0.13, 0.3, 18), (0.305, 0.33, 26)
    amplitudes = np.concatenate([np.linspace(*part) for part in parts])
    balance = HarmonicBalance(0.05, 0.1, 0.05, harmonics=30, samples=2048)
    frequencies, states = balance.branch_with_states(0.6, amplitudes)
    up, down = turning_points(amplitudes, frequencies)
    fine = np.linspace(0.11, 0.33, 20001)
    curve = CubicSpline(amplitudes, np.column_stack([frequencies, states]))(fine)
    beyond = sorted(found.beyond, key=lambda part: found.ends[part.end][0])
    assert [found.ends[part.end][0] for part in beyond] == [UP, DOWN]
    for part, start, goal in zip(beyond, (up, down), (down, up), strict=True):
        branch = part.branch
        assert np.all(branch.multipliers[:, 0].real > 1.0)
        assert found.ends[part.end][1].kind == FOLD
        assert found.ends[part.end][1].value == pytest.approx(start, rel=5e-5)
        assert branch.finish is not None
        assert branch.finish.kind == FOLD
        assert branch.finish.value == pytest.approx(goal, rel=5e-5)
        for value, state in zip(branch.values, branch.states, strict=True):
            assert np.min(np.max(np.abs(curve - [value, *state]), axis=1)) < 1e-4


def test_the_doubled_motion_of_the_oscillator_goes_on_from_its_fold_to_the_doubling():
    """ε = 0.3 without error: all of it by SciPy, and the edges of the tongue are those of linear theory."""
    found = response(np.arange(1.15, 2.3, 0.1), 0.0, 0.3)
    down_parts = [part for part in found.beyond if found.ends[part.end][0] == DOWN]
    kinds = {found.ends[part.end][1].kind: part for part in down_parts}
    single, double = kinds[PERIOD_DOUBLING].branch, kinds[FOLD].branch
    assert (single.period, double.period) == (1, 2)
    assert single.finish is not None
    assert double.finish is not None
    assert (single.finish.kind, double.finish.kind) == (PERIOD_DOUBLING, MERGING)
    assert double.finish.value == pytest.approx(single.finish.value, rel=1e-4)
    for branch in (single, double):
        for i in (0, len(branch.values) // 2, len(branch.values) - 1):
            parameters = (0.05, 0.1, 0.0, 0.3, branch.values[i])
            end = oscillator_march(parameters, branch.states[i], branch.period)[-1]
            np.testing.assert_allclose(end, branch.states[i], atol=1e-6)
            aside = [oscillator_march(parameters, branch.states[i] + h, branch.period)[-1] for h in SHIFTS]
            jacobian = np.array([aside[0] - aside[1], aside[2] - aside[3]]).T / 2e-6
            largest = np.max(np.abs(np.linalg.eigvals(jacobian)))
            assert abs(branch.multipliers[i, 0]) == pytest.approx(largest, rel=1e-4)


def test_round_the_fold_of_a_gear_pair():
    """The way up leaves the lower branch at its fold; what goes on is closed by SciPy, and unstable."""
    name, mesh = "jump-involute-23-47", tables(load_scenario("jump-involute-23-47").pair)

    def model_at(line, value):
        return prepare(load_scenario(name, {"operating.pinion_speed": f"{value} rad/s"}), (mesh,)).model

    model = model_at(0, 440.0)
    settings = {
        "samples": 8,
        "rtol": 1e-6,
        "max_cycles": 2000,
        "solver": "auto",
        "max_steps": 10**5,
        "workers": 1,
    }
    begin = [Leg(0, 440.0, 440.0, static_equilibrium(model), 0)]
    ((first, arrival, _),) = followed_states(model_at, begin, **settings)
    leg = Leg(0, 440.0, 486.0, arrival.next_state, first.period, reach=486.0)
    unstable = UnstableRange((480.0, 486.0), 12)
    ((_, arrival, (beyond,)),) = followed_states(model_at, [leg], unstable=unstable, **settings)
    assert [end.kind for end in arrival.ends] == [FOLD]
    values, modulus = beyond.branch.values, np.abs(beyond.branch.multipliers[:, 0])
    assert len(values) <= 12
    assert values[0] == pytest.approx(arrival.ends[0].value, rel=1e-4)
    assert values[-1] == pytest.approx(480.0)
    assert np.all(np.diff(modulus) > 0.0)
    assert modulus[0] > 1.0
    scale = state_scales(model, first.state)
    for value, steady in list(zip(values.tolist(), beyond.steadies, strict=True))[:: len(values) - 1]:
        assert steady.kind == "unstable"
        end = gear_march(model_at(0, value), steady.state, 1, 1e-10 * scale)[-1]
        moving = np.flatnonzero(steady.state)
        assert np.max(np.abs(end - steady.state)[moving] / scale[moving]) < 1e-5


def test_where_no_line_has_a_gear_pair_nothing_is_marched(prepared):
    def model_at(line, value):
        raise InputError("drive.module", value, "no teeth", "take another")

    model = prepared("crc-23-47").model
    settings = {"solver": "dopri5", "rtol": 1e-6, "fine_rtol": 1e-9, "max_steps": 10**6, "workers": 1}
    lines = GearLines(model_at, {0: static_equilibrium(model)}, moving_states(model), **settings)
    period_map, (refusal,) = lines.at([0], [0.5])
    assert "no teeth" in refusal
    marched = period_map.march(np.empty((0, 10)), np.empty(0, dtype=int), 2, False)
    assert marched.states.shape == (0, 2, 10)
