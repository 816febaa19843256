"""The elementary functions mean the same to floats, NumPy, numba and JAX."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from tribodyn.kernels.native import kernel
from tribodyn.numerics import elementary

jax.config.update("jax_enable_x64", True)

UNARY = ["sqrt", "exp", "log", "log1p", "expm1", "sin", "cos", "tan"]
BINARY = ["minimum", "maximum", "arctan2"]


@kernel
def _pairs(a, b, low, high, angle, chosen):
    for i in range(len(a)):
        low[i] = elementary.minimum(a[i], b[i])
        high[i] = elementary.maximum(a[i], b[i])
        angle[i] = elementary.arctan2(a[i], b[i])
        chosen[i] = elementary.where(a[i] > b[i], a[i], b[i])


@pytest.mark.parametrize("name", UNARY)
def test_unary(name):
    function = getattr(elementary, name)
    x = np.array([0.1, 0.7, 1.3, 2.9])
    expected = getattr(np, name)(x)
    np.testing.assert_allclose([function(float(v)) for v in x], expected, rtol=1e-15)
    np.testing.assert_allclose(function(x), expected, rtol=1e-15)
    np.testing.assert_allclose(function(jnp.asarray(x)), expected, rtol=1e-14)


def test_binary_and_choice_with_nan():
    """NaN is never lost in a minimum or maximum, whoever compiles it."""
    nan = float("nan")
    a = np.array([1.0, -2.0, nan, 3.0, nan, 0.0])
    b = np.array([2.0, -3.0, 1.0, nan, nan, 0.0])
    native = [np.empty(6) for _ in range(4)]
    _pairs(a, b, *native)
    chosen = np.where(a > b, a, b)
    for found, name in zip(native, ["minimum", "maximum", "arctan2"], strict=False):
        expected = getattr(np, name)(a, b)
        np.testing.assert_array_equal(found, expected)
        function = getattr(elementary, name)
        np.testing.assert_array_equal(
            [function(float(x), float(y)) for x, y in zip(a, b, strict=True)], expected
        )
        np.testing.assert_array_equal(function(a, b), expected)
        np.testing.assert_allclose(function(jnp.asarray(a), jnp.asarray(b)), expected, rtol=1e-14)
    np.testing.assert_array_equal(native[3], chosen)


def test_a_float_stays_a_float():
    for name in UNARY:
        assert type(getattr(elementary, name)(0.5)) is float
    for name in BINARY:
        assert type(getattr(elementary, name)(0.5, 0.25)) is float
