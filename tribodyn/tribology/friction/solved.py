"""Friction of the solved contact, from a table made before the run over the duty of the mesh."""

from tribodyn.numerics.elementary import law
from tribodyn.tribology.contact import hertz_half_width
from tribodyn.tribology.ehl.lookup import (
    LIMITS,
    RANGE,
    asperity_share,
    in_table,
    mixed_friction,
    most_of_film,
    polynomial,
    variables,
)
from tribodyn.tribology.film.solved import solved_table
from tribodyn.tribology.law import FrictionLaw


@law
def solved_friction(contact, film, surfaces, parameters):
    """Friction coefficient of film and asperities together."""
    x, y, z, s = variables(contact, parameters)
    share = asperity_share(parameters, x, y, z, s)
    half_width = hertz_half_width(contact.line_load, contact.curvature, surfaces.effective_modulus)
    most = most_of_film(contact.line_load, half_width, parameters.limit, parameters.floor)
    return mixed_friction(polynomial(parameters.friction, x, y, z, s), share, most, parameters.rubbing)


@law
def in_its_table(contact, film, surfaces, parameters):
    """Shares of load and entrainment allowed by the table."""
    return in_table(contact, surfaces, parameters)


LAW = FrictionLaw(
    "solved",
    "mixed thermal contact at the limiting shear stress, solved before the run over the duty of the mesh",
    solved_friction,
    solved_table,
    range=RANGE,
    limits=LIMITS,
    in_range=in_its_table,
    table_error=lambda table: table.friction_error,
    film="solved",
)
