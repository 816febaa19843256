"""Random involute pairs at random centre distances: backlash by teeth as cut and by the closed form."""

import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tribodyn.errors import InputError
from tribodyn.geometry.backlash import circumferential_backlash, normal_backlash
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import involute
from tribodyn.geometry.gauges import Involute, allowance_of_pins, allowance_of_span, over_pins, span
from tribodyn.geometry.helix import transverse_section
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.sheet import geometry_sheet

ALLOWANCES = st.floats(-0.04, 0.0)


@st.composite
def pairs(draw):
    module = draw(st.floats(0.5e-3, 12e-3))
    bodies = [
        GearBody(
            float(draw(st.integers(17, 90))),
            draw(st.floats(-0.1, 0.5)),
            1.0,
            1.25,
            draw(st.sampled_from((0.25, 0.38))),
            10 * module,
            2 * module,
            None,
            draw(ALLOWANCES) * module,
        )
        for _ in range(2)
    ]
    nominal = Drive(module, math.radians(draw(st.floats(18.0, 25.0))), *bodies)
    tight = float(involute.tight_centre_distance(nominal))
    return nominal._replace(centre_distance=tight + draw(st.floats(1e-4, 0.3)) * module), tight


@settings(max_examples=40)
@given(pairs())
def test_backlash_is_what_the_teeth_leave_open(drawn):
    drive, tight = drawn
    try:
        pair = check(involute.FAMILY, drive)
    except InputError as refused:
        assume("the teeth overlap" in refused.rule)  # other gears cannot be made, whatever their distance
        raise
    closed = float(involute.normal_backlash(drive))
    assert closed > 0
    assert normal_backlash(pair) == pytest.approx(closed, rel=1e-6, abs=1e-9 * drive.module)
    angle = float(pair.path.pressure_angle(0.0))
    assert circumferential_backlash(pair) * math.cos(angle) == pytest.approx(closed, rel=1e-6)
    # the base circles roll as they were cut
    assert pair.path.gear_pitch_radius * math.cos(angle) == pytest.approx(
        drive.module * drive.gear.teeth / 2 * math.cos(drive.pressure_angle), rel=1e-12
    )
    assert abs(float(involute.normal_backlash(drive._replace(centre_distance=tight)))) < 1e-9 * drive.module


@given(pairs())
def test_measures_are_taken_back(drawn):
    drive, _ = drawn
    body = drive.pinion
    gear = Involute(drive.module, drive.pressure_angle, body.teeth, body.profile_shift)
    allowance, pin = body.thickness_allowance, 1.728 * drive.module
    scale = 1e-12 * drive.module * body.teeth
    assert allowance_of_span(gear, 3, span(gear, 3, allowance)) == pytest.approx(allowance, abs=scale)
    over = over_pins(gear, pin, allowance)
    assert allowance_of_pins(gear, pin, over) == pytest.approx(allowance, abs=1e3 * scale)


@settings(max_examples=25)
@given(pairs())
def test_a_vanishing_helix_leaves_the_spur_sheet(drawn):
    drive, _ = drawn
    try:
        spur = geometry_sheet(check(involute.FAMILY, drive))
    except InputError:
        assume(False)
    helical = geometry_sheet(check(involute.FAMILY, transverse_section(drive._replace(helix_angle=1e-6))))
    for found, expected in ((helical, spur), *((helical[side], spur[side]) for side in ("pinion", "gear"))):
        for name in found.keys() & expected.keys() - {"pinion", "gear"}:
            assert found[name][0] == pytest.approx(expected[name][0], rel=1e-6, abs=1e-6), name
        renamed = {"module", "pressure angle of the rack on its rolling line", "pin diameter"}
        assert expected.keys() - found.keys() <= renamed | {"dimension over pins"}
