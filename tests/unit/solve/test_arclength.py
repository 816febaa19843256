"""Branches beyond the ends of their stable parts, on maps whose branches are known in closed form."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tests.support.closed_form_maps import Lines, cubic, delayed, logistic
from tribodyn.solve.branch import arclength
from tribodyn.solve.branch.arclength import FOLD, MERGING, PERIOD_DOUBLING, Arclength, BranchPoint, Seed
from tribodyn.solve.branch.continuation import Leg, follow
from tribodyn.solve.branch.unstable import unstable_branches


def followed(step):
    """A map with a second state, which follows the first and settles."""
    return lambda x, a: np.stack([step(x[:, :1], a)[:, 0], 0.3 * x[:, 1] + 0.5 * x[:, 0]], axis=1)


#: By itself, and beside a state that takes no part.
SIZES = pytest.mark.parametrize("size", [1, 2])


def lines(step, size):
    return Lines(step if size == 1 else followed(step), size)


def beyond(family, start, target, state, period, span):
    """The branch beyond the only end on the way from one value to another."""
    state = np.append(state, 0.6 * np.ones(family.size))[: family.size]
    leg = Leg(0, start, target, state, period, reach=max(map(abs, span)))
    (arrival,) = follow(family, [leg], tolerance=1e-9)
    (end,), (branch,) = arrival.ends, unstable_branches(family, 0, arrival.seeds, span, tolerance=1e-9)
    assert branch is not None
    assert max(orbit.residual for orbit in branch.orbits) <= 1e-9
    assert branch.states.shape == (len(branch.values), family.size)
    some = branch.thinned(3)
    assert len(some.values) == len(some.orbits) == min(3, len(branch.values))
    assert some.values[0] == branch.values[0]
    assert some.orbits[-1] is branch.orbits[-1]
    assert np.all(np.abs(branch.multipliers[:, 0]) > 1.0)
    return end, branch


@SIZES
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_round_a_fold_to_the_other_fold(way, size):
    """a = x³ − x between both folds of the cubic map, with the multiplier 1 + (1 − 3 x²)/4."""
    end, branch = beyond(lines(cubic, size), -0.7 * way, 0.5 * way, [-1.2 * way], 1, (-1.0, 1.0))
    fold = 2.0 / np.sqrt(27.0)
    assert end.kind == FOLD
    assert branch.finish is not None
    assert branch.finish.kind == FOLD
    assert branch.finish.value == pytest.approx(-way * fold, abs=2e-6)
    assert branch.finish.within <= 2e-6
    x = branch.states[:, 0]
    np.testing.assert_allclose(branch.values, x**3 - x, atol=1e-7)
    np.testing.assert_allclose(branch.multipliers[:, 0].real, 1.0 + 0.25 * (1.0 - 3.0 * x**2), atol=1e-4)
    assert np.all(np.diff(way * x) > 0.0)
    assert np.ptp(x) > 0.95 * 2.0 / np.sqrt(3.0)


@SIZES
def test_beyond_a_period_doubling_to_the_border_of_the_range(size):
    """The fixed point 1 − 1/r of the logistic map, with the multiplier 2 − r."""
    end, branch = beyond(lines(logistic, size), 2.8, 3.2, [1.0 - 1.0 / 2.8], 1, (2.8, 3.4))
    assert end.kind == PERIOD_DOUBLING
    assert branch.finish is None
    np.testing.assert_allclose(branch.states[:, 0], 1.0 - 1.0 / branch.values, atol=1e-8)
    np.testing.assert_allclose(branch.multipliers[:, 0].real, 2.0 - branch.values, atol=1e-4)
    assert branch.values[-1] == pytest.approx(3.4)
    assert np.max(np.diff(branch.values)) <= 0.035


@SIZES
def test_behind_a_merging_the_motion_of_fewer_periods_is_unstable(size):
    state = (4.2 - np.sqrt(4.2 * 0.2)) / 6.4
    end, branch = beyond(lines(logistic, size), 3.2, 2.9, [state], 2, (2.8, 3.4))
    assert (end.kind, end.period, branch.period) == (MERGING, 2, 1)
    np.testing.assert_allclose(branch.states[:, 0], 1.0 - 1.0 / branch.values, atol=1e-8)
    assert branch.values[0] == pytest.approx(3.0, abs=0.01)
    assert branch.values[-1] == pytest.approx(3.4)


def test_beyond_a_neimark_sacker_point():
    """Of the delayed logistic map, where the multipliers' modulus is the root of a − 1."""
    _, branch = beyond(Lines(delayed, 2), 1.8, 2.05, [0.45, 0.45], 1, (1.7, 2.2))
    np.testing.assert_allclose(np.abs(branch.multipliers[:, 0]), np.sqrt(branch.values - 1.0), atol=1e-4)
    assert branch.values[-1] == pytest.approx(2.2)


def subcritical(x, a):
    """x' = −(1 + a) x − x³ + x⁵/4: the fixed point 0 doubles at a = 0, what is doubled is there for a < 0.

    On it a = −x² + x⁴/4, which turns back at a = −1 where x² = 2.
    """
    return -(1.0 + a[:, None]) * x - x**3 + 0.25 * x**5


@SIZES
def test_a_doubled_motion_ends_where_it_merges(size):
    """From its fold, where it is met stable, to the doubling of the motion of one period."""
    family = lines(subcritical, size)
    x = np.sqrt(2.0 + 2.0 * np.sqrt(0.1))
    end, branch = beyond(family, -0.9, -1.05, [x], 2, (-1.2, 0.2))
    assert (end.kind, end.period, branch.period) == (FOLD, 2, 2)
    assert branch.finish is not None
    assert branch.finish.kind == MERGING
    assert branch.finish.value == pytest.approx(0.0, abs=1e-4)
    np.testing.assert_allclose(
        branch.values, -(branch.states[:, 0] ** 2) + 0.25 * branch.states[:, 0] ** 4, atol=1e-6
    )


def test_the_end_is_at_its_value_in_the_parameters_own_unit():
    """The same with the parameter counted from elsewhere and in another unit."""
    elsewhere = Lines(lambda x, b: subcritical(x, b / 40.0 - 0.75), 1)
    x = np.sqrt(2.0 + 2.0 * np.sqrt(0.1))
    _, branch = beyond(elsewhere, 40.0 * -0.15, 40.0 * -0.3, [x], 2, (-18.0, 38.0))
    assert branch.finish is not None
    assert branch.finish.kind == MERGING
    assert branch.finish.value == pytest.approx(30.0, abs=5e-3)
    assert branch.finish.within <= 5e-3


def test_where_nothing_goes_on_there_is_no_branch():
    """A place that is stable as far as the range goes."""
    (branch,) = unstable_branches(
        Lines(logistic, 1), 0, [Seed(2.5, np.array([0.6]), 1, 1.0)], (2.0, 2.9), tolerance=1e-9
    )
    assert branch is None
    runs_away = Seed(2.5, np.array([40.0]), 1, 1.0)
    assert unstable_branches(Lines(logistic, 1), 0, [runs_away], (2.0, 2.9)) == [None]


def test_the_parameter_turns_at_the_vertex_of_a_parabola():
    """a = 0.9 − x², in units of 2 for a and 1 for x, between places so near that nothing is solved."""
    ends = []
    for x in (-3e-4, 5e-4):
        tangent = np.array([1.0, -x])  # of (x, a/2)
        ends.append(
            BranchPoint(
                np.array([x, 0.45 - 0.5 * x * x]), tangent / np.linalg.norm(tangent), np.ones(1), 0.0, None
            )
        )
    way = cast(Any, SimpleNamespace(units=np.array([1.0, 2.0])))
    found, value, within = Arclength.turning(way, *ends)
    assert found is ends[0]
    assert value == pytest.approx(0.9, abs=1e-8)
    assert within == pytest.approx(9e-8, rel=1e-2)


@pytest.mark.parametrize("before", [1e-4, 3e-3, 7e-3])
def test_a_fold_is_found_from_as_far_as_the_parameter_hardly_moves(before):
    """a = x³ − x, which turns back at x = −1/√3."""
    x = -1.0 / np.sqrt(3.0) - before
    seed = Seed(x**3 - x, np.array([x]), 1, 1.0)
    turn = arclength.follow_arc(Lines(cubic, 1), 0, seed, 1.0, tolerance=1e-9)
    assert turn is not None
    assert turn.folded
    assert turn.value == pytest.approx(2.0 / np.sqrt(27.0), abs=2e-5)


def test_it_begins_at_the_value_of_the_seed():
    """On the plane of equal parameters, whatever the state that is given: x = y = 1 − 1/a of the map."""
    for way in (1.0, -1.0):
        seed = Seed(2.3, np.array([0.52, 0.61]), 1, way)
        along = Arclength(Lines(delayed, 2), 0, seed, 2.3, 1e-9)
        place = along.begin()
        assert place is not None
        np.testing.assert_allclose(place.point * along.units, [1 - 1 / 2.3, 1 - 1 / 2.3, 2.3], rtol=1e-8)
        slope = place.tangent[:2] * along.units[:2] / (place.tangent[2] * along.units[2])
        np.testing.assert_allclose(slope, 1 / 2.3**2, rtol=1e-4)
        assert way * place.tangent[2] > 0.0
