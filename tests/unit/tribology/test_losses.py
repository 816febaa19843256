"""Load-independent losses: formulas by hand in engineers' units, limits, orders of power."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.carriers import CarrierInOil, enclosed_drum
from tribodyn.tribology.losses.churning import changenet_velex, iso_14179_1
from tribodyn.tribology.losses.loss import OilState, Sump, Wheel
from tribodyn.tribology.losses.meshes import MeshInOil, iso_14179_2, mauz
from tribodyn.tribology.losses.pair import (
    LOSSES,
    LoadedBearings,
    LossData,
    ShaftLosses,
    Spray,
    losses_of_pair,
    shaft_torques,
)
from tribodyn.tribology.losses.palmgren import DRAG_FACTORS, palmgren
from tribodyn.tribology.losses.pump import PumpData
from tribodyn.tribology.losses.seals import SealData
from tribodyn.tribology.losses.windage import anderson_loewenthal, dawson

RPM = math.pi / 30.0
#: Module 3 mm, 53 teeth.
SPEED = 750 * RPM
ANGLE = math.radians(20.0)
WHEEL = Wheel(79.5e-3, 82.5e-3, 75.75e-3, 24e-3, 3e-3, 53.0, 40e-3, pressure_angle=ANGLE)
OIL = OilState(0.030, 850.0)
SUMP = Sump(1e-3)


def wetted(wheel, depth):
    """Flanks, sides and teeth below the level, m²."""
    theta = math.acos(1 - depth / wheel.pitch_radius)
    sides = wheel.pitch_radius**2 * (2 * theta - math.sin(2 * theta))
    rim = 2 * wheel.pitch_radius * wheel.face_width * theta
    height = (wheel.tip_radius - wheel.root_radius) / math.cos(ANGLE)
    return sides + rim + 2 * wheel.teeth * height * wheel.face_width * theta / math.pi


@pytest.mark.parametrize("rpm", [400.0, 950.0, 1130.0, 2900.0])
@pytest.mark.parametrize("immersion", [2e-3, 21e-3, 90e-3])
def test_changenet_velex_in_every_regime(rpm, immersion):
    """C_m of both regimes in powers of h/D, V_0/D³, Fr, Re, b/D; between Re = 6000 and 9000 linear.

    The slow regime's Reynolds number goes on to 9000. Above the axis the formula says that it ends.
    """
    wheel, volume = WHEEL._replace(immersion=immersion), 2.3e-3
    found = changenet_velex(wheel, rpm * RPM, OilState(0.031, 871.0), Sump(volume))
    r, b, depth = 79.5e-3, 24e-3, immersion - 3e-3
    if depth <= 0:
        assert found.torque == 0.0
        return
    froude, reynolds = (rpm * RPM) ** 2 * r / 9.80665, rpm * RPM * r * b * 871.0 / 0.031
    h, v = depth / (2 * r), volume / (2 * r) ** 3
    slow = 1.366 * h**0.45 * v**0.1 * froude**-0.6 * min(reynolds, 9000) ** -0.21
    fast = 3.644 * h**0.1 * v**-0.35 * froude**-0.88 * (b / (2 * r)) ** 0.85
    moment = np.interp(reynolds, [6000, 9000], [slow, fast])
    torque = 0.5 * 871.0 * (rpm * RPM) ** 2 * wetted(wheel, depth) * r**3 * moment
    assert found.torque == pytest.approx(torque, rel=1e-12)
    assert bool(found.exceeded) == (depth > r)


def test_a_gear_wholly_below_the_level_is_wetted_all_over():
    """Deeper than its diameter wets no more: only (h/D)^0.45 goes on."""
    deep = [
        changenet_velex(WHEEL._replace(immersion=depth), SPEED, OIL, SUMP).torque for depth in (0.2, 0.25)
    ]
    assert deep[1] / deep[0] == pytest.approx((247 / 197) ** 0.45)


def test_iso_14179_1_at_its_ends():
    """Immersed wholly f_g = 1; fine teeth: R_f is not below zero, and the limit is said."""
    whole, deeper = (
        iso_14179_1(WHEEL._replace(immersion=depth), SPEED, OIL, SUMP).torque for depth in (165e-3, 0.3)
    )
    assert whole == deeper
    assert whole == pytest.approx(iso_14179_1(WHEEL, SPEED, OIL, SUMP).torque * 165 / 40)
    for module, limits in ((0.5e-3, ("module ≥ 1 mm",)), (1e-3, ()), (3e-3, ())):
        found = iso_14179_1(WHEEL._replace(module=module), SPEED, OIL, SUMP)
        assert found.exceeded == limits
        viscosity, rough = 0.03 / 850 * 1e6, max(7.93 - 4.648 / (1e3 * module), 0.0)
        teeth = 7.37 * 165**4.7 * 24 * rough / math.sqrt(math.tan(math.pi / 18))
        power = 1e3 * 40 / 165 * viscosity * 750**3 * (teeth + 1.474 * 165**5.7) / (0.2 * 1e26)
        assert found.torque * SPEED == pytest.approx(power, rel=1e-9)


def test_windage_by_hand():
    """Dawson in rpm, mm, kW; Anderson & Loewenthal with oil of 30 mPa s."""
    speed, wheel = 7100 * RPM, Wheel(161e-3, 166e-3, 156e-3, 43e-3, 3.5e-3, 92.0)
    dawsons = 7100**2.9 * (0.16 * 312**3.9 + 312**2.9 * 43**0.75 * 3.5**1.15) * 1e-20
    assert dawson(wheel, speed, OIL).torque * speed == pytest.approx(1e3 * dawsons, rel=1e-12)
    kilowatts = 2.82e-7 * (1 + 2.3 * 43 / 161) * 7100**2.8 * 0.161**4.6 * (0.028 * 30 + 0.019) ** 0.2
    assert anderson_loewenthal(wheel, speed, OIL).torque * speed == pytest.approx(1e3 * kilowatts, rel=1e-12)
    for diameter, outside in ((0.299, True), (0.301, False), (1.159, False), (1.161, True)):
        assert bool(dawson(wheel._replace(root_radius=diameter / 2), speed, OIL).exceeded) == outside


def test_palmgren_by_hand():
    """10^−7 f_0 (ν n)^⅔ d_m³ N mm, and 160 for the power below ν n = 2000; factors of the types."""
    assert DRAG_FACTORS == {
        "deep-groove-ball": 2.0,
        "angular-contact-ball": 3.3,
        "cylindrical-roller": 3.0,
        "tapered-roller": 6.0,
        "needle-roller": 12.0,
        "self-aligning-ball": 1.75,
        "spherical-roller": 5.0,
        "four-point-contact-ball": 6.5,
    }
    for rpm in (30.0, 44.0, 700.0):
        for count in (1, 3):
            flow = 0.0391 / 853 * 1e6 * rpm
            moment = 1e-7 * 3.3 * 71.0**3 * (flow ** (2 / 3) if flow >= 2000 else 160)
            bearings = BearingInOil("angular-contact-ball", 71e-3, count)
            found = palmgren(bearings, rpm * RPM, OilState(0.0391, 853.0), 0.0, 0.0)
            assert found.idle == pytest.approx(count * moment * 1e-3, rel=1e-12)
            assert found.loaded == 0.0


SPEEDS = 1500 * RPM, SPEED


def on_sides(*bearings):
    """Bearings of the pinion's and of the gear's shaft."""
    return tuple(
        ShaftLosses(side, bearings=(LoadedBearings(side, one),))
        for side, one in zip(("pinion", "gear"), bearings, strict=True)
    )


def test_losses_of_both_gears_are_added_and_limits_said_once():
    pinion = WHEEL._replace(module=0.9e-3, immersion=11e-3, root_radius=31e-3)
    gear, sump = WHEEL._replace(module=0.9e-3), Sump(1.7e-3)
    drags = BearingInOil("deep-groove-ball", 60e-3, 2), BearingInOil("cylindrical-roller", 80e-3, 1)

    def both(formula, *rest):
        turning = zip((pinion, gear), SPEEDS, strict=True)
        return sum(formula(wheel, speed, *rest).torque * speed for wheel, speed in turning)

    for churning, each in (("iso-14179-1", iso_14179_1), ("changenet-velex", changenet_velex)):
        for windage, blown in (("dawson", dawson), ("anderson-loewenthal", anderson_loewenthal)):
            requested = LossData(churning, windage, "palmgren", 11e-3, 40e-3, sump, shafts=on_sides(*drags))
            found = losses_of_pair(requested, (pinion, gear), SPEEDS, OIL)
            assert found["churning"].power == pytest.approx(both(each, OIL, sump))
            assert found["windage"].power == pytest.approx(both(blown, OIL))
            assert len(found["churning"].exceeded) == (churning == "iso-14179-1")
            shafts = [
                palmgren(drag, speed, OIL, 0.0, 0.0).idle * speed
                for drag, speed in zip(drags, SPEEDS, strict=True)
            ]
            assert found["bearings"].power == pytest.approx(sum(shafts))


def test_only_what_is_asked_for_is_lost():
    both = (WHEEL._replace(immersion=0.0), WHEEL)
    assert losses_of_pair(LossData(), both, SPEEDS, OIL) == {}
    asked = LossData(churning="iso-14179-1", bearings="palmgren", gear_immersion=40e-3)
    drag = BearingInOil("deep-groove-ball", 60e-3, 2)
    found = losses_of_pair(
        replace(asked, shafts=(ShaftLosses("gear", bearings=(LoadedBearings("", drag),)),)), both, SPEEDS, OIL
    )
    assert set(found) == {"churning", "bearings"}
    assert found["churning"].power == pytest.approx(iso_14179_1(WHEEL, SPEED, OIL, SUMP).torque * SPEED)
    assert found["bearings"].power == pytest.approx(palmgren(drag, SPEED, OIL, 0.0, 0.0).idle * SPEED)


def test_a_helix_wets_longer_flanks_and_lessens_the_losses_of_agmas_teeth():
    helical, oil = WHEEL._replace(helix_angle=math.radians(30.0)), OilState(0.05, 870.0)

    def flanks(wheel):
        both = changenet_velex(wheel, SPEED, oil, SUMP).torque
        return both - changenet_velex(wheel._replace(teeth=0.0), SPEED, oil, SUMP).torque

    assert flanks(helical) == pytest.approx(flanks(WHEEL) / math.cos(math.radians(30.0)))
    sides = 1.474 * (2e3 * WHEEL.tip_radius) ** 5.7
    spur, inclined = (iso_14179_1(wheel, SPEED, oil, SUMP).torque for wheel in (WHEEL, helical))
    teeth = 7.37 * (2e3 * WHEEL.tip_radius) ** 4.7 * 24.0 * (7.93 - 4.648 / 3.0)
    share = (teeth / math.sqrt(math.tan(math.pi / 6.0)) + sides) / (
        teeth / math.sqrt(math.tan(math.pi / 18.0)) + sides
    )
    assert inclined / spur == pytest.approx(share)
    least = WHEEL._replace(helix_angle=math.radians(9.0))
    assert iso_14179_1(least, SPEED, oil, SUMP) == iso_14179_1(WHEEL, SPEED, oil, SUMP)


def test_every_loss_of_a_pair_has_its_name_and_power():
    """Each by its own function: at the shaft's speed, the load by the force that is given."""
    held = BearingInOil("cylindrical-roller", 60e-3, 2)
    on_gear = ShaftLosses(
        "gear",
        bearings=(LoadedBearings("of gear", held, 3000.0),),
        seals=SealData(50e-3),
        pump=PumpData(5e5, flow=0.1e-3),
        carrier=CarrierInOil(0.2, 0.05, 0.08, 0.01),
    )
    data = LossData(
        "iso-14179-2", "dawson", "iso-14179-2", 11e-3, 40e-3, Sump(1e-3, 0.3), shafts=(on_gear,),
        squeezing="mauz", spray=Spray(3e-5, 5.0), seals="iso-14179-2", carrier="enclosed-drum",
    )  # fmt: skip
    wheels = WHEEL._replace(immersion=11e-3), WHEEL
    found = {name: loss.power for name, loss in losses_of_pair(data, wheels, SPEEDS, OIL, 3e-3).items()}
    assert set(found) == set(LOSSES)
    mesh = MeshInOil(*wheels, 3e-3, *data.spray)
    rolling = 0.0003 * 3000.0 * 60e-3
    expected = {
        "churning": iso_14179_2(mesh, SPEEDS[0], OIL, data.sump).torque * SPEEDS[0],
        "squeezing": mauz(mesh, SPEEDS[0], OIL, data.sump).torque * SPEEDS[0],
        "bearings_under_load": 2 * rolling * SPEED,
        "seals": 7.69e-6 * 50.0**2 * 750.0,
        "pump": 5e5 * 0.1e-3 / 0.8,
        "carriers": enclosed_drum(on_gear.carrier, SPEED, OIL, data.sump).torque * SPEED,
    }
    assert {name: found[name] for name in expected} == pytest.approx(expected)


def test_losses_of_a_shaft_over_loads_and_speeds():
    """Of arrays one torque a point: no load, none; a load that drives, that of one that is driven."""
    held = BearingInOil("cylindrical-roller", 60e-3, 2)
    shaft = ShaftLosses("gear", SPEED, bearings=(LoadedBearings("one", held, 3000.0),), seals=SealData(50e-3))
    data = LossData(bearings="iso-14179-2", seals="iso-14179-1")
    speeds, loads = np.array([0.0, 50.0, 80.0]), np.array([0.0, -1.0, 2.0])
    found = {part.term: part for part in shaft_torques(data, shaft, speeds, OIL, loads)}
    assert {term: part.sort for term, part in found.items()} == {
        "P_VL0": "bearing",
        "P_VLP": "bearing",
        "P_VD": "seal",
    }
    assert found["P_VLP"].torque.torque == pytest.approx(2 * 0.0003 * 3000.0 * 60e-3 * np.abs(loads))
    assert found["P_VD"].torque.torque == pytest.approx([2.429e-3 * 50] * 3)
