"""CSV files of other programs: separators, decimal commas, columns too many; wrong units in any of them."""

from pathlib import Path

import pytest

from tribodyn.errors import InputError
from tribodyn.input.sources import read_curve
from tribodyn.studies.protocol.load import load_scenario

COLUMNS = ("roll_angle", "error")
POINTS = {"roll_angle": [-20.0, -13.5, 0.0], "error": [8.0, 8.0, 0.0]}


def read(folder: Path, text: str, encoding: str = "utf-8") -> dict:
    path = folder / "errors.csv"
    path.write_text(text, encoding=encoding)
    return read_curve(path, "mesh.transmission_error.table", COLUMNS)


def refusal(folder: Path, text: str) -> str:
    with pytest.raises(InputError) as refused:
        read(folder, text)
    (line,) = str(refused.value).splitlines()
    assert line.startswith(f"{folder / 'errors.csv'}: mesh.transmission_error.table: line ")
    return line


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_separators_and_byte_order_marks(tmp_path: Path, separator: str, encoding: str):
    """The same points, with a blank column at the end as spreadsheets leave it."""
    rows = ("roll_angle [deg]", "error [um]"), ("-20", "8"), ("-13.5", "8"), ("0", "0", "")
    found = read(tmp_path, "\n".join(separator.join(row) for row in rows), encoding)
    assert {name: column["values"] for name, column in found.items()} == POINTS
    assert [column["unit"] for column in found.values()] == ["deg", "um"]


HEAD = "roll_angle [deg],error [um]\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            HEAD + "-20,8\n-13,5,8\n0,0\n",
            ('line 3: 3 values under a header of 2: "-13,5,8"', "point"),
        ),
        (HEAD + '-20,8\n"-13,5",8\n', ("line 3", "a comma in a number", 'write a decimal point: "-13.5"')),
        ("roll_angle [deg];error [um]\n-13,5;8\n", ("line 2", "comma", 'write a decimal point: "-13.5"')),
        (HEAD + "-20;8\n", ("line 2", "the row is separated by semicolons, the header by commas")),
        (HEAD + "-20\t8\n", ("line 2", "the row is separated by tabs, the header by commas")),
        ("roll_angle [deg],error [um],error [mm]\n-20,8,8\n", ("line 1", '"error" names more than one')),
        ("roll_angle [deg];error [um]\n-20;8;1\n", ("line 2: 3 values under a header of 2", "leave it out")),
    ],
)
def test_what_would_be_misread_is_refused(tmp_path: Path, text: str, words: tuple[str, ...]):
    line = refusal(tmp_path, text)
    assert all(word in line for word in words), line


TOOTH = "drive.pinion.modification"


@pytest.mark.parametrize(
    ("head", "key", "unit"),
    [
        ("tooth [1],height [1],face [mm],error [deg]", "tooth_errors", "error is in"),
        ("tooth [mm],height [1],face [mm],error [um]", "tooth_errors", "tooth is in"),
        ("height [1],face [N],depth [um]", "map", "face is in"),
        ("height [1],face [mm],depth [parsnip]", "map", 'unknown unit "parsnip"'),
    ],
)
def test_a_wrong_unit_of_a_table_over_the_flank(tmp_path: Path, head: str, key: str, unit: str):
    """One message that names the key, the column and a unit that is due."""
    path = tmp_path / "flank.csv"
    cells = ",".join("1" for _ in head.split(","))
    path.write_text(f"{head}\n{cells}\n{cells}\n", encoding="utf-8")
    patch = {"gear": "pinion", "tooth": 1, "kind": "spall", "map": str(path)}
    changes = {f"{TOOTH}.tooth_errors": str(path)} if key == "tooth_errors" else {"damage": [patch]}
    with pytest.raises(InputError) as refused:
        load_scenario("involute-18-36", changes)
    (line,) = str(refused.value).splitlines()
    assert unit in line
    assert "such as" in line
    assert str(path) in line or "--set" in line
