"""The grammar of --vary: ranges and lists of any key, in its unit."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tribodyn.errors import InputError
from tribodyn.grid.grid import Grid
from tribodyn.input.units import ANGULAR_SPEED, to_si
from tribodyn.input.vary import axes_of
from tribodyn.quantities.quantity import shown
from tribodyn.studies.motion.pair.scenario import Scenario

SPEED = "operating.pinion_speed"


def axis(option: str):
    return axes_of([option], Scenario)[0]


def test_the_range_of_the_page():
    """From 100 rpm to 6000 rpm in steps of 200 rpm: 5900 rpm is the last that a step reaches."""
    found = axis(f"{SPEED}=100:6000:200rpm")
    assert found.name == "pinion_speed"
    assert found.units == "rad/s"
    np.testing.assert_allclose(np.array(found.values) * 30 / np.pi, np.arange(100, 6000, 200), rtol=1e-14)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("10:20rad/s/3", (10.0, 15.0, 20.0)),
        ("10:20/3 rad/s", (10.0, 15.0, 20.0)),
        ("20:10:-5rad/s", (20.0, 15.0, 10.0)),
        ("10,20,25rad/s", (10.0, 20.0, 25.0)),
        ("10 rad/s, 20 rad/s", (10.0, 20.0)),
    ],
)
def test_ways_to_write_speeds(text, expected):
    assert axis(f"{SPEED}={text}").values == expected


def test_a_unit_that_begins_with_a_one():
    assert axis("lubricant.pressure_viscosity=20:24:2 1/GPa").values == (20e-9, 22e-9, 24e-9)


def test_decimal_steps_are_the_decimals():
    assert axis("mesh.damping_ratio=0.1:0.7:0.1").values == (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7)


def test_names_are_values_too():
    found = axis("friction.law=none,coulomb")
    assert found.values == ("none", "coulomb")
    assert not found.numeric
    assert axis("mesh.foundation_coupling=true,false").values == ("true", "false")


def test_names_of_axes_are_told_apart():
    found = axes_of(["drive.pinion.profile_shift=0,0.1", "drive.gear.profile_shift=0,0.1"], Scenario)
    assert [axis.name for axis in found] == ["pinion_profile_shift", "gear_profile_shift"]


@given(
    start=st.integers(1, 10**6),
    step=st.integers(1, 10**4),
    count=st.integers(2, 300),
    digits=st.integers(0, 4),
)
def test_a_range_holds_exactly_its_steps(start, step, count, digits):
    """Every value is what its decimal means, the last within a step of the end."""
    unit = Fraction(1, 10**digits)
    stop = start + step * count - 1

    def decimal(number: int) -> str:
        return f"{number / 10**digits:.{digits}f}"

    found = axis(f"{SPEED}={decimal(start)}:{decimal(stop)}:{decimal(step)}rpm")
    assert len(found.values) == count
    for i in (0, count // 2, count - 1):
        exact = (start + i * step) * unit
        assert found.values[i] == to_si(f"{float(exact)!r} rpm", ANGULAR_SPEED)


@given(ends=st.tuples(st.integers(1, 9999), st.integers(1, 9999)).filter(lambda e: e[0] != e[1]))
def test_a_count_reaches_both_ends(ends):
    found = axis(f"{SPEED}={ends[0]}:{ends[1]}/7rad/s")
    assert found.values[0] == ends[0]
    assert found.values[-1] == ends[1]
    np.testing.assert_allclose(found.values, np.linspace(*ends, 7), rtol=1e-15)


@pytest.mark.parametrize(
    ("option", "message"),
    [
        (f"{SPEED}", "not KEY=VALUES"),
        (f"{SPEED}=", "not KEY=VALUES"),
        (f"{SPEED}=100:200 r\npm", "neither a range nor a list"),
        (f"{SPEED}=100:200", "a range without a number of values or a step"),
        (f"{SPEED}=200:100:10rpm", "leads away from 100; write 200:100:-10"),
        (f"{SPEED}=100:200:0rpm", "the step is zero"),
        (f"{SPEED}=100:100/5rpm", "an empty range"),
        (f"{SPEED}=100:200/1rpm", "an empty range"),
        (f"{SPEED}=1:1e9:1e-3rpm", "1e\\+12 values"),
        (f"{SPEED}=1:5:1", "a number without a unit"),
        (f"{SPEED}=1:5:1mm", "not a unit of angular speed"),
        (f"{SPEED}=1:5:1Hz", "leaves open whether turns or radians"),
        (f"{SPEED}=-5:5:1rpm", "greater than zero"),
        (f"{SPEED}=1,,2rpm", "an empty value"),
        (f"{SPEED}=1,1rpm", "a value comes twice"),
        ("operating=1,2", "operating is a table"),
        ("title=a,b", "cannot be varied"),
        ("output.samples_per_cycle=100,200", "cannot be varied"),
    ],
)
def test_what_cannot_be_read_is_refused(option, message):
    with pytest.raises(InputError, match=message):
        axis(option)


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ("operating.pinion_spead=1:3:1rpm", 'unknown key; did you mean "pinion_speed"'),
        ("drive.gear.teeth=3:20:1", "must be at least 4"),
        ("friction.law=none,xux", 'did you mean "xu"'),
        ("drive=liu-ni-crc-23-47,foo", "no such file in models/drives"),
    ],
)
def test_what_the_scenario_does_not_take_names_the_option(option, message):
    with pytest.raises(InputError, match=message) as refused:
        Grid("crc-23-47", [option], {})
    assert str(refused.value).startswith("--vary: ")


def test_keys_reach_through_references_that_vary():
    grid = Grid("crc-23-47", ["drive=liu-ni-crc-23-47,liu-ni-involute-23-47", "drive.module=2:3:1mm"], {})
    assert grid.case((1, 1)).pair.family == "involute"
    assert grid.case((0, 0)).pair.drive.module == 0.002


def test_a_case_of_the_grid_is_the_scenario_with_its_values_set():
    from tribodyn.studies.protocol.load import load_scenario

    grid = Grid(
        "crc-23-47", [f"{SPEED}=100:900:200rpm", "operating.gear_torque=50,70 N*m"], {"solver.cycles": 3}
    )
    case = grid.case((2, 1))
    same = load_scenario(
        "crc-23-47", {SPEED: "500 rpm", "operating.gear_torque": "70 N*m", "solver.cycles": 3}
    )
    assert case.pair.operating == same.pair.operating
    assert case.solver == same.solver


def test_frequencies_are_in_hertz():
    """As nobody gives a rate in turns."""
    rate, mode = axes_of(["sensor.0.rate=10,20kHz", "housing.mode.0.frequency=1:3:1Hz"], Scenario)
    assert (rate.values, rate.units) == ((10e3, 20e3), "Hz")
    assert (mode.values, mode.units) == ((1.0, 2.0, 3.0), "Hz")
    assert shown(rate.values[0], rate.units) == "10000 Hz"
