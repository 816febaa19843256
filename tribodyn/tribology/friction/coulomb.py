"""Coulomb's law: one coefficient, whatever load and speed."""

from typing import Any, NamedTuple

from tribodyn.numerics.elementary import as_float, law
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.law import FrictionLaw, LawInput


class Constant(NamedTuple):
    """The one coefficient of a contact, given or computed."""

    coefficient: Any  # μ
    #: smallest share allowed by the limits of the formula that it was computed by; NaN: none stated
    in_range: Any


@law
def constant(contact, film, surfaces, parameters):
    """Coefficient of the parameters."""
    return 0.0 * contact.sliding + parameters.coefficient


@law
def range_of_constant(contact, film, surfaces, parameters):
    """Smallest share allowed by the limits of the formula of the mean coefficient."""
    return 0.0 * contact.sliding + parameters.in_range


def _given(given: LawInput, coefficient: float) -> Constant:
    return Constant(as_float(coefficient), float("nan"))


LAW = FrictionLaw(
    "coulomb",
    "a constant coefficient, friction.coefficient",
    constant,
    _given,
    keys=(
        Parameter("coefficient", "number", "friction coefficient μ", allowed="not negative", example="0.05"),
    ),
)
