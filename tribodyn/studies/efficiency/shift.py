"""Profile shift at constant centre distance, x2 = −x1, in three ways of choosing the tip circles.

The studies of A. Diez-Ibarbia et al., efficiency of spur gears with a shifting profile, section 3.
"""

import math
from typing import Literal

from tribodyn.geometry.drive import Drive, tip_radius
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.numerics.elementary import cos, sin, sqrt
from tribodyn.studies.efficiency.loss_factor import tip_contact_ratios

Scenario = Literal["S1", "S2", "S3"]
SCENARIOS: dict[Scenario, str] = {
    "S1": "tip circles as without shift",
    "S2": "contact ratio as without shift: the pinion's tip follows its shift, the gear's keeps the ratio",
    "S3": "both tips follow the shift",
}


def shifted(drive: Drive, scenario: Scenario, shift: float) -> Drive:
    """Shift the pinion of an involute pair without shift by x1 = `shift` and the gear by −x1.

    S1 keeps the tip radii; S2 has R_1 = m (z1/2 + x1 + h_a*), ε2 = ε_α − ε1 and R_2 from ε2 (Diez-Ibarbia
    (16)-(19)); S3 has R_i = m (z_i/2 + x_i + h_a*).
    """
    pinion, gear = (
        drive.pinion._replace(profile_shift=shift, tip_radius=None),
        drive.gear._replace(profile_shift=-shift, tip_radius=None),
    )
    both = drive._replace(pinion=pinion, gear=gear)
    if scenario == "S3":
        return both
    if scenario == "S1":
        radii = tip_radius(drive, "pinion"), tip_radius(drive, "gear")
        return both._replace(
            pinion=pinion._replace(tip_radius=radii[0]), gear=gear._replace(tip_radius=radii[1])
        )
    kept = sum(tip_contact_ratios(FAMILY, drive)) - tip_contact_ratios(FAMILY, both)[0]
    path = FAMILY.working_path(both)
    angle = path.pressure_angle(0.0)
    radius = path.gear_pitch_radius
    base_pitch = 2.0 * math.pi * path.pinion_pitch_radius * cos(angle) / pinion.teeth
    outer = sqrt((radius * sin(angle) + kept * base_pitch) ** 2 + (radius * cos(angle)) ** 2)
    return both._replace(gear=gear._replace(tip_radius=outer))
