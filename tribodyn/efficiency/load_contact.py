"""Efficiency of a pair by the load contact model: load sharing with friction, corner contact included.

The proposed approach of A. Diez-Ibarbia et al., section 2.2: constant friction coefficient, slow rotation.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.load_sharing import (
    PairFlexibility,
    effective_contact_ratio,
    extended_rolls,
    share_load,
)
from tribodyn.errors import InputError
from tribodyn.geometry.corner_contact import pair_geometry, roll_at_gap

Array = Any

#: Positions over one pitch: the efficiency is then known to 1e-6 (test_load_contact_efficiency).
POSITIONS = 240
# Corners are followed to this many mean deflections on the pitch circle; two is enough for any load sharing.
_REACH = 2.5


class LoadContact(NamedTuple):
    """One mesh cycle of a pair in slow rotation.

    Attributes
    ----------
    efficiency : float
        Work put out over work put in.
    contact_ratio : float
        Effective contact ratio: pinion angle over which a pair carries load, over the pitch.
    roll, normal_load : (position, pair)
        Pinion angle of each pair from the pitch point, rad, and its load, N.
    loss : (position, pair)
        Friction work per pinion angle, N m/rad.
    """

    efficiency: float
    contact_ratio: float
    roll: Array
    normal_load: Array
    loss: Array


def load_contact(
    flexible: PairFlexibility, gear_torque: float, friction_coefficient: float, positions: int = POSITIONS
) -> LoadContact:
    """Run a pair through one mesh cycle.

    Parameters
    ----------
    flexible : PairFlexibility
        `load_sharing.flexibility` of the drive.
    gear_torque : float
        T_g > 0, N m, constant.
    friction_coefficient : float
        μ, the same for all pairs.
    positions : int
        Equal steps over one pitch.

    Raises
    ------
    InputError
        If the torque drives nothing.
    """
    if gear_torque <= 0:
        raise InputError("gear_torque", gear_torque, "must drive the gear", "use more than 0 N m")
    assembly = flexible.assembly
    ratio = assembly.path.pinion_pitch_radius / assembly.path.gear_pitch_radius
    single = share_load(flexible, np.zeros((1, 1)), gear_torque)
    limits = roll_at_gap(assembly, _REACH * float(single.deflection[0]))
    roll = extended_rolls(assembly, limits, positions)
    shared = share_load(flexible, roll, gear_torque, friction_coefficient)
    sliding = np.abs(pair_geometry(assembly, roll).motion.sliding)
    loss = friction_coefficient * shared.normal_load * sliding
    put_out = gear_torque * ratio
    return LoadContact(
        efficiency=float(put_out / (put_out + np.mean(np.sum(loss, axis=1)))),
        contact_ratio=effective_contact_ratio(roll, shared, 2.0 * np.pi / assembly.drive.pinion.teeth),
        roll=roll,
        normal_load=shared.normal_load,
        loss=loss,
    )
