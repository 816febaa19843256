"""The rack cutter: straight for the involute, the mate's counterpart, and the envelope of what it cuts."""

import numpy as np
import pytest

from tests.support.sample_drives import DRIVES, LIU_NI, SHIFTED, SOUND, STANDARD, bodies
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import CLEARANCE, rack_flank, rack_outline, tooth_outline
from tribodyn.geometry.drive import SIDES, body_of, reference_radius, tip_radius
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.tooth import cut_tooth


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("drive", [STANDARD, SHIFTED])
def test_rack_of_the_involute_is_straight(drive, side):
    tooth = cut_tooth(involute.FAMILY, drive, side)
    x, y = rack_flank(tooth, np.linspace(tooth.form_distance, tooth.tip_distance, 11))
    # the left flank of a tooth that points down
    np.testing.assert_allclose(np.diff(x) / np.diff(y), -np.tan(drive.pressure_angle), rtol=1e-9)
    shape = rack_outline(assemble(involute.FAMILY, drive), side)
    body = body_of(drive, side)
    assert shape.pitch == pytest.approx(np.pi * drive.module, rel=1e-14)
    assert shape.tip_height == pytest.approx((body.profile_shift - body.dedendum) * drive.module)
    # half the pitch thick on its reference line, x m above the rolling line
    half = np.interp(-body.profile_shift * drive.module, -y[::-1], x[::-1])
    assert half == pytest.approx(-np.pi * drive.module / 4, rel=1e-12)


@pytest.mark.parametrize(("family", "drive"), [(crc.FAMILY, LIU_NI), (involute.FAMILY, STANDARD)])
def test_racks_of_both_bodies_are_counterparts(family, drive):
    """One flank path makes both: the gear's rack is the pinion's turned by half a turn (Jia et al.)."""
    pinion, gear = (cut_tooth(family, drive, side) for side in SIDES)
    r = np.linspace(max(pinion.form_distance, -gear.tip_distance), pinion.tip_distance, 9)
    x, y = rack_flank(pinion, r)
    mate_x, mate_y = rack_flank(gear, -r)
    quarter = np.pi * drive.module / 4
    np.testing.assert_allclose(mate_x + quarter, -(x + quarter), atol=1e-15)
    np.testing.assert_allclose(mate_y, -y, atol=1e-15)


@bodies(DRIVES)
def test_outline_is_one_pitch_of_a_symmetric_tool(family, drive, side):
    shape = rack_outline(assemble(family, drive), side)
    np.testing.assert_allclose(shape.x, -shape.x[::-1], atol=1e-15)
    np.testing.assert_allclose(shape.y, shape.y[::-1], atol=1e-15)
    assert shape.x[-1] - shape.x[0] == pytest.approx(shape.pitch, rel=1e-14)
    assert np.all(np.diff(shape.x) >= 0)
    assert shape.y.min() == pytest.approx(shape.tip_height, rel=1e-12)
    assert shape.y.max() == shape.root_height
    bottom = tip_radius(drive, side) - reference_radius(drive, side) + CLEARANCE * drive.module
    assert shape.root_height == pytest.approx(bottom)


@bodies(SOUND)
def test_rolling_the_rack_over_the_body_leaves_the_tooth(family, drive, side):
    """In the tool's frame the rolling tooth touches the outline everywhere it was cut and never enters it."""
    tooth, shape = (
        cut_tooth(family, drive, side),
        rack_outline(assemble(family, drive), side, flank_points=400),
    )
    profile = tooth_outline(tooth, 120, 60)
    x = np.concatenate([profile.fillet_x, profile.flank_x[1:]])
    y = np.concatenate([profile.fillet_y, profile.flank_y[1:]])
    pitch_radius = tooth.path.pinion_pitch_radius
    turn = np.linspace(-0.6, 0.6, 4001)[:, None] * 2 * shape.pitch / pitch_radius
    # Half the tooth, whose axis stands half its thickness left of the line of centres at φ = 0.
    angle = tooth.half_angle - np.arctan2(y, x) - turn
    distance = np.hypot(x, y)
    along = -distance * np.sin(angle) - pitch_radius * turn - tooth.corner_limit
    height = distance * np.cos(angle) - pitch_radius
    tool = np.interp((along / shape.pitch + 0.5) % 1 - 0.5, shape.x / shape.pitch, shape.y)
    gap = (tool - height).min(axis=0)
    assert gap.min() > -1e-4 * drive.module
    assert gap.max() < 1e-3 * drive.module
