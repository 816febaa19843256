"""The search for steady states on maps whose answer is known in closed form."""

import numpy as np
import pytest

from tests.support.closed_form_maps import ClosedForm, logistic
from tribodyn.solve.orbit.motions import BLOCK, wanderings
from tribodyn.solve.orbit.search import find

TOLERANCE = 1e-9


def orbits(rates, **options):
    return find(ClosedForm(logistic, rates, 1), np.full((len(rates), 1), 0.31), tolerance=1e-9, **options)


def test_period_doubling_of_the_logistic_map():
    """Fixed point 1 − 1/r with multiplier 2 − r; the two-cycle's multiplier is 4 + 2r − r²."""
    fixed_point, two, four, eight = orbits([2.8, 3.3, 3.5, 3.55])
    kinds = (fixed_point.kind, two.kind, four.kind, eight.kind)
    assert kinds == ("period-1", "period-2", "period-4", "period-8")
    assert fixed_point.state[0] == pytest.approx(1.0 - 1.0 / 2.8, abs=1e-9)
    assert fixed_point.multipliers[0] == pytest.approx(2.0 - 2.8, abs=1e-6)
    assert two.multipliers[0] == pytest.approx(4.0 + 2.0 * 3.3 - 3.3**2, abs=1e-6)
    cycle = np.roots([3.3**2, -3.3 * 4.3, 4.3]).real  # x² − (r+1)/r x + (r+1)/r² = 0
    assert np.min(np.abs(cycle - two.state[0])) < 1e-9
    assert all(orbit.stable and orbit.residual <= 1e-9 for orbit in (fixed_point, two, four))


def test_period_three_of_the_logistic_map():
    """The window of period three opens at 1 + √8, with the multiplier 1."""
    (three,) = orbits([1.0 + np.sqrt(8.0) + 1e-3])
    assert three.kind == "period-3"
    assert 0.0 < three.multipliers[0].real < 1.0
    track = [three.state]
    for _ in range(3):
        track.append(logistic(track[-1], np.array([1.0 + np.sqrt(8.0) + 1e-3]))[0])
    slopes = [(1.0 + np.sqrt(8.0) + 1e-3) * (1.0 - 2.0 * x[0]) for x in track[:3]]
    assert three.multipliers[0].real == pytest.approx(np.prod(slopes), abs=1e-5)


def test_chaos_is_told_by_its_exponent_and_its_state_is_that_of_the_motion():
    """The exponent is the mean of ln |r (1 − 2x)| along the motion."""
    (chaos,) = orbits([3.9], max_periods=200)
    assert chaos.kind == "chaotic"
    assert chaos.period == 0
    assert abs(chaos.state[0] - (1.0 - 1.0 / 3.9)) > 1e-3
    assert np.all(np.isnan(chaos.multipliers))
    assert "left towards twice the period" in chaos.message
    (told,) = wanderings(ClosedForm(logistic, [3.9], 1), np.array([[0.31]]), np.array([0]))
    x = 0.31
    slopes = []
    for period in range(8 * 4 + 64 * 4):
        if period >= 8 * 4:
            slopes.append(np.log(abs(3.9 * (1.0 - 2.0 * x))))
        x = 3.9 * x * (1.0 - x)
    assert told.exponent == pytest.approx(np.mean(slopes), abs=0.02)


def test_a_motion_of_sixteen_periods_is_no_chaos():
    """The cascade of period doubling ends at r = 3.5699; period sixteen begins at 3.5644."""
    (long,) = orbits([3.566], max_periods=1200)
    assert long.kind == "longer period"
    assert "exponent -" in long.message


def test_a_case_on_an_unstable_state_goes_to_the_motion_beside_it():
    """At r = 3.0004 the fixed point's multiplier is −1.0004: by itself it takes thousands of periods."""
    rate = 3.0004
    fixed = np.array([[1.0 - 1.0 / rate]])
    (two,) = find(ClosedForm(logistic, [rate], 1), fixed, tolerance=1e-9, max_periods=600)
    assert two.kind == "period-2"
    cycle = np.roots([rate**2, -rate * (rate + 1.0), rate + 1.0]).real
    assert np.min(np.abs(cycle - two.state[0])) < 1e-6


def test_a_torus_is_quasi_periodic():
    """A curve that attracts: radius 1, one radian a period, which never closes."""

    def torus(x, modulus):
        radius = np.linalg.norm(x, axis=1, keepdims=True)
        c, s = np.cos(1.0), np.sin(1.0)
        return (x @ np.array([[c, s], [-s, c]])) * (1.0 + 0.5 * (1.0 - radius**2) / radius * modulus[:, None])

    (orbit,) = find(ClosedForm(torus, [0.5], 2), np.array([[0.9, 0.4]]), tolerance=1e-7, max_periods=60)
    assert orbit.kind == "quasi-periodic"
    assert np.linalg.norm(orbit.state) == pytest.approx(1.0, abs=1e-6)


def test_a_drift_is_not_taken_for_a_torus():
    drift = ClosedForm(lambda x, step: x + step[:, None], [0.01], 1)
    (orbit,) = find(drift, np.zeros((1, 1)), tolerance=1e-9, max_periods=60)
    assert orbit.kind == "not periodic"


def test_shooting_finds_the_unstable_state_that_marching_leaves():
    (shot,) = find(ClosedForm(logistic, [3.3], 1), np.array([[0.69]]), tolerance=1e-9, method="shooting")
    assert shot.kind == "unstable"
    assert shot.multipliers[0] == pytest.approx(2.0 - 3.3, abs=1e-6)
    (marched,) = orbits([3.3])
    assert marched.period == 2


def rotation(x, modulus):
    """Turn by one radian and shrink, about (0.3, −0.2)."""
    c, s = np.cos(1.0), np.sin(1.0)
    centre = np.array([0.3, -0.2])
    return centre + modulus[:, None] * ((x - centre) @ np.array([[c, s], [-s, c]]))


def test_marching_and_shooting_agree():
    states = np.zeros((3, 2))
    results = {
        method: find(ClosedForm(rotation, [0.3, 0.9, 0.99], 2), states, tolerance=TOLERANCE, method=method)
        for method in ("auto", "marching", "shooting")
    }
    for orbits_ in results.values():
        for orbit, modulus in zip(orbits_, (0.3, 0.9, 0.99), strict=True):
            assert orbit.kind == "period-1"
            # a residual leaves the state as far off as it takes to march it away
            assert np.max(np.abs(orbit.state - [0.3, -0.2])) <= 2.0 * TOLERANCE / (1.0 - modulus)
            np.testing.assert_allclose(np.abs(orbit.multipliers), modulus, atol=1e-6)
            assert abs(np.angle(orbit.multipliers[0])) == pytest.approx(1.0, abs=1e-6)
    assert [orbit.method for orbit in results["marching"]] == ["marching"] * 3


def test_a_slow_case_is_handed_over_to_shooting():
    """At the multiplier 0.999 marching alone would need some 20 000 periods."""
    slow = ClosedForm(rotation, [0.999], 2)
    (orbit,) = find(slow, np.array([[0.4, -0.2]]), tolerance=TOLERANCE)
    assert orbit.kind == "period-1"
    assert orbit.method == "shooting"
    assert orbit.cycles <= 8 * BLOCK


def test_a_rotation_that_never_settles_has_no_period():
    (orbit,) = find(ClosedForm(rotation, [1.0], 2), np.array([[0.9, 0.4]]), tolerance=1e-7, max_periods=60)
    assert orbit.kind == "quasi-periodic"
    assert orbit.period == 0
    assert np.all(np.isnan(orbit.multipliers))


def test_one_case_that_runs_away_leaves_the_others_alone():
    alone = orbits([2.8])[0]
    beside, lost = orbits([2.8, 4.5])
    assert lost.kind == "failed"
    assert lost.message == "it runs away"
    assert beside.kind == "period-1"
    assert beside.state == alone.state


def test_cases_that_are_done_are_not_marched_on():
    both = ClosedForm(logistic, [2.0, 3.9], 1)
    done, _ = find(both, np.full((2, 1), 0.31), tolerance=1e-9, max_periods=600)
    assert done.cycles == BLOCK
    assert both.marched[0] < 100 < both.marched[1]


def test_a_map_with_the_multiplier_one_is_told():
    """x → x + 0.01: there is no fixed point, and nothing for Newton to divide by."""
    drift = ClosedForm(lambda x, step: x + step[:, None], [0.01], 1)
    (orbit,) = find(drift, np.zeros((1, 1)), tolerance=1e-9, method="shooting")
    assert orbit.kind == "failed"
    assert "not isolated" in orbit.message


def test_noise_of_the_integration_is_not_taken_for_a_motion():
    """Fast contractions whose rough march never comes to rest: every fixed point is found, and soon."""

    class Rough(ClosedForm):
        def march(self, states, cases, periods, fine):
            self.step = lambda x, r: r[:, None] * x + (0.0 if fine else 2e-3 * np.sin(1e7 * x + 1.0))
            return super().march(states, cases, periods, fine)

    rates = np.linspace(-0.4, 0.4, 33)
    found = find(Rough(None, rates, 1), np.full((33, 1), 0.7), tolerance=TOLERANCE, max_periods=8 * BLOCK)
    for rate, orbit in zip(rates, found, strict=True):
        assert orbit.kind == "period-1", orbit.message
        assert abs(orbit.state[0]) <= 1e-8
        assert abs(orbit.multipliers[0]) == pytest.approx(abs(rate), abs=1e-6)
