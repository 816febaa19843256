"""No friction."""

from tribodyn.tribology.friction.coulomb import Constant, constant
from tribodyn.tribology.law import FrictionLaw

#: A coefficient of zero, so that machine code with it is that of any constant one.
NO_FRICTION = Constant(0.0, float("nan"))

LAW = FrictionLaw(
    "none",
    "frictionless flanks; the film is still reported",
    constant,
    lambda given: NO_FRICTION,
    reads_film=False,
)
