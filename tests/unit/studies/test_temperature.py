"""Temperature, film and friction of a case settled together; losses by the scenario's tables."""

import tomllib
from typing import Any

import pytest

import tribodyn as td
from tribodyn.errors import InputError
from tribodyn.gears.prepare import Thermal
from tribodyn.interface.scenario import scenario
from tribodyn.studies.efficiency.run import prepare, quantities_of
from tribodyn.studies.motion.heat.thermal_iteration import at_own_temperatures
from tribodyn.studies.motion.prepare import prepare as prepare_motion
from tribodyn.tribology.oil import TEMPERATURE_RANGE

SCENARIO = tomllib.loads(
    """
    title = "warm teeth"
    kind = "efficiency"
    drive = "diez-ibarbia-18-36"
    lubricant = "iso-vg-220-mineral"
    [operating]
    pinion_speed = "1800 rpm"
    gear_torque = "200 N*m"
    oil_temperature = "80 degC"
    [friction]
    law = "masjedi-khonsari"
    [temperature]
    model = "iso"
    """
)
NETWORK = {
    "temperature.model": "network",
    "temperature.pinion_oil": "20 W/K",
    "temperature.gear_oil": "40 W/K",
    "temperature.oil_flow": "2 l/min",
}
LOSSES = {
    "losses.churning": "changenet-velex",
    "losses.gear_immersion": "20 mm",
    "losses.oil_volume": "1.5 l",
    "losses.windage": "dawson",
    "losses.bearings": "palmgren",
    "losses.pinion_bearings.type": "deep-groove-ball",
    "losses.pinion_bearings.mean_diameter": "40 mm",
}
SEALED = {"losses.seals": "iso-14179-2", "losses.shaft_seals.pinion.diameter": "30 mm"}
UNSIZED = {"losses.seals": "iso-14179-2", "losses.shaft_seals.pinion.count": 2}
PUMP = {"losses.pump.shaft": "pinion", "losses.pump.pressure": "5 bar", "losses.pump.flow": "9 l/min"}
SKF = {
    "losses.bearings": "skf",
    "losses.gear_bearings.type": "deep-groove-ball",
    "losses.gear_bearings.series": "63",
    "losses.gear_bearings.bore": "45 mm",
    "losses.gear_bearings.outside_diameter": "100 mm",
    "losses.gear_bearings.static_rating": "31.5 kN",
    "losses.gear_bearings.radial_load": "4 kN",
}
MOTION = SCENARIO | {"kind": "gear-pair", "mesh": {"damping_ratio": 0.05}}


def case(changes=None, source=SCENARIO):
    return scenario(source, changes or {})


def warm_of(prepared: Any) -> Any:
    thermal = prepared.thermal
    return thermal if isinstance(thermal, Thermal) else thermal[0]


def test_the_estimate_of_the_standard_holds_at_its_own_temperature():
    """ISO/TR 15144-1 with the loss that the film at that temperature has: 7400 (P_v/(a b))^0.72/1.2."""
    found = quantities_of(case())
    loss, centre, width = found["power_friction_mean"], 81.0, 26.7
    rise = 7400 * (1e-3 * loss / (centre * width)) ** 0.72 / 1.2
    assert found["bulk_temperature"] == pytest.approx(353.15 + rise, abs=0.1)
    # and the film is that of the oil at the bulk temperature
    at_bulk = case(
        {"operating.oil_temperature": f"{found['bulk_temperature']!r} K", "temperature.model": "oil"}
    )
    assert quantities_of(at_bulk)["film_min"] == pytest.approx(found["film_min"], rel=1e-4)
    assert found["lubricant"]["inlet_viscosity"]["value"] == pytest.approx(
        at_bulk.lubricant.inlet_viscosity, rel=1e-4
    )


def test_how_the_oil_reaches_the_mesh():
    dip, spray, submerged = (
        quantities_of(case({"temperature.lubrication": lubrication}))["bulk_temperature"] - 353.15
        for lubrication in ("dip", "spray", "submerged")
    )
    assert spray / dip == pytest.approx(1.2, rel=0.02)
    assert submerged / dip == pytest.approx(0.2, rel=0.05)


def test_a_network_gives_off_all_heat_of_friction_and_losses():
    found = quantities_of(case(NETWORK | LOSSES))
    losses = sum(found[f"power_{name}"] for name in ("churning", "windage", "bearings"))
    assert found["power_load_independent"] == pytest.approx(losses)
    heat = found["power_friction_mean"] + losses
    assert found["heat_given_off"] == pytest.approx(heat, rel=1e-3)
    share = found["power_in_mean"] / (found["power_in_mean"] + losses)
    assert found["efficiency_with_losses"] == pytest.approx(found["efficiency"] * share)
    # 2 l/min of oil at 80 °C: the density and Cragoe's specific heat there
    flow = 2e-3 / 60 * (890 - 0.7 * 64.15) * (1685 + 3.39 * 80) / 0.89**0.5
    assert found["oil_temperature"] == pytest.approx(353.15 + heat / flow, abs=0.1)


def test_bearings_seals_and_pump_are_in_the_efficiency_and_heat_the_oil():
    """Both bearings of the gear by SKF's model; the load's share is not among the losses without load."""
    found = quantities_of(case(NETWORK | SEALED | PUMP | SKF))
    names = ("bearings", "bearings_under_load", "seals", "pump")
    power = {name: found[f"power_{name}"] for name in names}
    assert power["seals"] == pytest.approx(7.69e-6 * 30**2 * 1800, rel=1e-3)
    assert power["pump"] == pytest.approx(5e5 * 9e-3 / 60 / 0.8, rel=1e-6)
    assert 5.0 < power["bearings_under_load"] < 50.0
    assert found["power_load_independent"] == pytest.approx(
        sum(power.values()) - power["bearings_under_load"]
    )
    share = found["power_in_mean"] / (found["power_in_mean"] + sum(power.values()))
    assert found["efficiency_with_losses"] == pytest.approx(found["efficiency"] * share)
    heat = found["power_friction_mean"] + sum(power.values())
    assert found["heat_given_off"] == pytest.approx(heat, rel=1e-3)


def test_losses_are_off_unless_asked_for():
    found = quantities_of(case({"temperature.model": "oil"}))
    assert not {"power_load_independent", "bulk_temperature", "power_churning"} & set(found)


def test_mean_friction_reads_the_oil_around_the_gears():
    """Schlenk's and Niemann's coefficients are of the viscosity at the oil's temperature."""
    warm, cold = (
        quantities_of(case({"friction.law": "schlenk", "temperature.model": model}))
        for model in ("iso", "oil")
    )
    assert warm["friction_coefficient_mean"] == pytest.approx(cold["friction_coefficient_mean"], rel=1e-12)
    assert warm["bulk_temperature"] > 353.15
    assert warm["film_min"] < cold["film_min"]


@pytest.mark.parametrize("changes", [{}, NETWORK | LOSSES])
def test_dynamics_and_efficiency_find_the_same_temperature(changes):
    motion, still = (
        warm_of(prepared) for prepared in (prepare_motion(case(changes, MOTION)), prepare(case(changes)))
    )
    assert motion.temperatures.bulk == pytest.approx(still.temperatures.bulk, abs=0.05)
    assert motion.lubricant.supply == pytest.approx(still.lubricant.supply, abs=0.05)


def test_a_motion_with_another_loss_is_run_again_until_its_own_temperature():
    prepared = prepare_motion(case(source=MOTION))
    warm, lost = warm_of(prepared).temperatures.bulk, warm_of(prepared).mesh_loss
    assert at_own_temperatures(prepared.case, [warm], [lost]) is None
    again = at_own_temperatures(prepared.case, [warm], [1.2 * lost])
    assert again is not None
    hotter = warm_of(prepare_motion(again)).temperatures.bulk
    assert hotter - 353.15 == pytest.approx((warm - 353.15) * 1.2**0.72, rel=1e-3)
    assert at_own_temperatures(again, [hotter], [1.2 * lost]) is None
    assert at_own_temperatures(prepared.case, [None], [lost]) is None


@pytest.mark.parametrize(
    ("changes", "key", "rule"),
    [
        ({"temperature.oil_flow": "2 l/min"}, "temperature.oil_flow", 'no effect with model = "iso"'),
        (NETWORK | {"temperature.pinion_oil": "0 W/K"}, "temperature.pinion_oil", "greater than zero"),
        (NETWORK | {"temperature.oil_housing": "9 W/K"}, "temperature.housing_ambient", "missing"),
        (NETWORK | {"temperature.lubrication": "spray"}, "temperature.lubrication", "no effect"),
        (LOSSES | {"losses.gear_immersion": "0 mm"}, "losses.gear_immersion", "dips into the oil"),
        (
            {"losses.churning": "changenet-velex", "losses.gear_immersion": "9 mm"},
            "losses.oil_volume",
            "needs",
        ),
        ({"losses.gear_immersion": "9 mm"}, "losses.gear_immersion", "no effect"),
        ({"losses.bearings": "palmgren"}, "losses.pinion_bearings", "missing"),
        ({"losses.churning": "stirring"}, "losses.churning", "not one of the choices"),
        (LOSSES | {"losses.immersion.gear": "9 mm"}, "losses.immersion.gear", "as gear_immersion does"),
        (LOSSES | {"losses.immersion.wheel": "9 mm"}, "losses.immersion.wheel", "no such gear"),
        (UNSIZED, "losses.shaft_seals.pinion.diameter", "missing"),
        (SEALED | {"losses.seals": None}, "losses.shaft_seals.pinion", "no effect"),
        ({"losses.seals": "iso-14179-2"}, "losses.shaft_seals", "needs the seals of a shaft"),
        (
            SEALED | {"losses.shaft_seals.pinion.material": "fkm"},
            "losses.shaft_seals.pinion.material",
            "no eff",
        ),
        (
            SEALED | {"losses.shaft_seals.output.diameter": "9 mm"},
            "losses.shaft_seals.output",
            "no such gear",
        ),
        (PUMP | {"losses.pump.flow": None}, "losses.pump.flow", "missing: a pump needs it"),
        (PUMP | {"losses.pump.displacement": "9 ml"}, "losses.pump.flow", "the same as displacement"),
        (PUMP | {"losses.pump.shaft": "middle"}, "losses.pump.shaft", "no such gear"),
        (SKF | {"losses.gear_bearings.bore": None}, "losses.gear_bearings.bore", "missing"),
        (
            SKF | {"losses.gear_bearings.bore": "101 mm"},
            "losses.gear_bearings.bore",
            "below outside_diameter",
        ),
        (SKF | {"losses.gear_bearings.series": "65"}, "losses.gear_bearings.series", "no such series"),
        (SKF | {"losses.gear_bearings.static_rating": None}, "losses.gear_bearings.static_rating", "missing"),
        (SKF | {"losses.gear_bearings.type": "needle-roller"}, "losses.gear_bearings.type", "not known"),
        (
            SKF | {"losses.gear_bearings.type": "tapered-roller", "losses.gear_bearings.series": "320"},
            "losses.gear_bearings.contact_angle",
            "the load acts along it",
        ),
        (SKF | {"losses.bearings": "palmgren"}, "losses.gear_bearings.series", "no effect"),
        (SKF | {"losses.gear_bearings.seal": "RS1"}, "losses.gear_bearings.seal_diameter", "missing"),
        (SKF | {"losses.gear_bearings.bath_factor": 1e-4}, "losses.gear_bearings.bath_factor", "without oil"),
        (
            {"losses.churning": "iso-14179-2", "losses.gear_immersion": "9 mm"},
            "losses.hydraulic_length",
            "missing",
        ),
        ({"losses.squeezing": "mauz"}, "losses.spray.flow", "missing"),
        ({"losses.spray.flow": "1 l/min"}, "losses.spray", "no effect"),
        ({"losses.carrier": "enclosed-drum"}, "losses.carrier", "no planetary stage"),
    ],
)
def test_what_contradicts_is_refused(changes, key, rule):
    with pytest.raises(InputError) as refused:
        case(changes)
    assert refused.value.key == key
    assert rule in refused.value.rule


def test_losses_of_gears_by_name_are_those_of_pinion_and_gear():
    drag = {"type": "deep-groove-ball", "mean_diameter": "40 mm"}
    formulas = {"churning": "iso-14179-1", "bearings": "palmgren"}
    of_sides = formulas | {"gear_immersion": "20 mm", "pinion_bearings": drag}
    by_name = formulas | {"immersion": {"gear": "20 mm"}, "shaft_bearings": {"pinion": drag}}
    for keys in (of_sides, by_name):
        assert case({"losses": keys}).losses == case({"losses": of_sides}).losses
        of_pair, of_train = (
            case({"losses": keys}, MOTION | {"kind": kind}) for kind in ("gear-pair", "gear-train")
        )
        assert prepare_motion(of_pair).thermal[0].losses == prepare_motion(of_train).thermal[0].losses


def test_a_temperature_needs_the_oil_at_others():
    direct = {"operating": {"pinion_speed": "1800 rpm", "gear_torque": "200 N*m"}}
    with pytest.raises(InputError, match="data sheet") as refused:
        scenario(SCENARIO | direct | {"lubricant": "liu-ni-2022"})
    assert refused.value.key == "temperature.model"


def test_teeth_hotter_than_the_oil_is_known_are_refused():
    hot = {"temperature.pinion_oil": "1 W/K", "temperature.gear_oil": "1 W/K"}
    with pytest.raises(InputError, match="known from -40 to 180 degC"):
        quantities_of(case(NETWORK | hot))
    assert TEMPERATURE_RANGE[1] == 453.15


@pytest.mark.soak
def test_steady_states_and_runs_settle_at_the_temperature_of_their_own_loss(tmp_path):
    """Vibration changes the loss: that of the motion gives the temperature at which it was computed."""

    def off(bulk, loss):
        return bulk - 353.15 - 7400 * (1e-3 * loss / (81.0 * 26.7)) ** 0.72 / 1.2

    vary = {"operating.pinion_speed": "2000:10000:2000rpm"}
    swept = td.sweep(MOTION, vary, output=tmp_path / "sweep.h5")
    for bulk, loss in zip(swept["bulk_temperature"].values, swept["power_friction_mean"].values, strict=True):
        assert abs(off(bulk, loss)) < 0.11
    fast = {"operating.pinion_speed": "6000 rpm", "solver.cycles": 60}
    summary = td.run(MOTION, fast, output=tmp_path / "run.h5").summary
    assert abs(off(summary["bulk_temperature"], summary["power_friction_mean"])) < 0.11
