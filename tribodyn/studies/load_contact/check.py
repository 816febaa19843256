"""What `check` says of a load contact study."""

from tribodyn.studies.gears import checked, pitch_point_load
from tribodyn.studies.load_contact.case import LoadContactCase
from tribodyn.studies.load_contact.run import prepare, single_pair_stiffness
from tribodyn.studies.study import Checked


def check(case: LoadContactCase) -> Checked:
    """Check a case, and say what gears it describes and how stiff they are."""
    study = prepare(case)
    line_load = pitch_point_load(case, case.gear_torque) / study.flexible.width
    return checked(case, case, "finite elements", line_load, single_pair_stiffness(study))
