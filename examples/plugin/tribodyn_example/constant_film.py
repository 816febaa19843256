"""A film of one given thickness, whatever load and speed: for what a film law changes in a result."""

from tribodyn import FilmLaw, Parameter
from tribodyn.numerics.elementary import log


def film(contact, surfaces, parameters):
    """Ln of the film (m), roughness factor, share of the load that asperities carry."""
    return 0.0 * contact.line_load + log(parameters.thickness), 1.0, 0.0


LAW = FilmLaw(
    "constant-film",
    "a film of given thickness, without asperity contact",
    film,
    keys=(Parameter("thickness", "length", "of the film", example='"0.5 um"'),),
)
