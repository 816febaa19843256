"""Film of the solved contact, from a table made before the run over the duty of the mesh."""

from typing import Any

from tribodyn.numerics.elementary import law
from tribodyn.tribology.ehl.lookup import LIMITS, RANGE, asperity_share, in_table, polynomial, variables
from tribodyn.tribology.law import FilmLaw, LawInput


@law
def solved_film(contact, surfaces, parameters):
    """Ln of the mean gap on the line of centres (m), 1, and the asperities' share."""
    x, y, z, s = variables(contact, parameters)
    return polynomial(parameters.film, x, y, z, s), 1.0, asperity_share(parameters, x, y, z, s)


def solved_table(inputs: LawInput) -> Any:
    """Return the table of a case; it is solved where it is not kept."""
    from tribodyn.tribology.ehl.table import table_of

    return table_of(inputs)


LAW = FilmLaw(
    "solved",
    "mixed thermal contact solved before the run over the duty of the mesh: mean gap on the line of centres",
    solved_film,
    solved_table,
    range=RANGE,
    limits=LIMITS,
    in_range=in_table,
    table_error=lambda table: table.film_error,
)
