"""Coulomb's law: one coefficient, whatever load and speed; and how laws of a mean coefficient are made."""

from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.numerics.elementary import as_float, law
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.law import FrictionLaw, JudgedRange, LawInput


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


def mean_law(
    name: str,
    about: str,
    mean: Callable[[NominalConditions], Any],
    share: Callable[[NominalConditions], Any],
    range: str,
    limit: str,
    ratio: tuple[float, float, float],
    outside: tuple[float, float, float] | None = None,
) -> FrictionLaw:
    """Law of a mean coefficient over the mesh; `ratio` and `outside` as in `JudgedRange`.

    `mean` and `share` give the coefficient, and the share that its limits allow, of the pitch point.
    """

    def of_mesh(inputs: LawInput) -> Constant:
        conditions = inputs.nominal()
        return Constant(as_float(mean(conditions)), as_float(share(conditions)))

    return FrictionLaw(
        name,
        about,
        constant,
        of_mesh,
        in_range=range_of_constant,
        range=range,
        limits=(limit,),
        judged=JudgedRange((0.5, 2.0), ratio, outside=outside),
        reads_film=False,
    )


def _given(_inputs: LawInput, coefficient: float) -> Constant:
    return Constant(as_float(coefficient), float("nan"))


LAW = FrictionLaw(
    "coulomb",
    "a constant coefficient, friction.coefficient",
    constant,
    _given,
    keys=(
        Parameter("coefficient", "number", "friction coefficient μ", allowed="not negative", example="0.05"),
    ),
    reads_film=False,
)


#: A coefficient of zero, so that machine code with it is that of any constant one.
NO_FRICTION = Constant(0.0, float("nan"))

NONE = FrictionLaw(
    "none",
    "frictionless flanks; the film is still reported",
    constant,
    lambda given: NO_FRICTION,
    reads_film=False,
)
