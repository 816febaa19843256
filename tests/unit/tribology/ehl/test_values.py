"""What counts as a number of a contact, at the very edges, and what its message says."""

import math
from fractions import Fraction

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.tribology.ehl.values import not_negative, number, positive

TINY, HUGE = 1e-30, 1e30


@pytest.mark.parametrize("value", [0, -3, 2.5, TINY / 2, HUGE, -HUGE, Fraction(1, 4), np.float64(7.0)])
def test_numbers(value):
    assert number("a", value) == float(value)
    assert isinstance(number("a", value), float)


@pytest.mark.parametrize("value", [True, "1", None, [1.0], math.nan, math.inf, 1.1 * HUGE, -1.1 * HUGE, 1j])
def test_what_is_no_number(value):
    for rule in (number, not_negative, positive):
        with pytest.raises(InputError) as caught:
            rule("a", value)
        assert caught.value.key == "a"


def test_signs():
    assert not_negative("a", 0) == 0.0
    assert not_negative("a", TINY / 2) == TINY / 2
    assert positive("a", 1.01 * TINY) == 1.01 * TINY
    assert positive("a", TINY) == TINY
    with pytest.raises(InputError, match=r"a = -0\.5 mm.*must not be negative"):
        not_negative("a", -0.5, "mm")
    with pytest.raises(InputError, match=r"a = 0 mm.*must be positive"):
        positive("a", 0.0, "mm")
    with pytest.raises(InputError, match="is below 1e-30"):
        positive("a", 0.9 * TINY)
