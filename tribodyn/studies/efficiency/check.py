"""What `check` says of an efficiency study."""

from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.quasi_static import single_pair
from tribodyn.studies.efficiency.case import EfficiencyCase
from tribodyn.studies.efficiency.run import prepare
from tribodyn.studies.gears.law_ranges import with_laws
from tribodyn.studies.gears.oil import with_oil
from tribodyn.studies.gears.shared import checked
from tribodyn.studies.protocol.study import Checked


def check(case: EfficiencyCase) -> Checked:
    """Check a case, tabulate its mesh, and say what gears and oil it describes, how stiff the gears are."""
    study = prepare(case)
    pair = single_pair(study.cycle, case.operating.gear_torque)
    method = f'compliance = "{case.mesh.compliance}"'
    remark = compliance_remark(study.assembly, case.materials, case.mesh)
    gears = checked(study.assembly, case.materials, method, *pair, remark=remark)
    return with_laws(with_oil(gears, study.lubricant), case, study.duty.closure)
