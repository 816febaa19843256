"""The families of paths of contact: one per file, and their registry."""

from tribodyn.geometry.family import Family
from tribodyn.numerics.registry import Registry

FAMILIES: Registry[Family] = Registry(
    "drive.family",
    "family of paths of contact",
    {
        "involute": "tribodyn.geometry.families.involute:FAMILY",
        "crc": "tribodyn.geometry.families.crc:FAMILY",
        "cycloidal": "tribodyn.geometry.families.cycloidal:FAMILY",
        "parabolic": "tribodyn.geometry.families.parabolic:FAMILY",
        "s-gear": "tribodyn.geometry.families.s_gear:FAMILY",
        "points": "tribodyn.geometry.families.points:FAMILY",
        "spline": "tribodyn.geometry.families.spline:FAMILY",
        "circular-arc": "tribodyn.geometry.families.circular_arc:FAMILY",
    },
    "tribodyn.families",
    Family,
)


def family(name: str) -> Family:
    """Return the family of paths of contact of that name; InputError where there is none."""
    return FAMILIES[name]
