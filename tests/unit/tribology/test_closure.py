"""From a case to its contacts: involute gears in closed form, at 23/47 teeth of module 3 mm and 20°."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.support.closures import LIU_NI
from tribodyn.errors import InputError
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.closure import (
    duty_range,
    law_quantities,
    laws_of,
    nominal_conditions,
    nominal_line_load,
    surfaces_of,
    with_laws,
)
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FilmData, FrictionData
from tribodyn.tribology.oil import OilSheet, lubricant_from

R1, R2, ALPHA, WIDTH = 34.5e-3, 70.5e-3, math.radians(20.0), 20e-3
OMEGA, TORQUE = 10.0, 500.0


@pytest.fixture(scope="module")
def case() -> Any:
    return load_scenario("involute-23-47").pair


def flanks():
    """Radii of curvature of both flanks at places along the line of action, from tip to tip."""
    whole = (R1 + R2) * math.sin(ALPHA)
    at_gear_tip = whole - math.sqrt((R2 + 3e-3) ** 2 - (R2 * math.cos(ALPHA)) ** 2)
    at_pinion_tip = math.sqrt((R1 + 3e-3) ** 2 - (R1 * math.cos(ALPHA)) ** 2)
    first = np.linspace(at_gear_tip, at_pinion_tip, 81)
    return first, whole - first


def test_duty_of_involute_gears(case):
    """A quarter of the whole load to one and a half of it; 0.8 to 1.2 times the speeds; what the path has."""
    duty = duty_range(case)
    first, two = flanks()
    load = TORQUE / (R2 * math.cos(ALPHA)) / WIDTH
    assert duty.line_load == pytest.approx((0.25 * load, 1.5 * load))
    assert nominal_line_load(duty) == pytest.approx(load)
    entrainment, sliding = (OMEGA * (first + sign * two * R1 / R2) for sign in (1, -1))
    entrainment, ratio = 0.5 * entrainment, 2.0 * np.abs(sliding / entrainment)
    assert duty.entrainment == pytest.approx((0.8 * entrainment.min(), 1.2 * entrainment.max()))
    curvature = 1 / first + 1 / two
    assert duty.curvature == pytest.approx((0.99 * curvature.min(), 1.01 * curvature.max()))
    assert duty.slide_to_roll == pytest.approx((0.02, 1.05 * ratio.max()))
    expected = np.stack([entrainment, curvature, ratio], axis=1)
    np.testing.assert_allclose(duty.places, expected, rtol=1e-9, atol=1e-12)


def test_speed_and_torque_turn_either_way_but_must_not_vanish(case):
    turned = replace(case.operating, pinion_speed=-2 * OMEGA, gear_torque=-3 * TORQUE)
    duty, base = duty_range(replace(case, operating=turned)), duty_range(case)
    assert duty.line_load == pytest.approx([3 * load for load in base.line_load])
    assert duty.entrainment == pytest.approx([2 * speed for speed in base.entrainment])
    assert duty.slide_to_roll == pytest.approx(base.slide_to_roll)
    for name in ("pinion_speed", "gear_torque"):
        resting = replace(case, operating=replace(case.operating, **{name: 0.0}))
        with pytest.raises(InputError, match="needs a torque and a speed"):
            duty_range(resting)


def test_a_cycloid_is_held_near_its_pitch_point():
    """There radius and entrainment vanish: both are held at a tenth of their largest."""
    duty = duty_range(load_scenario("cycloidal-23-47").pair)
    places = np.array(duty.places)
    assert places[:, 0].min() == pytest.approx(0.1 * places[:, 0].max())
    assert places[:, 1].max() == pytest.approx(10.0 * places[:, 1].min())
    assert duty.entrainment[1] == pytest.approx(1.2 * places[:, 0].max())


def test_nominal_conditions_of_involute_gears(case):
    """At the pitch point: w = T/(r b cos α), 1/ρ = (1/r_1 + 1/r_2)/sin α, V = ω r_1."""
    found = nominal_conditions(replace(case, operating=replace(case.operating, gear_torque=-TORQUE)))
    assert found.tangential_load == pytest.approx(TORQUE / R2)
    assert (found.pinion_pitch_radius, found.gear_pitch_radius) == pytest.approx((R1, R2))
    assert found.face_width == WIDTH
    assert found.line_load == pytest.approx(TORQUE / R2 / WIDTH / math.cos(ALPHA))
    assert found.curvature == pytest.approx((1 / R1 + 1 / R2) / math.sin(ALPHA))
    assert found.pitch_line_speed == pytest.approx(OMEGA * R1)
    assert found.sum_speed == pytest.approx(2 * OMEGA * R1 * math.sin(ALPHA))
    ratio = R2 / R1
    assert found.load_intensity == pytest.approx(TORQUE / R2 * (ratio + 1) / (WIDTH * 2 * R1 * ratio))
    assert (found.viscosity, found.density) == (0.35, 880.0)
    idle = replace(case, operating=replace(case.operating, gear_torque=0.0))
    for law in ("niemann", FRICTION_LAWS["niemann"]):
        with pytest.raises(InputError, match=r'"niemann".*which vanish here'):
            nominal_conditions(replace(idle, friction=FrictionData(law)))
    with pytest.raises(InputError, match="which vanish here"):
        nominal_conditions(load_scenario("cycloidal-23-47").pair)


def test_mean_coefficients_read_the_oil_around_the_gears(case):
    sheet = OilSheet("mineral", 220e-6, 19e-6, 890.0)
    warm = replace(lubricant_from(sheet, 370.0), supply=340.0)
    found = nominal_conditions(replace(case, lubricant=warm))
    assert found.viscosity == pytest.approx(sheet.viscosity(340.0))
    assert found.density == pytest.approx(890.0 - 0.7 * 51.0)
    assert (found.load_exponent, found.lubricant_factor, found.schlenk_factor) == (0.0, 1.0, 0.846)


def test_surfaces_of_unlike_steels(case):
    """2/E' = Σ (1 − ν²)/E; the softer one's hardness; heat capacities per volume."""
    first, two = case.materials
    first = replace(first, youngs_modulus=2.1e11, poisson_ratio=0.28, hardness=3e9, density=7700.0)
    two = replace(two, thermal_conductivity=37.0, specific_heat=480.0)
    found = surfaces_of(replace(case, materials=(first, two)))
    assert 2 / found.effective_modulus == pytest.approx((1 - 0.28**2) / 2.1e11 + 0.91 / 2.06e11)
    assert found.hardness == 2.3e9
    assert surfaces_of(replace(case, materials=(two, first))).hardness == 2.3e9
    assert (found.roughness, found.mean_roughness) == (case.roughness, case.mean_roughness)
    assert (found.inlet_viscosity, found.pressure_viscosity) == (0.35, case.lubricant.pressure_viscosity)
    assert (found.pinion_conductivity, found.gear_conductivity) == (60.5, 37.0)
    assert (found.pinion_heat_capacity, found.gear_heat_capacity) == (7700.0 * 434.0, 7850.0 * 480.0)


def test_laws_of_a_case(case):
    """By name or as objects; the film that goes with the friction law where none is chosen."""
    assert laws_of(with_laws(case, friction="solved")) == (FILM_LAWS["solved"], FRICTION_LAWS["solved"])
    changed = with_laws(case, FILM_LAWS["moes"], FRICTION_LAWS["xu"])
    assert laws_of(changed) == (FILM_LAWS["moes"], FRICTION_LAWS["xu"])
    assert changed.friction.reversal_width == case.friction.reversal_width
    assert with_laws(case) == case
    kept = with_laws(replace(case, film=FilmData("moes")), friction="xu")
    assert laws_of(kept)[0].name == "moes"


def test_a_summary_names_laws_and_ratios(case):
    found = law_quantities(with_laws(case, "moes", "coulomb"))
    assert (found["film_law"], found["film_thickness"]) == ("moes", "central")
    assert found["friction_range"] == "none stated"
    judged = FILM_LAWS["moes"].judged
    low, median, high = judged.ratio
    outside = dict(zip(("low_outside", "median_outside", "high_outside"), judged.outside, strict=True))
    assert found["film_judged"] == {"low": low, "median": median, "high": high, "limits": 6, **outside}
    assert not {"friction_judged", "film_table_error", "friction_table_error"} & set(found)
    assert law_quantities(with_laws(case, "dowson-higginson", "coulomb"))["film_thickness"] == "minimum"
    assert LIU_NI.lubricant.supply is None
