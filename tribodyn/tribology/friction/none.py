"""No friction."""

from typing import NamedTuple

from tribodyn.numerics.elementary import law
from tribodyn.tribology.law import FrictionLaw


class NoParameters(NamedTuple):
    """Of a law that reads no numbers."""


@law
def no_friction(contact, film, surfaces, parameters):
    """Coefficient zero."""
    return 0.0 * contact.sliding


@law
def no_heat(contact, film, surfaces, parameters, coefficient):
    """Flash temperature rise zero."""
    return 0.0 * contact.sliding


LAW = FrictionLaw(
    "none",
    "frictionless flanks; the film is still reported",
    no_friction,
    lambda given: NoParameters(),
    flash_temperature=no_heat,
    reads_film=False,
)
