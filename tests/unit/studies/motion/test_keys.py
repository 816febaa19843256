"""Keys of trains: overrides and axes of sweeps reach gears by name and stages by place."""

import tomllib
from pathlib import Path

import pytest
import tomli_w

from tests.support.train_scenarios import REDUCER, train_case
from tribodyn.errors import InputErrors
from tribodyn.input.vary import axes_of
from tribodyn.studies.motion import TRAIN as STUDY


@pytest.fixture
def written(tmp_path: Path) -> Path:
    path = tmp_path / "reducer.toml"
    path.write_text(tomli_w.dumps(REDUCER), encoding="utf-8")
    return path


def test_overrides_reach_gears_and_stages(written: Path):
    case = train_case(
        written,
        {
            "gear.wheel-1.teeth": "70",
            "stage.1.azimuth": "90 deg",
            "gear.wheel-2.material": "42CrMo4",
            "gear.wheel-2.material.density": "7000 kg/m**3",
            "bearings.pinion-1.stiffness_x": "1e8 N/m",
            "bearings.pinion-1.stiffness_y": "2e8 N/m",
            "bearings.pinion-1.damping_ratio": "0.1",
        },
    )
    assert case.gears[1].teeth == 70
    assert case.bodies[2].centre[0] == pytest.approx(case.bodies[1].centre[0])
    assert [gear.density for gear in case.gears] == [7850.0] * 3 + [7000.0]
    assert case.links[0].stiffness == (1e8, 2e8, 0.0)
    assert case.links[1].stiffness == (1e9, 1e9, 0.0)


def test_axes_know_the_units_of_keys_by_name_and_place():
    options = [
        "gear.a.face_width=20:40/3 mm",
        "stage.1.module=3,4 mm",
        "operating.input_speed=100:300:100rpm",
    ]
    axes = axes_of(options, STUDY.table())
    assert [axis.units for axis in axes] == ["m", "m", "rad/s"]
    assert axes[0].values == (0.02, 0.03, 0.04)
    assert axes[1].values == (0.003, 0.004)


def test_what_is_resolved_is_the_same_case(written: Path, tmp_path: Path):
    case, again = train_case(written), tmp_path / "again.toml"
    again.write_text(case.toml, encoding="utf-8")
    assert train_case(again).sha256 == case.sha256
    assert tomllib.loads(case.toml)["gear"]["wheel-1"]["modification"]["tip_relief"] == "0 um"


def test_flanks_and_points_come_from_csv_files(written: Path, tmp_path: Path):
    """A profile error of a gear, the path of a stage's teeth, and the stiffness of a bare mesh."""
    (tmp_path / "error.csv").write_text("roll_angle [deg],error [um]\n-30,0\n30,4\n", encoding="utf-8")
    case = train_case(
        written, {"gear.wheel-1.modification": {"profile_error": "error.csv"}, "mesh.compliance": "fem"}
    )
    flank = case.meshes[0].pair.mesh.modifications.gear
    assert flank.profile_error is not None
    assert flank.profile_error[1][-1] == pytest.approx(4e-6)
    with pytest.raises(InputErrors, match=r"stage\.0\.shape\.points.* no such file"):
        train_case(written, {"stage.0.family": "points", "stage.0.shape": {"points": "none.csv"}})


def test_some_gears_have_a_material(written: Path):
    data = {name: value for name, value in REDUCER.items() if name != "material"}
    written.write_text(tomli_w.dumps(data), encoding="utf-8")
    with pytest.raises(InputErrors) as caught:
        train_case(written, {"gear.wheel-1.material": "42CrMo4"})
    assert [error.key for error in caught.value.errors] == [
        f"gear.{name}.material" for name in ("pinion-1", "pinion-2", "wheel-2")
    ]
    assert "material for all gears" in caught.value.errors[0].remedy


def test_the_template_is_a_scenario(tmp_path: Path):
    text = STUDY.template().replace("TITLE", "mine").replace("KINDS", f'kind = "{STUDY.kind}"')
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    assert train_case(path).period == 3
    assert max(map(len, text.splitlines())) <= 120


def test_the_schema_describes_every_key():
    schema = STUDY.table().model_json_schema()
    (held,) = schema["properties"]["gear"]["patternProperties"].values()
    assert held == {"$ref": "#/$defs/TrainGear"}
    for name, table in schema["$defs"].items():
        if name in ("Stage", "Shaft", "BareBody", "Link", "BareMesh", "LoadTable", "TrainOperating"):
            assert table["properties"]
