"""Laws that count mixed lubrication: none above a film parameter, all below another, linear between.

Archard's law so: M. Priest, C. M. Taylor, Wear 241 (2000) 193 (from memory, not checked against the paper),
for piston rings; taken over for gears since: K = k for λ < 1/2, (2/7)(4 − λ) k for 1/2 ≤ λ ≤ 4, 0 above.

By the energy that friction dissipates, V = k_E ∫ μ p |v_s| dA dt: S. Fouvry, P. Kapsa, L. Vincent, Wear 200
(1996) 186; S. Fouvry, T. Liskiewicz, P. Kapsa, S. Hannel, E. Sauger, Wear 255 (2003) 287. Their coefficients,
of dry steel in fretting, are orders of magnitude above those of lubricated gears: there is no default.
Without a lubricant there is no film to count.
"""

from typing import Any

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import law, maximum, minimum
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.law import values_of
from tribodyn.tribology.wear.archard import COEFFICIENT
from tribodyn.tribology.wear.law import WearLaw

BOUNDARY = Parameter(
    "boundary_film_parameter",
    "number",
    "film over roughness below which asperities carry all",
    0.5,
    "Priest & Taylor (2000); from memory",
    allowed="not negative",
    example="0.5",
)
SEPARATING = Parameter(
    "separating_film_parameter",
    "number",
    "film over roughness above which nothing is worn, λ_crit",
    4.0,
    "Priest & Taylor (2000); from memory",
    allowed="positive",
    example="4.0",
)


@law
def share_in_contact(film_parameter, boundary, separating):
    """1 below the boundary film parameter, 0 above the separating one, linear between."""
    return minimum(maximum((separating - film_parameter) / (separating - boundary), 0.0), 1.0)


@law
def priest_taylor(contact, parameters):
    """K = k times the share in contact."""
    share = share_in_contact(
        contact.film_parameter, parameters.boundary_film_parameter, parameters.separating_film_parameter
    )
    return parameters.coefficient * share


def checked(_inputs: Any, **values: float) -> Any:
    """The values of the keys; InputError where the film that separates is not above the other."""
    low, high = values[BOUNDARY.name], values[SEPARATING.name]
    if high <= low:
        rule = f"must be above {BOUNDARY.name}, {low:g}: between the two lubrication is mixed"
        raise InputError(f"wear.{SEPARATING.name}", f"{high:g}", rule, "write a larger number, such as 4.0")
    return values_of(values)


LAW = WearLaw(
    "priest-taylor",
    "Archard's coefficient, falling to nothing with the film over roughness, Priest & Taylor (2000)",
    priest_taylor,
    checked,
    keys=(COEFFICIENT, BOUNDARY, SEPARATING),
    needs_film=True,
)


@law
def energy(contact, parameters):
    """K = k_E μ times the share in contact."""
    share = share_in_contact(
        contact.film_parameter, parameters.boundary_film_parameter, parameters.separating_film_parameter
    )
    return parameters.energy_coefficient * contact.friction_coefficient * share


ENERGY = WearLaw(
    "energy",
    "volume in proportion to the energy that friction dissipates, Fouvry (1996)",
    energy,
    checked,
    keys=(
        Parameter(
            "energy_coefficient",
            "wear coefficient",
            "volume worn off a flank per energy dissipated, k_E",
            example='"2e-8 mm**3/J"',
        ),
        BOUNDARY,
        SEPARATING,
    ),
    needs_friction=True,
)
