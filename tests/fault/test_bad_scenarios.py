"""Every mistake in a scenario gives one clear line: file, full key, value, rule, remedy; exit status 2."""

from pathlib import Path

import pytest

from tests.support.verbs import complaint, complaints

SPEED, TORQUE = '"10 rad/s"', 'gear_torque = "500 N*m"'
ENERGY, NONE, OIL = 'compliance = "energy"', '"none"', "lubricant"
CSV = 'gear_torque_table = "none.csv"'
SHAFT = 'source = "torque"\nshaft_stiffness = "1e4 N*m/rad"'
#: What is replaced in the scenario by what; key, rule and remedy of the message.
IN_TEXT = [
    (TORQUE, f"{TORQUE}\ngear_torqe = 5", "operating.gear_torqe = 5", "unknown key", '"gear_torque"?'),
    (TORQUE, "", "operating.gear_torque", "missing", f"add {TORQUE}"),
    ('[friction]\nlaw = "none"', "", "friction", "missing", "table [friction]"),
    ('lubricant = "liu-ni-2022"', "", OIL, "missing", "a file in models/lubricants"),
    (
        SPEED,
        "10",
        "operating.pinion_speed = 10",
        "a number without a unit",
        f"of angular speed, such as {SPEED}",
    ),
    ("0.05", "-0.05", "mesh.damping_ratio = -0.05", "must be at least 0", "write 0 or more"),
    ('"500 N*m"', '"0 N*m"', "operating.gear_torque = 0 N*m", "must be greater than zero", "backlash"),
    ("cycles = 2", "cycles = 2.5", "solver.cycles = 2.5", "not a whole number", "such as 20"),
    ("cycles = 2", "rtol = 0.5", "solver.rtol = 0.5", "must be at most 0.01", "or less"),
    ('"energy"', '"enrgy"', 'mesh.compliance = "enrgy"', "not one of the choices", 'mean "energy"?'),
    (NONE, '"masjedi"', 'friction.law = "masjedi"', "no such friction law", '"masjedi-khonsari"?'),
    ('"liu-ni-2022"', "[1, 2]", "lubricant = [1, 2]", "not a table", "write a table"),
    (
        *(TORQUE, f'{TORQUE}\npinion_torque = "5 N*m"', "operating.pinion_torque"),
        *('contradicts source = "speed"', 'write source = "torque"'),
    ),
    (
        *(TORQUE, f"{TORQUE}\n{SHAFT}", "operating.drive_inertia"),
        *("needs a motor with inertia", "leave shaft_stiffness out"),
    ),
    (ENERGY, 'compliance = "constant"', "mesh.stiffness", "missing", 'stiffness = "2.8e8 N/m"'),
    (ENERGY, 'compliance = "table"', "mesh.table", "missing", "columns roll_angle and stiffness"),
    (NONE, '"coulomb"', "friction.coefficient", "missing", "add coefficient = "),
    (NONE, f"{NONE}\ncoefficient = 0.1", "friction.coefficient = 0.1", f"contradicts law = {NONE}", "leave"),
    (TORQUE, f"{TORQUE}\n{CSV}", f"operating.{CSV}", "no such file", "time [unit],torque [unit]"),
    (SPEED, "10 rad/s", "line 7", "not TOML", "with quotes round text and quantities"),
]


@pytest.mark.parametrize(("old", "new", "key", "rule", "remedy"), IN_TEXT)
def test_a_mistake_in_the_file(scenario: Path, old: str, new: str, key: str, rule: str, remedy: str):
    text = scenario.read_text(encoding="utf-8")
    assert old in text
    scenario.write_text(text.replace(old, new, 1), encoding="utf-8")
    line = complaint("check", scenario)
    assert line.startswith(f"{scenario}: {key}")
    said = line.removeprefix(f"{scenario}: ").partition("; ")
    assert rule in said[0]
    assert remedy in said[2]


RANGE = "a range, where one value is expected; write"
GRADES = 'did you mean "iso-vg-320-mineral" or "iso-vg-320-pao"?'
SPRINGS = '{ stiffness_x = "1e6 N/m", stiffness_y = "1e6 N/m", damping_ratio = 0.05 }'
BEARING = "bearings.gear.damping_ratio"
WITH_SET = [
    ("drive.pinion.teeth=0", "drive.pinion.teeth = 0", "must be at least 4"),
    ("drive.material=stel", 'drive.material = "stel"', "no such file in models/materials"),
    ("drive.material.poisson_ratio=0.5", "drive.material.poisson_ratio = 0.5", "must be less than 0.5"),
    (f"{BEARING}_x=0.1", f"{BEARING} = 0.05", "contradicts damping_ratio_x and damping_ratio_y"),
    ("bearings.damping_ratio=0.05", "bearings.damping_ratio = 0.05", "[bearings.pinion] and [bearings.gear]"),
    (f"bearings.default={SPRINGS}", "bearings.default", "has no effect: pinion and gear have bearings"),
    ("like=spur-25-51", 'like = "spur-25-51"', "takes up no other one"),
    ("solver.cycles.more=1", "solver.cycles.more", "is not a table"),
    ('lubricant="ISO VG 320"', 'lubricant = "ISO VG 320"', GRADES),
    ("operating.pinion_speed=500-6000rpm", 'operating.pinion_speed = "500-6000rpm"', f'{RANGE} "500 rpm"'),
    ("mesh.damping_ratio=0.01-0.1", 'mesh.damping_ratio = "0.01-0.1"', f"{RANGE} 0.01"),
    ("solver.cycles", '--set = "solver.cycles"', "not KEY=VALUE"),
    ("=3", '--set = "=3"', "not KEY=VALUE"),
    (
        "kind=efficiency",
        '--set: kind = "efficiency": the kind of a scenario cannot be set',
        "--kind efficiency",
    ),
]


@pytest.mark.parametrize(("setting", "key", "rule"), WITH_SET)
def test_a_mistake_on_the_command_line(scenario: Path, setting: str, key: str, rule: str):
    line = complaint("check", scenario, "--set", setting)
    assert key in line
    assert rule in line
    assert ";" in line


def test_all_mistakes_are_listed_one_a_line_each_with_its_own_file(scenario: Path):
    text = scenario.read_text(encoding="utf-8")
    text = text.replace(SPEED, "10").replace('"none"', '"none"\nlaws = 1').replace("cycles", "cycels")
    scenario.write_text(text, encoding="utf-8")
    lines = complaints("check", scenario, "--set", "drive.pinion.teeth=-1", "--set", "lubricant=oil")
    assert [line.split(" = ")[0] for line in lines] == [
        "--set: lubricant",
        "--set: drive.pinion.teeth",
        f"{scenario}: operating.pinion_speed",
        f"{scenario}: friction.laws",
        f"{scenario}: solver.cycels",
    ]


def test_a_scenario_that_is_not_there(tmp_path: Path, scenario: Path):
    for name, near in (("crc-23-74", "crc-23-47"), (str(tmp_path / "mime.toml"), str(scenario))):
        line = complaint("run", name)
        assert line.startswith(f'scenario = "{name}": no such')
        assert f'did you mean "{near}"?' in line


def test_a_scenario_that_cannot_be_read(tmp_path: Path):
    folder, binary = tmp_path / "folder.toml", tmp_path / "binary.toml"
    folder.mkdir()
    binary.write_bytes(b'title = "\xff\xfe"')
    assert "a folder" in complaint("check", folder)
    assert "not UTF-8 text" in complaint("check", binary)
