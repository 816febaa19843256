"""What `check` says of a study of the solved contact."""

from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.quasi_static import single_pair
from tribodyn.studies.ehl.along_path import prepare
from tribodyn.studies.ehl.case import EhlCase
from tribodyn.studies.gears.oil import with_oil
from tribodyn.studies.gears.shared import checked
from tribodyn.studies.protocol.study import Checked


def check(case: EhlCase) -> Checked:
    """Check a case, tabulate its mesh, and say what gears and oil it describes, how stiff the gears are."""
    study = prepare(case)
    pair = single_pair(study.cycle, case.operating.gear_torque)
    method = f'compliance = "{case.mesh.compliance}"'
    remark = compliance_remark(study.assembly, case.materials, case.mesh)
    return with_oil(checked(study.assembly, case.materials, method, *pair, remark=remark), case.lubricant)
