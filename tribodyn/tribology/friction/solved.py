"""Friction of the solved contact, from a table made before the run over the duty of the mesh."""

from tribodyn.numerics.elementary import law
from tribodyn.tribology.contact import hertz_half_width, hertz_pressure
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
    """Shares of load and entrainment allowed by the table, and of what the viscosity was measured for."""
    pressure = hertz_pressure(contact.line_load, contact.curvature, surfaces.effective_modulus)
    return (
        *in_table(contact, surfaces, parameters),
        parameters.measured,
        parameters.pressure_limit / pressure,
        parameters.temperature_share,
    )


#: What an oil's viscosity must be measured for, that a friction solved with it is no extrapolation.
MEASURED = (
    "viscosity measured at high pressure, not estimated",
    "p_H ≤ pressure of the measured viscosity",
    "oil within the measured temperatures",
)

LAW = FrictionLaw(
    "solved",
    "mixed thermal contact at the limiting shear stress, solved before the run over the duty of the mesh",
    solved_friction,
    solved_table,
    range=f"{RANGE}; viscosity measured at pressure and temperature of the contact",
    limits=(*LIMITS, *MEASURED),
    in_range=in_its_table,
    table_error=lambda table: table.friction_error,
    table_band=lambda table: (table.friction_low, table.friction_high),
    film="solved",
)
