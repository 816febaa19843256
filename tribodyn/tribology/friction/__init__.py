"""The friction laws: one per file, and their registry."""

from tribodyn.numerics.registry import Registry
from tribodyn.tribology.law import FrictionLaw

_MIXED = "tribodyn.tribology.friction.masjedi_khonsari"

FRICTION_LAWS: Registry[FrictionLaw] = Registry(
    "friction.law",
    "friction law",
    {
        "none": "tribodyn.tribology.friction.coulomb:NONE",
        "coulomb": "tribodyn.tribology.friction.coulomb:LAW",
        "masjedi-khonsari": f"{_MIXED}:LAW",
        "masjedi-khonsari-mean-pressure": f"{_MIXED}:MEAN_PRESSURE",
        "masjedi-khonsari-as-printed": f"{_MIXED}:AS_PRINTED",
        "masjedi-khonsari-veciana": f"{_MIXED}:VECIANA",
        "masjedi-khonsari-veciana-peak": f"{_MIXED}:VECIANA_PEAK",
        "xu": "tribodyn.tribology.friction.xu:LAW",
        "benedict-kelley": "tribodyn.tribology.friction.benedict_kelley:LAW",
        "niemann": "tribodyn.tribology.friction.niemann:LAW",
        "schlenk": "tribodyn.tribology.friction.niemann:SCHLENK",
        "iso-14179-1": "tribodyn.tribology.friction.iso_14179_1:LAW",
        "solved": "tribodyn.tribology.friction.solved:LAW",
    },
    "tribodyn.friction_laws",
    FrictionLaw,
)
