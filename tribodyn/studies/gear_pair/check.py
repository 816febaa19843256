"""What `check` says of a gear pair."""

from tribodyn.mesh.stiffness import single_pair_stiffness
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.gears import checked, pitch_point_load
from tribodyn.studies.study import Checked


def check(case: Case) -> Checked:
    """Check a case, tabulate its mesh, and say what gears it describes and how stiff they are."""
    prepared = prepare(case)
    load = pitch_point_load(case, case.operating.gear_torque)
    stiffness = single_pair_stiffness(prepared.cycle, load)
    method = f'compliance = "{case.mesh.compliance}"'
    width = float(prepared.cycle.face_width)
    return checked(case, case, method, load / width, stiffness, prepared.masses)
