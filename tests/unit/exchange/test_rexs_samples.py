"""Gearboxes of other programs as REXS: what is read of them; that they are checked, run and assessed."""

import math
from pathlib import Path
from typing import Any

import pytest

import tribodyn as td
from tests.support.rexs_models import sample
from tests.support.verbs import invoke
from tribodyn.exchange.rexs.file.files import read_model
from tribodyn.exchange.rexs.reading.scenario import scenario_of
from tribodyn.exchange.rexs.rexs_format import read

THREE, TWO = "SEW_3-stage_cylindrical_gearbox_1.0.rexs", "FVA_two_stage_industrial_1.4.rexs"
PLANETARY = "FVA_Planetary_stage_-_Minus_gearing_1.1"
OF_PLANETS = [f"{PLANETARY}.{ending}" for ending in ("rexs", "rexsj", "rexsz")]


def tables(name: str) -> dict[str, Any]:
    return read(sample(name)).scenario


@pytest.mark.parametrize("name", [THREE, TWO, *OF_PLANETS])
def test_every_attribute_is_read_or_listed(name: str):
    path = sample(name)
    model, found = read_model(path), scenario_of(path)
    parts = (*model.parts.values(), *(part for case in model.cases for part in case.parts))
    there = [(part.number, key) for part in parts for key in part.attributes]
    listed = [(each.number, each.attribute) for each in found.not_used]
    assert set(listed) < set(there)
    assert len(listed) < len(there)
    needed = "face_width", "normal_module", "center_distance", "viscosity_at_40_degree_celsius"
    alike = {number for number, key in listed if key in needed}
    assert {model.parts[number].type for number in alike} <= {"cylindrical_gear", "cylindrical_stage"}
    assert all("@ 240" in model.parts[number].name or "@ 120" in model.parts[number].name for number in alike)


def test_a_reducer_of_three_stages_stands_where_the_file_puts_it():
    """Its azimuths and centre distances lead to the places of its shafts, which the file says on its own."""
    data, model = tables(THREE), read_model(sample(THREE))
    place = {"anw-4": (0.0, 0.0)}
    shafts = {shaft["name"]: shaft["gears"] for shaft in data["shaft"]}
    on = {gear: shaft for shaft, gears in shafts.items() for gear in gears}
    for stage in data["stage"]:
        first, second = (on[gear] for gear in stage["gears"])
        distance, azimuth = (float(stage[key].split()[0]) for key in ("centre_distance", "azimuth"))
        x, y = place[first]
        angle = math.radians(azimuth)
        place[second] = x + distance * math.cos(angle), y + distance * math.sin(angle)
    told = {
        f"{shaft.name.split()[0].lower()}-{shaft.number}": shaft.attributes["support_vector"].value
        for shaft in model.of_type("shaft")
    }
    assert len(place) == 4
    for name, (x, y) in place.items():
        vector = told[name]
        assert isinstance(vector, tuple)
        assert (x, y) == pytest.approx([float(vector[1]), float(vector[2])], abs=1e-6)


def test_files_that_count_from_the_start_of_a_face_are_understood():
    """Version 1.0: 146 mm and half of 16 mm are the 154 mm of its support vector."""
    data = tables(THREE)
    assert data["shaft"][0]["drawn"]["positions"] == {"stirnrad-pos-1-23": "154 mm"}
    bearing = data["shaft"][0]["drawn"]["bearing"][0]
    assert bearing["type"] == "deep-groove-ball"
    assert (bearing["bore"], bearing["outside_diameter"], bearing["static_rating"]) == (
        "25 mm",
        "62 mm",
        "11.4 kN",
    )


def test_load_cases_are_duties_and_what_no_key_holds_is_said():
    found = read(sample(TWO))
    duties = found.scenario["duty"]
    assert [(each["share"], each["input_speed"], each["input_torque"]) for each in duties] == [
        (0.2, "543 rpm", "567 N*m"),
        (0.3, "3456 rpm", "345 N*m"),
        (0.35, "1234 rpm", "456 N*m"),
        (0.15, "789 rpm", "789 N*m"),
    ]
    assert "tip_diameter" not in found.scenario["gear"]["cylindrical-gear-44"]
    unused = [each for each in found.details["not_used"] if each["attribute"] == "tip_diameter"]
    assert [(each["value"], each["why"]) for each in unused] == [
        ("1", "no tip diameter of a reference diameter of 151.806 mm")
    ]
    assert any("force_v_direction = 456 N" in line for line in found.remarks)
    assert any(
        "stands between shaft 'Shaft [6]' (id 12) and shaft 'Shaft [42]'" in line for line in found.remarks
    )


@pytest.mark.parametrize("name", OF_PLANETS)
def test_a_planetary_stage_is_one_in_every_container(name: str):
    """Its 250 kW at 1500 rpm; planets at 90°, 210° and 330° where their shafts stand."""
    data = tables(name)
    stage = data["stage"][0]
    assert (stage["type"], stage["planets"], stage["held"]) == ("planetary", 3, "ring")
    assert stage["angles"] == ["90 deg", "210 deg", "330 deg"]
    assert [data["gear"][stage[member]]["teeth"] for member in ("sun", "planet", "ring")] == [17, 22, 61]
    assert data["gear"]["hohlrad-58"]["cutter_teeth"] == 23
    torque, speed = (float(data["operating"][key].split()[0]) for key in ("input_torque", "input_speed"))
    assert torque * speed * math.pi / 30 == pytest.approx(250e3, rel=1e-9)
    assert float(data["body"][0]["mass"].split()[0]) == pytest.approx(8.03804, rel=1e-6)


def test_the_mass_of_a_carrier_is_that_of_its_parts():
    """Two plates, two hollow shafts and three pins of steel, summed here from their drawing; mm and g/cm³."""
    rings = [(219, 80, 8), (219, 99, 8), (80, 60, 100), (99, 88, 8), *[(43.2, 0, 66)] * 3]
    mass = sum(math.pi / 4 * (outer**2 - inner**2) * length * 7.85e-6 for outer, inner, length in rings)
    assert float(tables(OF_PLANETS[0])["body"][0]["mass"].split()[0]) == pytest.approx(mass, rel=1e-5)


def test_the_planetary_sample_is_checked_and_run(tmp_path: Path):
    path = tmp_path / "set.toml"
    invoke("import", sample(OF_PLANETS[2]), "-o", path)
    laws = {"film.law": "moes", "friction.law": "schlenk", "solver.cycles": 2}
    checked = td.check(path, laws)
    assert checked["train_ratio"] == pytest.approx(1 + 61 / 17)
    run = td.run(path, laws, output=tmp_path / "set.h5")
    assert 0.97 < run.summary["efficiency"] < 0.995


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "ratio"),
    [
        pytest.param(TWO, 51 / 27 * 34 / 23, marks=pytest.mark.soak),
        pytest.param(THREE, 67 / 23 * 76 / 13 * 87 / 14, marks=pytest.mark.soak),
        (OF_PLANETS[0], 1 + 61 / 17),
    ],
)
def test_samples_come_through_check_run_and_assess(tmp_path: Path, name: str, ratio: float):
    path = tmp_path / "gearbox.toml"
    invoke("import", sample(name), "-o", path)
    laws = {"film.law": "moes", "friction.law": "schlenk"}
    assert td.check(path, laws)["train_ratio"] == pytest.approx(ratio)
    run = td.run(path, laws | {"solver.cycles": 2}, output=tmp_path / "run.h5")
    assert 0.9 < run.summary["efficiency"] < 1.0
    study = 'title = "page"\nkind = "train-assessment"\n[scenario]\nlike = "gearbox.toml"\nquality = 6\n'
    study += "[assessment]\nspeeds = 0\nsamples = 0\n"
    (tmp_path / "page.toml").write_text(study, encoding="utf-8")
    assert "Pitting S_H" in invoke("assess", "page.toml", folder=tmp_path)
