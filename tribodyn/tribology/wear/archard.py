"""Archard's law with a constant coefficient, k, of the whole load or of what asperities carry of it.

The default of k is the coefficient that P. Bajpai, A. Kahraman, N. E. Anderson, J. Tribol. 126 (2004) 597,
fitted to measured flanks of case-hardened gears, 9.65e-19 m²/N, and that much of the later literature on
gears takes over. A. Flodin, S. Andersson, Wear 207 (1997) 16, take 5e-16 m²/N for slow gears in boundary
lubrication. Both from memory, not checked against the papers: between oils, steels and speeds k differs by
three orders.
"""

from tribodyn.numerics.elementary import law
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.wear.law import WearLaw

COEFFICIENT = Parameter(
    "coefficient",
    "wear coefficient",
    "volume worn off a flank per load and sliding distance, k",
    9.65e-19,
    "Bajpai, Kahraman & Anderson (2004), case-hardened gears; from memory",
)


@law
def archard(contact, parameters):
    """K = k, whatever the contact."""
    return parameters.coefficient + 0.0 * contact.hertz_pressure


@law
def on_asperities(contact, parameters):
    """K = k times the share of the load that asperities carry."""
    return parameters.coefficient * contact.asperity_load_ratio


LAW = WearLaw("archard", "a constant coefficient, wear.coefficient", archard, keys=(COEFFICIENT,))
ASPERITIES = WearLaw(
    "archard-asperities",
    "Archard's coefficient on the part of the load that asperities carry, by the film law",
    on_asperities,
    keys=(COEFFICIENT,),
    needs_film=True,
    film="masjedi-khonsari",  # which gives that part; laws of smooth surfaces give none
)
