"""A crack in the root of a tooth: compliance added to the flank whose load opens it."""

from dataclasses import dataclass

import numpy as np

from tribodyn.compliance.crack import Crack, crack_compliance
from tribodyn.compliance.energy import tooth_compliance
from tribodyn.mesh.teeth.damage.gear import CLEAR, DamagedGear, strips
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields, sound
from tribodyn.numerics.shapes import Array, Float

#: Depths of a crack that is not equally deep along the face, by finite elements.
_SOLVED_DEPTHS = 4
_DEPTHS = 40


@dataclass(frozen=True)
class RootCrack:
    """Crack whose front is straight along the face, or falls like a parabola from one end to the other.

    Strips of the face bend beside each other, each with the compliance of a tooth that is cracked as the
    strip is (Z. Chen & Y. Shao, Eng. Fail. Anal. 18 (2011) 2149, from whom the parabola is): together they
    are as compliant as strips in parallel.
    """

    tooth: int
    flank: int
    depth: float  # at its deepest, m
    #: angle, tangent: as of `compliance.crack.Crack`
    angle: float
    tangent: float
    face: float  # middle of the cracked part, m from the middle of the face
    width: float  # of the cracked part, m; infinite: the whole face
    #: end at which it is deepest: 1 that at +z, −1 that at −z; 0: equally deep
    deepest: int = 0

    @property
    def crack(self) -> Crack:
        """The crack at its deepest."""
        return Crack(self.depth, self.angle, self.tangent)

    @property
    def early(self) -> float:
        """See `gear.Damage`."""
        return CLEAR

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `gear.Damage`."""
        if flank != self.flank or self.depth == 0.0:
            return None
        share = self._depth_share(gear, places)  # (slice, strip)
        shares = np.linspace(0.0, 1.0, _DEPTHS + 1) if self.deepest else np.array([0.0, 1.0])
        added = self._added(gear, places, shares)  # (share, node)
        cracked = np.stack([np.interp(share, shares, node) for node in added.T], axis=-1)
        compliance = tooth_compliance(gear.loaded, gear.materials[0], gear.width, places.distance)
        sound_tooth = compliance.bending + compliance.shear + compliance.axial
        stiffness = np.mean(1.0 / (sound_tooth + cracked), axis=1)
        return sound(places)._replace(compliance=1.0 / stiffness - sound_tooth)

    def _depth_share(self, gear: DamagedGear, places: FlankPlaces) -> Float[Array, "slice strip"]:
        z = strips(gear, places)
        width = min(self.width, gear.width)
        middle = self.face if self.width <= gear.width else 0.0
        along = (z - middle) / width  # −1/2 … 1/2
        cracked = np.abs(along) <= 0.5
        if not self.deepest:
            return cracked * 1.0
        return cracked * np.sqrt(np.clip(0.5 + self.deepest * along, 0.0, 1.0))

    def _added(
        self, gear: DamagedGear, places: FlankPlaces, shares: Float[Array, " share"]
    ) -> Float[Array, "share node"]:
        """Compliance (m/N) that a crack of so many shares of the depth adds over the whole width."""
        material, depth = gear.materials[0], self.depth
        if not gear.solved:
            return crack_compliance(
                gear.loaded, material, gear.width, places.distance, self.crack, depth * shares
            )
        from tribodyn.compliance.fem.cracked_tooth import solved_crack_compliance

        at = np.linspace(0.0, 1.0, _SOLVED_DEPTHS + 1)[1:] if self.deepest else np.ones(1)
        solved = [
            solved_crack_compliance(
                gear.loaded,
                material,
                gear.width,
                places.distance,
                self.crack._replace(depth=float(depth * share)),
            )
            for share in at
        ]
        # it grows about like the square of the depth
        ratio = np.stack(solved) / at[:, None] ** 2
        by_node = [np.interp(shares, at, node) for node in ratio.T]
        return np.stack(by_node, axis=-1) * shares[:, None] ** 2
