"""The heat of a whole gearbox: the sump as a result, what carries heat away, and what is refused."""

import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

import tribodyn
from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.errors import InputError, InputErrors
from tribodyn.interface.scenario import scenario
from tribodyn.standards.micropitting import bulk_rise
from tribodyn.studies import STUDIES
from tribodyn.studies.motion.heat.nodes import heat_of
from tribodyn.studies.motion.heat.rating import rating_of
from tribodyn.studies.motion.heat.settled import in_balance, prepare_settled, warmer
from tribodyn.studies.motion.losses.gearbox import GearboxLoss
from tribodyn.studies.motion.losses.part import LOSSES
from tribodyn.studies.motion.prepare import tabulated
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

REDUCER = tomllib.loads(
    (Path(tribodyn.__file__).parents[1] / "scenarios" / "two-stage-reducer.toml").read_text(encoding="utf-8")
)
REDUCER["friction"] = {"law": "schlenk"}
del REDUCER["operating"]["oil_temperature"]
WARM = {"model": "gearbox", "ambient_temperature": "20 degC", "housing": {"area": "0.7 m**2"}}
CHURNING = {
    "churning": "changenet-velex",
    "oil_volume": "6 l",
    "immersion": {"wheel-1": "15 mm", "wheel-2": "40 mm"},
}


def reducer(**changes: Any) -> Any:
    data = REDUCER | {"losses": CHURNING, "temperature": WARM | changes.pop("temperature", {})}
    operating = {**REDUCER["operating"], **changes.pop("operating", {})}
    return scenario(data | {"operating": operating} | changes, {})


def refusal(**changes: Any) -> str:
    with pytest.raises((InputError, InputErrors)) as caught:
        reducer(**changes)
    assert not isinstance(caught.value, InputErrors) or len(caught.value.errors) == 1
    return str(caught.value)


@pytest.fixture(scope="module")
def settled() -> Any:
    return in_balance(reducer())


def test_the_sump_is_where_all_losses_leave_by_the_housing(settled):
    heat = settled.heat.settled
    assert heat.heat == pytest.approx(heat.given_off, rel=1e-6)
    bulk = [[0.5 * (one + two) for one, two in heat.gears]]
    speed = np.array([settled.source.speed])
    point = OperatingPoints(np.ones(1), speed, np.array([heat.oil]), np.array(bulk))
    lost = float(LOSSES.at(reducer(), point).power(speed).sum())
    assert heat.heat == pytest.approx(lost, rel=1e-6)
    # through two thermal resistances, one of them by the textbook's coefficients at these temperatures
    path = next(path for path in heat_of(settled).network.paths if path.two == "ambient")
    assert callable(path.conductance)
    outside = path.conductance(np.array([heat.housing]), np.array([293.15]), 0.0)[0]
    assert outside * (heat.housing - 293.15) == pytest.approx(lost, rel=1e-6)
    inside = 0.7 / (1.0 / 200.0 + 0.5 * 0.01 / 50.0)
    assert inside * (heat.oil - heat.housing) == pytest.approx(lost, rel=1e-6)


def test_every_mesh_has_a_temperature_of_its_own(settled):
    prepared = prepare_settled(settled)
    oils = [pair.lubricant.temperature for pair in prepared.warm_pairs]
    assert oils == pytest.approx([0.5 * sum(gears) for gears in settled.heat.settled.gears])
    assert abs(oils[0] - oils[1]) > 0.05
    assert min(oils) > settled.heat.settled.oil
    assert all(pair.lubricant.supply == settled.heat.settled.oil for pair in prepared.warm_pairs)
    assert prepared.case.pair.lubricant.temperature == settled.heat.settled.oil


def test_teeth_are_as_much_warmer_as_the_estimate_of_the_standard_within_a_factor_of_two(settled):
    """ISO/TR 15144-1, dip lubrication, with the same loss: another method from tests of other gears."""
    heat = settled.heat.settled
    for number, mesh in enumerate(settled.meshes):
        drive = mesh.pair.drive
        centre = 0.5 * float(drive.module * (drive.pinion.teeth + drive.gear.teeth))
        width = float(min(drive.pinion.face_width, drive.gear.face_width))
        estimate = bulk_rise(heat.losses[number], 1.0, 1.0, centre, width, 1.0)
        assert 0.5 < (0.5 * sum(heat.gears[number]) - heat.oil) / estimate < 2.0


def test_a_strong_cooler_and_a_large_flow_hold_the_oil():
    cooled = in_balance(
        reducer(temperature={"cooler": {"conductance": "1e7 W/K", "coolant_temperature": "41 degC"}})
    )
    assert cooled.heat.settled.oil == pytest.approx(314.15, abs=1e-3)
    warm = {"operating": {"oil_temperature": "55 degC"}}
    flooded = in_balance(reducer(temperature={"oil_flow": "1000 m**3/s"}, **warm)).heat.settled
    held = in_balance(reducer(**warm)).heat.settled
    assert flooded.oil == pytest.approx(328.15, abs=1e-3)
    assert flooded.parts["gear pinion-1"] == pytest.approx(held.parts["gear pinion-1"], abs=1e-2)
    assert held.heat == pytest.approx(held.given_off, rel=1e-6)
    free = in_balance(reducer(temperature={"sump": "free"}, **warm)).heat.settled
    assert free.oil == pytest.approx(in_balance(reducer()).heat.settled.oil, abs=1e-3)


def test_wind_and_a_larger_housing_cool(settled):
    for changes in ({"area": "1.4 m**2"}, {"area": "0.7 m**2", "air_speed": "5 m/s"}):
        assert in_balance(reducer(temperature={"housing": changes})).heat.settled.oil < (
            settled.heat.settled.oil - 5.0
        )


def test_losses_of_the_motion_take_the_place_of_the_quasi_static_ones(settled):
    lost = settled.heat.settled.losses
    assert warmer(settled, lost) is None
    more = warmer(settled, [1.5 * loss for loss in lost])
    assert more is not None
    found = more.heat.settled
    assert found.losses == pytest.approx([1.5 * loss for loss in lost])
    assert found.heat == pytest.approx(found.given_off, rel=1e-6)
    assert found.oil > settled.heat.settled.oil + 5.0
    assert warmer(more, [1.5 * loss for loss in lost]) is None


def test_at_its_thermal_rating_the_sump_is_at_the_limit():
    case = reducer(temperature={"sump_limit": "60 degC"})
    rating = rating_of(GearboxLoss(case, tabulated(case)))
    assert rating is not None
    assert rating.coefficient == 15.0
    assert rating.heat_dissipated == pytest.approx(15.0 * 0.7 * 40.0)
    output = 1770.0 * float(case.source.speed) * 23.0 * 23.0 / (69.0 * 57.0)  # W of the duty
    load = (rating.thermal_power - rating.heat_dissipated) / output
    limit, driven = np.array([333.15]), np.array([case.source.speed])
    rated = OperatingPoints(np.array([load]), driven, limit, np.full((1, 2), 333.15))
    assert LOSSES.at(case, rated).power(driven).sum() == pytest.approx(rating.heat_dissipated, rel=1e-5)
    assert rating.sump_temperature is not None
    speed, bulk = np.array([case.source.speed]), np.full((1, 2), rating.sump_temperature)
    point = OperatingPoints(np.ones(1), speed, np.array([rating.sump_temperature]), bulk)
    at_sump = LOSSES.at(case, point).power(speed).sum()
    assert at_sump == pytest.approx(15.0 * 0.7 * (rating.sump_temperature - 293.15), rel=2e-3)


def test_check_prints_parts_paths_and_rating():
    checked = STUDIES["gear-train"].check(reducer())
    heat = checked.data["heat"]
    assert heat["heat_generated"] == pytest.approx(heat["heat_given_off"], rel=1e-6)
    assert {"gear pinion-1", "gear wheel-2", "shaft middle", "oil", "housing"} <= set(heat["temperatures"])
    assert checked.data["losses"]["power_lost"] == pytest.approx(heat["heat_generated"], rel=1e-6)
    titles = [table.title for table in checked.every]
    assert {"Temperatures of the parts", "Paths of heat"} <= set(titles)


def test_at_a_given_oil_temperature_meshes_are_as_much_warmer_as_in_the_balance(settled):
    heat, speed = settled.heat.settled, settled.source.speed
    oil = np.array([heat.oil, heat.oil, heat.oil])
    found = LOSSES.at(settled, OperatingPoints(np.array([1.0, 0.0, 1.0]), speed * np.array([1, 1, 0]), oil))
    bulk = found.meshes["bulk_temperature"]
    assert bulk[0] == pytest.approx([0.5 * sum(gears) for gears in heat.gears], abs=0.1)
    assert bulk[1] == pytest.approx(heat.oil, abs=0.1)  # only the drag of the wheels loads the teeth
    assert bulk[2] == pytest.approx(heat.oil, abs=0.1)


def test_bearings_that_are_not_drawn_are_parts_too():
    bearings = {"type": "deep-groove-ball", "mean_diameter": "60 mm"}
    losses = {"bearings": "palmgren", "shaft_bearings": {"pinion-1": bearings, "middle": bearings}}
    parts = in_balance(reducer(losses=losses)).heat.settled.parts
    assert parts["bearings of pinion-1"] > parts["bearings of middle"] > parts["housing"]


def test_carriers_and_planets_are_parts():
    case = scenario(
        "planetary-24-84",
        {"friction.law": "schlenk", "temperature.model": "gearbox", "temperature.housing.area": "1 m**2"}
        | {"temperature.sump": "free"},
    )
    heat = in_balance(case).heat.settled
    planets = [heat.parts[f"gear planet-{number}"] for number in (1, 2, 3)]
    assert planets == pytest.approx([planets[0]] * 3, abs=1e-3)
    assert heat.parts["gear sun"] > planets[0] > heat.parts["oil"]
    assert heat.heat == pytest.approx(heat.given_off, rel=1e-6)


def test_a_run_and_a_mesh_taken_alone_have_the_temperatures_of_the_balance(settled, tmp_path):
    data = REDUCER | {"losses": CHURNING, "temperature": WARM}
    data |= {"solver": {"cycles": 3}, "output": {"samples_per_cycle": 40}}
    summary = run(scenario(data, {}), tmp_path / "warm.h5").summary
    heat = settled.heat.settled
    for number, name in enumerate(("first", "second")):
        mesh, (one, two) = summary["meshes"][name], heat.gears[number]
        assert mesh["bulk_temperature"] == pytest.approx(0.5 * (one + two), abs=1.0)
        assert mesh["heat_generated"] == pytest.approx(mesh["heat_given_off"], rel=1e-6)
    assert summary["part_temperatures"].keys() == heat.parts.keys()
    assert summary["part_temperatures"]["oil"] == pytest.approx(heat.oil, abs=3.0)
    (tmp_path / "train.toml").write_text(tomli_w.dumps(data), encoding="utf-8")
    alone = {"title": "first", "kind": "efficiency", "gearbox": {"scenario": "train.toml", "mesh": "first"}}
    (tmp_path / "mesh.toml").write_text(tomli_w.dumps(alone), encoding="utf-8")
    pair = load_scenario(tmp_path / "mesh.toml")
    assert pair.lubricant.temperature == pytest.approx(0.5 * sum(heat.gears[0]), abs=1e-3)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"temperature": {"housing": {"air_speed": "1 m/s"}}}, r"temperature.housing.area: missing"),
        ({"temperature": {"housing": None}}, "temperature.housing: missing: heat leaves by it"),
        ({"temperature": {"tooth_oil": {"pinion": "2 W/K"}}}, "temperature.tooth_oil.pinion"),
        ({"temperature": {"oil_flow": "2 l/min"}}, "operating.oil_temperature: missing"),
        ({"temperature": {"ambient_temperature": "-60 degC"}}, "temperature.ambient_temperature"),
        ({"temperature": {"pinion_oil": "2 W/K"}}, 'no effect with model = "gearbox"'),
        (
            {
                "temperature": {"cooler": {"conductance": "1 W/K"}},
                "operating": {"oil_temperature": "50 degC"},
            },
            "temperature.cooler: has no effect",
        ),
    ],
)
def test_what_is_missing_or_wrong_is_one_message(changes, message):
    if changes["temperature"].get("housing", 0) is None:
        changes = {"temperature": {}}
        data = REDUCER | {"temperature": {"model": "gearbox"}}
        with pytest.raises(InputError, match=message):
            scenario(data, {})
        return
    assert message.replace("\\", "") in refusal(**changes)


def test_oil_that_would_get_too_hot_is_refused():
    with pytest.raises(InputError, match=r"would reach|grow faster"):
        in_balance(reducer(temperature={"housing": {"area": "0.01 m**2"}}))
    assert math.isfinite(in_balance(reducer(temperature={"housing": {"area": "5 m**2"}})).heat.settled.oil)
