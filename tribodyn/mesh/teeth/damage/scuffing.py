"""Scuffed patches: the flank is as it was, but rougher."""

from dataclasses import dataclass

from tribodyn.mesh.teeth.damage.gear import DamagedGear
from tribodyn.mesh.teeth.damage.patch import Patch
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields, sound


@dataclass(frozen=True)
class Scuffing:
    """A patch in which friction is so many times that of the sound flank; a slice has its mean."""

    tooth: int
    flank: int
    patch: Patch
    factor: float

    @property
    def early(self) -> float:
        """See `gear.Damage`."""
        return 0.0

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `gear.Damage`."""
        if flank != self.flank:
            return None
        scuffed = self.patch.share(gear, places).mean(axis=1)
        return sound(places)._replace(friction=1.0 + (self.factor - 1.0) * scuffed)
