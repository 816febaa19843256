"""What the study computes: speeds of the contact along both flanks, and specific sliding."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.path import kinematics
from tribodyn_example.specific_sliding.scenario import SlidingCase


class Sliding(NamedTuple):
    """Along the path of contact, (positions,); SI units.

    Attributes
    ----------
    assembly : Assembly
    signed_distance : r, m
    sliding_speed : v_s = u_p − u_g, m/s
    pinion, gear : specific sliding (u_p − u_g)/u_p and (u_g − u_p)/u_g
    """

    assembly: Assembly
    signed_distance: Any
    sliding_speed: Any
    pinion: Any
    gear: Any


def sliding_of(case: SlidingCase) -> Sliding:
    """Work out the sliding of a case; InputError where its gears cannot be made or cannot run."""
    assembly = check(family(case.family), case.drive)
    r = np.linspace(assembly.r_start, assembly.r_end, case.positions)
    motion = kinematics(assembly.path, r)
    u_p, u_g = motion.pinion_speed, motion.gear_speed  # per rad/s of the pinion
    return Sliding(assembly, r, case.pinion_speed * (u_p - u_g), 1.0 - u_g / u_p, 1.0 - u_p / u_g)


def summary_of(sliding: Sliding) -> dict[str, Any]:
    """Quantities of the summary; specific sliding is most negative where a flank is near its root."""
    return {
        "contact_ratio": sliding.assembly.contact_ratio,
        "pinion_specific_sliding_min": float(np.min(sliding.pinion)),
        "gear_specific_sliding_min": float(np.min(sliding.gear)),
        "sliding_speed_max": float(np.max(np.abs(sliding.sliding_speed))),
    }
