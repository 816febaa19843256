"""What a drawing of the gear with rolling elements says."""

from tribodyn.studies.rolling.checks import element_radius_limits
from tribodyn.studies.rolling.geometry import RollingDrive


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
