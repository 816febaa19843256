"""What `check` says of a load contact study."""

import math

from tribodyn.studies.gears.shared import checked
from tribodyn.studies.load_contact.case import LoadContactCase
from tribodyn.studies.load_contact.run import prepare, single_pair_stiffness
from tribodyn.studies.protocol.study import Checked


def check(case: LoadContactCase) -> Checked:
    """Check a case, and say what gears it describes and how stiff they are."""
    study = prepare(case)
    assembly = study.flexible.assembly
    arm = float(assembly.path.gear_pitch_radius) * math.cos(float(assembly.path.pressure_angle(0.0)))
    load = case.gear_torque / arm
    return checked(assembly, case.materials, "finite elements", load, single_pair_stiffness(study))
