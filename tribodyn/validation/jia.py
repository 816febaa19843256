"""Jia et al., Mathematics 10(22):4290 (2022): limits of k1 and k2, contact ratios, stresses as ratios."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.families.parabolic import maximum_coefficient, published_limits
from tribodyn.geometry.path import kinematics
from tribodyn.studies.gear_pair.case import Case
from tribodyn.tribology.contact import hertz_pressure
from tribodyn.validation.jia_study import (
    CROWNED,
    FaceState,
    Name,
    case_of,
    maximum_line_load,
    maximum_pressure,
    maximum_root_stress,
)
from tribodyn.validation.rows import Row, compare, published

PAPER = "jia-2022"
#: Reliefs y1 = y2 (µm) and unmodified lengths y3 (mm) of Table 3.
RELIEFS = [(relief, unmodified) for unmodified in (0, 8) for relief in (4, 8, 12)]
# Pairs closer to the pitch point, degrees, are left out where pressures of the two families are compared.
_NEAR = 2.0
_PRESSURES = "Hertz pressures"


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
    """All rows of the paper; no run is recorded, so that `folder` stays empty."""
    values = geometry()
    parts = (
        lambda: _misaligned("involute", "unmodified", FaceState()),
        lambda: _misaligned("involute", "crowned", CROWNED),
        lambda: _misaligned("parabolic", "unmodified", FaceState()),
        lambda: _misaligned("parabolic", "crowned", CROWNED),
        lambda: _relieved() | _families(),
    )
    for done, part in enumerate(parts, start=1):
        values |= part()
        if progress:
            progress(done / len(parts))
    table = published(PAPER)
    return [compare(table[key], *values[key]) for key in table]


def geometry() -> dict[str, tuple[Any, ...]]:
    """Rows of limits of the geometry, contact ratios and the pressure at the pitch point: value and note."""
    parabolic, involute = case_of("parabolic"), case_of("involute")
    pinion, gear = parabolic.drive.pinion.teeth, parabolic.drive.gear.teeth
    lowest, highest_k1 = published_limits(gear)
    _, most_k2 = published_limits(pinion)
    actual = [maximum_coefficient(parabolic.drive, half) for half in (1, -1)]
    true = "by the geometry, with the mate's actual tip: below {:.3f}"
    pressure, ratio = pressure_at_pitch_point(involute), contact_ratio(involute)
    # Z_ε of ISO 6336-2 for spur gears, which takes off the part of the load that a second pair carries
    factor = math.sqrt((4.0 - ratio) / 3.0)
    return {
        "jia/k1-max": (highest_k1, true.format(actual[0]), ("actual tip", actual[0])),
        "jia/k2-max": (most_k2, true.format(actual[1]), ("actual tip", actual[1])),
        "jia/k-min": (
            lowest,
            "by the geometry there is no such limit: smaller k only steepens the path",
            ("actual tip, no limit", None),
        ),
        "jia/cr-novel": (contact_ratio(parabolic), ""),
        "jia/cr-involute": (ratio, ""),
        "jia/hertz-pitch": (
            factor * pressure,
            f"{pressure / 1e6:.2f} MPa without Z_eps = {factor:.4f}",
            ("without Z_eps", pressure),
        ),
    }


def _misaligned(name: Name, sort: str, base: FaceState) -> dict[str, tuple[Any, ...]]:
    """Rows of Tables 4 and 5: over their own value without misalignment."""
    return {
        f"jia/misaligned-{name}-{sort}-{minutes}": _ratio(
            name, base._replace(misalignment=float(minutes)), base, apart=minutes == 3
        )
        for minutes in (1, 2, 3)
    }


def _relieved() -> dict[str, tuple[Any, ...]]:
    """Rows of Table 3: over the unmodified."""
    return {
        f"jia/crown-{relief}-{relief}-{unmodified}": _ratio(
            "parabolic", FaceState(float(relief), float(unmodified)), FaceState(), apart=relief == 8
        )
        for relief, unmodified in RELIEFS
    }


def _ratio(
    name: Name, state: FaceState, base: FaceState, apart: bool
) -> tuple[float, str, tuple[str, float]]:
    """Ratio of the maximum line loads; the note has where, and the ratios of other readings."""
    maximum = maximum_line_load(name, state)
    pressures = maximum_pressure(name, state).value / maximum_pressure(name, base).value
    note = (
        f"ratio of maximum line loads over mesh cycle and face, {maximum.value / 1e3:.0f} N/mm at "
        f"{maximum.roll:+.1f} deg from the pitch point, {maximum.place:+.0f} mm from the middle; "
        f"of maximum Hertz pressures {pressures:.4f}"
    )
    if apart:
        free = [maximum_line_load(name, given._replace(coupled=False)).value for given in (state, base)]
        note += f"; of line loads on slices that do not hold each other {free[0] / free[1]:.4f}"
    return maximum.value / maximum_line_load(name, base).value, note, (_PRESSURES, pressures)


def _families() -> dict[str, tuple[Any, ...]]:
    """Rows of Table 2: parabolic over involute, neither modified nor misaligned."""
    ours, theirs = (maximum_line_load(name).value for name in ("parabolic", "involute"))
    pressure = [maximum_pressure(name).value for name in ("parabolic", "involute")]
    away = [maximum_pressure(name, away=_NEAR).value for name in ("parabolic", "involute")]
    compared: dict[str, tuple[Any, ...]] = {
        "jia/ratio-contact": (
            ours / theirs,
            f"ratio of maximum line loads, {ours / 1e3:.0f} and {theirs / 1e3:.0f} N/mm. Hertz pressure "
            f"does not fall: {pressure[0] / 1e6:.0f} and {pressure[1] / 1e6:.0f} MPa at most, "
            f"{away[0] / 1e6:.0f} and {away[1] / 1e6:.0f} MPa more than {_NEAR:g} deg from the pitch point, "
            "where the parabolic flanks' radius goes to zero",
            (_PRESSURES, pressure[0] / pressure[1]),
        )
    }
    for key, tension in (("compression", False), ("tension", True)):
        parabolic, involute = (maximum_root_stress(name, tension) for name in ("parabolic", "involute"))
        compared[f"jia/ratio-{key}"] = (
            max(parabolic) / max(involute),
            "maximum root stress of pinion, gear: "
            f"parabolic {parabolic[0] / 1e6:.0f}, {parabolic[1] / 1e6:.0f} MPa, "
            f"involute {involute[0] / 1e6:.0f}, {involute[1] / 1e6:.0f} MPa",
        )
    return compared
