"""What REXS says of a gearbox in other ways than a scenario, and what becomes of it."""

import math
import re
from pathlib import Path
from typing import Any

import pytest

import tribodyn as td
from tests.support.rexs_models import PARTS, one_stage, part, relation
from tribodyn.exchange.format import Imported
from tribodyn.exchange.rexs.rexs_format import read
from tribodyn.input import units
from tribodyn.input.units import to_si


def imported(
    folder: Path, parts: dict[int, str] | None = None, more: str = "", version: str = "2.0.0"
) -> Imported:
    path = folder / "gearbox.rexs"
    path.write_text(one_stage(version, parts, more), encoding="utf-8")
    return read(path)


def shaft_of(found: Imported, name: str) -> dict[str, Any]:
    return next(shaft["drawn"] for shaft in found.scenario["shaft"] if shaft["name"] == name)


def with_values(number: int, **values: object) -> str:
    """A part of the gearbox with further attributes, or other values of its own."""
    text = PARTS[number]
    for key in values:
        text = re.sub(rf'\n *<attribute id="{key}".*', "", text)
    more = part(0, "x", "", **values).split("\n", 2)[2].rsplit("\n", 1)[0]
    return text.replace("\n    </component>", f"\n{more}\n    </component>")


RELIEFS = {
    20: part(
        20,
        "tip_relief",
        tip_relief_depth="0.02 mm",
        tip_relief_datum_length="3 mm",
        shape_of_relief="parabolic",
    ),
    21: part(
        21,
        "helix_crowning",
        helix_crowning_amount_datum_face="4 mum",
        helix_crowning_amount_non_datum_face="8 mum",
    ),
    22: part(22, "helix_slope", helix_slope="-0.005 mm"),
}
ON_FLANK = "".join(relation(40 + each, "reference", origin=9, referenced=each) for each in RELIEFS)


def test_modifications_are_those_of_the_flanks(tmp_path: Path):
    found = imported(tmp_path, RELIEFS, ON_FLANK).scenario["gear"]["pinion"]["modification"]
    assert found == {
        "tip_relief": "0.02 mm",
        "tip_relief_length": "3 mm",
        "tip_relief_shape": "parabolic",
        "lead_relief_start": "4 um",
        "lead_relief_end": "8 um",
        "helix_slope": "-0.005 mm",
    }


def test_a_datum_face_at_the_far_end_turns_them_round(tmp_path: Path):
    parts = RELIEFS | {7: with_values(7, datum_face_orientation="positive")}
    found = imported(tmp_path, parts, ON_FLANK).scenario["gear"]["pinion"]["modification"]
    assert (found["lead_relief_start"], found["lead_relief_end"]) == ("8 um", "4 um")
    assert found["helix_slope"] == "0.005 mm"


def end_relief(number: int, face: str, depth: str, length: str, **more: str) -> dict[int, str]:
    values = {f"end_relief_depth_{face}": depth, f"end_relief_length_{face}": length}
    return {number: part(number, f"end_relief_{face}", **values, **more)}


def test_reliefs_of_the_ends_of_the_face_leave_its_middle_straight(tmp_path: Path):
    """32 mm wide, 5 mm at either end."""
    reliefs = end_relief(20, "datum_face", "12 mum", "5 mm") | end_relief(
        23, "non_datum_face", "0.007 mm", "5 mm", shape_of_relief="linear"
    )
    on_flank = "".join(relation(40 + each, "reference", origin=9, referenced=each) for each in reliefs)
    found = imported(tmp_path, reliefs, on_flank)
    ends = {"lead_relief_start": "12 um", "lead_relief_end": "0.007 mm", "lead_unmodified": "22 mm"}
    assert found.scenario["gear"]["pinion"]["modification"] == ends
    assert any("a parabola stands for the linear relief" in line for line in found.remarks)


@pytest.mark.parametrize(("length", "more"), [("6 mm", ()), ("5 mm", (21,)), ("17 mm", ())])
def test_end_reliefs_that_no_scenario_has_are_left_and_listed(
    length: str, more: tuple[int, ...], tmp_path: Path
):
    """Of two lengths, beside crowning, or over more than half of the face of 32 mm."""
    first = length if length == "17 mm" else "5 mm"
    reliefs = end_relief(20, "datum_face", "12 mum", first) | end_relief(
        23, "non_datum_face", "7 mum", length
    )
    reliefs |= {each: RELIEFS[each] for each in more}
    on_flank = "".join(relation(40 + each, "reference", origin=9, referenced=each) for each in reliefs)
    found = imported(tmp_path, reliefs, on_flank)
    written = found.scenario["gear"]["pinion"].get("modification", {})
    assert set(written) == ({"lead_relief_start", "lead_relief_end"} if more else set())
    left = {each["attribute"]: each["why"] for each in found.details["not_used"]}
    for name in ("end_relief_depth_datum_face", "end_relief_length_non_datum_face"):
        assert ("helix_crowning goes before" if more else "of one length") in left[name]


def test_reliefs_of_the_ends_come_back(tmp_path: Path):
    ends = {"lead_relief_start": "12 um", "lead_relief_end": "5 um", "lead_unmodified": "8 mm"}
    changes = {f"drive.pinion.modification.{key}": value for key, value in ends.items()}
    td.export("helical-23-47", "rexs", tmp_path / "out.rexs", changes)
    found = td.import_scenario(tmp_path / "out.rexs").scenario["gear"]["pinion"]["modification"]
    sizes = {key: to_si(value, units.DEVIATION) for key, value in found.items()}
    assert sizes == pytest.approx({key: to_si(value, units.DEVIATION) for key, value in ends.items()})


def test_a_sixth_of_the_peaks_is_the_mean_roughness_where_that_is_missing(tmp_path: Path):
    plain = with_values(7, mean_peak_to_valley_roughness_flank_iso_4287_1997="3 mum")
    assert imported(tmp_path, {7: plain}).scenario["gear"]["pinion"]["mean_roughness"] == "0.4 um"
    alone = "\n".join(line for line in plain.splitlines() if "arithmetic_mean" not in line)
    found = imported(tmp_path, {7: alone})
    assert found.scenario["gear"]["pinion"]["mean_roughness"] == "0.5 um"
    assert any("Rz = 3 µm as Ra = Rz/6" in line for line in found.remarks)


def test_a_cone_is_cylinders_of_nearly_its_volume(tmp_path: Path):
    found = imported(tmp_path, {6: with_values(6, outer_diameter_end="70 mm")})
    sections = shaft_of(found, "output")["section"]
    sizes = [[float(each[key].split()[0]) for key in ("length", "diameter")] for each in sections]
    volume = sum(length * diameter**2 for length, diameter in sizes) * math.pi / 4
    exact = math.pi / 12 * 100 * (50**2 + 50 * 70 + 70**2)
    assert sum(length for length, _ in sizes) == 100
    assert volume == pytest.approx(exact, rel=1e-3)
    assert any("is a cone; here 4 cylinders" in line for line in found.remarks)


def test_a_shaft_that_runs_the_other_way_is_turned_round(tmp_path: Path):
    """Its u points along -u of the gear unit: places count from its other end, thrust has the other sign."""
    tapered = {
        number: with_values(
            number,
            bearing_type="radial_tapered_roller_bearing",
            catalogue_value_e="0.4",
            axial_force_absorption=held,
        )
        for number, held in ((16, "positive"), (17, "negative"))
    }
    straight = shaft_of(imported(tmp_path, tapered), "output")
    frame = PARTS[4].replace("<c>10</c>", "<c>110</c>", 1).replace("<c>1</c>", "<c>-1</c>", 1)
    turned = shaft_of(imported(tmp_path, tapered | {4: frame}), "output")
    assert [each["position"] for each in straight["bearing"]] == ["10 mm", "90 mm"]
    assert [each["position"] for each in turned["bearing"]] == ["90 mm", "10 mm"]
    assert [each["thrust"] for each in straight["bearing"]] == ["+z", "-z"]
    assert [each["thrust"] for each in turned["bearing"]] == ["-z", "+z"]
    assert straight["positions"] == turned["positions"] == {"wheel": "50 mm"}
    angle = float(straight["bearing"][0]["contact_angle"].split()[0])
    assert 1.5 * math.tan(math.radians(angle)) == pytest.approx(0.4, rel=1e-5)


def test_version_1_0_counts_from_the_start_of_the_face(tmp_path: Path):
    older = {7: PARTS[7].replace('mm">60<', 'mm">44<'), 8: PARTS[8].replace('mm">50<', 'mm">35<')}
    found = imported(tmp_path, older, version="1.0")
    assert shaft_of(found, "input")["positions"] == {"pinion": "60 mm"}
    assert shaft_of(found, "output")["positions"] == {"wheel": "50 mm"}


RADIAL = {"radial_stiffness": "3e8 N / m"}


@pytest.mark.parametrize(
    ("values", "expected", "said"),
    [
        ({"radial_stiffness": "1e20 N / m"}, {"stiffness_x": "1e+10 N/m"}, "changed: concept_bearing"),
        (RADIAL, {"stiffness_x": "300000000 N/m"}, ""),
        ({}, {"stiffness_x": "5e+08 N/m"}, "not in the file, assumed: shaft.drawn.bearing.stiffness_x"),
        (
            RADIAL | {"axial_force_absorption": "both_directions", "axial_stiffness": "2e8 N / m"},
            {"stiffness_axial": "200000000 N/m"},
            "",
        ),
        (RADIAL | {"bending_stiffness": "5e7 N mm / rad"}, {"stiffness_tilt": "50000 N*m/rad"}, ""),
        (
            RADIAL | {"bending_stiffness": "1e18 N mm / rad"},
            {"stiffness_tilt": "1e+09 N*m/rad"},
            "is rigid; here stiffness_tilt",
        ),
    ],
)
def test_concept_bearings_are_springs(
    values: dict[str, str], expected: dict[str, str], said: str, tmp_path: Path
):
    spring = part(17, "concept_bearing", "spring", u_coordinate_on_shaft_inner_side="90 mm", **values)
    found = imported(tmp_path, {17: spring})
    assert expected.items() <= shaft_of(found, "output")["bearing"][1].items()
    assert any(said in line for line in found.remarks)


def test_a_bearing_without_its_sizes_is_left_as_a_comment_to_fill_in(tmp_path: Path):
    told = {"bearing_type": "radial_grooved_ball_bearing", "u_coordinate_on_shaft_inner_side": "90 mm"}
    bare = part(17, "rolling_bearing_with_catalog_geometry", "6210", **told)
    found = imported(tmp_path, {17: bare})
    assert '# type = "deep-groove-ball"' in found.toml
    assert shaft_of(found, "output")["bearing"][1]["stiffness_x"] == "5e+08 N/m"


def test_a_mass_at_the_place_of_the_load_is_where_power_enters(tmp_path: Path):
    told = {"mass_of_component": "3 kg", "moment_of_inertia_u_axis": "0.01 kg m^2"}
    mass = part(30, "additional_mass", "half coupling", u_coordinate_on_shaft="0 mm", **told)
    found = imported(tmp_path, {30: mass}, relation(50, "assembly", assembly=3, part=30))
    assert found.scenario["body"] == [{"name": "half-coupling", "mass": "3 kg", "inertia": "0.01 kg*m**2"}]
    assert found.scenario["operating"]["input"] == "half-coupling"
    assert shaft_of(found, "input")["positions"] == {"half-coupling": "0 mm", "pinion": "60 mm"}


def test_power_and_the_output_s_speed_are_taken_as_they_are(tmp_path: Path):
    """80 N m at -1500 rpm are put in at the pinion; the same as power, and from the speed of the wheel."""
    parts = {
        3: re.sub(r"\n *<attribute id=.rotational_speed.*", "", PARTS[3]),
        4: with_values(4, rotational_speed="731.7 1 / min"),
        12: re.sub(r"\n *<attribute id=.torque_around_u.*", "", with_values(12, power="12.5 kW")),
    }
    operating = imported(tmp_path, parts).scenario["operating"]
    assert (operating["power"], operating["output_speed"]) == ("12.5 kW", "731.7 rpm")
    assert (operating["input"], operating["sense"]) == ("pinion", "clockwise")


def test_a_load_that_drives_is_the_input(tmp_path: Path):
    """Torque and speed of the same sign put power in, of opposite sign they take it out."""
    found = imported(tmp_path, {12: with_values(12, torque_around_u_axis="80 N m")}).scenario["operating"]
    assert (found["input"], found["output"]) == ("wheel", "pinion")
    assert (found["output_torque"], found["output_speed"]) == ("80 N*m", "1500 rpm")
    assert found["sense"] == "counter-clockwise"


@pytest.mark.parametrize("rigid", [False, True])
def test_a_shaft_without_gears_is_a_body_that_a_coupling_joins(tmp_path: Path, rigid: bool):
    """A motor's shaft of 100 mm and 40 mm of steel before the pinion's; its mass by hand."""
    stiffness = "1e18" if rigid else "2e8"
    parts = {
        30: part(30, "shaft", "motor shaft", at=(-120, 0, 0)),
        31: part(31, "shaft_section", length="100 mm", outer_diameter_begin="40 mm"),
        32: part(32, "coupling", "coupling", rotational_stiffness=f"{stiffness} N mm / rad"),
    }
    more = relation(50, "assembly", assembly=30, part=31) + relation(
        51, "side", assembly=32, inner_part=30, outer_part=3
    )
    path = tmp_path / "gearbox.rexs"
    on_shaft = '<ref role="assembly" id="{}"/><ref role="part" id="12"/>'
    text = one_stage("2.0.0", parts, more).replace(on_shaft.format(3), on_shaft.format(30))
    path.write_text(text, encoding="utf-8")
    found = read(path).scenario
    mass = 7850 * math.pi / 4 * 0.04**2 * 0.1
    assert float(found["body"][0]["mass"].split()[0]) == pytest.approx(mass, rel=1e-8)
    assert float(found["body"][0]["inertia"].split()[0]) == pytest.approx(mass * 0.04**2 / 8, rel=1e-8)
    (link,) = found["link"]
    assert (link["ends"], found["operating"]["input"]) == (["motor-shaft", "pinion"], "motor-shaft")
    assert link["stiffness"] == ("1e+09 N*m/rad" if rigid else "200000 N*m/rad")


def test_modified_spur_gears_are_given_to_finite_elements(tmp_path: Path):
    spur = {number: with_values(number, helix_angle_reference_diameter="0 deg") for number in (7, 8)}
    assert "compliance" not in imported(tmp_path, spur).scenario["mesh"]
    assert imported(tmp_path, RELIEFS | spur, ON_FLANK).scenario["mesh"]["compliance"] == "fem"
