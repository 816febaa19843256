"""Which losses a gearbox asks for: bearings of drawn shafts, planets on their pins, carriers; refusals."""

import math
import tomllib
from typing import Any

import numpy as np
import pytest

from tests.support.drawn_shafts import BETWEEN, OVERHUNG
from tests.support.three_gearboxes import GEARBOXES
from tests.support.train_scenarios import case_of_table
from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.errors import InputError
from tribodyn.gears.rating.bearings import bearing_part
from tribodyn.studies.motion.losses.part import LOSSES
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.train.assessable import shafts
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.tribology.losses.loss import OilState
from tribodyn.tribology.losses.methods import BEARING_METHODS

OIL = {"lubricant": "iso-vg-220-mineral"}
DRAG = {"type": "cylindrical-roller", "mean_diameter": "60 mm"}
DRUM = {"diameter": "200 mm", "width": "60 mm", "immersion": "50 mm", "clearance": "10 mm"}
DRAWN: dict[str, Any] = {
    "title": "Drawn shafts",
    "kind": "gear-train",
    "drive": "helical-23-47",
    "mesh": {"compliance": "energy", "slices": 5, "damping_ratio": 0.05},
    "bearings": {},
    "shaft": [
        {"name": "one", "gears": ["pinion"], "drawn": OVERHUNG},
        {"name": "two", "gears": ["gear"], "drawn": BETWEEN},
    ],
    "operating": {"input_speed": "1500 rpm", "output_torque": "300 N*m", "oil_temperature": "80 degC"},
    "friction": {"law": "none"},
}


def drawn(losses: dict[str, Any]) -> Any:
    return case_of_table({**DRAWN, **OIL, "losses": losses})


def planetary(losses: dict[str, Any]) -> Any:
    return case_of_table({**GEARBOXES["planetary"], **OIL, "losses": losses})


@pytest.mark.parametrize("method", list(BEARING_METHODS))
def test_bearings_of_drawn_shafts_lose_under_their_own_forces(method: str):
    """The loss is that of the formula at the forces that the shafts' equilibrium has, shaft by shaft."""
    case = drawn({"bearings": method})
    lost = prepare(case).thermal[0].losses
    forces = bearing_part(shafts(case))["bearings"]
    oil = OilState(case.pair.lubricant.inlet_viscosity, case.pair.lubricant.density)
    idle = loaded = 0.0
    for shaft, ratio in zip(case.pair.losses.shafts, (1.0, 23 / 47), strict=True):
        speed = 1500 * math.pi / 30 * ratio
        for number, (name, bearing, radial, axial, _) in enumerate(shaft.bearings, start=1):
            assert name == f"{shaft.name}-{number}"
            held = forces[f"{shaft.name}-{number}"]
            assert (radial, axial) == pytest.approx((held["radial_load"], held["axial_load"]))
            found = BEARING_METHODS[method].formula(bearing, speed, oil, radial, axial)
            idle, loaded = idle + found.idle * speed, loaded + found.loaded * speed
    assert lost["bearings"].power == pytest.approx(idle)
    assert lost["bearings_under_load"].power == pytest.approx(loaded)
    assert loaded > 0.0


def test_losses_over_points_are_those_of_a_run_at_the_nominal_one():
    """Terms at the nominal point are the sums of the summary; without load P_VLP is 0, all finite at rest."""
    seals = {"seals": "iso-14179-2", "shaft_seals": {"two": {"diameter": "40 mm"}}}
    in_oil = {"churning": "iso-14179-2", "immersion": {"gear": "20 mm"}, "hydraulic_length": "300 mm"}
    pump = {"pump": {"shaft": "one", "pressure": "4 bar", "flow": "6 l/min"}}
    sprayed = {"squeezing": "mauz", "spray": {"flow": "1 l/min"}}
    case = drawn({"bearings": "skf", "windage": "anderson-loewenthal", **seals, **in_oil, **pump, **sprayed})
    speed = case.source.speed
    at = OperatingPoints(np.array([1.0, 0.0, 1.0]), np.array([1.0, 1.0, 0.0]) * speed, np.full(3, 353.15))
    over = LOSSES.at(case, at)
    run = {name: loss.power for name, loss in prepare(case).thermal[0].losses.items()}
    of_term = {
        "P_VZ0": run["churning"] + run["windage"] + run["squeezing"],
        "P_VL0": run["bearings"],
        "P_VLP": run["bearings_under_load"],
        "P_VD": run["seals"],
        "P_VX": run["pump"],
    }
    found = over.by_term()
    assert {term: found[term][0] * speed for term in of_term} == pytest.approx(of_term, rel=1e-6)
    assert found["P_VLP"][1] == 0.0
    assert np.all(np.isfinite(over.drag))
    sources = {(source.element, source.sort) for source in over.sources}
    assert {("one-1", "bearing"), ("two-2", "bearing"), ("seals of two", "seal"), ("gear", "gear")} <= sources


def test_bearings_that_are_not_drawn_share_the_forces_of_the_meshes():
    """They are what the equilibria of drawn shafts have at all bearings of a shaft together."""
    box = load_scenario("industrial-reducer")
    held = {"type": "cylindrical-roller", "mean_diameter": "80 mm", "load": "meshes", "count": 2}
    shafts = ("pinion-1", "middle", "wheel-2")
    keys = {"losses.bearings": "iso-14179-2", **{f"losses.shaft_bearings.{name}": held for name in shafts}}
    table = tomllib.loads(box.toml)
    table["shaft"] = [shaft for shaft in table["shaft"] if len(shaft["gears"]) > 1]
    table["shaft"][0].pop("drawn")
    for key in ("losses", "housing", "sensor", "body"):
        table.pop(key, None)
    table["operating"] |= {"input": "pinion-1", "output": "wheel-2"}
    bare = load_data(table, "bare", keys | {"bearings": "rigid-1e9"}).case
    drawn_shafts = [support for support in box.supports.values() if support.bearings]
    found = {shaft.name: shaft.bearings[0] for shaft in bare.pair.losses.shafts}
    for name, support in zip(shafts, drawn_shafts, strict=True):
        x, y, z = np.sum([bearing.force[:3] for bearing in support.bearings], axis=0)
        assert 2.0 * found[name].radial == pytest.approx(math.hypot(x, y), rel=2e-3)
        assert 2.0 * found[name].axial == pytest.approx(abs(z), rel=2e-3)


def test_drawn_shafts_of_several_gears_go_by_their_own_names():
    keys = {"losses.seals": "iso-14179-2", "losses.shaft_seals.middle.diameter": "60 mm"}
    case = load_scenario("industrial-reducer", keys)
    (sealed,) = case.pair.losses.shafts
    assert sealed.speed == pytest.approx(case.source.speed * 19.0 / 83.0)
    with pytest.raises(InputError, match=r"(?s)no such gear, shaft or body.*high-speed"):
        load_scenario("industrial-reducer", {**keys, "losses.shaft_seals.slow.diameter": "60 mm"})


def test_a_pair_and_its_train_share_the_same_forces():
    held = DRAG | {"load": "meshes"}
    pair = GEARBOXES["pair"] | {"losses": {"bearings": "palmgren", "pinion_bearings": held}}
    alone = load_data(pair, "pair").case.pair.losses.shafts[0].bearings[0]
    efficiency = {**pair, "kind": "efficiency", "mesh": {"compliance": "constant", "stiffness": "3e8 N/m"}}
    for key in ("bearings", "solver", "output"):
        efficiency.pop(key)
    in_slow_rotation = load_data(efficiency, "pair").case.losses.shafts[0].bearings[0]
    assert in_slow_rotation == alone
    torque, base = 150.0, 51 * 3e-3 / 2.0 * math.cos(math.radians(20.0))
    assert alone.radial == pytest.approx(torque / base / 2.0, rel=1e-9)
    assert alone.axial == 0.0


def test_planets_turn_against_their_carrier():
    """Willis: ω_p − ω_c = (ω_s − ω_c) z_s/z_p; a ring that stands loses nothing."""
    case = planetary(
        {"bearings": "iso-14179-2", "shaft_bearings": dict.fromkeys(("planet-1", "ring", "carrier"), DRAG)}
    )
    speeds = {shaft.name: shaft.speed for shaft in case.pair.losses.shafts}
    ratio = {body.name: float(body.ratio) for body in case.bodies}
    teeth = {gear.name: abs(gear.teeth) for gear in case.gears}
    sun = case.source.speed
    against = (sun - sun * ratio["carrier"]) * teeth["sun"] / teeth["planet-1"]
    assert speeds == pytest.approx({"planet-1": against, "carrier": sun * ratio["carrier"]})


def test_a_carrier_churns_at_its_own_speed():
    case = planetary({"carrier": "enclosed-drum", "carriers": {"carrier": DRUM}})
    (shaft,) = case.pair.losses.shafts
    found = prepare(case).thermal[0].losses["carriers"].power
    assert found > 0.0
    assert shaft.body is not None
    assert case.bodies[shaft.body].name == "carrier"


@pytest.mark.parametrize(
    ("of", "losses", "key", "rule"),
    [
        (drawn, {"bearings": "skf", "shaft_bearings": {"one": DRAG}}, "shaft_bearings.one", "drawn shaft"),
        (drawn, {"bearings": "skf", "shaft_bearings": {"gear": DRAG}}, "shaft_bearings.gear", "drawn shaft"),
        (planetary, {"carrier": "enclosed-drum"}, "carriers", "needs a planet carrier"),
        (planetary, {"carriers": {"carrier": DRUM}}, "carriers.carrier", "no effect"),
        (
            planetary,
            {"carrier": "enclosed-drum", "carriers": {"sun": DRUM}},
            "carriers.sun",
            "no such planet",
        ),
        (
            planetary,
            {"carrier": "changenet-velex", "carriers": {"carrier": DRUM}, "oil_volume": "2 l"},
            "carriers.carrier.clearance",
            "no effect",
        ),
        (
            planetary,
            {"carrier": "enclosed-drum", "carriers": {"carrier": DRUM | {"clearance": None}}},
            "carriers.carrier.clearance",
            "missing",
        ),
    ],
)
def test_one_message_of_what_contradicts(of: Any, losses: dict[str, Any], key: str, rule: str):
    carriers = {
        name: {one: value for one, value in drum.items() if value is not None}
        for name, drum in losses.get("carriers", {}).items()
    }
    with pytest.raises(InputError) as refused:
        of(losses | ({"carriers": carriers} if carriers else {}))
    assert refused.value.key == f"losses.{key}"
    assert rule in refused.value.rule


def test_a_series_that_the_method_does_not_know():
    first = {**OVERHUNG, "bearing": [{**OVERHUNG["bearing"][0], "series": "999"}, OVERHUNG["bearing"][1]]}
    listed = [{"name": "one", "gears": ["pinion"], "drawn": first}, DRAWN["shaft"][1]]
    with pytest.raises(InputError) as refused:
        case_of_table({**DRAWN, **OIL, "shaft": listed, "losses": {"bearings": "skf"}})
    assert "no such series; there is: 302" in str(refused.value)
