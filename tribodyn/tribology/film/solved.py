"""Film of the solved contact, from a table made before the run over the duty of the mesh."""

from typing import Any

from tribodyn.numerics.elementary import absolute, law, log, maximum, minimum
from tribodyn.tribology.ehl.table.lookup import LIMITS, RANGE, clipped, in_table, polynomial
from tribodyn.tribology.law import FilmLaw, LawInput


@law
def solved_film(contact, surfaces, parameters):
    """Ln of the mean gap on the line of centres (m), 1, and the asperities' share."""
    box = parameters
    x = clipped(log(contact.line_load), box.line_load, box.line_load_half)
    y = clipped(log(contact.entrainment), box.entrainment, box.entrainment_half)
    z = clipped(log(contact.curvature), box.curvature, box.curvature_half)
    ratio = maximum(absolute(contact.sliding) / contact.entrainment, 1e-9)
    s = clipped(log(ratio), box.slide_to_roll, box.slide_to_roll_half)
    share = polynomial(box.share, x, y, z, s)
    return polynomial(box.film, x, y, z, s), 1.0, maximum(minimum(share, 1.0), 0.0)


def _table(given: LawInput) -> Any:
    from tribodyn.tribology.ehl.table.table import table_of

    return table_of(given)


LAW = FilmLaw(
    "solved",
    "mixed thermal contact solved before the run over the duty of the mesh: mean gap on the line of centres",
    solved_film,
    _table,
    range=RANGE,
    limits=LIMITS,
    in_range=in_table,
    table_error=lambda table: table.film_error,
)
