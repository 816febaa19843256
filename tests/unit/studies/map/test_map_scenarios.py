"""What a file of a map may say, and what is said of one that may not; its short form of Python."""

from pathlib import Path
from typing import Any

import pytest

import tribodyn as td
from tests.support.verbs import complaint
from tribodyn.errors import InputError
from tribodyn.studies.map.looked_up import axis_of, loaded_map
from tribodyn.studies.protocol.load import load_data

RPM = 3.141592653589793 / 30.0
REDUCER = {"title": "A map", "kind": "map", "scenario": {"like": "two-stage-reducer"}}


def case(**table: Any) -> Any:
    return load_data({**REDUCER, "map": table}, "mine").case


def refusal(**table: Any) -> str:
    with pytest.raises(InputError) as error:
        case(**table)
    return str(error.value)


def test_ranges_and_lists_are_the_same_axes():
    spread = case(torque={"from": "0 N*m", "to": "100 N*m", "points": 5}).axes[0]
    assert spread.tolist() == case(torque=[f"{x} N*m" for x in (0, 25, 50, 75, 100)]).axes[0].tolist()
    steps = case(speed={"from": "1 rpm", "to": "1000 rpm", "points": 4, "spacing": "log"}).axes[1] / RPM
    assert steps.tolist() == pytest.approx([1.0, 10.0, 100.0, 1000.0], rel=1e-12)
    assert case(oil_temperature=["70 degC"]).axes[2].tolist() == [343.15]


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"torque": ["-5 N*m", "5 N*m"]}, ["map.torque", "passes through 0", 'write directions = "both"']),
        ({"torque": ["-5 N*m", "-1 N*m"]}, ["lies below 0", 'write directions = "back"']),
        ({"torque": ["-5 N*m"], "directions": "forward"}, ["lies below 0", 'directions = "forward"']),
        ({"torque": ["-5 N*m"], "directions": "both"}, ["lies below 0", 'write directions = "back"']),
        ({"torque": ["-5 N*m", "5 N*m"], "directions": "back"}, ["passes through 0", 'write "both"']),
        ({"torque": ["5 N*m", "5 N*m"]}, ["value 2 repeats the one before it", "write each value once"]),
        ({"speed": ["5 rpm", "9 rpm", "7 rpm"]}, ["value 3 is below the one before it", "increasing order"]),
        ({"speed": []}, ["an empty list"]),
        (
            {"speed": {"from": "0 rpm", "to": "9 rpm", "points": 3, "spacing": "log"}},
            ["0 has no logarithm", "start above 0"],
        ),
        ({"speed": {"from": "9 rpm", "to": "9 rpm", "points": 3}}, ["let to be greater than from"]),
        ({"speed": {"from": "1 rpm", "to": "9 rpm", "points": 1}}, ["map.speed.points"]),
        ({"speed": ["5"]}, ["a number without a unit"]),
        (
            {"oil_temperature": ["70 degC", "250 degC"]},
            ["map.oil_temperature", "250 degC", "-40 to 180 degC"],
        ),
        ({"directions": "upwards"}, ["map.directions", '"forward"', '"both"']),
        ({"accuracy": 0.7}, ["map.accuracy", "0.5"]),
        ({"most_points": 0}, ["map.most_points"]),
        ({"axis": 3}, ["map.axis", "unknown key"]),
    ],
)
def test_a_mistake_is_said_with_key_rule_and_remedy(table: dict[str, Any], words: list[str]):
    message = refusal(**table)
    assert "\n" not in message
    for word in words:
        assert word in message


def test_an_oil_without_a_data_sheet_is_known_at_one_temperature():
    data = {
        **REDUCER,
        "scenario": {"like": "involute-23-47"},
        "map": {"oil_temperature": ["20 degC", "60 degC"]},
    }
    with pytest.raises(InputError, match="given at one temperature") as error:
        load_data(data, "mine")
    assert error.value.key == "map.oil_temperature.0"


def test_what_is_no_gearbox_is_refused():
    for name in ("irefc", "map-two-stage-reducer"):
        with pytest.raises(InputError, match="is no gearbox") as error:
            load_data({**REDUCER, "scenario": {"like": name}}, "mine")
        assert error.value.key == "scenario.kind"


def test_mistakes_of_the_gearbox_are_named_in_its_table():
    data = {**REDUCER, "scenario": {"like": "two-stage-reducer", "operating": {"input_speed": "0 rpm"}}}
    with pytest.raises(InputError) as error:
        load_data(data, "mine")
    assert error.value.key.startswith("scenario.operating.input_speed")


def test_the_short_form_is_the_long_one():
    short = loaded_map(
        "two-stage-reducer", {"torque": axis_of("torque", "0:100/5N*m"), "directions": "both"}, {}
    )
    long = case(torque={"from": "0 N*m", "to": "100 N*m", "points": 5}, directions="both")
    assert [axis.tolist() for axis in short.case.axes] == [axis.tolist() for axis in long.axes]
    assert short.case.name == "two-stage-reducer-map"
    changed = loaded_map("map-two-stage-reducer", {"accuracy": 0.0}, {"operating.input_speed": "1000 rpm"})
    assert changed.case.accuracy == 0.0
    assert changed.case.nominal.input_speed == pytest.approx(1000 * RPM)
    assert axis_of("speed", "0,50,100rpm") == ["0 rpm", "50 rpm", "100rpm"]
    with pytest.raises(InputError, match="empty range") as error:
        axis_of("speed", "5:5/3rpm")
    assert error.value.key == "--speed"


def test_the_verb_says_what_is_wrong_in_a_line(tmp_path: Path):
    assert "--torque" in complaint("map", "two-stage-reducer", "--torque", "0:5:zN*m")
    assert "no direction is stated" in complaint("map", "two-stage-reducer", "--torque=-5,5N*m")
    with pytest.raises(InputError, match="no such scenario"):
        td.map("no-such-reducer")


def test_an_oil_of_one_temperature_needs_to_be_told_which():
    of_paper = {**REDUCER, "scenario": {"like": "involute-23-47"}}
    with pytest.raises(InputError, match=r"(?s)map.oil_temperature.*is not known.*60 degC"):
        load_data({**of_paper, "map": {}}, "mine")
    told = load_data({**of_paper, "map": {"oil_temperature": ["60 degC"]}}, "mine").case
    assert told.axes[2].tolist() == [told.nominal.oil_temperature] == [333.15]
    with pytest.raises(InputError, match="not known at another"):
        load_data({**of_paper, "map": {"oil_temperature": ["60 degC", "70 degC"]}}, "mine")


def test_a_gearbox_without_a_load_is_mapped_without_one():
    idle = {
        "like": "spur-25-51",
        "operating": {"gear_torque": "0 N*m"},
        "mesh": {"backlash": "50 um"},
        "friction": {"law": "coulomb", "coefficient": 0.05},
    }
    data = {**REDUCER, "scenario": idle}
    loaded = load_data(data, "mine")
    assert loaded.case.axes[0].tolist() == [0.0]
    assert loaded.study.quantities_of(loaded.case)["own_power_loss"] == 0.0
    loaded = load_data({**data, "map": {"torque": ["5 N*m"]}}, "mine")
    with pytest.raises(InputError, match="in proportion to those of its gearbox, and that has none") as error:
        loaded.study.check(loaded.case)
    assert error.value.key == "map.torque"
