"""What `check` says of a gear with rolling elements."""

from tribodyn.studies.gears.check import with_unit
from tribodyn.studies.protocol.study import CheckResult, TextTable
from tribodyn.studies.rolling.geometry import RollingDrive, element_radius_limits
from tribodyn.studies.rolling.run import prepare
from tribodyn.studies.rolling.scenario import RollingCase


def check(case: RollingCase) -> CheckResult:
    """Check a case, and say what gear it describes."""
    prepare(case)
    sheet = geometry_sheet(case.drive)
    rows = [("mode", case.mode), *((name, with_unit(*value)) for name, value in sheet.items())]
    table = TextTable("Gear with rolling elements", ("quantity", "value"), rows)
    return CheckResult({"mode": case.mode, "geometry": sheet}, (table,))


def geometry_sheet(drive: RollingDrive) -> dict[str, tuple[float | int, str]]:
    """Return figures by name, each a value and its unit, in the units of a drawing."""
    limits = {
        f"element radius at which {what}": (limit * 1e3, "mm")
        for what, limit in element_radius_limits(drive).items()
    }
    return {
        "rolling elements": (drive.elements, ""),
        "teeth of the cam": (drive.elements - 1, ""),
        "teeth of the crown": (drive.elements + 1, ""),
        "ratio of input to cam, which turns the other way": (drive.ratio, ""),
        "element radius": (drive.element_radius * 1e3, "mm"),
        "displacement coefficient": (drive.displacement, ""),
        "pitch radius of the cage": (drive.pitch_radius * 1e3, "mm"),
        "pitch radius of the cam": (drive.cam_pitch_radius * 1e3, "mm"),
        "pitch radius of the crown": (drive.crown_pitch_radius * 1e3, "mm"),
        "radius of the elements' centres": (drive.displacement * drive.pitch_radius * 1e3, "mm"),
        "eccentricity": (drive.eccentricity * 1e3, "mm"),
        **limits,
    }
