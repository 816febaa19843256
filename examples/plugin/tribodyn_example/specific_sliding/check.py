"""What `tribodyn check` says of a case."""

from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.studies.gears import sheet_tables
from tribodyn.studies.study import Checked
from tribodyn_example.specific_sliding.scenario import SlidingCase
from tribodyn_example.specific_sliding.sliding import sliding_of


def check(case: SlidingCase) -> Checked:
    """Check a case, and say what gears it describes."""
    sheet = geometry_sheet(sliding_of(case).assembly)
    return Checked({"geometry": sheet}, sheet_tables(sheet))
