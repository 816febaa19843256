import hashlib
import tomllib
from math import pi

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.input.sources import names, shipped
from tribodyn.studies.protocol.load import load, load_scenario

SCENARIO = """
title = "a scenario"
drive = "liu-ni-crc-23-47"
lubricant = "liu-ni-2022"
[operating]
pinion_speed = "100 rpm"
gear_torque = "500 N*m"
[mesh]
damping_ratio = 0.05
[friction]
law = "none"
"""


@pytest.fixture
def written(tmp_path):
    def write(text, name="mine.toml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.mark.parametrize("name", names(shipped("scenarios")))
def test_every_shipped_scenario_is_sound_and_says_where_it_comes_from(name):
    case = load_scenario(name)
    assert case.name == name
    text = (shipped("scenarios") / f"{name}.toml").read_text(encoding="utf-8")
    assert text.startswith("# ")
    assert "Shows" in text


def test_every_model_file_names_its_source_and_every_drive_is_used():
    used = "".join(load_scenario(name).toml for name in names(shipped("scenarios")))
    for path in shipped("models").glob("*/*.toml"):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        assert data["source"].strip()
        assert data["title"] in used or path.parent.name != "drives"


def test_defaults_stand_in_the_resolved_text_and_nothing_is_left_to_look_up(written):
    case = load_scenario(written(SCENARIO))
    data = tomllib.loads(case.toml)
    assert data["solver"]["rtol"] == 1e-6
    assert data["mesh"]["contact_width"] == "0.1 um"
    assert data["bearings"]["pinion"]["stiffness_x"] == "1e9 N/m"
    assert data["drive"]["material"]["youngs_modulus"] == "206 GPa"
    assert data["operating"]["pinion_speed"] == "100 rpm"
    assert case.sha256 == hashlib.sha256(case.toml.encode()).hexdigest()
    assert case.name == "mine"


def test_overrides_reach_through_references_and_into_lists(written):
    text = SCENARIO.replace(
        '"500 N*m"\n',
        '"500 N*m"\ngear_torque_harmonics = [{ amplitude = "1 N*m", frequency = "5 Hz" }]\n',
    )
    case = load_scenario(
        written(text),
        {
            "drive.pinion.profile_shift": "0.25",
            "drive.material.youngs_modulus": "210 GPa",
            "operating.gear_torque_harmonics.0.amplitude": "7 N*m",
            "bearings.gear.stiffness_x": "2e9 N/m",
            "solver.cycles": "3",
            "title": "another",
        },
    )
    assert case.pair.drive.pinion.profile_shift == 0.25
    assert case.pair.materials[0].youngs_modulus == case.pair.materials[1].youngs_modulus == 210e9
    assert case.loads[0].harmonics == ((7.0, pytest.approx(10 * pi), 0.0),)
    assert [bearing.stiffness_x for bearing in case.bearings] == [1e9, 2e9]
    assert case.solver.cycles == 3
    assert case.title == "another"


def test_each_gear_may_have_its_own_material(written):
    case = load_scenario(written(SCENARIO), {"drive.gear.material": "steel-diez-ibarbia"}).pair
    assert [material.youngs_modulus for material in case.materials] == pytest.approx([206e9, 207e9])


def test_models_are_found_beside_the_scenario_first_and_by_path(tmp_path):
    mine = (shipped("models") / "drives" / "liu-ni-crc-23-47.toml").read_text(encoding="utf-8")
    (tmp_path / "models" / "drives").mkdir(parents=True)
    (tmp_path / "scenarios").mkdir()
    (tmp_path / "models" / "drives" / "own.toml").write_text(mine.replace("teeth = 23", "teeth = 29"))
    scenario = tmp_path / "scenarios" / "mine.toml"
    for reference in ("own", "../models/drives/own.toml"):
        scenario.write_text(SCENARIO.replace("liu-ni-crc-23-47", reference))
        assert load_scenario(scenario).pair.drive.pinion.teeth == 29.0


def test_a_curve_comes_from_csv_in_any_unit_and_column_order(written):
    written("# made by hand\n\ntorque [kN*m], note [], time [ms]\n0, x, 0\n0.1, y, 5\n", "load.csv")
    text = SCENARIO.replace('"500 N*m"\n', '"500 N*m"\ngear_torque_table = "load.csv"\n')
    table = load_scenario(written(text)).loads[0].table
    assert table is not None
    np.testing.assert_allclose(table[0], [0.0, 0.005], rtol=1e-15)
    np.testing.assert_allclose(table[1], [0.0, 100.0], rtol=1e-15)


def test_the_name_of_a_record_is_fit_for_a_file(written):
    assert load_scenario(written(SCENARIO, "my drive (2)!.toml")).name == "my drive -2--"


def test_where_each_value_stands_is_known(written):
    path = written(SCENARIO)
    origins = load(path, {"solver.cycles": "3"}).origins
    assert origins.of(("operating", "gear_torque")) == str(path)
    assert origins.of(("solver", "cycles")) == "--set"
    assert origins.of(("drive", "pinion", "teeth")).endswith("liu-ni-crc-23-47.toml")
    assert origins.of(("drive", "material", "density")).endswith("steel-liu-ni-2022.toml")


def test_physics_errors_are_given_the_file(written):
    loaded = load(written(SCENARIO))
    with pytest.raises(InputError, match=r"liu-ni-crc-23-47\.toml: drive\.pinion\.teeth"), loaded.naming():
        raise InputError("drive.pinion.teeth", 5, "too few", "more")
    with pytest.raises(InputError, match=r"^output = "), loaded.naming():
        raise InputError("output", "x.h5", "the file exists")


def test_what_a_name_may_hold_is_what_its_message_says():
    """Names of parts stand in keys: no space and no point."""
    for name in ("a b", "a.b"):
        with pytest.raises(InputError, match="use letters, digits, - and _ "):
            load_scenario("idler-train", {"stage.0.name": name})
