"""A tip that has broken off: above the break neither flank of the tooth is there."""

from dataclasses import dataclass

import numpy as np

from tribodyn.mesh.teeth.damage.gear import CLEAR, DamagedGear, arc, strips
from tribodyn.mesh.teeth.damage.patch import middle_of, smooth
from tribodyn.mesh.teeth.damage.touching import partly_touching
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields


@dataclass(frozen=True)
class BrokenTip:
    """Break across a tooth; contact ends there, over a part of the face.

    Beyond the break the gap grows like a slope of 45 degrees, which begins within `edge`.
    """

    tooth: int
    #: height, radius: of the break, as of `patch.Patch`
    height: float | None
    radius: float | None
    face: float  # middle of the broken part, m from the middle of the face
    width: float  # of the broken part, m; infinite: the whole face
    edge: float  # m

    @property
    def early(self) -> float:
        """See `gear.Damage`."""
        return CLEAR

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `gear.Damage`."""
        up = arc(gear, places)
        beyond = np.maximum(up - middle_of(self.height, self.radius, up, places), 0.0)
        gap = np.where(beyond < self.edge, beyond**2 / (2.0 * self.edge), beyond - self.edge / 2.0)
        across = np.abs(strips(gear, places) - self.face)[..., None]
        return partly_touching(gear, places, gap * smooth((self.width / 2.0 - across) / self.edge))
