"""The geometry sheet against the closed forms of the involute and of solid bodies."""

import numpy as np
import pytest

from tests.support.sample_drives import LIU_NI, SHIFTED, STANDARD, UNDERCUT
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import SIDES, body_of, reference_radius, tip_radius
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.sheet import geometry_sheet


@pytest.mark.parametrize("drive", [STANDARD, SHIFTED])
def test_specific_sliding_of_the_involute(drive):
    """ζ = 1 − ρ_mate/(u ρ) at the ends of contact, from tip and base circles alone (ISO 21771)."""
    sheet = geometry_sheet(assemble(involute.FAMILY, drive))
    working = involute.working_pressure_angle(drive)
    base = [reference_radius(drive, side) * np.cos(drive.pressure_angle) for side in SIDES]
    length = sum(base) * np.tan(working)
    outer = [np.sqrt(tip_radius(drive, side) ** 2 - r**2) for side, r in zip(SIDES, base, strict=True)]
    ratio = base[1] / base[0]
    # radii of curvature (pinion, gear) where the gear's tip and where the pinion's tip touches
    (start_pinion, start_gear), (end_pinion, end_gear) = (
        (length - outer[1], outer[1]),
        (outer[0], length - outer[0]),
    )
    pinion, gear = sheet["pinion"], sheet["gear"]
    assert pinion["minimum specific sliding"][0] == pytest.approx(1 - start_gear / (ratio * start_pinion))
    assert pinion["maximum specific sliding"][0] == pytest.approx(1 - end_gear / (ratio * end_pinion))
    assert gear["minimum specific sliding"][0] == pytest.approx(1 - ratio * end_pinion / end_gear)
    assert gear["maximum specific sliding"][0] == pytest.approx(1 - ratio * start_pinion / start_gear)
    # sliding over the pinion's speed: distance from the pitch point times 1 + 1/u
    curved = {"start": (start_pinion, start_gear), "end": (end_pinion, end_gear)}
    for name, place in (("approach", "start"), ("recess", "end")):
        own, mate = curved[place]
        assert sheet[f"equivalent radius at {place} of contact"][0] == pytest.approx(
            1e3 * own * mate / length
        )
        assert sheet[f"pressure angle at {place} of contact"][0] == pytest.approx(np.degrees(working))
        distance = abs(sheet[f"{place} of contact from pitch point"][0])
        sliding = sheet[f"maximum sliding in {name}"]
        assert sliding == (pytest.approx(distance * (1 + 1 / ratio)), "mm/rad")


@pytest.mark.parametrize("drive", [STANDARD, SHIFTED])
def test_circles_and_thicknesses_of_the_involute(drive):
    """Half the thickness angle at any diameter: (π/2 + 2 x tan α)/z + inv α − inv α_y (ISO 21771)."""
    sheet = geometry_sheet(assemble(involute.FAMILY, drive))
    alpha, module = drive.pressure_angle, 1e3 * drive.module
    working = involute.working_pressure_angle(drive)
    teeth = drive.pinion.teeth + drive.gear.teeth
    distance = module * teeth / 2 * np.cos(alpha) / np.cos(working)
    assert sheet["centre distance"][0] == pytest.approx(distance)
    assert sheet["gear ratio"][0] == pytest.approx(drive.gear.teeth / drive.pinion.teeth)
    assert sheet["operating pressure angle"] == (pytest.approx(np.degrees(working)), "°")
    tips = [2e3 * tip_radius(drive, side) for side in SIDES]
    pitch = np.pi * module * np.cos(alpha)
    parts = (
        (f"{way} contact ratio", f"{end} of contact")
        for way, end in (("approach", "start"), ("recess", "end"))
    )
    for ratio, end in parts:
        assert sheet[ratio][0] == pytest.approx(abs(sheet[f"{end} from pitch point"][0]) / pitch)
    for side, tip, mate_tip in zip(SIDES, tips, tips[::-1], strict=True):
        body, found = body_of(drive, side), {name: value for name, (value, _) in sheet[side].items()}
        base = module * body.teeth * np.cos(alpha)
        mate_base = 2 * distance * np.cos(working) - base
        first = 2 * distance * np.sin(working) - np.sqrt(mate_tip**2 - mate_base**2)

        def thickness(diameter, body=body, base=base):
            at = np.arccos(base / diameter)
            opened = np.tan(alpha) - alpha - np.tan(at) + at
            return (np.pi / 2 + 2 * body.profile_shift * np.tan(alpha)) / body.teeth + opened

        pitch = base / np.cos(working)
        wanted = {
            "teeth": body.teeth,
            "profile shift": body.profile_shift,
            "reference diameter": module * body.teeth,
            "working pitch diameter": pitch,
            "tip diameter": tip,
            "lowest contact diameter": np.hypot(base, first),
            "active flank above form circle": (np.hypot(base, first) - found["form diameter"]) / 2,
            "root diameter": module * (body.teeth + 2 * body.profile_shift - 2 * body.dedendum),
            "bore diameter": 2e3 * body.bore_radius,
            "face width": 1e3 * body.face_width,
            "tooth thickness on working pitch circle": pitch * thickness(pitch),
            "tip thickness": tip * np.sin(thickness(tip)),
        }
        assert {name: found[name] for name in wanted} == pytest.approx(wanted)


@pytest.mark.parametrize("side", SIDES)
def test_undercut_margin_of_the_involute(side):
    """On the line of action, from the end of the rack's flank to the point of tangency of the base circle."""
    sheet = geometry_sheet(assemble(involute.FAMILY, STANDARD))[side]
    body, alpha = body_of(STANDARD, side), STANDARD.pressure_angle
    depth = body.dedendum - body.fillet_radius * (1 - np.sin(alpha))
    margin = STANDARD.module * (body.teeth / 2 * np.sin(alpha) - depth / np.sin(alpha))
    assert sheet["undercut margin"] == (pytest.approx(1e3 * margin), "mm")
    assert sheet["base diameter"][0] == pytest.approx(
        1e3 * STANDARD.module * body.teeth * np.cos(alpha), rel=1e-12
    )


def test_undercut_is_a_negative_margin():
    pinion = geometry_sheet(assemble(involute.FAMILY, UNDERCUT))["pinion"]
    assert pinion["undercut margin"][0] < 0
    assert pinion["undercut by the rack"][0] == 1


def test_masses_stand_in_the_sheet_when_they_are_known():
    bare = geometry_sheet(assemble(crc.FAMILY, LIU_NI))
    full = geometry_sheet(assemble(crc.FAMILY, LIU_NI), [(1.5, 2e-3), (3.0, 4e-3)])
    assert not {"mass", "base diameter"} & set(bare["pinion"])  # its path is curved
    assert full["gear"]["mass"] == (3.0, "kg")
    assert full["gear"]["moment of inertia"] == (pytest.approx(4000.0), "kg mm²")
