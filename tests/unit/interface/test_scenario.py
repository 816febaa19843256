"""Scenarios from Python: whatever names or describes them, and values of NumPy and pint."""

from pathlib import Path

import numpy as np
import pint
import pytest

import tribodyn as td
from tribodyn.input.units import registry
from tribodyn.interface.scenario import in_toml

UNIT = pint.UnitRegistry()
TABLES = {
    "title": "Mine",
    "drive": "liu-ni-crc-23-47",
    "lubricant": "liu-ni-2022",
    "operating": {"pinion_speed": "100 rad/s", "gear_torque": "500 N*m"},
    "mesh": {"damping_ratio": 0.05},
    "friction": {"law": "coulomb", "coefficient": 0.05},
}


def with_speed(speed):
    return {**TABLES, "operating": {"pinion_speed": speed, "gear_torque": "1 N*m"}}


def test_tables_are_a_scenario_file(tmp_path: Path):
    file = tmp_path / "scenario.toml"
    file.write_text(td.scenario(TABLES).toml, encoding="utf-8")
    assert td.scenario(file).sha256 == td.scenario(str(file)).sha256 == td.scenario(TABLES).sha256


@pytest.mark.parametrize("unit", [UNIT, registry()], ids=["another registry", "our registry"])
def test_values_of_numpy_and_pint(unit):
    given = {
        **TABLES,
        "operating": {
            "pinion_speed": 100.0 * unit.rad / unit.s,
            "gear_torque": np.float64(0.5) * unit.kN * unit.m,
        },
        "mesh": {"damping_ratio": np.float32(0.25)},
    }
    case = td.scenario(given, {"solver.cycles": np.int64(3)})
    assert case.pair.operating.pinion_speed == pytest.approx(100.0, rel=1e-14)
    assert case.pair.operating.gear_torque == pytest.approx(500.0, rel=1e-14)
    assert (case.pair.mesh.damping_ratio, case.solver.cycles) == (0.25, 3)


def test_plain_data_of_arrays():
    assert in_toml({"a": np.arange(3), "b": (np.float64(1.5), None), "c": None}) == {
        "a": [0, 1, 2],
        "b": [1.5, None],
    }
    assert in_toml(np.array([1.0, 2.0]) * UNIT.mm) == ["1.0 millimeter", "2.0 millimeter"]
    assert in_toml(np.array([0.25]) * UNIT.dimensionless) == [0.25]


def test_a_case_with_overrides_is_another_case():
    first = td.scenario("crc-23-47")
    assert td.scenario(first) is first
    other = td.scenario(first, {"operating.gear_torque": "600 N*m"})
    assert other.pair.operating.gear_torque == 600.0
    assert other.sha256 == td.scenario("crc-23-47", {"operating.gear_torque": "600 N*m"}).sha256


def test_errors_name_what_python_has():
    for call in (
        lambda: td.scenario("crc-23-47", {"operating.gear_torqe": "1 N*m"}),
        lambda: td.drive("liu-ni-crc-23-47", {"drive.pinion.profile_shift": "3 mm"}),
    ):
        with pytest.raises(td.InputError, match=r"^overrides: "):
            call()
    with pytest.raises(td.InputError, match=r"^vary: "):
        td.sweep("crc-23-47", {"operating.pinion_speed": [1.0, 2.0]})


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("crc-23-74", "crc-23-47"),
        (with_speed(5), "operating.pinion_speed = 5: a number without a unit"),
        (with_speed(5 * UNIT.kg), "operating.pinion_speed"),
        ({**TABLES, "friktion": {}}, "friktion"),
    ],
)
def test_mistakes_are_input_errors(source, said):
    with pytest.raises(td.InputError) as error:
        td.scenario(source)
    assert said in str(error.value)
