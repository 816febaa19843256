"""Branches of steady states followed along a parameter, on maps whose ends are known in closed form."""

import numpy as np
import pytest

from tests.support.closed_form_maps import Lines, cubic, delayed, logistic
from tribodyn.solve.branch.arclength import CORNER, FOLD, MERGING, NEIMARK_SACKER, PERIOD_DOUBLING
from tribodyn.solve.branch.continuation import Leg, follow


def swept(family, values, start, **options):
    """Motions at values, one after the other, and the ends in between."""
    reach = float(np.max(np.abs(values)))
    leg = Leg(0, values[0], values[0], np.array(start, dtype=float), 0, reach=reach)
    found, ends = [], []
    for value in values:
        leg = leg._replace(target=float(value))
        (arrival,) = follow(family, [leg], tolerance=1e-9, **options)
        found.append(arrival.orbit)
        ends += arrival.ends
        leg = Leg(0, float(value), float(value), arrival.next_state, arrival.orbit.period, reach=reach)
    return found, ends


@pytest.mark.parametrize("step", [0.013, 0.05, 0.2])
def test_the_cascade_of_the_logistic_map(step):
    """Period doublings at r = 3 and 1 + √6, where the multipliers 2 − r and 4 + 2r − r² are −1."""
    values = np.append(np.arange(2.8, 3.5, step), 3.5)
    found, ends = swept(Lines(logistic, 1), values, [0.6])
    assert [end.kind for end in ends] == [PERIOD_DOUBLING, PERIOD_DOUBLING]
    for end, exact in zip(ends, (3.0, 1.0 + np.sqrt(6.0)), strict=True):
        assert end.value == pytest.approx(exact, rel=1e-4)
        assert end.within <= 1e-4 * exact
        assert end.multiplier.real == pytest.approx(-1.0, abs=2e-3)
    for value, orbit in zip(values, found, strict=True):
        if abs(value - 3.0) > 1e-9:
            assert orbit.period == (1 if value < 3.0 else 2 if value < 1.0 + np.sqrt(6.0) else 4)


def test_a_family_of_neutral_motions_is_not_followed():
    """Every state of x' = x, y' = (y + a)/2 with y = a repeats, here nearly: none leads to another."""
    hold = 1.0 - 1e-8
    free = Lines(lambda x, a: np.stack([hold * x[:, 0], 0.5 * (x[:, 1] + a)], axis=1), 2)
    found, ends = swept(free, [1.0, 1.5, 2.0], [0.0, 1.0])
    assert ends == []
    np.testing.assert_allclose(
        [orbit.state for orbit in found], [[0.0, 1.0], [0.0, 1.5], [0.0, 2.0]], atol=1e-8
    )
    assert len(free.asked) <= 7


@pytest.mark.parametrize("start", [2.8, 2.85, 2.9])
def test_a_place_that_is_not_found_is_no_end(start):
    """Nothing is found at the first place between a stable and an unstable one: the end is still located."""
    plain = Lines(logistic, 1)
    leg = Leg(0, start, 3.2, np.array([1.0 - 1.0 / start]), 1)
    follow(plain, [leg], tolerance=1e-9)
    beyond = next(i for i, value in enumerate(plain.asked) if value > 3.0)
    between = plain.asked[beyond + 1]
    assert start < between < plain.asked[beyond]

    class WithGap(Lines):
        def at(self, lines, values):
            inside = [abs(value - between) < 1e-4 for value in values]
            outside = [value for value, missing in zip(values, inside, strict=True) if not missing]
            period_map, _ = super().at(lines, outside)
            return period_map, ["not here" if missing else "" for missing in inside]

    (arrival,) = follow(WithGap(logistic, 1), [leg], tolerance=1e-9)
    assert [end.kind for end in arrival.ends] == [PERIOD_DOUBLING]
    assert arrival.ends[0].value == pytest.approx(3.0, rel=1e-4)


def test_the_way_back_merges():
    values = np.arange(3.4, 2.85, -0.1)
    found, ends = swept(Lines(logistic, 1), values, [0.6])
    assert [end.kind for end in ends] == [MERGING]
    assert ends[0].value == pytest.approx(3.0, rel=1e-4)
    assert [orbit.period for orbit in found] == [2, 2, 2, 2, 1, 1]


@pytest.mark.parametrize("step", [0.031, 0.11, 0.5])
def test_a_branch_is_left_at_its_fold_whatever_the_step(step):
    fold = 2.0 / np.sqrt(27.0)
    for way in (1.0, -1.0):
        values = way * np.append(np.arange(-0.7, 0.6, step), 0.6)
        found, ends = swept(Lines(cubic, 1), values, [-way])
        assert [end.kind for end in ends] == [FOLD]
        assert way * ends[0].value == pytest.approx(fold, rel=1e-4)
        for value, orbit in zip(values, found, strict=True):
            assert orbit.kind == "period-1"
            assert np.sign(orbit.state[0]) == (-way if way * value < fold else way)


def test_a_neimark_sacker_point_is_located_and_what_follows_is_on_a_torus():
    values = np.array([1.7, 1.9, 2.02])
    found, ends = swept(Lines(delayed, 2), values, [0.45, 0.45], max_periods=1200)
    assert [end.kind for end in ends] == [NEIMARK_SACKER]
    assert ends[0].value == pytest.approx(2.0, rel=1e-4)
    assert abs(np.degrees(np.angle(ends[0].multiplier))) == pytest.approx(60.0, abs=0.5)
    assert [orbit.kind for orbit in found] == ["period-1", "period-1", "quasi-periodic"]


def tent(x, height):
    """A corner at 0: beyond the border the branch's multiplier is −3 at once."""
    return height[:, None] + np.where(x < 0.0, 0.5 * x, -3.0 * x)


def test_a_branch_that_ends_at_a_corner():
    """The fixed point 2 h, multiplier 0.5, meets the corner at h = 0; beyond, h/4 has the multiplier −3."""
    shifted = Lines(lambda x, h: tent(x, h - 1.0), 1)
    _, ends = swept(shifted, np.array([0.5, 0.8, 1.1]), [-1.0], max_periods=240)
    assert ends[0].value == pytest.approx(1.0, rel=1e-4)
    assert ends[0].kind in (CORNER, PERIOD_DOUBLING)


def test_lines_go_side_by_side_as_if_alone():
    family = Lines(logistic, 1)
    legs = [Leg(line, 2.9, target, np.array([1.0 - 1.0 / 2.9]), 1) for line, target in enumerate((3.2, 3.5))]
    together = follow(family, legs, tolerance=1e-9)
    for leg, arrival in zip(legs, together, strict=True):
        (alone,) = follow(family, [leg], tolerance=1e-9)
        np.testing.assert_array_equal(arrival.orbit.state, alone.orbit.state)
        assert arrival.ends == alone.ends


def test_where_there_is_nothing_in_between_the_neighbours_state_is_marched():
    family = Lines(logistic, 1)
    leg = Leg(0, 2.9, 3.2, np.array([1.0 - 1.0 / 2.9]), 1, finest=np.inf)
    (arrival,) = follow(family, [leg], tolerance=1e-9)
    assert arrival.orbit.period == 2
    assert set(family.asked) == {3.2}
    assert arrival.ends == ()


def test_expensive_steps_are_few():
    family = Lines(logistic, 1)
    leg = Leg(0, 2.9, 3.3, np.array([1.0 - 1.0 / 2.9]), 1, finest=0.1)
    (arrival,) = follow(family, [leg], tolerance=1e-9)
    assert arrival.orbit.period == 2
    assert len(set(family.asked)) <= 5
    assert arrival.ends[0].within <= 0.1 + 1e-12
    assert abs(arrival.ends[0].value - 3.0) <= 0.1


def test_steps_are_in_the_parameters_own_unit():
    asked = []
    for unit in (1.0, 1e3, 1e-3):
        family = Lines(lambda x, b, unit=unit: logistic(x, b / unit), 1)
        leg = Leg(0, 2.6 * unit, 3.3 * unit, np.array([1.0 - 1.0 / 2.6]), 1)
        follow(family, [leg], tolerance=1e-9)
        asked.append(np.array(family.asked) / unit)
    np.testing.assert_allclose(asked[1:], [asked[0]] * 2, rtol=1e-6)
