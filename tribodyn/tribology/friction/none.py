"""No friction."""

from typing import Any, NamedTuple

from tribodyn.numerics.elementary import law
from tribodyn.tribology.law import FrictionLaw, LawInput


class NoParameters(NamedTuple):
    """Of a law that reads no numbers."""


@law
def no_friction(contact, film, surfaces, parameters):
    """Coefficient zero."""
    return 0.0 * contact.sliding


@law
def steepness(worse, contact, surfaces, parameters):
    """Zero: there is no heat."""
    return 0.0 * worse.line_load


def _none(given: LawInput) -> Any:
    return NoParameters()


LAW = FrictionLaw(
    "none",
    "frictionless flanks; the film is still reported",
    no_friction,
    _none,
    steepness=steepness,
)
