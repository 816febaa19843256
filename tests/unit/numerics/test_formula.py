"""Formulas of scenarios: what they are worth, and what is none."""

import math

import numpy as np
import pytest

from tribodyn.numerics.curve import FormulaError, evaluated

H = np.array([0.0, 0.25, 1.0])


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2*i - 3/4 + 7%4", 2 * 5 - 0.75 + 3),
        ("-i**2", -25.0),
        ("sin(pi/6) + floor(2.7)", 2.5),
        ("max(0.5, h, 1-h)", [1.0, 0.75, 1.0]),
        ("min(0.5, h, 1-h)", [0.0, 0.25, 0.0]),
        ("abs(h - 0.5)", [0.5, 0.25, 0.5]),
        ("exp(-1/h)", [0.0, math.exp(-4.0), math.exp(-1.0)]),
    ],
)
def test_values(text: str, value: "float | list[float]"):
    assert evaluated(text, {"i": 5, "h": H}) == pytest.approx(value, rel=1e-15, abs=0.0)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("(-8)**(1/3)", "not finite"),  # of Python's numbers a complex one
        ("(-i)**0.5", "not finite"),
        ("(h-0.5)**0.5", "not finite"),
        ("log(h)", "not finite"),
        ("0/0", "not finite"),
        ("i**i**i**i", "not finite"),
        ("1" * 400, "can be evaluated"),
        ("1j", "only numbers"),
        ("sin(h, h)", '"sin" takes one number'),  # NumPy would write into h
        ("sqrt()", "takes one number"),
        ("max(h)", "takes two numbers or more"),
        ("max()", "takes two numbers or more"),
        ("sin(x=h)", "only numbers"),
        ("sin(*h)", "only numbers"),
        ("open(1)", "none of the functions"),
        ("j", '"j" is none of'),
        ("", "can be evaluated"),
        ("(" * 300 + "1" + ")" * 300, "longer than"),
        ("h if h else 1", "only numbers"),
        ("[1, 2]", "only numbers"),
    ],
)
def test_what_is_no_formula(text: str, why: str):
    before = H.copy()
    with pytest.raises(FormulaError, match=why):
        evaluated(text, {"i": 5, "h": H})
    np.testing.assert_array_equal(H, before)
