"""What `tribodyn check` says of a case."""

from tribodyn.gears.check import sheet_tables
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.studies.protocol.study import CheckResult
from tribodyn_example.specific_sliding.scenario import SlidingCase
from tribodyn_example.specific_sliding.sliding import sliding_of


def check(case: SlidingCase) -> CheckResult:
    """Check a case, and say what gears it describes."""
    sheet = geometry_sheet(sliding_of(case).assembly)
    return CheckResult({"geometry": sheet}, sheet_tables(sheet))
