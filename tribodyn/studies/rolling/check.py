"""What `check` says of a gear with rolling elements."""

from tribodyn.studies.gears.shared import with_unit
from tribodyn.studies.protocol.study import Checked, TextTable
from tribodyn.studies.rolling.case import RollingCase
from tribodyn.studies.rolling.run import prepare
from tribodyn.studies.rolling.sheet import geometry_sheet


def check(case: RollingCase) -> Checked:
    """Check a case, and say what gear it describes."""
    prepare(case)
    sheet = geometry_sheet(case.drive)
    rows = [("mode", case.mode), *((name, with_unit(*value)) for name, value in sheet.items())]
    table = TextTable("Gear with rolling elements", ("quantity", "value"), rows)
    return Checked({"mode": case.mode, "geometry": sheet}, (table,))
