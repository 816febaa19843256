"""Speed and load under the names of a gearbox and under those of a pair: one key, whoever asks for it."""

import tomllib

import pytest

from tribodyn.derivatives.differentiable import Differentiable
from tribodyn.errors import InputError
from tribodyn.grid.grid import Grid
from tribodyn.identification.unknowns import unknowns_of
from tribodyn.input.names import OF_PAIR
from tribodyn.studies import STUDIES
from tribodyn.studies.design.candidates.evaluation import loaded_case
from tribodyn.studies.design.candidates.sources import BASE, require_key, sources_of
from tribodyn.studies.protocol.load import json_schema, load, load_data

SCENARIO = "jump-involute-23-47"  # driven by a motor
DATA = tomllib.loads(load(SCENARIO).case.toml)
CURVE = {"time": {"unit": "s", "values": [0.0, 1.0]}, "torque": {"unit": "N*m", "values": [0.0, 5.0]}}
#: Every key in terms of a pair, with values that are not the defaults.
WRITTEN = {
    "pinion_speed": "100 rad/s",
    "gear_torque": "30 N*m",
    "pinion_torque": "15 N*m",
    "gear_torque_table": CURVE,
    "gear_torque_harmonics": [{"amplitude": "2 N*m", "frequency": "7 Hz"}],
    "source": "torque",
    "drive_inertia": "0.1 kg*m**2",
}


def case_with(operating: dict):
    return load_data({**DATA, "operating": operating}, "pair").case


def test_a_pair_is_the_same_under_either_name():
    of_gearbox = {OF_PAIR.get(name, name): value for name, value in WRITTEN.items()}
    one, other = case_with(WRITTEN), case_with(of_gearbox)
    assert repr((one.source, one.loads)) == repr((other.source, other.loads))
    assert one.source.torque == 15.0
    by_gear = {"gear_speed": "50 rad/s", "power": "1 kW"}
    by_output = {"output_speed": "50 rad/s", "power": "1 kW"}
    assert case_with(by_gear).pair.operating == case_with(by_output).pair.operating
    # and each record has the names of its file
    assert "gear_torque_table" in one.toml
    assert "output_torque" not in one.toml
    assert "output_torque_table" in other.toml
    assert "gear_torque" not in other.toml


@pytest.mark.parametrize("name", ["operating.output_torque", "operating.gear_torque"])
def test_an_override_takes_the_place_of_either(name: str):
    for written in ("gear_torque", "output_torque"):
        data = {**DATA, "operating": {"pinion_speed": "100 rad/s", written: "30 N*m"}}
        case = load_data(data, "pair", {name: "40 N*m"}).case
        assert case.pair.operating.gear_torque == 40.0
        assert tomllib.loads(case.toml)["operating"][written] == "40 N*m"


def test_an_override_reaches_into_a_table_under_either_name():
    changes = {"operating.output_torque_harmonics.0.amplitude": "3 N*m"}
    case = load_data({**DATA, "operating": WRITTEN}, "pair", changes).case
    assert case.loads[0].harmonics[0][0] == 3.0


def test_both_names_are_one_error():
    with pytest.raises(InputError) as refused:
        case_with({"pinion_speed": "100 rad/s", "input_speed": "100 rad/s", "gear_torque": "30 N*m"})
    assert str(refused.value).count("\n") == 0
    assert "operating.pinion_speed" in str(refused.value)
    assert "is input_speed by another name, and both are given; leave one of them out" in str(refused.value)


@pytest.mark.parametrize(
    ("written", "said"),
    [
        (
            {"pinion_speed": "1 rad/s"},
            'operating.gear_torque: missing: the load; add gear_torque = "500 N*m"',
        ),
        ({"input_speed": "1 rad/s"}, 'operating.output_torque: missing: the load; add output_torque = "500'),
        ({}, "add gear_torque"),
        (
            {"input_speed": "1 rad/s", "output_speed": "1 rad/s"},
            "output_speed: gives the speed, as input_speed",
        ),
        (
            {"pinion_speed": "1 rad/s", "gear_speed": "1 rad/s"},
            "gear_speed: gives the speed, as pinion_speed",
        ),
        ({"input_speed": "1 N"}, 'operating.input_speed = "1 N"'),
        ({"pinion_speed": "1 N"}, 'operating.pinion_speed = "1 N"'),
        ({"input_sped": "1 rad/s"}, 'did you mean "input_speed"'),
        ({"pinion_sped": "1 rad/s"}, 'did you mean "pinion_speed"'),
    ],
)
def test_messages_speak_as_the_file_does(written: dict, said: str):
    with pytest.raises(InputError) as refused:
        case_with(written)
    assert said in str(refused.value)


def test_a_train_has_both_names_too():
    data = {**DATA, "kind": "gear-train", "bearings": "rigid-1e9"}
    data["operating"] = {"pinion_speed": "100 rad/s", "gear_torque": "30 N*m"}
    case = load_data(data, "train", {"operating.output_torque": "40 N*m"}).case
    assert case.source.speed == 100.0
    assert case.loads[0].torque == 40.0


def test_sweeps_take_either_name():
    for name in ("operating.input_speed", "operating.pinion_speed"):
        grid = Grid(SCENARIO, [f"{name}=100,200rad/s"], {})
        assert grid.case((1,)).pair.operating.pinion_speed == 200.0
    with pytest.raises(InputError, match=r"^--vary: operating\.gear_torque = .*must be greater than zero"):
        Grid("crc-23-47", ["operating.output_torque=-5,5N*m"], {})
    with pytest.raises(InputError, match="varied twice"):
        Grid(SCENARIO, ["operating.input_speed=1,2rad/s", "operating.pinion_speed=1,2rad/s"], {})
    with pytest.raises(InputError, match="is varied too"):
        Grid(SCENARIO, ["operating.input_speed=1,2rad/s"], {"operating.pinion_speed": "3 rad/s"})


def test_searches_take_either_name():
    source, key = require_key("design.free.0.key", "operating.output_torque", sources_of({BASE: DATA}))
    assert (source.study.kind, key) == ("gear-pair", "operating.output_torque")
    case = loaded_case(DATA, {"operating.output_speed": "50 rad/s", "operating.output_torque": "40 N*m"}).case
    assert case.pair.operating.gear_torque == 40.0
    assert case.pair.operating.pinion_speed == pytest.approx(50.0 * 47 / 23)


def test_slopes_take_either_name():
    case, schema = load("efficiency-involute-18-36").case, STUDIES["efficiency"].table()
    of_pair, of_gearbox = (
        Differentiable(case, schema, ["contact_ratio"], [name])
        for name in ("operating.gear_torque", "operating.output_torque")
    )
    assert of_pair.at == of_gearbox.at
    assert of_pair.key_units == of_gearbox.key_units
    assert of_gearbox.jacobian(of_gearbox.at)[1] == of_pair.jacobian(of_pair.at)[1]


def test_identification_takes_either_name():
    case = case_with({"pinion_speed": "100 rad/s", "gear_torque": "30 N*m"})
    (unknown,) = unknowns_of(case, {"operating.output_torque": ("10 N*m", "50 N*m")})
    assert unknown.start == 30.0
    limits = ("10 N*m", "50 N*m")
    with pytest.raises(InputError, match="sought twice"):
        unknowns_of(case, {"operating.output_torque": limits, "operating.gear_torque": limits})


def test_the_schema_for_editors_knows_both():
    keys = json_schema()["$defs"]["Operating"]["properties"]
    assert OF_PAIR.keys() <= keys.keys()
    assert set(OF_PAIR.values()) <= keys.keys()
