"""`tribodyn gear`: the sheet of a drive by name, of a file or of a scenario; drawings; refusals."""

import json
import math
import tomllib
from pathlib import Path

import ezdxf
import pytest

import tribodyn as td
from tests.support.verbs import complaint, ended, invoke
from tribodyn.input.sources import shipped

SIDES = [f"{side}{end}" for side in ("pinion", "gear") for end in (".dxf", "-rack.dxf", ".csv")]
DRAWINGS = ("pair.svg", "pair.png", "pair.dxf", *SIDES)


def sheet(*arguments: object) -> dict:
    return json.loads(invoke("gear", *arguments, "--json"))


def test_sheet_of_a_shipped_drive():
    printed = sheet("liu-ni-crc-23-47")
    assert printed["family"] == "crc"
    assert printed["files"] == []
    # Liu & Ni's contact ratio as the published one rounds it
    assert printed["geometry"]["contact ratio"][0] == pytest.approx(1.52, abs=5e-3)
    pinion = printed["geometry"]["pinion"]
    assert pinion["teeth"] == [23.0, ""]
    assert pinion["tip diameter"] == [pytest.approx(0.075), "m"]
    assert pinion["mass"][1] == "kg"
    assert 0 < pinion["mass"][0] < 7850 * 3.1416 * 0.0375**2 * 0.025


def test_drive_file_and_scenario_give_the_same_sheet():
    by_scenario = sheet("crc-23-47")["geometry"]
    by_name = sheet("liu-ni-crc-23-47")["geometry"]
    by_file = sheet(str(shipped("models") / "drives" / "liu-ni-crc-23-47.toml"))["geometry"]
    assert by_scenario == by_name == by_file


def test_drawings(tmp_path: Path):
    printed = sheet("liu-ni-involute-23-47", "-o", tmp_path / "new" / "folder", "--points", "20")
    files = [Path(file) for file in printed["files"]]
    assert sorted(file.name for file in files) == sorted(f"liu-ni-involute-23-47-{end}" for end in DRAWINGS)
    for file in files:
        assert file.stat().st_size > 1000
        if file.suffix == ".dxf":
            outlines = ezdxf.readfile(file).modelspace().query('LWPOLYLINE[layer=="OUTLINE"]')
            assert len(outlines) == (2 if file.name.endswith("pair.dxf") else 1)
            assert all(outline.closed for outline in outlines)


@pytest.mark.parametrize(
    ("model", "said"),
    [
        ("liu-ni-crc-23-74", 'did you mean "liu-ni-crc-23-47"?'),
        ("nowhere.toml", "no such file"),
        ("efremenkov-irefc", "not a pair of gears"),
        ("irefc", "not a pair of gears"),
    ],
)
def test_what_is_no_gear_pair_is_refused(model: str, said: str):
    assert said in complaint("gear", model)


def own_drive(folder: Path, old: str, new: str) -> str:
    text = (shipped("models") / "drives" / "liu-ni-involute-23-47.toml").read_text(encoding="utf-8")
    assert old in text
    path = folder / "own.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('family = "involute"', 'family = "evolvent"', "drive.family"),
        ('module = "3 mm"', 'module = "3"', "drive.module"),
        ("teeth = 23", "teeth = 9", "the bore reaches the root circle"),
        ('material = "steel-liu-ni-2022"', "", "drive.pinion.material: missing"),
        ('material = "steel-liu-ni-2022"', 'material = "steel-liu-nix"', "did you mean"),
    ],
)
def test_a_bad_drive_file_is_named_with_its_key(tmp_path: Path, old: str, new: str, said: str):
    path = own_drive(tmp_path, old, new)
    refused = ended("gear", path)
    assert refused.exit_code == 2
    assert said in refused.stderr
    assert all(line.startswith(f"{path}: drive.") for line in refused.stderr.splitlines())


def test_materials_of_an_own_drive_are_found_beside_it(tmp_path: Path):
    (tmp_path / "drives").mkdir()
    (tmp_path / "materials").mkdir()
    steel = (shipped("models") / "materials" / "steel-liu-ni-2022.toml").read_text(encoding="utf-8")
    assert "7850" in steel
    (tmp_path / "materials" / "light.toml").write_text(steel.replace("7850", "3925"), encoding="utf-8")
    light = sheet(own_drive(tmp_path / "drives", "steel-liu-ni-2022", "light"))["geometry"]["gear"]
    steel = sheet("liu-ni-involute-23-47")["geometry"]["gear"]
    assert light["mass"][0] == pytest.approx(steel["mass"][0] / 2)


def test_a_pair_as_a_free_form_one(tmp_path):
    """The drive that is written has the teeth of the original, and is not written over."""
    printed = sheet("liu-ni-crc-23-47", "--as-spline", "9", "-o", tmp_path)
    file = tmp_path / "liu-ni-crc-23-47-spline.toml"
    assert printed["files"][0] == str(file)
    assert (tmp_path / "liu-ni-crc-23-47-spline-pair.svg").exists()
    assert printed["family"] == "spline"
    original = sheet("liu-ni-crc-23-47")["geometry"]
    for name in ("contact ratio", "equivalent radius at end of contact"):
        assert sheet(file)["geometry"][name][0] == pytest.approx(original[name][0], rel=1e-4)
    table = tomllib.loads(file.read_text(encoding="utf-8"))
    assert table["family"] == "spline"
    assert len(table["shape"]["angles"]) == 9
    assert ended("gear", "liu-ni-crc-23-47", "--as-spline", "9", "-o", tmp_path).exit_code != 0
    pair = td.drive("liu-ni-crc-23-47").as_spline(9)
    assert pair.toml == file.read_text(encoding="utf-8")
    # an entry of the list, as --set and --vary name it
    changed = sheet(file, "--set", 'drive.shape.angles.4="23 deg"')
    assert changed["geometry"]["pressure angle at pitch point"][0] == pytest.approx(math.radians(23.0))


def test_too_few_values_for_a_free_form_path():
    with pytest.raises(td.InputError, match="4 to 100 values"):
        td.drive("liu-ni-crc-23-47").as_spline(3)
