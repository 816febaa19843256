"""Wear by the energy that friction dissipates.

V = k_E ∫ μ p |v_s| dA dt: S. Fouvry, P. Kapsa, L. Vincent, Wear 200 (1996) 186; S. Fouvry, T. Liskiewicz,
P. Kapsa, S. Hannel, E. Sauger, Wear 255 (2003) 287. Their coefficients, of dry steel in fretting, are
orders of magnitude above those of lubricated gears: there is no default. A film counts as in
`priest_taylor`; without a lubricant there is none.
"""

from tribodyn.numerics.elementary import law
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.wear.law import WearLaw
from tribodyn.tribology.wear.priest_taylor import BOUNDARY, SEPARATING, checked, share_in_contact


@law
def energy(contact, parameters):
    """K = k_E μ times the share in contact."""
    share = share_in_contact(
        contact.film_parameter, parameters.boundary_film_parameter, parameters.separating_film_parameter
    )
    return parameters.energy_coefficient * contact.friction_coefficient * share


LAW = WearLaw(
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
