"""The wear laws and their registry."""

from tribodyn.numerics.registry import Registry
from tribodyn.tribology.wear.law import WearData, WearLaw

WEAR_LAWS: Registry[WearLaw] = Registry(
    "wear.law",
    "wear law",
    {
        "priest-taylor": "tribodyn.tribology.wear.priest_taylor:LAW",
        "archard": "tribodyn.tribology.wear.archard:LAW",
        "archard-asperities": "tribodyn.tribology.wear.archard:ASPERITIES",
        "energy": "tribodyn.tribology.wear.priest_taylor:ENERGY",
    },
    "tribodyn.wear_laws",
    WearLaw,
)


def wear_law_of(data: WearData) -> WearLaw:
    """Return the law of a case."""
    return WEAR_LAWS[data.law] if isinstance(data.law, str) else data.law
