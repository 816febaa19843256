"""What `check` says of an assessment."""

from tribodyn.studies.assessment import parts
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.run import prepare
from tribodyn.studies.gears.oil import with_oil
from tribodyn.studies.gears.shared import sheet_tables
from tribodyn.studies.protocol.study import Checked


def check(case: AssessmentCase) -> Checked:
    """Check a case and what it asks of the other studies; say what gears and oil it describes."""
    from tribodyn.geometry.sheet.sheet import geometry_sheet

    sheet = geometry_sheet(prepare(case))
    asked = parts.asked_of(case)
    tasks = [task for part in parts.parts(asked) for task in part.tasks]
    for task in tasks:
        if task.needed:
            parts.case_of(task, {task.key: task.values[0]} if task.values else {})
    found = Checked({"geometry": sheet, "tasks": [task.name for task in tasks]}, sheet_tables(sheet))
    return with_oil(found, case.lubricant)
