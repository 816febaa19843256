"""`td.check` gives what `tribodyn check --json` prints: every number of every kind, in SI units."""

import json
from pathlib import Path
from typing import Any

import pytest

import tribodyn as td
from tests.support.short_studies import SHORT, shortened, written_template
from tests.support.verbs import invoke
from tribodyn.cli.printing import plain
from tribodyn.input.sources import find_scenario
from tribodyn.quantities.quantity import SHOWN
from tribodyn.studies import STUDIES

#: Units in which numbers are shown to people and kept in another.
NOT_SI = {unit for unit, (si, factor, _) in SHOWN.items() if unit and (si, factor) != (unit, 1.0)}


def units_in(data: Any) -> set[str]:
    """Units of all pairs of a number and a unit."""
    if isinstance(data, dict):
        return set().union(*(units_in(value) for value in data.values()))
    if isinstance(data, list):
        if len(data) == 2 and isinstance(data[1], str) and isinstance(data[0], (int, float)):
            return {data[1]}
        return set().union(*(units_in(value) for value in data))
    return set()


@pytest.mark.parametrize("kind", sorted(STUDIES))
def test_python_and_json_say_the_same(kind: str, tmp_path: Path):
    path = written_template(kind, tmp_path)
    data = json.loads(invoke("check", path, "--json", *shortened(kind)))
    assert plain(td.check(path, SHORT.get(kind))) == data
    assert not units_in(data) & NOT_SI


def test_a_duty_in_si():
    """25 kW at 1500 rpm and 318.3 N m, 18 and 36 teeth, in newton metres, watts and radians per second."""
    duty = td.check("involute-18-36")["duty"]
    speed = 1500 / 60 * 2 * 3.141592653589793
    assert duty["speed of the pinion"] == (pytest.approx(speed), "rad/s")
    assert duty["power"] == (pytest.approx(318.3 / 2 * speed), "W")


def test_a_case_has_a_name_in_place_of_a_file():
    case = td.scenario("involute-18-36")
    named, of_case = td.check("involute-18-36"), td.check(case)
    assert Path(named["scenario"]).samefile(find_scenario("involute-18-36"))
    assert of_case["scenario"] == "involute-18-36"
    assert {**of_case, "scenario": named["scenario"]} == named
