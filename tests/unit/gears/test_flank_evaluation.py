"""Deviations of traces, pitch and runout by closed form, and the class that they keep."""

import math

import numpy as np
import pytest

from tribodyn.gears.measured.flank_evaluation import (
    classes_reached,
    eccentricity_of,
    evaluation_range,
    pitch_deviations,
    trace_deviations,
)


def test_a_line_with_a_whole_wave_has_the_slope_of_the_line_and_the_form_of_the_wave():
    """Over [2, 12] mm: rise 0.5 µm/mm and a wave of 3 µm, whose own line of least squares is known.

    Of A sin(2πx/L) over its period that line rises by −6 A/(π L) per length.
    """
    length, amplitude, rise = 10e-3, 3e-6, 0.5e-3
    x = np.linspace(0.0, 14e-3, 2801)
    y = rise * x + amplitude * np.sin(2.0 * np.pi * (x - 2e-3) / length)
    found = trace_deviations(x, y, (2e-3, 12e-3), length)
    own = -6.0 * amplitude / (math.pi * length)
    assert found.slope == pytest.approx((rise + own) * length, rel=1e-4)
    inside = np.linspace(0.0, length, 100_001)
    wave = amplitude * np.sin(2.0 * np.pi * inside / length)
    assert found.form == pytest.approx(np.ptp(wave - own * inside), rel=1e-4)
    assert found.total == pytest.approx(np.ptp(wave + rise * inside), rel=1e-4)
    # the same line over the whole profile, as the edition of 2013 extends it
    assert trace_deviations(x, y, (2e-3, 12e-3), 12e-3).slope == pytest.approx(1.2 * found.slope)


def test_order_and_spacing_of_points_do_not_matter():
    x = np.linspace(0.0, 1.0, 401) ** 2 * 10e-3
    y = 1e-3 * x**2 / 10e-3
    even = np.linspace(0.0, 10e-3, 2001)
    expected = trace_deviations(even, 1e-3 * even**2 / 10e-3, (0.0, 10e-3), 10e-3)
    for at, value in ((x, y), (x[::-1], y[::-1])):
        found = trace_deviations(at, value, (0.0, 10e-3), 10e-3)
        assert tuple(found) == pytest.approx(tuple(expected), rel=2e-4)
    with pytest.raises(ValueError, match="three points"):
        trace_deviations(np.array([0.0, 1.0]), np.zeros(2), (0.0, 1.0), 1.0)


def test_what_is_evaluated_where_nothing_is_said():
    assert evaluation_range(5e-3, 15e-3, False, 3e-3) == pytest.approx((5e-3, 14.5e-3))
    assert evaluation_range(0.0, 40e-3, True, 3e-3) == pytest.approx((2e-3, 38e-3))
    assert evaluation_range(0.0, 100e-3, True, 3e-3) == pytest.approx((3e-3, 97e-3))


def test_pitch_of_a_sine_and_runout_of_an_eccentricity():
    """F_pi = A sin(2πi/z): F_p = 2 A, f_p = A sin(2π/z) from tooth 0 to 1; runout of e is 2 e."""
    teeth, size = 24, 12e-6
    place = 2.0 * np.pi * np.arange(teeth) / teeth
    single, total = pitch_deviations(size * np.sin(place))
    assert abs(single) == pytest.approx(size * math.sin(2.0 * math.pi / teeth))
    assert total == pytest.approx(2.0 * size)
    radial = size * np.cos(place - math.pi / 3.0) + 4e-6
    assert eccentricity_of(radial) == pytest.approx((size, math.pi / 3.0))
    assert np.ptp(radial) == pytest.approx(2.0 * size)


def test_the_finest_class_that_is_kept():
    """m 4 mm, d 100 mm, b 25 mm: f_HαT of class 5 is 5.7 µm, printed 5.5; of class 6 8.06, printed 8."""
    sizes = 4e-3, 100e-3, 25e-3
    for value, expected in ((5.5e-6, 5), (-5.5e-6, 5), (5.6e-6, 6), (-8e-6, 6), (8.1e-6, 7), (1.0, None)):
        assert classes_reached({"profile_slope": value}, *sizes).overall == expected
    both = classes_reached({"profile_slope": 5.5e-6, "single_pitch": 13e-6}, *sizes)
    # f_pT of class 5 is 6.7 µm, √2 from class to class: 13.4 of class 7, printed 13
    assert (both.each["profile_slope"], both.each["single_pitch"], both.overall) == (5, 7, 7)
    # f_Hα of 1995, class 5: m of 3.5 … 6, d of 50 … 125 mm: 2 √4.583 + 0.14 √79.06 + 0.5 = 6.03, printed 6
    assert classes_reached({"profile_slope": 6e-6}, *sizes, 1995).overall == 5
