"""Keys of modified flanks, misalignment and slices: what they mean in SI, and how they are written out."""

import tomllib
from math import pi
from pathlib import Path

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.modification import LeadRelief, Misalignment, Relief
from tribodyn.studies.protocol.load import load, load_scenario

STUDY = "load-contact-18-36"
PINION = "drive.pinion.modification."


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """A study whose drive is like a shipped one, with relief of its own."""
    path = tmp_path / "mine.toml"
    path.write_text(
        'title = "mine"\nkind = "load-contact"\n'
        '[drive]\nlike = "diez-ibarbia-18-36"\n'
        '[drive.pinion.modification]\ntip_relief = "0.02 mm"\ntip_relief_length = "4 mm"\n'
        '[operating]\ngear_torque = "318 N*m"\n',
        encoding="utf-8",
    )
    return path


def test_quantities_in_si():
    case = load_scenario(
        STUDY,
        {
            PINION + "tip_relief": "20 um",
            PINION + "tip_relief_length": "4 mm",
            PINION + "root_relief": "0.0005 inch",
            PINION + "root_relief_length": "0.1 inch",
            PINION + "root_relief_shape": "parabolic",
            "drive.gear.modification.lead_relief_start": "8 um",
            "drive.gear.modification.lead_relief_end": "6 um",
            "drive.gear.modification.lead_unmodified": "8 mm",
            "mesh.misalignment.in_plane": "3 arcmin",
            "mesh.misalignment.out_of_plane": "-0.1 deg",
        },
    )
    pinion, gear, misalignment = case.mesh.modifications
    assert pinion.tip == Relief(20e-6, 4e-3, 1.0)
    assert pinion.root == pytest.approx((12.7e-6, 2.54e-3, 2.0))
    assert gear.lead == LeadRelief(8e-6, 6e-6, 8e-3)
    assert misalignment == pytest.approx(Misalignment(3 / 60 * pi / 180, -0.1 * pi / 180))


@pytest.mark.parametrize(
    ("overrides", "slices"),
    [
        ({PINION + "crowning": "8 um"}, 21),
        ({"drive.gear.modification.lead_relief_end": "8 um"}, 21),
        ({"mesh.misalignment.in_plane": "1 arcmin"}, 21),
        ({"mesh.misalignment.out_of_plane": "1 arcmin"}, 21),
        ({PINION + "tip_relief": "8 um", PINION + "tip_relief_length": "3 mm"}, 1),
        ({"mesh.misalignment.in_plane": "1 arcmin", "mesh.slices": 5}, 5),
        ({"mesh.slices": 7}, 7),
    ],
    ids=lambda value: str(value)[:50],
)
@pytest.mark.parametrize("name", [STUDY, "involute-18-36-fem"])
def test_as_many_slices_as_what_varies_asks_for(name: str, overrides: dict, slices: int):
    case = load_scenario(name, overrides)
    assert case.pair.mesh.slices == slices


def test_what_is_written_in_a_scenario_changes_the_model_it_is_like(scenario: Path):
    case = load_scenario(scenario)
    shipped = load_scenario(STUDY)
    assert case.drive == shipped.drive
    assert case.materials == shipped.materials
    assert case.mesh.modifications.pinion.tip == Relief(20e-6, 4e-3, 1.0)
    other = load_scenario(scenario, {"drive.like": "jia-involute-17-29"})
    assert other.drive.pinion.teeth == 17
    assert other.mesh.modifications.pinion.tip == Relief(20e-6, 4e-3, 1.0)


def test_mistakes_are_told_with_the_file_that_they_are_in(scenario: Path):
    def said(text: str) -> str:
        before = scenario.read_text(encoding="utf-8")
        scenario.write_text(text, encoding="utf-8")
        with pytest.raises(InputError) as error:
            load_scenario(scenario)
        scenario.write_text(before, encoding="utf-8")
        return str(error.value)

    text = scenario.read_text(encoding="utf-8")
    assert said(text.replace("tip_relief_length", "tip_relief_lenght")).startswith(
        f"{scenario}: drive.pinion.modification.tip_relief_lenght"
    )
    unknown = said(text.replace("diez-ibarbia-18-36", "diez-ibarbia-18-63"))
    assert unknown.startswith(f'{scenario}: drive.like = "diez-ibarbia-18-63": no such file')
    assert len(unknown.splitlines()) == 1  # and not a line for everything that is missing with it
    assert 'did you mean "diez-ibarbia-18-36"?' in unknown
    assert "not the name of a model" in said(text.replace('"diez-ibarbia-18-36"', "3"))


def test_a_resolved_scenario_is_the_same_case(scenario: Path, tmp_path: Path):
    first = load(scenario, {PINION + "crowning": "8 um"}).case
    written = tomllib.loads(first.toml)
    assert "like" not in written["drive"]
    flank = written["drive"]["pinion"]["modification"]
    assert flank["root_relief"] == "0 um"  # defaults are written out
    assert flank["tip_relief"] == "0.02 mm"
    (tmp_path / "again.toml").write_text(first.toml, encoding="utf-8")
    again = load_scenario(tmp_path / "again.toml")
    assert again.sha256 == first.sha256
    assert again == first


def test_errors_of_profile_and_pitch_from_csv_files(scenario: Path):
    scenario.with_name("profile.csv").write_text("roll_angle [deg],error [um]\n-25,0\n0,1\n25,4\n", "utf-8")
    rows = "\n".join(str(0.25 * tooth) for tooth in range(18))
    scenario.with_name("pitch.csv").write_text(f"# one per tooth\nerror [um]\n{rows}\n", "utf-8")
    case = load_scenario(
        scenario, {PINION + "profile_error": "profile.csv", PINION + "pitch_errors": "pitch.csv"}
    )
    angle, error = case.mesh.modifications.pinion.profile_error
    np.testing.assert_allclose(angle, np.radians([-25, 0, 25]))
    np.testing.assert_allclose(error, [0, 1e-6, 4e-6])
    np.testing.assert_allclose(case.mesh.modifications.pinion.pitch_error, 0.25e-6 * np.arange(18))
    listed = load_scenario(scenario, {PINION + "pitch_errors": [f"{0.25 * tooth} um" for tooth in range(18)]})
    assert listed.mesh.modifications.pinion.pitch_error == case.mesh.modifications.pinion.pitch_error
