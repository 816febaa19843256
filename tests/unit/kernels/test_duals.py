"""Duals: derivatives of laws as compiled code carries them, against complex steps."""

from typing import Any, NamedTuple

import numpy as np
import pytest

from tribodyn.kernels.duals import functions  # noqa: F401  (its import gives the laws their derivatives)
from tribodyn.kernels.duals.functions import duals_of, length_of
from tribodyn.kernels.native import kernel
from tribodyn.numerics import elementary
from tribodyn.numerics.elementary import law

#: Directions of the duals, two blocks; and those of what is evaluated by few numbers of its own.
DIRECTIONS, FEW = 16, 8
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
    numbers = duals_of(x, DIRECTIONS)
    evaluated(numbers[0], numbers[1], duals_of(out, DIRECTIONS))


@kernel
def branched_over_duals(x, out):
    """`branched` at two numbers."""
    numbers = duals_of(x, DIRECTIONS)
    branched(numbers[0], numbers[1], duals_of(out, DIRECTIONS))


def dual(value, **slopes):
    row = np.zeros(length_of(DIRECTIONS))
    row[DIRECTIONS] = value
    for name, slope in slopes.items():
        row[int(name.removeprefix("d"))] = slope
    return row


def values_and_slopes(function, rows, x, z):
    """Values, and derivatives with respect to x and z, which are in directions far apart."""
    out = np.full((rows, length_of(DIRECTIONS)), np.nan)
    function(np.array([dual(x, d0=1.0), dual(z, d15=1.0)]), out)
    assert not np.any(out[:, 1 : DIRECTIONS - 1])
    return out[:, DIRECTIONS], out[:, 0], out[:, DIRECTIONS - 1]


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
    return elementary.largest_slope(duals_of(x, DIRECTIONS)[1:][0])


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
    numbers = duals_of(x, DIRECTIONS)
    duals_of(out, DIRECTIONS)[0] = function(numbers[0], numbers[1])


def test_a_law_that_is_handed_over_is_differentiated():
    law = law_of(3.0)
    for x, z in ((0.2, 1.3), (-0.4, 0.7)):
        out = np.zeros((1, length_of(DIRECTIONS)))
        handed_over(law, np.array([dual(x, d0=1.0), dual(z, d1=1.0)]), out)
        fall = 0.06 * np.exp(-3.0 * abs(x)) / np.sqrt(z)
        assert out[0, DIRECTIONS] == pytest.approx(law(x, z), rel=1e-14)
        assert out[0, 0] == pytest.approx(-3.0 * np.sign(x) * fall, rel=1e-13)
        assert out[0, 1] == pytest.approx(-0.5 * fall / z, rel=1e-13)


class Two(NamedTuple):
    """What `inner` depends on."""

    first: Any
    second: Any


@law
def inner(numbers, store):
    """A function of two numbers that keeps a number in between."""
    store[0] = numbers.first * elementary.exp(numbers.second)
    return store[0] / numbers.second, 2.0, numbers.second


@law
def nested(x, z, store):
    """The function of two functions of x and z."""
    numbers = Two(x * z, x - 3.0 * z)
    return elementary.by_chain_rule(inner(elementary.independent(numbers, store), store), numbers, store)


@kernel
def nested_over_duals(x, store, out):
    """`nested` at two numbers, with the derivatives in between by its own numbers alone."""
    numbers, into = duals_of(x, DIRECTIONS), duals_of(out, DIRECTIONS)
    into[0], into[1], into[2] = nested(numbers[0], numbers[1], duals_of(store, FEW))


@kernel
def nested_throughout(x, store, out):
    """The same with all derivatives throughout."""
    numbers, into = duals_of(x, DIRECTIONS), duals_of(out, DIRECTIONS)
    into[0], into[1], into[2] = nested(numbers[0], numbers[1], duals_of(store, DIRECTIONS))


def test_derivatives_by_few_numbers_are_taken_to_many_by_the_chain_rule():
    rng = np.random.default_rng(3)
    x = rng.normal(size=(2, length_of(DIRECTIONS)))
    x[:, DIRECTIONS] = 0.8, 0.3
    found, expected = np.zeros((2, 3, length_of(DIRECTIONS)))
    nested_over_duals(x, np.zeros((1, length_of(FEW))), found)
    nested_throughout(x, np.zeros((1, length_of(DIRECTIONS))), expected)
    np.testing.assert_allclose(found, expected, rtol=1e-13)
    assert nested(0.8, 0.3, {}) == pytest.approx(found[:, DIRECTIONS], rel=1e-14)
