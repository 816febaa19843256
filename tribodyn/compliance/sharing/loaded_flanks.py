"""The flanks of a pair as they are: elastic, modified, on axes as they stand, in slices along the face."""

from typing import NamedTuple

from tribodyn.compliance.sharing.flank_gap import flank_gap
from tribodyn.compliance.sharing.load_sharing import SharedLoad, share_load
from tribodyn.compliance.sharing.pair_flexibility import PairFlexibility
from tribodyn.compliance.sharing.slices import face_positions
from tribodyn.geometry.flanks.corner_contact import pair_geometry
from tribodyn.geometry.flanks.modification import UNMODIFIED, Modifications
from tribodyn.numerics.shapes import Array, Float


class LoadedFlanks(NamedTuple):
    """What the load contact model needs to know except position, load and friction.

    Attributes
    ----------
    flexible : with `lead` where slices hold each other
    modifications : without pitch errors: all teeth are alike
    slices : equal slices of the face
    coupled : whether slices hold each other through the teeth and bodies
    """

    flexible: PairFlexibility
    modifications: Modifications = UNMODIFIED
    slices: int = 1
    coupled: bool = True

    def share(
        self,
        roll: Float[Array, "position pair"],
        gear_torque: float,
        friction_coefficient: Float[Array, "position pair"] | float = 0.0,
    ) -> SharedLoad:
        """Share the gear's torque among pairs at the roll angles (position, pair), see `share_load`."""
        flexible = self.flexible
        geometry = pair_geometry(flexible.assembly, roll)
        face = face_positions(flexible.width, self.slices)
        gap = flank_gap(flexible.assembly, self.modifications, geometry, face)
        return share_load(flexible, roll, gear_torque, friction_coefficient, gap, self.slices, self.coupled)
