"""Jia et al., Mathematics 10(22):4290 (2022): limits of k1 and k2, contact ratios, Hertz pressure."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tribodyn.case import Case
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.parabolic import greatest_coefficient, published_limits
from tribodyn.geometry.path import kinematics
from tribodyn.scenario.load import family, load_scenario
from tribodyn.tribology.contact import hertz_pressure
from tribodyn.validation.rows import Row, compare, published

PAPER = "jia-2022"
NO_CONTACT_MODEL = "needs stresses of the load contact model over the face width, which are not in yet"


def drive_of(name: str) -> Case:
    """Return the case of one of the paper's two drives."""
    case = load_scenario(f"jia-{name}-17-29")
    assert isinstance(case, Case)
    return case


def contact_ratio(case: Case) -> float:
    """Transverse contact ratio of a case's drive."""
    return assemble(family(case.family), case.drive).contact_ratio


def pressure_at_pitch_point(case: Case) -> float:
    """Hertz pressure (Pa) of one pair at the pitch point under the whole torque."""
    path = family(case.family).working_path(case.drive)
    at = kinematics(path, 0.0)
    line_load = case.operating.gear_torque / float(at.gear_normal_arm) / case.drive.gear.face_width
    modulus = 2.0 / sum((1 - m.poisson_ratio**2) / m.youngs_modulus for m in case.materials)
    return float(hertz_pressure(line_load, float(at.relative_curvature), modulus))


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows of the paper; no run is needed, so that `folder` stays empty."""
    parabolic, involute = (drive_of(name) for name in ("parabolic", "involute"))
    pinion, gear = parabolic.drive.pinion.teeth, parabolic.drive.gear.teeth
    least, most_k1 = published_limits(gear)
    _, most_k2 = published_limits(pinion)
    actual = [greatest_coefficient(parabolic.drive, half) for half in (1, -1)]
    true = "by the geometry, with the mate's actual tip: below {:.3f}"
    pressure, ratio = pressure_at_pitch_point(involute), contact_ratio(involute)
    # Z_ε of ISO 6336-2 for spur gears, which takes off the part of the load that a second pair carries
    factor = math.sqrt((4.0 - ratio) / 3.0)
    values: dict[str, tuple[Any, str]] = {
        "jia/k1-max": (most_k1, true.format(actual[0])),
        "jia/k2-max": (most_k2, true.format(actual[1])),
        "jia/k-min": (least, "by the geometry there is no such limit: smaller k only steepens the path"),
        "jia/cr-novel": (contact_ratio(parabolic), ""),
        "jia/cr-involute": (ratio, ""),
        "jia/hertz-pitch": (factor * pressure, f"{pressure / 1e6:.2f} MPa without Z_eps = {factor:.4f}"),
    }
    if progress:
        progress(1.0)
    table = published(PAPER)
    return [compare(table[key], *values.get(key, (None, NO_CONTACT_MODEL))) for key in table]
