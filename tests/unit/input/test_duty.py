"""Speed and load of a drive, however they are given."""

import math

import pytest

from tribodyn.errors import InputError
from tribodyn.input.tables.duty import DutyTable, broken_duty_rules, duty_of
from tribodyn.studies.protocol.load import load

SPEED = 1800 * 2 * math.pi / 60
RATIO = 60 / 25
TORQUE = 20e3 / SPEED * RATIO
#: The same duty, in every way in which it can be said.
SPEEDS = ({"pinion_speed": "1800 rpm"}, {"gear_speed": "750 rpm"})
LOADS = (
    {"power": "20 kW"},
    {"gear_torque": f"{TORQUE!r} N*m"},
    {"pinion_torque": f"{TORQUE / RATIO!r} N*m"},
)


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("given", LOADS)
def test_the_same_duty_however_it_is_given(speed: dict[str, str], given: dict[str, str]):
    table = DutyTable.model_validate(speed | given)
    assert broken_duty_rules(table) == []
    duty = duty_of(table, 25, 60)
    assert duty.pinion_speed == pytest.approx(SPEED, rel=1e-12)
    assert duty.gear_torque == pytest.approx(TORQUE, rel=1e-12)


@pytest.mark.parametrize(
    ("given", "key", "rule"),
    [
        ({}, "output_torque", "missing"),
        ({"power": "1 kW"}, "power", "gives no torque without a speed"),
        ({"gear_torque": "1 N*m"}, "input_speed", "missing"),
        (SPEEDS[0] | SPEEDS[1] | LOADS[0], "output_speed", "as input_speed does"),
        (SPEEDS[0] | LOADS[0] | LOADS[1], "power", "as output_torque does"),
        (SPEEDS[0] | LOADS[2] | LOADS[1], "input_torque", "as output_torque does"),
    ],
)
def test_too_much_or_too_little_is_named(given: dict[str, str], key: str, rule: str):
    broken = broken_duty_rules(DutyTable.model_validate(given))
    assert any(error.key == f"operating.{key}" and rule in error.rule and error.remedy for error in broken)


def test_without_power_a_speed_may_be_unneeded():
    table = DutyTable.model_validate({"pinion_torque": "10 N*m"})
    assert broken_duty_rules(table, speed_needed=False) == []
    assert duty_of(table, 20, 40).gear_torque == 20.0


PAIR = {
    "drive.pinion.profile_shift": 0.2,
    "drive.centre_distance": "106.9 mm",
    "operating.gear_torque": "300 N*m",
}


def test_the_dynamics_use_the_backlash_of_the_centre_distance():
    assert load("involute-shifted-23-47").case.pair.mesh.backlash is None
    backlash = load("involute-shifted-23-47", PAIR).case.pair.mesh.backlash
    alpha, reference = math.radians(20), 105e-3
    working = math.acos(reference * math.cos(alpha) / 106.9e-3)
    opened = 70 * (math.tan(working) - working - math.tan(alpha) + alpha) - 2 * 0.3 * math.tan(alpha)
    assert backlash == pytest.approx(3e-3 * math.cos(alpha) * opened, rel=1e-9)
    assert load("involute-shifted-23-47", PAIR | {"mesh.backlash": "0.1 mm"}).case.pair.mesh.backlash == 1e-4


def test_a_case_names_the_file_of_a_power_without_speed(tmp_path):
    file = tmp_path / "lc.toml"
    file.write_text(
        'title = "t"\nkind = "load-contact"\ndrive = "diez-ibarbia-18-36"\n[operating]\npower = "20 kW"\n'
    )
    with pytest.raises(InputError, match=r"lc.toml: operating.power = .*without a speed; add pinion_speed"):
        load(file)
    assert load(file, {"operating.gear_speed": "100 rad/s"}).case.operating.gear_torque == pytest.approx(
        200.0
    )
