"""Sampled deviations: seeded, within their tolerances, distributed as stated."""

import numpy as np
import pytest

from tests.support.sample_drives import STANDARD
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import involute
from tribodyn.geometry.modification import (
    FlankModification,
    Limits,
    Misalignment,
    Modifications,
    deviating,
    profile_curve,
    sampled,
    summed,
)

LIMITS = Limits(8e-6, 30e-6, 7e-6, 9e-6, 8e-6)
SAMPLES = [sampled(LIMITS, 40, seed, 0) for seed in range(400)]


def test_the_same_seed_draws_the_same_gear():
    first, second = sampled(LIMITS, 40, 7, 1), sampled(LIMITS, 40, 7, 1)
    assert np.array_equal(first.pitch, second.pitch)
    assert first._replace(pitch=None) == second._replace(pitch=None)
    assert not np.array_equal(first.pitch, sampled(LIMITS, 40, 7, 0).pitch)


def test_deviations_keep_their_tolerances():
    for sample in SAMPLES:
        steps = np.diff(np.append(sample.pitch, sample.pitch[0]))
        assert np.abs(steps).max() <= LIMITS.single_pitch * (1 + 1e-9)
        assert np.ptp(sample.pitch) <= LIMITS.total_pitch * (1 + 1e-9)
        assert abs(sample.pitch.sum()) < 1e-15 * 40 * 1e6 * 1e-6
        assert max(abs(sample.slope) / 7e-6, sample.form / 9e-6, abs(sample.helix) / 8e-6) <= 1


def test_tolerances_are_three_standard_deviations():
    for name, tolerance in (("slope", 7e-6), ("helix", 8e-6)):
        values = np.array([getattr(sample, name) for sample in SAMPLES])
        # four standard errors of 400 samples
        assert abs(values.mean()) < 4 * tolerance / 3 / 20
        assert values.std() == pytest.approx(tolerance / 3, rel=4 / np.sqrt(800))
    # of a form deviation the magnitude; its one to three waves begin anywhere
    form = np.array([sample.form for sample in SAMPLES])
    assert form.mean() == pytest.approx(9e-6 / 3 * np.sqrt(2 / np.pi), rel=0.15)
    for name, ends, bins in (("waves", (0.5, 3.5), 3), ("phase", (0.0, 2 * np.pi), 4)):
        counts, _ = np.histogram([getattr(sample, name) for sample in SAMPLES], bins, ends)
        assert sum(counts) == 400
        assert counts.min() > 400 / bins - 4 * np.sqrt(400 / bins)


def test_the_profile_is_the_sum_of_both_gears():
    pair = assemble(involute.FAMILY, STANDARD)
    none = SAMPLES[0]._replace(slope=0.0, form=0.0, single_pitch=0.0)
    sloped = none._replace(slope=5e-6)
    roll, tip = profile_curve(pair, sloped, none, base_pitch=False)
    assert (roll[0], roll[-1]) == tuple(float(limit) for limit in pair.roll_limits)
    # more is missing at the pinion's tip, where contact ends; at the gear's, where it begins
    assert tip[-1] - tip[0] == pytest.approx(5e-6)
    _, other = profile_curve(pair, none, sloped, base_pitch=False)
    assert other == pytest.approx(tip[::-1])
    assert profile_curve(pair, sloped, sloped, base_pitch=False)[1] == pytest.approx(0.0, abs=1e-18)


def test_a_deviation_of_base_pitch_opens_by_itself_from_pair_to_pair():
    pair = assemble(involute.FAMILY, STANDARD)
    none = SAMPLES[0]._replace(slope=0.0, form=0.0, single_pitch=0.0)
    roll, error = profile_curve(pair, none._replace(single_pitch=6e-6), none, base_pitch=True)
    a_pitch_later = np.interp(roll[0] + pair.pitch_angle, roll, error) - error[0]
    assert a_pitch_later == pytest.approx(6e-6 * np.cos(STANDARD.pressure_angle), rel=1e-9)
    # in the middle of the path the pair is where it would be without
    np.testing.assert_allclose(error + error[::-1], 0.0, atol=1e-18)
    _, other = profile_curve(pair, none, none._replace(single_pitch=6e-6), base_pitch=True)
    np.testing.assert_allclose(other, error, rtol=1e-12, atol=1e-18)


def test_curves_are_added_at_the_points_of_both():
    curve = np.array([0.0, 1.0, 2.0]), np.array([0.0, 2.0, 0.0])
    at, total = summed(curve, (np.array([0.5, 3.0]), np.array([1.0, 1.0])))
    assert at.tolist() == [0.0, 0.5, 1.0, 2.0, 3.0]
    assert total.tolist() == [1.0, 2.0, 3.0, 1.0, 1.0]


@pytest.mark.parametrize("every_tooth", [False, True])
def test_deviations_are_added_to_what_each_gear_has(every_tooth: bool):
    pair = assemble(involute.FAMILY, STANDARD)
    pinion, gear = sampled(LIMITS, 20, 3, 0), sampled(LIMITS, 36, 4, 1)
    given = np.linspace(-1e-6, 2e-6, 20)
    ends = np.array([float(limit) for limit in pair.roll_limits])
    curve = ends, np.array([3e-6, 1e-6])
    stand = Misalignment(in_plane=40e-6, out_of_plane=70e-6)
    before = Modifications(
        FlankModification(pitch_error=tuple(given), profile_error=curve),
        FlankModification(both_flanks=True),
        stand,
    )
    after = deviating(before, pair, pinion, gear, every_tooth)
    widths = STANDARD.pinion.face_width, STANDARD.gear.face_width
    assert after.misalignment.in_plane == pytest.approx(
        40e-6 + pinion.helix / widths[0] + gear.helix / widths[1], rel=1e-12
    )
    assert after.misalignment.out_of_plane == 70e-6
    assert (after.pinion.both_flanks, after.gear.both_flanks) == (False, True)
    assert after.gear.profile_error is None
    if every_tooth:
        np.testing.assert_allclose(after.pinion.pitch_error, pinion.pitch + given, rtol=1e-12)
        np.testing.assert_allclose(after.gear.pitch_error, gear.pitch, rtol=1e-12)
    else:
        assert after.pinion.pitch_error == tuple(given)
        assert len(after.gear.pitch_error) == 0
    roll, own = profile_curve(pair, pinion, gear, base_pitch=not every_tooth)
    assert after.pinion.profile_error is not None
    at, total = after.pinion.profile_error
    assert total == pytest.approx(np.interp(at, roll, own) + np.interp(at, *curve), abs=1e-18)


def test_form_is_a_wave_of_half_its_deviation():
    """Between crest and trough of whole waves; the gear's phase runs from the other end."""
    pair = assemble(involute.FAMILY, STANDARD)
    none = SAMPLES[0]._replace(slope=0.0, form=0.0, single_pitch=0.0)
    wavy = none._replace(form=4e-6, waves=2, phase=0.7)
    roll, own = profile_curve(pair, wavy, none, base_pitch=False)
    assert np.ptp(own) == pytest.approx(4e-6, rel=5e-3)
    share = (roll - roll[0]) / (roll[-1] - roll[0])
    assert own == pytest.approx(2e-6 * np.cos(4 * np.pi * share + 0.7), abs=1e-15)
    assert profile_curve(pair, none, wavy, base_pitch=False)[1] == pytest.approx(own[::-1], abs=1e-15)
