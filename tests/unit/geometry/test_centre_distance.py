"""An involute pair at any centre distance: closed forms of ISO 21771, and what is refused."""

import math

import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, tip_clearance
from tribodyn.geometry.backlash import circumferential_backlash, normal_backlash
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family, involute
from tribodyn.geometry.limits.checks import check

PINION = GearBody(25.0, 0.2, 1.0, 1.25, 0.25, 0.03, 0.015)
GEAR = GearBody(60.0, 0.1, 1.0, 1.25, 0.25, 0.028, 0.025)
TIGHT = Drive(3e-3, math.radians(20.0), PINION, GEAR)
ALPHA = math.radians(20.0)


def inv(angle: float) -> float:
    return math.tan(angle) - angle


def at(distance: float | None, *allowances: float) -> Assembly:
    pinion, gear = allowances or (0.0, 0.0)
    drive = TIGHT._replace(
        pinion=PINION._replace(thickness_allowance=pinion),
        gear=GEAR._replace(thickness_allowance=gear),
        centre_distance=distance,
    )
    return check(family("involute"), drive)


def distance_without_backlash() -> float:
    """By bisection of the defining equation, inv α_w = inv α + 2 tan α Σx/Σz."""
    low, high = 0.1, 1.0
    target = inv(ALPHA) + 2 * math.tan(ALPHA) * 0.3 / 85
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if inv(middle) < target else (low, middle)
    return 127.5e-3 * math.cos(ALPHA) / math.cos(low)


def test_the_tight_mesh_is_that_without_a_centre_distance():
    tight = distance_without_backlash()
    path = at(None).path
    assert path.pinion_pitch_radius + path.gear_pitch_radius == pytest.approx(tight, rel=1e-13)
    assert float(involute.tight_centre_distance(TIGHT)) == pytest.approx(tight, rel=1e-13)
    assert at(tight).contact_ratio == pytest.approx(at(None).contact_ratio, rel=1e-12)
    assert abs(normal_backlash(at(tight))) < 1e-15 + 1e-12 * tight


@pytest.mark.parametrize("off", [0.2e-3, 0.5e-3, 0.62e-3])
def test_base_circles_stay_and_backlash_follows(off: float):
    distance = distance_without_backlash() + off
    pair = at(distance)
    working = math.acos(127.5e-3 * math.cos(ALPHA) / distance)
    assert pair.path.pressure_angle(0.0) == pytest.approx(working, rel=1e-12)
    arm = pair.path.pinion_pitch_radius * math.cos(float(pair.path.pressure_angle(0.0)))
    assert arm == pytest.approx(37.5e-3 * math.cos(ALPHA), rel=1e-13)
    # base pitch less base thicknesses, m cos α (π/2 + 2 x tan α + z inv α), seen at the working angle
    opened = 85 * (inv(working) - inv(ALPHA)) - 2 * 0.3 * math.tan(ALPHA)
    expected = 3e-3 * math.cos(ALPHA) * opened
    assert normal_backlash(pair) == pytest.approx(expected, rel=1e-10)
    assert float(involute.normal_backlash(pair.drive)) == pytest.approx(expected, rel=1e-12)
    assert circumferential_backlash(pair) == pytest.approx(expected / math.cos(working), rel=1e-10)
    assert tip_clearance(pair, "pinion") == pytest.approx(tip_clearance(at(None), "pinion") + off, rel=1e-9)
    # length of the line of action between the tip circles over the base pitch
    base = 37.5e-3 * math.cos(ALPHA), 90e-3 * math.cos(ALPHA)
    length = math.sqrt(41.1e-3**2 - base[0] ** 2) + math.sqrt(93.3e-3**2 - base[1] ** 2)
    length -= distance * math.sin(working)
    assert pair.contact_ratio == pytest.approx(length / (math.pi * 3e-3 * math.cos(ALPHA)), rel=1e-12)


def test_thinner_teeth_leave_their_allowances_as_backlash():
    pair = at(None, -60e-6, -80e-6)
    assert normal_backlash(pair) == pytest.approx(140e-6 * math.cos(ALPHA), rel=1e-3)
    assert float(involute.normal_backlash(pair.drive)) == pytest.approx(normal_backlash(pair), rel=1e-9)
    # the rack is fed deeper, the tip circle stays
    deeper = 60e-6 / (2 * math.tan(ALPHA))
    assert pair.pinion.root_radius == pytest.approx(at(None).pinion.root_radius - deeper, rel=1e-12)
    assert pair.pinion.tip_radius == at(None).pinion.tip_radius


def test_teeth_of_other_families_are_thinned_at_their_pitch_circle():
    from tribodyn.studies.protocol.load import load_scenario

    case = load_scenario("crc-23-47").pair
    thin = case.drive._replace(gear=case.drive.gear._replace(thickness_allowance=-50e-6))
    pair = check(family("crc"), thin)
    assert circumferential_backlash(pair) == pytest.approx(50e-6, rel=1e-9)
    assert circumferential_backlash(check(family("crc"), case.drive)) == pytest.approx(0.0, abs=1e-15)


def test_overlapping_teeth_are_refused_with_the_smallest_distance():
    tight = distance_without_backlash()
    with pytest.raises(InputError, match=r"drive.centre_distance = 128.3 mm: the teeth overlap") as refused:
        at(128.3e-3)
    usable = float(refused.value.remedy.split()[3]) * 1e-3
    assert tight <= usable < tight + 1e-7
    at(usable)
    with pytest.raises(InputError, match="overlap"):
        at(1e-3)
    with pytest.raises(InputError, match="thickness_allowance"):
        at(None, 20e-6, -10e-6)
    at(tight + 0.1e-3, 20e-6, -10e-6)


def test_other_families_refuse_a_centre_distance():
    from tribodyn.studies.protocol.load import load_scenario

    case = load_scenario("crc-23-47").pair
    with pytest.raises(InputError, match="conjugate at one centre distance only"):
        check(family("crc"), case.drive._replace(centre_distance=0.106))


def test_gears_too_far_apart_are_refused_with_the_largest_distance():
    with pytest.raises(InputError, match=r"drive.centre_distance = 132 mm: the contact ratio") as refused:
        at(0.132)
    largest = float(str(refused.value).split("use at most ")[1].split(" mm")[0])
    tips = (41.1**2 - (37.5 * math.cos(ALPHA)) ** 2) ** 0.5 + (93.3**2 - (90 * math.cos(ALPHA)) ** 2) ** 0.5
    for distance, touches in ((largest, True), (largest + 2e-3, False)):
        line = math.sqrt(distance**2 - (127.5 * math.cos(ALPHA)) ** 2)  # a sin α_w
        assert (tips - line >= 3.0 * math.pi * math.cos(ALPHA)) is touches
