"""Duals: derivatives of laws as compiled code carries them, against complex steps."""

import numpy as np
import pytest

from tribodyn.kernels.duals import functions  # noqa: F401  (its import gives the laws their derivatives)
from tribodyn.kernels.duals.functions import LENGTH, VALUE, duals_of
from tribodyn.kernels.duals.numbers import DIRECTIONS
from tribodyn.kernels.native import kernel
from tribodyn.numerics import elementary
from tribodyn.numerics.elementary import law

#: Results of `evaluated`.
ROWS = 17


@law
def evaluated(x, z, out):
    """Every function at x, z > 0."""
    out[0] = elementary.sqrt(x)
    out[1] = elementary.exp(x)
    out[2] = elementary.expm1(x)
    out[3] = elementary.log(x)
    out[4] = elementary.log1p(x)
    out[5] = elementary.sin(x)
    out[6] = elementary.cos(x)
    out[7] = elementary.tan(x)
    out[8] = x**2
    out[9] = x**-0.17
    out[10] = 2.5**x
    out[11] = x**z
    out[12] = x / (z + 1)
    out[13] = 3 / x
    out[14] = 2.0 - x * z - 1
    out[15] = -x
    total = 0.0
    for _ in range(3):
        total += 2 * x
    out[16] = total


@law
def branched(x, z, out):
    """What looks at values: each is differentiated where it is."""
    out[0] = elementary.absolute(x)
    out[1] = elementary.maximum(x, z)
    out[2] = elementary.minimum(x, 1)
    out[3] = elementary.where(x > z, x * z, 2.0)
    out[4] = elementary.arctan2(x, z)
    out[5] = 1.0 * elementary.truncate(elementary.absolute(x))
    if x != z and (x < z or z <= x):
        out[6] = x
    else:
        out[6] = z


@kernel
def smooth_over_duals(x, out):
    """`evaluated` at two numbers."""
    numbers = duals_of(x)
    evaluated(numbers[0], numbers[1], duals_of(out))


@kernel
def branched_over_duals(x, out):
    """`branched` at two numbers."""
    numbers = duals_of(x)
    branched(numbers[0], numbers[1], duals_of(out))


def dual(value, **slopes):
    row = np.zeros(LENGTH)
    row[VALUE] = value
    for name, slope in slopes.items():
        row[int(name.removeprefix("d"))] = slope
    return row


def values_and_slopes(function, rows, x, z):
    """Values, and derivatives with respect to x and z, which are in directions far apart."""
    out = np.full((rows, LENGTH), np.nan)
    function(np.array([dual(x, d0=1.0), dual(z, d15=1.0)]), out)
    assert not np.any(out[:, 1 : DIRECTIONS - 1])
    return out[:, VALUE], out[:, 0], out[:, DIRECTIONS - 1]


@pytest.mark.parametrize(("x", "z"), [(0.3, 1.7), (1.9, 0.6), (1e-9, 3.0), (2.5, 2.5)])
def test_derivatives_are_those_of_complex_steps(x, z):
    value, by_x, by_z = values_and_slopes(smooth_over_duals, ROWS, x, z)
    exact: dict[int, float] = {}
    evaluated(x, z, exact)
    step = 1e-30

    def numpy(x, z):
        out = np.zeros(ROWS, dtype=complex)
        evaluated(np.complex128(x), np.complex128(z), out)
        return out

    np.testing.assert_allclose(value, [exact[row] for row in range(ROWS)], rtol=1e-14)
    np.testing.assert_allclose(by_x, numpy(x + 1j * step, z).imag / step, rtol=1e-13)
    np.testing.assert_allclose(by_z, numpy(x, z + 1j * step).imag / step, rtol=1e-13, atol=1e-300)


@pytest.mark.parametrize(("x", "z"), [(-0.3, 1.7), (1.9, 0.6), (-2.5, -0.5)])
def test_comparisons_look_at_values_and_take_the_slopes_along(x, z):
    value, by_x, by_z = values_and_slopes(branched_over_duals, 7, x, z)
    expected = [abs(x), max(x, z), min(x, 1.0), x * z if x > z else 2.0, np.arctan2(x, z), int(abs(x)), x]
    square = x * x + z * z
    slopes_x = [np.sign(x), float(x > z), float(x < 1.0), z * (x > z), z / square, 0.0, 1.0]
    slopes_z = [0.0, float(z > x), 0.0, x * (x > z), -x / square, 0.0, 0.0]
    np.testing.assert_allclose(value, expected, rtol=1e-15)
    np.testing.assert_allclose(by_x, slopes_x, rtol=1e-15)
    np.testing.assert_allclose(by_z, slopes_z, rtol=1e-15)


def test_what_is_not_a_number_is_seen_in_the_largest_slope():
    for place in (0, 7, DIRECTIONS - 1):
        slopes = np.linspace(-1.0, 0.5, DIRECTIONS)
        row = dual(3.0)
        row[:DIRECTIONS] = slopes
        assert _largest(row) == 1.0
        row[place] = -4.0
        assert _largest(row) == 4.0
        row[place] = np.nan
        assert np.isnan(_largest(row))


@kernel
def largest(x):
    """The largest slope of the one number of an array, read through a slice."""
    return elementary.largest_slope(duals_of(x)[1:][0])


def _largest(row):
    return largest(np.array([dual(0.0), row]))


def law_of(slope):
    """A law as a user defines it: nothing marked but itself, with a number of its own in a closure."""

    def falling(x, z):
        return 0.04 + 0.06 * elementary.exp(-slope * elementary.absolute(x)) / elementary.sqrt(z)

    return falling


@kernel
def handed_over(function, x, out):
    """A function among the arguments, at two numbers."""
    numbers = duals_of(x)
    duals_of(out)[0] = function(numbers[0], numbers[1])


def test_a_law_that_is_handed_over_is_differentiated():
    law = law_of(3.0)
    for x, z in ((0.2, 1.3), (-0.4, 0.7)):
        out = np.zeros((1, LENGTH))
        handed_over(law, np.array([dual(x, d0=1.0), dual(z, d1=1.0)]), out)
        fall = 0.06 * np.exp(-3.0 * abs(x)) / np.sqrt(z)
        assert out[0, VALUE] == pytest.approx(law(x, z), rel=1e-14)
        assert out[0, 0] == pytest.approx(-3.0 * np.sign(x) * fall, rel=1e-13)
        assert out[0, 1] == pytest.approx(-0.5 * fall / z, rel=1e-13)
