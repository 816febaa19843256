"""An internal gear in a drive file: its keys, and its sheet against the outline and closed forms."""

import math
from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.tooth import flank_point, thickness_half_angle
from tribodyn.studies.drive_file import as_spline, load_drive

RING = {"teeth": 93, "internal": True, "face_width": "550 mm", "profile_shift": 0.1171, "cutter_teeth": 30}
DRIVE = {
    "family": "involute",
    "module": "21 mm",
    "pressure_angle": "20 deg",
    "roughness": "0.6 um",
    "material": "18CrNiMo7-6",
    "pinion": {"teeth": 36, "face_width": "550 mm", "profile_shift": 0.5039},
    "gear": RING,
}


def sheet_of(**gear: Any) -> tuple[Any, dict[str, Any]]:
    drive = load_drive(DRIVE | {"gear": RING | gear})
    assembly = check(family("involute"), drive.drive)
    return assembly, drive.sheet(assembly)


def test_keys_have_no_signs_and_the_sheet_those_of_the_standard():
    assembly, sheet = sheet_of(tip_diameter="1906.081 mm", outer_diameter="2.2 m", cutter_rounding=0.3)
    ring = assembly.drive.gear
    assert (ring.teeth, ring.cutter_teeth, ring.fillet_radius) == (-93, 30, 0.3)
    assert (ring.tip_radius, ring.bore_radius) == pytest.approx((-0.9530405, -1.1))
    assert sheet["centre distance"][0] == pytest.approx(-584.0, abs=1e-3)
    assert sheet["gear"]["root diameter"][0] == pytest.approx(-2000.581, abs=2e-3)
    assert sheet["gear"]["outer diameter"][0] == pytest.approx(-2200.0)
    assert "bore diameter" not in sheet["gear"]


def test_profile_shift_counts_on_the_tooth_or_on_the_gap():
    on_tooth, _ = sheet_of()
    on_gap, _ = sheet_of(profile_shift=-0.1171, profile_shift_of="gap")
    assert on_gap.drive == on_tooth.drive


def test_the_span_lies_over_gaps():
    """A gap's width on the base circle and the base pitches of the others: by the half thickness angle."""
    assembly, sheet = sheet_of()
    tooth, radius = assembly.gear, -0.96
    gap = math.pi / 93 + float(thickness_half_angle(tooth, radius))  # half, at the radius
    angle = math.acos(93 * 10.5e-3 * math.cos(math.radians(20)) / -radius)
    base = 93 * 10.5e-3 * math.cos(math.radians(20))
    width = 2 * base * (gap + math.tan(angle) - angle)
    count = sheet["gear"]["gaps of the span"][0]
    expected = width + (count - 1) * 2 * math.pi * base / 93
    assert sheet["gear"]["span over gaps"][0] == pytest.approx(1e3 * expected, rel=1e-9)


def test_pins_touch_both_flanks_of_a_gap():
    """93 is odd: opposite gaps are half a pitch off. A pin's surface is nearest to the flank by nothing."""
    assembly, sheet = sheet_of()
    ring = sheet["gear"]
    pin, between = (1e-3 * ring[name][0] for name in ("pin diameter", "dimension between pins"))
    centre = (between + pin) / 2 / math.cos(math.pi / 186)
    tooth = assembly.gear
    x, y = flank_point(tooth, np.linspace(tooth.form_distance, tooth.tip_distance, 200_001))
    away = np.hypot(
        -x - centre * math.cos(math.pi / 93), y - centre * math.sin(math.pi / 93)
    )  # the gap's axis lies half a pitch beside the tooth's
    assert away.min() == pytest.approx(pin / 2, abs=1e-9)


@pytest.mark.parametrize(("key", "gaps"), [("span", True), ("over_pins", False)])
def test_measured_thickness_gives_the_allowance_back(key: str, gaps: bool):
    _, sheet = sheet_of(thickness_allowance="-200 um")
    ring = sheet["gear"]
    if gaps:
        given = {"span": ring["span over gaps"][0], "span_teeth": int(ring["gaps of the span"][0])}
        given = given | {"span": f"{given['span']:.9f} mm"}
    else:
        names = {"over_pins": "dimension between pins", "pin_diameter": "pin diameter"}
        given = {name: f"{ring[line][0]:.9f} mm" for name, line in names.items()}
    assembly, _ = sheet_of(**given)
    assert assembly.drive.gear.thickness_allowance == pytest.approx(-200e-6, abs=1e-11)


@pytest.mark.parametrize(
    ("side", "keys", "key", "says"),
    [
        ("pinion", {"internal": True}, "drive.pinion.internal", "make one of them external"),
        ("pinion", {"cutter_teeth": 20}, "drive.pinion.cutter_teeth", "add internal = true"),
        ("gear", {"bore_diameter": "1 m"}, "drive.gear.bore_diameter", "outer_diameter"),
        (
            "drive",
            {"helix_angle": "10 deg", "hand": "left", "gear": DRIVE["gear"] | {"hand": "right"}},
            "drive.gear.hand",
            'an internal gear has the hand of its mate; write "left"',
        ),
    ],
)
def test_what_contradicts(side: str, keys: dict[str, Any], key: str, says: str):
    table = DRIVE | (keys if side == "drive" else {side: DRIVE[side] | keys})
    with pytest.raises(InputError) as refused:
        load_drive(table)
    errors = getattr(refused.value, "errors", [refused.value])
    found = [error for error in errors if error.key == key]
    assert found
    assert says in str(found[0])


def test_no_free_form_path_is_fitted_to_a_ring():
    with pytest.raises(InputError, match="no free-form path"):
        as_spline(load_drive(DRIVE), 9)
