"""CSV files of other programs: separators, decimal commas, columns too many; wrong units in any of them."""

from pathlib import Path

import pytest

from tribodyn.errors import InputError
from tribodyn.input.csv_files import read_curve
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


@pytest.mark.parametrize(
    "text",
    [
        "roll_angle [deg];error [um]\n-20;8\n-13,5;8\n0;0\n",
        "roll_angle [deg]\terror [um]\r\n-20\t8\r\n-13,5\t8,0\r\n0\t0\r\n",
        "sep=;\nroll_angle [deg];error [um]\n-20;8\n-13.5;8\n0;0\n",
        '"roll_angle [deg]";"error [um]"\n"-20";"8"\n"-13,5";"8"\n"0";"0"\n',
        "roll_angle;error\n[deg];[um]\n-20;8\n-1,35e1;8\n0;0\n",
        "error,roll_angle\num,deg\n8,-20\n8,-13.5\n0,0\n",
        "roll_angle [deg];error [um];remark\n-20;8;\n-13,5;8;a, b\n0;0;\n",
    ],
)
def test_files_as_other_programs_write_them(tmp_path: Path, text: str):
    """Decimal commas, tabs, lines that name the separator, quotes, a line of units, a column of remarks."""
    found = read(tmp_path, text)
    assert {name: column["values"] for name, column in found.items()} == POINTS
    assert [column["unit"] for column in found.values()] == ["deg", "um"]


def test_a_line_of_units_with_a_unit_of_one(tmp_path: Path):
    """A load without dimension has the unit 1; a line of numbers alone holds values."""
    path = tmp_path / "cycle.csv"
    path.write_text("time;load\ns;1\n0;0,5\n1;1\n", encoding="utf-8")
    found = read_curve(path, "cycle.table", ["time", "load"])
    assert [column["unit"] for column in found.values()] == ["s", "1"]
    path.write_text("time;load\n1;1\n", encoding="utf-8")
    with pytest.raises(InputError, match="no column"):
        read_curve(path, "cycle.table", ["time", "load"])


def test_a_list_with_a_wrong_value_is_not_too_short():
    """Of a list whose value is refused only that value is said."""
    values = {"unit": "N*m", "values": [0, float("nan")]}
    with pytest.raises(InputError) as refused:
        load_scenario("start-from-rest", {"operating.torque_speed_curve.torque": values})
    assert "values.1" in str(refused.value)
    assert "fewer" not in str(refused.value)


def test_one_column_is_not_cut_at_decimal_commas(tmp_path: Path):
    """Under a header of one column 1,234 may be one number or two, of thousands or of one."""
    path = tmp_path / "pitch.csv"
    for cell in ("1,234", "0,5"):
        path.write_text(f"error [um]\n{cell}\n", encoding="utf-8")
        with pytest.raises(InputError, match=f'2 values under a header of 1, separated by commas: "{cell}"'):
            read_curve(path, "pitch_errors", ["error"])


def test_a_case_of_another_program(tmp_path: Path):
    """A row of three values under two columns is no row of two, wherever a scenario names the file."""
    path = tmp_path / "relief.csv"
    path.write_text("roll_angle [deg],error [um]\n-20,8\n-13,5,8\n0,0\n", encoding="utf-8")
    for key in ("mesh.transmission_error.table", "drive.gear.modification.profile_error"):
        with pytest.raises(InputError, match="line 3: 3 values under a header of 2"):
            load_scenario("involute-18-36", {key: str(path)})


HEAD, MIXED = "roll_angle [deg],error [um]\n", "roll_angle [deg];error [um]\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            HEAD + "-20,8\n-13,5,8\n0,0\n",
            ('line 3: 3 values under a header of 2, separated by commas: "-13,5,8"', "point", "semicolons"),
        ),
        (HEAD + '-20,8\n"-13,5",8\n', ("line 3", "a comma in a number", 'write a decimal point: "-13.5"')),
        (
            HEAD + "-20\n",
            ("line 2: 1 value under a header of 2, separated by commas", "each column its value"),
        ),
        (HEAD.strip() + ",remark\n-20,8\n", ("line 2: 2 values under a header of 3",)),
        (MIXED + "-13,5;8.5\n", ('"-13,5" has a comma, and "8.5" in line 2 a point', "thousands")),
        (MIXED + "1.234,5;8\n", ('"1.234,5" has a comma', "thousands")),
        (MIXED + "1,234;8\n2,468;9\n", ('line 2: "1,234" has a separator of thousands', "write 1234, or")),
        (MIXED + "-1,234,567;8\n0,5;9\n", ('"-1,234,567" has a separator of thousands', "write -1234567")),
        (MIXED + "1 234;8\n", ('"1 234" has a separator of thousands',)),
        (MIXED + "1.234.567;8\n", ('"1.234.567" has a separator of thousands',)),
        (MIXED + "-13,5,8\n", ("the row is separated by commas, the header by semicolons",)),
        (MIXED + "1_000;8\n", ('"1_000" is not a number',)),
        ("sep=|\n" + HEAD, ('"sep=|": no such separator', "semicolons, tabs, commas")),
        ("roll_angle;error\n1;2\n", ('no column "roll_angle [unit]"',)),
        ("roll_angle;error\ndeg;um;mm\n1;2\n", ('no column "roll_angle [unit]"',)),
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
