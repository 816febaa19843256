"""What `check` says of an efficiency study."""

from tribodyn.mesh.stiffness import single_pair_stiffness
from tribodyn.studies.efficiency.case import EfficiencyCase
from tribodyn.studies.efficiency.run import prepare
from tribodyn.studies.gears import checked, pitch_point_load
from tribodyn.studies.study import Checked


def check(case: EfficiencyCase) -> Checked:
    """Check a case, tabulate its mesh, and say what gears it describes and how stiff they are."""
    cycle = prepare(case).cycle
    load = pitch_point_load(case, case.operating.gear_torque)
    method = f'compliance = "{case.mesh.compliance}"'
    return checked(case, case, method, load / float(cycle.face_width), single_pair_stiffness(cycle, load))
