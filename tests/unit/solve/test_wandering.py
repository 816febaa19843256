"""Parts of the search for steady motions: Newton's steps, what repeats, what wanders, on closed forms."""

from typing import Any, cast

import numpy as np
import pytest

from tests.support.closed_form_maps import ClosedForm, Lines, logistic
from tribodyn.solve.branch.arclength import (
    CORNER,
    FOLD,
    MERGING,
    NEIMARK_SACKER,
    PERIOD_DOUBLING,
    kind_of_end,
)
from tribodyn.solve.branch.continuation import PERIODS, VALUES, Leg, between, follow
from tribodyn.solve.orbit.motions import BLOCK, Recurrence, recognised, recurrences, wanderings
from tribodyn.solve.orbit.search import LOOK, NOISE, Progress
from tribodyn.solve.orbit.shooting import closed_orbit, critical_direction, eigenvalues, shoot, way_out


class Affine(ClosedForm):
    """x' = c + M (x − c), with exact derivatives."""

    def __init__(self, matrix, centre, scale):
        super().__init__(lambda x, _: centre + (x - centre) @ matrix.T, [0.0], len(centre))
        self.matrix, self.scale = matrix, np.array([scale])

    def tangent(self, states, cases, periods, fine=True):
        found = super().tangent(states, cases, periods, fine)
        jacobian = np.linalg.matrix_power(self.matrix, periods)
        return found._replace(jacobian=np.tile(jacobian, (len(states), 1, 1)))


MATRIX = np.array([[0.3, -1.1, 0.2], [0.5, 0.4, 0.0], [0.1, -0.3, -1.7]])
CENTRE = np.array([2.0, -3e-3, 40.0])


@pytest.mark.parametrize("periods", [1, 2])
def test_one_newton_step_solves_an_affine_map(periods):
    """Whatever the units of its states; multipliers are the eigenvalues, of an unstable map too."""
    units = np.array([1.0, 1e-3, 20.0])
    matrix = MATRIX * units[:, None] / units
    found = Affine(matrix, CENTRE, units)
    (shot,) = shoot(found, (CENTRE + 0.3 * units)[None], np.array([0]), periods, 1e-10)
    assert shot.steps == 1
    assert not shot.reason
    np.testing.assert_allclose(shot.state, CENTRE, rtol=1e-12)
    assert shot.residual <= 1e-10
    exact = np.linalg.eigvals(np.linalg.matrix_power(MATRIX, periods))
    exact = exact[np.lexsort((-exact.imag, -np.round(np.abs(exact), 9)))]
    np.testing.assert_allclose(shot.multipliers, exact, rtol=1e-9)
    (judged,) = shoot(found, (CENTRE + 0.3 * units)[None], np.array([0]), periods, 1e-10, 0)
    assert judged.steps == 0
    assert "after 0 steps" in judged.reason
    off = np.linalg.matrix_power(MATRIX, periods) @ np.full(3, 0.3) - 0.3
    assert judged.residual == pytest.approx(np.abs(off).max())


def test_a_step_that_goes_too_far_is_halved():
    """Newton's method on x − arctan x runs away from 2; halved steps find 0."""
    curve = ClosedForm(lambda x, _: x - np.arctan(x), [0.0], 1)
    (shot,) = shoot(curve, np.array([[2.0]]), np.array([0]), 1, 1e-9)
    assert not shot.reason
    assert abs(shot.state[0]) < 1e-9
    assert shot.multipliers[0] == pytest.approx(0.0, abs=1e-3)


def test_where_no_step_lowers_the_residual_shooting_gives_up():
    """|x| + 1 has no zero: at its least value every step fails."""
    curve = ClosedForm(lambda x, _: x + np.abs(x) + 1.0, [0.0], 1)
    (shot,) = shoot(curve, np.array([[0.0]]), np.array([0]), 1, 1e-9)
    assert "lowers the residual" in shot.reason
    assert shot.residual == pytest.approx(1.0)
    shift = ClosedForm(lambda x, _: x + 0.5, [0.0], 1)
    (shot,) = shoot(shift, np.array([[0.0]]), np.array([0]), 1, 1e-9)
    assert "not isolated" in shot.reason


def test_multipliers_are_sorted_by_modulus_and_conjugates_by_sign():
    matrix = np.diag([0.2, -3.0, 0.0, 0.0])
    matrix[2:, 2:] = [[0.5, -1.0], [1.0, 0.5]]
    np.testing.assert_allclose(eigenvalues(matrix), [-3.0, 0.5 + 1j, 0.5 - 1j, 0.2], rtol=1e-12)
    assert np.all(np.isnan(eigenvalues(matrix * np.nan)))
    direction = critical_direction(np.array([[0.5, 0.0], [0.0, -2.0]]), np.array([1.0, 4.0]))
    np.testing.assert_allclose(np.abs(direction), [0.0, 4.0])


@pytest.mark.parametrize(
    ("multipliers", "words"),
    [([1.2, 0.1], "another state"), ([-1.3, 0.2], "twice the period"), ([1j, -1j], "±90°")],
)
def test_the_way_out_follows_from_the_largest_multiplier(multipliers, words):
    said = way_out(np.array(multipliers, dtype=complex))
    assert words in said
    assert f"{abs(multipliers[0]):.4g}" in said


def test_kinds_of_ends():
    def of(before, beyond=None, merged=False):
        after = None if beyond is None else np.array(beyond, dtype=complex)
        return kind_of_end(np.array(before, dtype=complex), after, merged)

    assert of([0.95, 0.1]) == FOLD
    assert of([0.85, 0.1]) == CORNER
    assert of([-0.99, 0.95]) == FOLD
    assert of([0.9, 0.1], [-1.1, 0.1]) == PERIOD_DOUBLING
    assert of([0.9, 0.1], [1.1, 0.1]) == FOLD
    assert of([0.9, 0.1], [0.6 + 0.9j, 0.6 - 0.9j]) == NEIMARK_SACKER
    assert of([0.9, 0.1], None, True) == of([0.9, 0.1], [1.1, 0.1], True) == MERGING


def shot_at(x, rate, periods, tolerance=1e-10):
    (shot,) = shoot(ClosedForm(logistic, [rate], 1), np.array([[x]]), np.array([0]), periods, tolerance)
    return shot


@pytest.mark.parametrize("over", [2, 4])
def test_a_motion_is_judged_by_its_shortest_period(over):
    """The logistic map's fixed point, shot over 2 and 4 periods; its two-cycle, shot over 4."""
    fixed = closed_orbit(ClosedForm(logistic, [2.8], 1), shot_at(0.64, 2.8, over), 0, over, 36, 1e-10)
    assert (fixed.period, fixed.kind, fixed.stable, fixed.cycles) == (1, "period-1", True, 36)
    assert fixed.multipliers[0].real == pytest.approx(-0.8, abs=1e-5)
    rate = 3.3
    cycle = min(np.roots([rate**2, -rate * (rate + 1.0), rate + 1.0]).real)
    two = closed_orbit(ClosedForm(logistic, [rate], 1), shot_at(cycle + 1e-4, rate, over), 0, over, 0, 1e-10)
    assert (two.period, two.kind) == (2, "period-2")
    assert two.multipliers[0].real == pytest.approx(4 + 2 * rate - rate**2, abs=1e-5)
    left = closed_orbit(ClosedForm(logistic, [rate], 1), shot_at(1 - 1 / rate, rate, 1), 0, 1, 0, 1e-10)
    assert (left.stable, left.kind) == (False, "unstable")
    assert "twice the period" in left.message


def test_a_motion_is_shot_where_it_has_been_moved():
    """Over both periods, or only over the one that it has: the residual of one is five times that of both."""
    methods = []
    for start in 1.0 - 1.0 / 2.8 + np.geomspace(1e-12, 1e-1, 100):
        orbit = closed_orbit(ClosedForm(logistic, [2.8], 1), shot_at(start, 2.8, 2), 0, 2, 0, 1e-10)
        methods.append(orbit.method)
        assert methods[-1] == ("marching" if orbit.state[0] == start else "shooting")
    assert set(methods) == {"marching", "shooting"}


def test_a_neutral_motion_is_said_to_be():
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    neutral = Affine(turn, np.zeros(2), np.ones(2))
    (shot,) = shoot(neutral, np.zeros((1, 2)), np.array([0]), 1, 1e-9)
    told = closed_orbit(cast(Any, neutral), shot, 0, 1, 0, 1e-9)
    assert told.stable
    assert told.message.startswith("neutral")
    assert told.method == "marching"


def test_changes_of_a_decaying_cycle_are_geometric():
    """x = (−1)^k + c q^k: over two periods it changes by c q^k (1 − q²), over one by 2 and more."""
    q, c = 0.8, 0.01
    k = np.arange(25)
    track = ((-1.0) ** k + c * q**k)[:, None]
    found = {recurrence.period: recurrence for recurrence in recurrences(track)}
    assert sorted(found) == list(range(1, 9))
    # the largest of the last three changes is the first of them; the earlier six periods before
    two = found[2]
    assert two.half == 6
    assert two.change == pytest.approx(c * q**20 * (1 - q**2), rel=1e-6)
    assert two.earlier == pytest.approx(c * q**14 * (1 - q**2), rel=1e-6)
    assert two.rate == pytest.approx(q, rel=1e-6)
    assert two.distance == pytest.approx(25.0 * two.change)
    assert found[1].change == pytest.approx(2.0, rel=1e-3)
    assert [recurrence.period for recurrence in recognised(list(found.values()))] == [2, 4, 6, 8]
    # a rate near 1: what is left of a geometric series
    slow = Recurrence(2, 1e-3, 1e-3 * 0.99**-6, 6)
    assert slow.distance == pytest.approx(1e-3 / (1.0 - 0.99**2), rel=1e-9)
    assert Recurrence(1, 1e-3, 1e-3, 6).distance == pytest.approx(1.0)
    assert Recurrence(1, 0.0, 0.0, 6).rate == 0.0
    assert [recurrence.period for recurrence in recurrences(track[:5])] == [1, 2]


def progress(size=1, scale=2.0):
    return Progress(np.zeros((2, size)), np.full((2, size), scale))


def test_progress_keeps_the_last_states_over_their_scale():
    so_far = progress()
    for block in range(3):
        so_far.take(1, (block * BLOCK + 1.0 + np.arange(BLOCK))[:, None])
    assert so_far.current[1] == 36.0
    assert so_far.current[0] == 0.0
    assert so_far.marched.tolist() == [0, 3 * BLOCK]
    assert len(so_far.track[1]) == LOOK
    np.testing.assert_allclose(so_far.track[1][:, 0], np.arange(12.0, 37.0) / 2.0)
    assert so_far.smallest[1] == pytest.approx(0.5)
    assert so_far.away(1, np.array([30.0])) == pytest.approx(3.0)
    so_far.put(1, np.array([4.0]))
    assert so_far.current[1] == 4.0
    np.testing.assert_allclose(so_far.track[1], [[2.0]])


def test_the_period_that_shows_is_that_of_the_smallest_change():
    so_far = progress(scale=1.0)
    k = np.arange(1.0, 25.0)
    for amplitude, shown in ((1e-4, {3, 6}), (0.3, {1})):
        states = (np.cos(2.0 * np.pi * k / 3.0) + amplitude * np.cos(k))[:, None]
        so_far.take(0, states)
        assert so_far.shown(0) in shown


def test_a_change_that_falls_no_further_is_marched_finely():
    """The last four blocks of a small change: two not below half of the two before."""
    for history, fine in (
        ([4e-3, 4e-3, 3e-3, 2e-3], True),
        ([4e-3, 4e-3, 1.9e-3, 1e-3], False),
        ([4e-2, 4e-2, 3e-2, 2e-2], False),
        ([4e-3, 3e-3, 3e-3], False),
        ([1.0, 1e-4, 9e-3, 9e-3], False),
        ([1e-3, 1e-3, 1.0, 1.0, 4e-3, 4e-3, 3e-3, 2e-3], True),
        ([1e-3, 1e-3, 1.0, 1.0, 4e-3, 4e-3, 1e-3, 1e-3], False),
    ):
        so_far = progress()
        so_far.history[1] = list(history)
        so_far.next_shot |= {(1, 1): 40, (1, 8): 40, (0, 1): 40}
        so_far.refine_where_stuck(1)
        assert bool(so_far.fine[1]) == fine
        assert not so_far.fine[0]
        assert set(so_far.next_shot) == ({(0, 1)} if fine else {(1, 1), (1, 8), (0, 1)})
    assert NOISE == pytest.approx(1e-2)


def test_whether_the_change_falls_is_told_by_its_last_quarters():
    so_far = progress()
    for history, falls in (
        ([1.0] * 4 + [0.4] * 2 + [0.19] * 2, True),
        ([1.0] * 4 + [0.4] * 2 + [0.21] * 2, False),
        ([0.1] * 4 + [1.0] * 2 + [0.49] * 2, True),
        ([0.3], False),
    ):
        so_far.history[0] = list(history)
        assert so_far.approaching(0) == falls


def test_exponents_of_maps_that_stretch_and_shrink_uniformly():
    """Doubling on a circle, a little bent, has the exponent ln 2; a contraction that of its rate."""
    twice = ClosedForm(lambda x, _: np.mod(2.0 * x + 1e-3 * np.sin(40.0 * x), 1.0), [0.0], 1)
    (told,) = wanderings(twice, np.array([[0.2371]]), np.array([0]))
    assert told.kind == "chaotic"
    assert told.exponent == pytest.approx(np.log(2.0), abs=0.3)
    shrinks = ClosedForm(lambda x, _: np.exp([-0.3, -0.5]) * x, [0.0], 2)
    shrinks.scale = np.array([[1e-6, 50.0]])  # the units of the states
    (told,) = wanderings(shrinks, np.array([[3e-7, 10.0]]), np.array([0]))
    assert told.exponent == pytest.approx(-0.3, rel=1e-6)
    assert told.kind == "not periodic"  # it has not settled: its extent falls
    assert told.error == pytest.approx(0.0, abs=1e-6)


def test_what_stops_a_motion_while_its_exponent_is_measured_is_said():
    """Rows that go on are measured as if alone."""
    maps = ClosedForm(lambda x, rate: rate[:, None] * x, [-2.0, -1.0], 1)
    lost, kept = wanderings(maps, np.ones((2, 1)), np.array([0, 1]))
    assert (lost.kind, np.isnan(lost.exponent)) == ("not periodic", True)
    assert lost.describe().endswith("could not be measured: it runs away")
    assert kept == wanderings(maps, np.ones((1, 1)), np.array([1]))[0]


def test_values_of_a_motion_without_period_do_not_depend_on_those_asked_for():
    for start, target in ((0.9, 2.3), (-3.0, -0.7), (2.3, 0.9)):
        found = np.array(between(start, target))
        low, high = sorted((start, target))
        assert np.all((found > low) & (found < high))
        assert np.all(np.diff(found) * (target - start) > 0.0)
        # 256 in every factor of two: the grid k 2^n/256 with 256 ≤ k < 512
        size = np.exp2(np.floor(np.log2(np.abs(found))))
        np.testing.assert_allclose(found / size * VALUES % 1.0, 0.0, atol=1e-9)
        size = np.abs(np.sort(np.abs(found)))
        whole = size[(size >= 1.0) & (size < 2.0)]
        assert len(whole) == (VALUES if (low < 1.0 < 2.0 < high or -high < 1.0 < 2.0 < -low) else VALUES - 1)
    assert between(1.0, 1.0) == between(-0.5, 0.5) == between(0.0, 2.0) == []


@pytest.mark.parametrize(("most", "each"), [(2000, PERIODS), (120, 6), (4, 1)])
def test_what_a_search_may_march_limits_what_is_marched_between_values(most, each):
    """The state counts its periods."""
    drift = Lines(lambda x, _: x + 1.0, 1)
    (arrival,) = follow(drift, [Leg(0, 1.0, 2.0, np.zeros(1), 0)], max_periods=most)
    assert arrival.next_state == each * (VALUES - 1)
