"""A path reaches far enough where tips and rack flanks of both gears end on it, by closed forms."""

import numpy as np
import pytest

from tests.support.sample_drives import LIU_NI
from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, body_of, reference_radius, tip_radius
from tribodyn.geometry.families import involute
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach

DRIVE = LIU_NI._replace(
    pinion=LIU_NI.pinion._replace(addendum=0.8, dedendum=1.3, fillet_radius=0.2),
    gear=LIU_NI.gear._replace(addendum=0.9, dedendum=1.1, fillet_radius=0.3),
)
FAR = 0.03


def advice(drive, half):
    return f"shape.{'approach' if half < 0 else 'recess'}", half, "change it"


def tip_distance(side):
    """From the pitch point to the tip circle on a straight line under α, m."""
    sine, r = np.sin(DRIVE.pressure_angle), reference_radius(DRIVE, side)
    return -r * sine + np.sqrt(tip_radius(DRIVE, side) ** 2 - (r * np.cos(DRIVE.pressure_angle)) ** 2)


def rack_distance(side):
    """To where the flank of the gear's rack ends in its rounding, m: by its height above the pitch line."""
    body, sine = body_of(DRIVE, side), np.sin(DRIVE.pressure_angle)
    rounding = DRIVE.module * body.fillet_radius
    return rounding + (DRIVE.module * body.dedendum - rounding) / sine


def refused(lower, upper):
    path = involute.FAMILY.working_path(DRIVE)
    try:
        require_reach(DRIVE, path, lower, upper, advice)
    except InputError as error:
        return error
    return None


def test_a_straight_path_that_is_long_enough_is_taken():
    assert refused(-FAR, FAR) is None


@pytest.mark.parametrize("half", [-1, 1])
def test_it_must_reach_tip_and_rack(half: int):
    """In approach the pinion's rack and the gear's tip, in recess the other way round."""
    mate, own = ("gear", "pinion") if half < 0 else ("pinion", "gear")
    needed = {f"{mate}'s tip": tip_distance(mate), f"flank of the {own}'s rack": rack_distance(own)}
    last = max(needed, key=lambda what: needed[what])

    def ends_at(distance):
        return refused(-distance, FAR) if half < 0 else refused(-FAR, distance)

    assert ends_at(1.002 * needed[last]) is None
    for distance in (0.998 * needed[last], 0.5 * min(needed.values())):
        error = ends_at(distance)
        assert error is not None
        assert error.key == f"drive.shape.{'approach' if half < 0 else 'recess'}"
        assert (error.value, error.remedy) == (half, "change it")
        height = 1e3 * distance * np.sin(DRIVE.pressure_angle)
        assert f"{height:.4g} mm from the pitch line" in error.rule
    assert last in ends_at(0.998 * needed[last]).rule


def test_a_flank_that_would_be_undercut_is_refused_where_it_works():
    """Few teeth with a long addendum of the mate: contact beyond the base circle's tangent point."""
    drive = LIU_NI._replace(
        pinion=LIU_NI.pinion._replace(teeth=9.0, dedendum=1.0, fillet_radius=0.0),
        gear=LIU_NI.gear._replace(addendum=1.0),
    )
    path = involute.FAMILY.working_path(drive)
    tangent = reference_radius(drive, "pinion") * np.sin(drive.pressure_angle)
    sine, r = np.sin(drive.pressure_angle), reference_radius(drive, "gear")
    start = -r * sine + np.sqrt(tip_radius(drive, "gear") ** 2 - (r * np.cos(drive.pressure_angle)) ** 2)
    assert start > tangent
    with pytest.raises(InputError, match="the working flank of the pinion would be undercut"):
        require_reach(drive, path, -FAR, FAR, advice)
    shorter = drive._replace(gear=drive.gear._replace(addendum=0.3))
    require_reach(shorter, path, -FAR, FAR, advice)


@pytest.mark.parametrize("side", SIDES)
def test_profile_shift_is_refused_for_either_gear(side):
    refuse_shift(LIU_NI)
    shifted = LIU_NI._replace(**{side: body_of(LIU_NI, side)._replace(profile_shift=0.1)})
    with pytest.raises(InputError, match="cannot be profile-shifted") as error:
        refuse_shift(shifted)
    assert error.value.key == f"drive.{side}.profile_shift"
