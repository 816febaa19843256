"""The wear laws: one per file, and their registry."""

from tribodyn.numerics.registry import Registry
from tribodyn.tribology.wear.law import WearLaw

WEAR_LAWS: Registry[WearLaw] = Registry(
    "wear.law",
    "wear law",
    {
        "priest-taylor": "tribodyn.tribology.wear.priest_taylor:LAW",
        "archard": "tribodyn.tribology.wear.archard:LAW",
        "archard-asperities": "tribodyn.tribology.wear.archard:ASPERITIES",
        "energy": "tribodyn.tribology.wear.energy:LAW",
    },
    "tribodyn.wear_laws",
    WearLaw,
)
