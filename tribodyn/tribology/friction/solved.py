"""Friction of the solved contact, from a table made before the run over the duty of the mesh."""

from typing import Any

from tribodyn.numerics.elementary import absolute, exp, law, log, maximum
from tribodyn.tribology.ehl.table_lookup import held, polynomial
from tribodyn.tribology.law import FrictionLaw, LawInput


@law
def solved_friction(contact, film, surfaces, parameters):
    """Friction coefficient of film and asperities together."""
    box = parameters
    x = held(log(contact.line_load), box.line_load, box.line_load_half)
    y = held(log(contact.entrainment), box.entrainment, box.entrainment_half)
    z = held(log(contact.curvature), box.curvature, box.curvature_half)
    ratio = maximum(absolute(contact.sliding) / contact.entrainment, 1e-9)
    s = held(log(ratio), box.slide_to_roll, box.slide_to_roll_half)
    return exp(polynomial(parameters.friction, x, y, z, s))


def _table(given: LawInput) -> Any:
    from tribodyn.tribology.ehl.table import table_of

    return table_of(given)


LAW = FrictionLaw(
    "solved",
    "mixed thermal contact at the limiting shear stress, solved before the run over the duty of the mesh",
    solved_friction,
    _table,
    film="solved",
)
