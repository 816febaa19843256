"""Every rule of a drive: what it refuses, which key it names, and that its remedy works."""

import math
import re

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.limits.sizes import check_sizes


def body(teeth, shift=0.0, **changes):
    return GearBody(teeth, shift, 1.0, 1.25, 0.25, 0.02, 0.005)._replace(**changes)


def drive(pinion, gear, angle=20.0):
    return Drive(0.003, math.radians(angle), pinion, gear)


def rack_cut_radius(teeth, alpha):
    """Radius, in modules times 3 mm, down to which the rounded tip of a rack has left the involute.

    All places of the rounding are carried into the gear's frame, tooth upwards, and those that lie inside the
    involute looked for.
    """
    module, pitch = 0.003, 0.0015 * teeth
    base, rounding = pitch * math.cos(alpha), 0.25 * module
    centre_y = pitch - 1.0 * module
    centre_x = math.pi * module / 4 + module * math.tan(alpha) + rounding / math.cos(alpha)
    turn, at = np.meshgrid(np.linspace(-1.0, 0.2, 4000), np.linspace(alpha, 1.2, 1500))
    x = centre_x - rounding * np.cos(at) + pitch * turn
    y = centre_y - rounding * np.sin(at)
    x, y = x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)
    radius, half = np.hypot(x, y), np.arctan2(x, y)
    there = np.maximum(radius, base)
    tangent = np.sqrt((there / base) ** 2 - 1)
    involute_half = math.pi / (2 * teeth) + math.tan(alpha) - alpha - (tangent - np.arctan(tangent))
    return float(np.max(radius[(radius > base) & (half < involute_half - 1e-9) & (half > 0.0)]))


def refusal(family, bad):
    with pytest.raises(InputError) as caught:
        check(family, bad)
    return caught.value


# drive, key, what the message says, whether it names a value that then passes this rule
REFUSED = {
    "undercut": (drive(body(9.0), body(47.0)), "pinion.profile_shift", "rack undercuts", True),
    "undercut gear": (
        drive(body(30.0), body(8.0, bore_radius=0.0)),
        "gear.profile_shift",
        "rack undercuts",
        True,
    ),
    "pointed by shift": (drive(body(14.0, 1.0), body(47.0)), "pinion.profile_shift", "pointed", True),
    "pointed by addendum": (
        drive(body(23.0, addendum=1.9), body(47.0, dedendum=1.35, fillet_radius=0.1)),
        "pinion.addendum",
        "pointed",
        True,
    ),
    "pointed by tip radius": (
        drive(body(23.0, tip_radius=0.041), body(47.0)),
        "pinion.tip_radius",
        "pointed",
        True,
    ),
    "no flank": (
        drive(body(23.0, tip_radius=0.032), body(47.0)),
        "pinion.tip_radius",
        "nothing is left",
        False,
    ),
    "clearance": (drive(body(23.0, addendum=1.3), body(47.0)), "pinion.addendum", "root circle", True),
    "clearance by shift": (
        drive(body(30.0, 0.8), body(30.0, 0.9, dedendum=1.1)),
        "pinion.addendum",
        "root circle",
        True,
    ),
    "contact ratio": (
        drive(body(23.0, addendum=0.4), body(47.0, addendum=0.4)),
        "pinion.addendum",
        "contact ratio",
        False,
    ),
    "interference": (drive(body(23.0, 1.2), body(47.0)), "gear.addendum", "touches the pinion", True),
    "rack corners": (
        drive(body(23.0, fillet_radius=0.5), body(47.0)),
        "pinion.fillet_radius",
        "corners",
        True,
    ),
    "rack pointed": (drive(body(23.0, dedendum=2.3), body(47.0)), "pinion.dedendum", "flanks meet", True),
    "past the axis": (
        drive(body(20.0), body(3.0, dedendum=1.6)),
        "gear.dedendum",
        "past the axis",
        False,
    ),
    "bore": (drive(body(23.0), body(47.0, bore_radius=0.067)), "gear.bore_radius", "bore", False),
    "sum of shifts": (
        drive(body(23.0, -1.0), body(47.0, -1.0)),
        "pinion.profile_shift",
        "closer than their base",
        True,
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused_with_key_rule_and_remedy(case):
    bad, key, phrase, has_remedy = REFUSED[case]
    error = refusal(involute.FAMILY, bad)
    assert error.key == f"drive.{key}"
    assert phrase in str(error)
    assert re.search(r"use (at most|at least|more than) -?\d", error.remedy) is not None or not has_remedy
    if has_remedy:
        side, name = key.split(".")
        value = float(re.findall(r"-?\d+\.?\d*", error.remedy)[0])
        value += 1e-4 * ("more" in error.remedy)
        changed = getattr(bad, side)._replace(**{name: value / 1e3 if name == "tip_radius" else value})
        assert not breaks_rule(bad._replace(**{side: changed}), error)


def breaks_rule(drive, before):
    """Whether the drive is refused for the same thing again."""
    try:
        check(involute.FAMILY, drive)
    except InputError as error:
        return error.key == before.key and error.rule[:14] == before.rule[:14]
    return False


@pytest.mark.parametrize(("teeth", "mate"), [(7, 47), (8, 47), (9, 47), (8, 17), (9, 17), (9, 200)])
def test_profile_shift_advised_against_undercut_is_the_least_that_is_accepted(teeth, mate):
    # x_min = h − z sin² α/2 leaves no undercut, h the height of the rack's straight flank below its
    # reference line; less will do where enough of the path is left
    alpha = math.radians(20)
    height = 1.25 - 0.25 * (1 - math.sin(alpha))

    def shifted(shift):
        return drive(body(float(teeth), shift, bore_radius=0.0), body(float(mate)))

    error = refusal(involute.FAMILY, shifted(0.0))
    named = float(error.remedy.split()[-1])
    assert 0.0 < named < height - teeth * math.sin(alpha) ** 2 / 2
    assert not breaks_rule(shifted(named), error)
    assert breaks_rule(shifted(named - 2e-3), error)


def test_message_reads_as_one_sentence():
    message = str(refusal(involute.FAMILY, drive(body(14.0, 1.0), body(47.0))))
    rule = r"the tip is pointed \(thickness -\d\.\d+ mm\)"
    assert re.fullmatch(rf"drive\.pinion\.profile_shift = 1\.0: {rule}; use at most 0\.\d+", message)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize(
    "key", ["module", "pressure_angle", "pinion.teeth", "gear.tip_radius", "pinion.dedendum"]
)
def test_numbers_must_be_finite(key, value):
    assert refusal(involute.FAMILY, changed(key, value)).rule == "must be a finite number"


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("module", 0.0),
        ("module", -0.003),
        ("pressure_angle", 0.0),
        ("pressure_angle", math.radians(60)),
        ("pinion.teeth", 2.0),
        ("gear.teeth", 47.5),
        ("pinion.face_width", 0.0),
        ("gear.addendum", -1.0),
        ("gear.dedendum", 0.0),
        ("pinion.fillet_radius", -0.1),
        ("pinion.bore_radius", -0.001),
    ],
)
def test_sizes_must_make_sense(key, value):
    with pytest.raises(InputError) as caught:
        check_sizes(changed(key, value))
    assert caught.value.key == f"drive.{key}"
    assert caught.value.rule.startswith("must")


def changed(key, value):
    good = drive(body(23.0), body(47.0))
    side, _, name = key.rpartition(".")
    return good._replace(**({side: getattr(good, side)._replace(**{name: value})} if side else {name: value}))


class TestCRC:
    # no solution; sin α above 1 on a series that converges; a series that does not; sin α below 0
    @pytest.mark.parametrize(
        ("teeth", "mate", "angle"), [(8.0, 200.0, 10.0), (6.0, 47.0, 5.0), (6.0, 8.0, 8.0), (6.0, 47.0, 14.0)]
    )
    def test_path_that_ends_before_the_teeth_do(self, teeth, mate, angle):
        error = refusal(crc.FAMILY, drive(body(teeth, dedendum=1.6), body(mate), angle))
        assert error.key == "drive.pressure_angle"
        assert "does not reach" in error.rule

    @pytest.mark.parametrize("angle", [21.0, 22.81, 24.0])
    @pytest.mark.parametrize("teeth", [12.0, 14.0, 17.0])
    def test_few_teeth_are_not_undercut(self, teeth, angle):
        """There is no undercut limit: on this path u_p/ω = [r(1 + w) + √(r²(1 + w)² + 4 A A_0)]/2 > 0."""
        check(crc.FAMILY, drive(body(teeth, fillet_radius=0.2), body(47.0, fillet_radius=0.2), angle))


@pytest.mark.parametrize(("teeth", "mate"), [(10, 47), (12, 47), (14, 14), (14, 200), (20, 40)])
def test_contact_on_an_undercut_flank_begins_where_the_rack_has_left_it(teeth, mate):
    """Against the envelope of the rack, drawn point by point: its tip's path and the involute cross there."""
    angle = 20.0 if teeth < 20 else 14.5
    pair = check(involute.FAMILY, drive(body(float(teeth), bore_radius=0.0), body(float(mate)), angle))
    alpha, radius = math.radians(angle), 0.0015 * teeth
    base, begins = radius * math.cos(alpha), rack_cut_radius(teeth, alpha)
    assert pair.shortened("pinion")
    assert pair.pinion.form_radius == pytest.approx(begins, rel=1e-4)
    start = radius * math.sin(alpha) - math.sqrt(begins**2 - base**2)
    leaves = math.sqrt((radius + 0.003) ** 2 - base**2) - radius * math.sin(alpha)
    if pair.shortened("gear"):
        leaves = start
    found = pair.contact_ratio * 0.003 * math.pi * math.cos(alpha)
    assert found == pytest.approx(start + leaves, rel=2e-3)


def test_undercut_below_the_lowest_contact_is_no_fault():
    """Eighteen teeth lack 0.033 of shift with this rack, but the mate never gets there."""
    check(involute.FAMILY, drive(body(18.0), body(36.0)))


def test_every_involute_in_the_catalogue_passes():
    for teeth in (18.0, 23.0, 40.0):
        for ratio in (1.0, 2.0, 5.0):
            check(involute.FAMILY, drive(body(teeth), body(teeth * ratio)))
    check(involute.FAMILY, drive(body(17.0, 0.45), body(41.0, -0.12)))
