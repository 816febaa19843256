"""What the load contact model can take: torque, modifications, slices."""

import numpy as np

from tribodyn.compliance.sharing.flank_gap import check_modifications, maximum_along_lead
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, SharedLoad, half_width
from tribodyn.errors import InputError
from tribodyn.geometry.flanks.corner_contact import pair_geometry
from tribodyn.geometry.flanks.modification import (
    MINIMUM_SLICES,
    too_few_slices,
    vary_along_lead,
)


def check_torque(gear_torque: float) -> None:
    """Refuse a torque that presses no flanks together."""
    if gear_torque <= 0:
        rule = "presses no flanks together: the load contact model is taken at this load"
        raise InputError("operating.gear_torque", gear_torque, rule, 'write a torque such as "500 N*m"')


def check_contact(flanks: LoadedFlanks, gear_torque: float) -> None:
    """Refuse loads that drive nothing, modifications that are none, too few slices for them, and too many.

    A slice must be as wide as its contact: the loads of narrower ones are not line loads to each other.

    Raises InputError, which names the key, the rule and a value that obeys it.
    """
    flexible, modifications, slices, _ = flanks
    check_torque(gear_torque)
    check_modifications(flexible.assembly, modifications)
    if broken := too_few_slices(slices, vary_along_lead(modifications)):
        raise broken
    motion = pair_geometry(flexible.assembly, np.zeros(1)).motion
    line_load = gear_torque / motion.gear_normal_arm / flexible.width
    contact = 2.0 * float(half_width(flexible, motion.relative_curvature, line_load)[0])
    if contact > flexible.width:
        raise InputError(
            "operating.gear_torque",
            f"{gear_torque:g} N m",
            f"flattens the contact to {contact * 1e3:.2g} mm, wider than the face",
            "use a smaller load",
        )
    if slices * contact > flexible.width:
        raise InputError(
            "mesh.slices",
            slices,
            f"makes slices narrower than the contact at {gear_torque:g} N m, {contact * 1e3:.2g} mm",
            f"give at most {int(flexible.width / contact)}",
        )


def check_resolved(flanks: LoadedFlanks, shared: SharedLoad, gear_torque: float) -> None:
    """Refuse what leaves the heaviest pair on fewer slices than a distribution along the face needs."""
    slices = shared.slice_load.shape[-1]
    if slices < MINIMUM_SLICES or not vary_along_lead(flanks.modifications):
        return
    heaviest = np.argmax(shared.normal_load, axis=1)[:, None, None]
    touching = np.sum(np.take_along_axis(shared.slice_load, heaviest, axis=1)[:, 0] > 0.0, axis=-1)
    if np.any(touching < MINIMUM_SLICES):
        raise InputError(
            *maximum_along_lead(flanks.flexible.assembly, flanks.modifications),
            f"lifts the flanks off each other: at {gear_torque:g} N m only {int(np.min(touching))} "
            f"of {slices} slices carry the heaviest pair",
            "give less, or more torque; or more mesh.slices, to resolve so narrow a contact",
        )
