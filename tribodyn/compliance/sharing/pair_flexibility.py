"""The elasticity of both gears of a pair."""

from typing import NamedTuple

from tribodyn.compliance.fem.gear_compliance import GearCompliance
from tribodyn.compliance.local import Elastic
from tribodyn.geometry.assembly import Assembly


class PairFlexibility(NamedTuple):
    """Elasticity of both gears of a drive; see `load_sharing.flexibility`.

    Attributes
    ----------
    materials : (Elastic, Elastic)
    width : common face width, m
    gears : (GearCompliance, GearCompliance)
    """

    assembly: Assembly
    materials: tuple[Elastic, Elastic]
    width: float
    gears: tuple[GearCompliance, GearCompliance]
