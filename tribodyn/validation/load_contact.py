"""Efficiency of a pair by the load contact model: load sharing with friction, corner contact included.

The proposed approach of A. Diez-Ibarbia et al., section 2.2: constant friction coefficient, slow rotation.
"""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, effective_contact_ratio, extended_rolls
from tribodyn.compliance.sharing.loaded_contact import reach
from tribodyn.compliance.sharing.loaded_rules import check_contact
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.geometry.flanks.corner_contact import pair_geometry
from tribodyn.geometry.flanks.modification import UNMODIFIED, Modifications, back_flanks, uneven_teeth
from tribodyn.mesh.power_flow import efficiency
from tribodyn.numerics.shapes import Array, Float

#: Positions over one pitch: the efficiency is then known to 1e-6 (test_load_contact_efficiency).
POSITIONS = 240
# Corners are followed to this many deflections of a single pair; two is enough for any load sharing.
_REACH = 2.5


class LoadContact(NamedTuple):
    """One mesh cycle of a pair in slow rotation."""

    efficiency: float  # as `mesh.power_flow` defines it
    #: effective contact ratio: pinion angle over which a pair carries load, over the pitch
    contact_ratio: float
    #: roll, normal_load: (position, pair), pinion angle of each pair from the pitch point, rad, and its load,
    #: N
    roll: Float[Array, "position pair"]
    normal_load: Float[Array, "position pair"]
    loss: Float[Array, "position pair"]  # (position, pair), friction work per pinion angle, N m/rad


def load_contact(
    flexible: PairFlexibility,
    gear_torque: float,
    friction_coefficient: float,
    positions: int = POSITIONS,
    modifications: Modifications = UNMODIFIED,
    slices: int = 1,
    coupled: bool = True,
) -> LoadContact:
    """Run a pair through one mesh cycle.

    Raises InputError if the torque drives nothing, or as `roll_through` does.

    Parameters
    ----------
    flexible : `load_sharing.flexibility` of the drive
    gear_torque : T_g, N m, constant; < 0 where the gear drives, on back flanks
    friction_coefficient : μ, the same for all pairs
    positions : equal steps over one pitch
    modifications, slices, coupled
        As for `loaded_contact.roll_through`, without pitch errors.
    """
    for broken in uneven_teeth(modifications):
        raise broken
    assembly = flexible.assembly
    torque, way = abs(gear_torque), math.copysign(1.0, gear_torque)
    if way < 0.0:
        modifications = back_flanks(modifications, float(assembly.path.pressure_angle(0.0)))
    flanks = LoadedFlanks(flexible, modifications, slices, coupled)
    check_contact(flanks, torque)
    ratio = assembly.path.pinion_pitch_radius / assembly.path.gear_pitch_radius
    limits = reach(flanks, torque, _REACH)
    roll = extended_rolls(assembly, limits, positions)
    shared = flanks.share(roll, torque, way * friction_coefficient)
    sliding = np.abs(pair_geometry(assembly, roll).motion.sliding)
    loss = friction_coefficient * shared.normal_load * sliding
    gear, lost = gear_torque * ratio, float(np.mean(np.sum(loss, axis=1)))
    return LoadContact(
        efficiency=float(efficiency(gear + lost, gear, lost)),
        contact_ratio=effective_contact_ratio(roll, shared, 2.0 * np.pi / assembly.drive.pinion.teeth),
        roll=roll,
        normal_load=shared.normal_load,
        loss=loss,
    )
