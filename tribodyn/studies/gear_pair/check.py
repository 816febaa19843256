"""What `check` says of a gear pair."""

from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.quasi_static import single_pair
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.gears.law_ranges import with_laws
from tribodyn.studies.gears.oil import with_oil
from tribodyn.studies.gears.shared import checked
from tribodyn.studies.protocol.study import Checked


def check(case: Case) -> Checked:
    """Check a case, tabulate its mesh, and say what gears and oil it describes, how stiff the gears are."""
    prepared = prepare(case)
    pair = single_pair(prepared.cycle, case.operating.gear_torque)
    method = f'compliance = "{case.mesh.compliance}"'
    remark = compliance_remark(prepared.assembly, case.materials, case.mesh)
    gears = checked(prepared.assembly, case.materials, method, *pair, prepared.masses, remark)
    return with_laws(with_oil(gears, prepared.lubricant), case, prepared.model.closure)
