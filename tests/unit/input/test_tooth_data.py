"""Teeth as a drawing gives them: what is the same, and what contradicts."""

import math

import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.studies.drive_file import load_drive
from tribodyn.studies.protocol.load import load

PAIR = {
    "family": "involute",
    "module": "3 mm",
    "rack": "ISO 53 A",
    "centre_distance": "129.0 mm",
    "mean_roughness": "0.8 um",
    "material": "steel-liu-ni-2022",
    "pinion": {"teeth": 25, "face_width": "30 mm", "profile_shift": 0.2},
    "gear": {"teeth": 60, "face_width": "28 mm", "profile_shift": 0.1},
}


def drive(**changes):
    return load_drive(PAIR, {f"drive.{key.replace('__', '.')}": value for key, value in changes.items()})


def refused(**changes):
    with pytest.raises(InputError) as error:
        drive(**changes)
    return str(error.value)


def test_the_pair_of_a_data_sheet_needs_few_keys():
    pair = drive().drive
    assert pair.pressure_angle == math.radians(20)
    assert (pair.gear.dedendum, pair.gear.fillet_radius) == (1.25, 0.38)
    assert pair.pinion.bore_radius == pytest.approx(0.2 * 75e-3)
    check(family("involute"), pair)


def test_what_the_sheet_prints_is_taken_back():
    thin = load_drive(PAIR, {"drive.pinion.thickness_allowance": "-60 um"})
    sheet = thin.sheet(check(family("involute"), thin.drive))["pinion"]
    for keys in (
        {"span": "span", "span_teeth": "teeth of the span"},
        {"over_pins": "dimension over pins", "pin_diameter": "pin diameter"},
    ):
        given = {
            f"drive.pinion.{key}": int(sheet[name][0]) if key == "span_teeth" else f"{sheet[name][0]!r} mm"
            for key, name in keys.items()
        }
        again = load_drive(PAIR, given).drive
        assert again.pinion.thickness_allowance == pytest.approx(-60e-6, rel=1e-6)


def test_diameters_are_twice_the_radii():
    pair = load_drive(PAIR, {"drive.gear.bore_radius": "20 mm", "drive.gear.tip_radius": "93 mm"}).drive
    other = load_drive(PAIR, {"drive.gear.bore_diameter": "40 mm", "drive.gear.tip_diameter": "186 mm"}).drive
    assert pair == other


def test_the_middle_of_the_tolerance_is_taken():
    given = {"drive.gear.thickness_allowance": "-60 um", "drive.gear.thickness_tolerance": "40 um"}
    assert load_drive(PAIR, given).drive.gear.thickness_allowance == pytest.approx(-80e-6)


def test_limits_of_a_published_stage():
    """Helical stage 24/95 of a design report (KISSsoft 2017): cd25 by DIN 3967, a js6; printed digits, mm."""
    given = {"drive.centre_distance_grade": 6}
    for side, teeth, ball in (("pinion", 4, 28), ("gear", 13, 25)):
        given |= {f"drive.{side}.thickness_code": "cd25", f"drive.{side}.span_teeth": teeth}
        given[f"drive.{side}.pin_diameter"] = f"{ball} mm"
    model = load_drive("helical-24-95", given)
    sheet = model.sheet(check(family("involute"), model.drive))
    assert sheet["allowance of the centre distance, ±"][0] == pytest.approx(0.028)
    printed = {
        "pair": {"circumferential backlash": (0.359, 0.571)},
        "pinion": {"span": (153.989, 154.045), "dimension over balls": (396.921, 397.035)},
        "gear": {"span": (542.171, 542.264), "dimension over balls": (1403.756, 1403.997)},
    }
    for part, dimensions in printed.items():
        lines = sheet if part == "pair" else sheet[part]
        for name, limits in dimensions.items():
            found = [lines[f"{name}, {end}"][0] for end in ("least", "most")]
            assert found == pytest.approx(limits, abs=7e-4)
    assert sheet["pinion"]["deviation of tooth thickness"][0] == pytest.approx(-0.160)


def test_limits_of_an_internal_pair_and_of_another_family():
    """Backlash of a ring grows as the axes come together; teeth without a centre distance have thickness."""
    for name, changes, moved in (
        ("ring-36-93", {"drive.centre_distance_grade": 8}, True),
        ("liu-ni-crc-23-47", {"drive.gear.thickness_code": "d24"}, False),
    ):
        model = load_drive(name, changes)
        sheet = model.sheet(check(family(model.family), model.drive))
        least, middle, most = (
            sheet[f"circumferential backlash{end}"][0] for end in (", least", "", ", most")
        )
        # 2 tan α_w per allowance of the distance; T_sn 30 µm of d24 at 141 mm
        angle = math.radians(sheet["operating pressure angle"][0]) if moved else 0.0
        whole = 4 * math.tan(angle) * sheet["allowance of the centre distance, ±"][0] if moved else 0.03
        assert most - least == pytest.approx(whole, rel=2e-2)
        assert (most + least) / 2 == pytest.approx(middle, abs=2e-3)
    with pytest.raises(InputError, match="mesh at one distance only"):
        load_drive("liu-ni-crc-23-47", {"drive.centre_distance_grade": 7})


def test_a_rounded_tip_ends_the_contact_but_keeps_the_clearance():
    sharp = geometry_sheet(check(family("involute"), drive().drive))
    rounded = load_drive(PAIR, {"drive.pinion.tip_rounding": "0.3 mm"}).drive
    sheet = geometry_sheet(check(family("involute"), rounded))
    profile = math.acos(75 * math.cos(math.radians(20)) / sharp["pinion"]["tip diameter"][0])
    lost = 2 * 0.3 * (1 - math.sin(profile))
    assert sheet["pinion"]["tip form diameter"][0] == pytest.approx(
        sharp["pinion"]["tip diameter"][0] - lost, rel=1e-9
    )
    assert sheet["pinion"]["tip clearance"] == sharp["pinion"]["tip clearance"]
    assert sheet["contact ratio"][0] < sharp["contact ratio"][0]


def test_rounded_edges_that_meet_are_refused_with_the_largest_radius():
    def refusing(radius):
        check(family("involute"), drive(pinion__tip_rounding=radius).drive)

    with pytest.raises(InputError, match=r"tip_rounding = 5 mm: .* use at most ([\d.]+) mm") as error:
        refusing("5 mm")
    largest = float(str(error.value).split("at most ")[1].split(" ")[0])
    refusing(f"{largest * 0.999} mm")
    with pytest.raises(InputError, match="the rounded edges of the tip meet"):
        refusing(f"{largest * 1.01} mm")


def test_contradictions_are_named():
    assert "gives the tooth thickness, as thickness_allowance does" in refused(
        pinion__thickness_allowance="-50 um", pinion__span="32.4 mm", pinion__span_teeth=4
    )
    assert "drive.pinion.span_teeth: missing" in refused(pinion__span="32.4 mm")
    assert "drive.pinion.pin_diameter: missing" in refused(pinion__over_pins="83.2 mm")
    assert "drive.gear.thickness_allowance: missing" in refused(gear__thickness_tolerance="30 um")
    assert "contradicts thickness_code" in refused(
        gear__thickness_code="cd25", gear__thickness_tolerance="30 um"
    )
    unknown = refused(gear__thickness_code="cd31")
    assert 'drive.gear.thickness_code = "cd31": is none of DIN 3967' in unknown
    assert "gives the tooth thickness, as thickness_allowance does" in refused(
        pinion__thickness_allowance="-50 um", pinion__thickness_code="cd25"
    )
    assert "contradicts bore_radius" in refused(gear__bore_radius="20 mm", gear__bore_diameter="40 mm")
    assert "contradicts tip_diameter" in refused(gear__addendum=1.0, gear__tip_diameter="186 mm")
    assert "there is: ISO 53 A, ISO 53 B" in refused(rack="ISO 53")
    far = refused(pinion__span="32.4 mm", pinion__span_teeth=3)
    assert "one of nominal thickness measures 23.6018 mm over 3 teeth" in far
    thin = refused(pinion__over_pins="65 mm", pinion__pin_diameter="0.2 mm")
    assert "these pins drop between teeth of nominal thickness" in thin
    both = {key: value for key, value in PAIR.items() if key != "mean_roughness"}
    with pytest.raises(InputError, match="roughness: missing"):
        load_drive(both)
    with pytest.raises(InputError, match="mean_roughness: missing"):
        load_drive(both, {"drive.pinion.mean_roughness": "0.4 um"})


def test_other_families_have_no_span():
    with pytest.raises(InputError, match="crc have no measure over a span"):
        load_drive("liu-ni-crc-23-47", {"drive.pinion.span": "30 mm", "drive.pinion.span_teeth": 3})


def test_roughness_of_each_gear_is_combined():
    given = {
        "drive.roughness": None,
        "drive.pinion.mean_roughness": "0.4 um",
        "drive.gear.mean_roughness": "0.8 um",
    }
    case = load("involute-shifted-23-47", {key: value for key, value in given.items() if value}).case
    assert (case.pair.roughness, case.pair.mean_roughness) == (3e-7, pytest.approx(0.6e-6))
    from tribodyn.input.tables.gears.drive_data import roughness_of
    from tribodyn.input.tables.gears.model_files import DriveTable

    written = dict(load_drive(PAIR, {"drive.gear.mean_roughness": "0.4 um"}).table)
    table = DriveTable.model_validate(written)
    # of normally distributed heights R_q = Ra √(π/2)
    assert roughness_of(table) == pytest.approx(math.sqrt(math.pi / 2) * math.hypot(0.8e-6, 0.4e-6))
