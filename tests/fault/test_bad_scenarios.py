"""Every mistake in a scenario gives one clear line: file, full key, value, rule, remedy; exit status 2."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

Refused = Callable[..., tuple[int, list[str]]]


class Mistake(NamedTuple):
    """What is replaced in the scenario by what, and what the message must say."""

    old: str
    new: str
    key: str
    rule: str
    remedy: str


SPEED = '"10 rad/s"'
TORQUE = 'gear_torque = "500 N*m"'
ENERGY = 'compliance = "energy"'
IN_TEXT = {
    "unknown key": Mistake(
        TORQUE, TORQUE + "\ngear_torqe = 5", "operating.gear_torqe = 5", "unknown key", '"gear_torque"?'
    ),
    "missing key": Mistake(TORQUE, "", "operating.gear_torque", "missing", 'add gear_torque = "500 N*m"'),
    "missing table": Mistake('[friction]\nlaw = "none"', "", "friction", "missing", "table [friction]"),
    "missing reference": Mistake(
        'lubricant = "liu-ni-2022"', "", "lubricant", "missing", "a file in models/lubricants"
    ),
    "bare number": Mistake(
        SPEED,
        "10",
        "operating.pinion_speed = 10",
        "a number without a unit",
        'write a quantity with a unit of angular speed, such as "10 rad/s"',
    ),
    "negative number": Mistake(
        "0.05", "-0.05", "mesh.damping_ratio = -0.05", "must be at least 0", "write 0 or more"
    ),
    "zero torque": Mistake(
        '"500 N*m"', '"0 N*m"', "operating.gear_torque = 0 N*m", "must be greater than zero", "backlash"
    ),
    "fraction of a cycle": Mistake(
        "cycles = 2", "cycles = 2.5", "solver.cycles = 2.5", "not a whole number", "such as 20"
    ),
    "rtol": Mistake("cycles = 2", "rtol = 0.5", "solver.rtol = 0.5", "must be at most 0.01", "or less"),
    "unknown choice": Mistake(
        '"energy"', '"enrgy"', 'mesh.compliance = "enrgy"', "not one of the choices", 'mean "energy"?'
    ),
    "unknown law": Mistake(
        '"none"', '"masjedi"', 'friction.law = "masjedi"', "no such friction law", '"masjedi-khonsari"?'
    ),
    "list for a table": Mistake(
        '"liu-ni-2022"', "[1, 2]", "lubricant = [1, 2]", "not a table", "write a table"
    ),
    "motor without torque source": Mistake(
        TORQUE,
        TORQUE + '\npinion_torque = "5 N*m"',
        "operating.pinion_torque",
        'contradicts source = "speed"',
        'write source = "torque"',
    ),
    "shaft without motor inertia": Mistake(
        TORQUE,
        TORQUE + '\nsource = "torque"\nshaft_stiffness = "1e4 N*m/rad"',
        "operating.drive_inertia",
        "needs a motor with inertia",
        "leave shaft_stiffness out",
    ),
    "constant without stiffness": Mistake(
        ENERGY, 'compliance = "constant"', "mesh.stiffness", "missing", 'stiffness = "2.8e8 N/m"'
    ),
    "table without table": Mistake(
        ENERGY, 'compliance = "table"', "mesh.table", "missing", "columns roll_angle and stiffness"
    ),
    "Coulomb without coefficient": Mistake(
        '"none"', '"coulomb"', "friction.coefficient", "missing", "add coefficient = "
    ),
    "coefficient without Coulomb": Mistake(
        '"none"',
        '"none"\ncoefficient = 0.1',
        "friction.coefficient = 0.1",
        'contradicts law = "none"',
        "leave",
    ),
    "missing CSV": Mistake(
        TORQUE,
        TORQUE + '\ngear_torque_table = "none.csv"',
        'operating.gear_torque_table = "none.csv"',
        "no such file",
        "time [unit],torque [unit]",
    ),
    "TOML syntax": Mistake(SPEED, "10 rad/s", "line 7", "not TOML", "with quotes round text and quantities"),
}

WITH_SET = {
    "pinion without teeth": ("drive.pinion.teeth=0", "drive.pinion.teeth = 0", "must be at least 4"),
    "no material": ("drive.material=stel", 'drive.material = "stel"', "no such file in models/materials"),
    "Poisson's ratio": (
        "drive.material.poisson_ratio=0.5",
        "drive.material.poisson_ratio = 0.5",
        "must be less than 0.5",
    ),
    "bearing twice": (
        "bearings.gear.damping_ratio_x=0.1",
        "bearings.gear.damping_ratio = 0.05",
        "contradicts damping_ratio_x and damping_ratio_y",
    ),
    "through a number": ("solver.cycles.more=1", "solver.cycles.more", "is not a table"),
    "an oil's grade": (
        'lubricant="ISO VG 320"',
        'lubricant = "ISO VG 320"',
        'did you mean "iso-vg-320-mineral" or "iso-vg-320-pao"?',
    ),
    "a range": (
        "operating.pinion_speed=500-6000rpm",
        'operating.pinion_speed = "500-6000rpm"',
        'a range, where one value is expected; write "500 rpm"',
    ),
    "a range of a plain number": (
        "mesh.damping_ratio=0.01-0.1",
        'mesh.damping_ratio = "0.01-0.1"',
        "a range, where one value is expected; write 0.01",
    ),
    "no value": ("solver.cycles", '--set = "solver.cycles"', "not KEY=VALUE"),
    "no key": ("=3", '--set = "=3"', "not KEY=VALUE"),
}


@pytest.mark.parametrize("mistake", IN_TEXT.values(), ids=list(IN_TEXT))
def test_a_mistake_in_the_file(refused: Refused, scenario: Path, mistake: Mistake):
    text = scenario.read_text(encoding="utf-8")
    assert mistake.old in text
    scenario.write_text(text.replace(mistake.old, mistake.new, 1), encoding="utf-8")
    code, lines = refused("check", str(scenario))
    assert code == 2
    (line,) = lines
    assert line.startswith(f"{scenario}: {mistake.key}")
    rule, _, remedy = line.removeprefix(f"{scenario}: ").partition("; ")
    assert mistake.rule in rule
    assert mistake.remedy in remedy


@pytest.mark.parametrize(("setting", "key", "rule"), WITH_SET.values(), ids=list(WITH_SET))
def test_a_mistake_on_the_command_line(refused: Refused, scenario: Path, setting: str, key: str, rule: str):
    code, lines = refused("check", str(scenario), "--set", setting)
    assert code == 2
    (line,) = lines
    assert key in line
    assert rule in line
    assert ";" in line


def test_all_mistakes_are_listed_one_a_line_each_with_its_own_file(refused: Refused, scenario: Path):
    text = scenario.read_text(encoding="utf-8")
    text = text.replace(SPEED, "10").replace('"none"', '"none"\nlaws = 1').replace("cycles", "cycels")
    scenario.write_text(text, encoding="utf-8")
    code, lines = refused("check", str(scenario), "--set", "drive.pinion.teeth=-1", "--set", "lubricant=oil")
    assert code == 2
    assert [line.split(" = ")[0] for line in lines] == [
        f"{scenario}: --set: lubricant".removeprefix(f"{scenario}: "),
        "--set: drive.pinion.teeth",
        f"{scenario}: operating.pinion_speed",
        f"{scenario}: friction.laws",
        f"{scenario}: solver.cycels",
    ]


def test_a_scenario_that_is_not_there(refused: Refused, tmp_path: Path, scenario: Path):
    for name, near in (("crc-23-74", "crc-23-47"), (str(tmp_path / "mime.toml"), str(scenario))):
        code, lines = refused("run", name)
        assert code == 2
        (line,) = lines
        assert line.startswith(f'scenario = "{name}": no such')
        assert f'did you mean "{near}"?' in line


def test_a_scenario_that_cannot_be_read(refused: Refused, tmp_path: Path):
    folder, binary = tmp_path / "folder.toml", tmp_path / "binary.toml"
    folder.mkdir()
    binary.write_bytes(b'title = "\xff\xfe"')
    for path, rule in ((folder, "no such file"), (binary, "not UTF-8 text")):
        code, lines = refused("check", str(path))
        assert code == 2
        assert len(lines) == 1
        assert rule in lines[0]


def test_a_negative_number_of_teeth_names_the_table_of_that_gear(refused: Refused):
    code, (line,) = refused("check", "two-stage-reducer", "--set", "gear.wheel-1.teeth=-82")
    assert code == 2
    assert "write internal = true in [gear.wheel-1]" in line
    code, (line,) = refused("check", "crc-23-47", "--set", "drive.gear.teeth=-47")
    assert "write internal = true in [drive.gear]" in line


def test_the_kind_of_a_scenario_is_not_set(refused: Refused):
    code, (line,) = refused("check", "crc-23-47", "--set", "kind=efficiency")
    assert code == 2
    assert line.startswith('--set: kind = "efficiency": the kind of a scenario cannot be set')
    assert "tribodyn init NAME --kind efficiency" in line
