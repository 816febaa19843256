"""Which contacts are refused, at the edges of what the equations are made for."""

import math
from fractions import Fraction

import numpy as np
import pytest

from tests.support.line_contacts import MODULUS, by_moes
from tribodyn.errors import InputError
from tribodyn.tribology.ehl.fluid import Fluid
from tribodyn.tribology.ehl.problem import LineContact, check, not_negative, number, positive
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.oil import roelands_index

FLUID = Fluid(0.04, 22e-9, 0.6)
PROBLEM = LineContact(2e5, 0.01, 1.0, FLUID, MODULUS)


def refused(problem):
    """Key of the value that is refused; None: none is."""
    try:
        check(problem)
    except InputError as error:
        return error.key
    return None


def test_moes_numbers_that_are_solved():
    """M from 0.01 to 1e12, L up to 1000."""
    assert refused(by_moes(0.0102, 1.0, 1e7)) is None
    assert refused(by_moes(0.0098, 1.0, 1e7)) == "line_load"
    assert refused(by_moes(0.98e12, 1.0)) is None
    assert refused(by_moes(1.02e12, 1.0)) == "line_load"
    assert refused(by_moes(100.0, 998.0)) is None
    assert refused(by_moes(100.0, 1002.0)) == "pressure_viscosity"


def test_a_contact_is_no_wider_than_its_cylinders():
    """b² = 8 w R/(π E') ≤ R²: w ≤ π E' R/8."""
    most = math.pi * MODULUS * 0.01 / 8
    assert refused(PROBLEM._replace(line_load=0.99 * most)) is None
    assert refused(PROBLEM._replace(line_load=1.01 * most)) == "line_load"


@pytest.mark.parametrize("name", ["line_load", "radius", "entrainment_speed", "effective_modulus"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf, None])
def test_numbers_that_must_be_positive(name, value):
    assert refused(PROBLEM._replace(**{name: value})) == name


@pytest.mark.parametrize(
    ("fluid", "key"),
    [
        (FLUID, None),
        (FLUID._replace(pressure_viscosity=0.0), None),
        (FLUID._replace(viscosity_pressure_index=1.0), None),
        (FLUID._replace(viscosity=0.0), "viscosity"),
        (FLUID._replace(viscosity=-0.1), "viscosity"),
        (FLUID._replace(pressure_viscosity=-1e-9), "pressure_viscosity"),
        (FLUID._replace(viscosity_pressure_index=0.0), "viscosity_pressure_index"),
        (FLUID._replace(viscosity_pressure_index=1.001), "viscosity_pressure_index"),
    ],
)
def test_oils(fluid, key):
    assert refused(PROBLEM._replace(fluid=fluid)) == key


def test_sliding_and_roughness():
    assert refused(PROBLEM._replace(sliding_speed=-3.0, roughness=Roughness(1e-7, friction=0.0))) is None
    for speed in (math.inf, math.nan):
        assert refused(PROBLEM._replace(sliding_speed=speed)) == "sliding_speed"
    for name, key in (
        ("height", "roughness"),
        ("density", "asperity_density"),
        ("slope", "asperity_slope"),
    ):
        assert refused(PROBLEM._replace(roughness=Roughness(1e-7)._replace(**{name: 0.0}))) == key
    for friction in (-0.1, math.nan):
        assert refused(PROBLEM._replace(roughness=Roughness(1e-7, friction=friction))) == "asperity_friction"


def test_index_of_roelands():
    """z at which ln η + 9.67 = (ln η0 + 9.67) (1 + p/p_r)^z begins with the slope α."""
    z = roelands_index(21e-9, 0.037)
    step = 1e3
    rise = (math.log(0.037) + 9.67) * ((1 + step / 1.962e8) ** z - 1)
    assert rise / step == pytest.approx(21e-9, rel=1e-5)


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
