"""Free-form paths of contact: what they are made of, the nearest to another family's, what is refused."""

import jax
import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from tests.support.compile_fast import ONE_CALL
from tests.support.sample_drives import SHIFTED, STANDARD, body
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import SIDES, Drive
from tribodyn.geometry.families import family, involute
from tribodyn.geometry.families.spline import (
    FAMILY,
    SplineShape,
    _advice,
    even_places,
    fit_spline,
    flank_deviation,
)
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.path import kinematics, position
from tribodyn.geometry.tooth import flank_point, thickness_half_angle
from tribodyn.studies.drive_file import load_drive

ANGLES = np.radians([26.7, 25.2, 23.8, 22.9, 22.0, 21.5, 21.4, 21.6])
LENGTH = 0.019
FREE = Drive(0.003, 0.0, body(23.0), body(47.0), SplineShape(ANGLES, None, LENGTH, 0.0))
#: A drive of every family: those of the scenarios.
OTHERS = [
    "involute-23-47",
    "involute-shifted-23-47",
    "high-contact-ratio",
    "crc-23-47",
    "cycloidal-23-47",
    "parabolic-23-47",
    "jia-parabolic-17-29",
    "circular-arc-23-47",
    "s-gear-23-47",
    "points-23-47",
]


def knots():
    return LENGTH / 2 * even_places(len(ANGLES))


def with_shape(**changes):
    return FREE._replace(shape=FREE.shape._replace(**changes))


def test_the_angle_is_the_not_a_knot_spline_through_the_values():
    """Scipy's; 0 is one of the knots for an even number of values too."""
    path = FAMILY.working_path(FREE)
    assert knots()[len(ANGLES) // 2] == 0.0
    r = np.linspace(-LENGTH / 2, LENGTH / 2, 501)
    reference = CubicSpline(knots(), ANGLES)
    np.testing.assert_allclose(path.pressure_angle(r), reference(r), atol=1e-14)
    np.testing.assert_allclose(path.pressure_angle_slope(r), reference(r, 1), atol=1e-11)


def test_a_corner_adds_its_share_of_the_distance():
    corner = np.radians(1.5)
    path = FAMILY.working_path(with_shape(corner=corner))
    r = np.linspace(-LENGTH / 2, LENGTH / 2, 400)
    smooth = CubicSpline(knots(), ANGLES - corner * np.abs(knots()) / (LENGTH / 2))
    np.testing.assert_allclose(
        path.pressure_angle(r), smooth(r) + corner * np.abs(r) / (LENGTH / 2), atol=1e-14
    )


def test_beyond_the_knots_the_slope_fades_and_the_path_goes_on_straight():
    path = FAMILY.working_path(FREE)
    for end, interval in ((-LENGTH / 2, LENGTH / 8), (LENGTH / 2, LENGTH / 6)):
        way = np.sign(end)
        slope = path.pressure_angle_slope(end)
        assert path.pressure_angle_slope(end + way * 1e-9) == pytest.approx(slope, rel=1e-5)
        assert path.pressure_angle_slope(end + way * interval / 2) == pytest.approx(slope / 2, rel=1e-9)
        assert path.pressure_angle_slope(end + way * 1.01 * interval) == 0.0
        rise = path.pressure_angle(end + way * 2 * interval) - path.pressure_angle(end)
        assert rise == pytest.approx(way * slope * interval / 2, rel=1e-9)


def test_both_gears_and_racks_touch_along_a_common_normal():
    """At every phase the cut flanks of both meet on the path, and the normal passes through P."""
    pair = check(FAMILY, FREE)
    r = np.linspace(pair.r_start, pair.r_end, 41)
    ratio = pair.path.pinion_pitch_radius / pair.path.gear_pitch_radius
    place = {}
    for side in SIDES:
        sign = 1.0 if side == "pinion" else -1.0
        tooth, view = pair.tooth(side), pair.path_of(side)
        pitch = view.pinion_pitch_radius
        turned = pair.path.rotation(r) * (1.0 if side == "pinion" else -ratio)
        step = 1e-7
        points = []
        for shift in (0.0, step, -step):
            x, y = flank_point(tooth, sign * r + shift)
            angle = thickness_half_angle(tooth, pitch) - turned - np.arctan2(y, x)
            points.append(
                sign * np.stack([-np.hypot(x, y) * np.sin(angle), np.hypot(x, y) * np.cos(angle) - pitch])
            )
        place[side] = points[0]
        tangent = points[1] - points[2]
        alpha = pair.path.pressure_angle(r)
        across = tangent[0] * np.cos(alpha) + tangent[1] * np.sin(alpha)
        assert np.abs(across / np.hypot(*tangent)).max() < 1e-6
    np.testing.assert_allclose(place["pinion"], place["gear"], atol=1e-12)
    np.testing.assert_allclose(place["pinion"], np.stack(position(pair.path, r)), atol=1e-12)


@pytest.mark.parametrize("name", OTHERS)
@pytest.mark.parametrize("values", [7, 12])
def test_it_starts_from_every_other_path(name, values):
    """Within 1 um of all working flanks, with the contact ratio and the heights of the original."""
    model = load_drive(name)
    original = assemble(family(model.family), model.drive)
    fitted = fit_spline(original, values)
    check(FAMILY, fitted.drive)
    assert len(fitted.drive.shape.angles) == values
    assert flank_deviation(original, fitted) < 0.5e-6
    assert fitted.contact_ratio == pytest.approx(original.contact_ratio, abs=0.01)
    for side in SIDES:
        for radius in ("tip_radius", "root_radius"):
            ours, theirs = (getattr(pair.tooth(side), radius) for pair in (fitted, original))
            assert ours == pytest.approx(theirs, rel=1e-12)
    rho = [1.0 / kinematics(pair.path, 1e-4).relative_curvature for pair in (original, fitted)]
    assert rho[1] == pytest.approx(rho[0], rel=2e-2)


def test_the_deviation_is_the_distance_that_teeth_were_made_thicker():
    """By 2 x m tan α on the pitch circle, half of it on either flank, along the normal times cos α."""
    pair = assemble(involute.FAMILY, STANDARD)
    thicker = STANDARD._replace(
        pinion=STANDARD.pinion._replace(profile_shift=0.01, addendum=0.99),
        gear=STANDARD.gear._replace(profile_shift=-0.01, addendum=1.01),
    )
    expected = 0.01 * 0.003 * np.sin(STANDARD.pressure_angle)
    assert flank_deviation(pair, assemble(involute.FAMILY, thicker)) == pytest.approx(expected, rel=1e-6)


def test_a_shift_moves_thickness_from_gear_to_pinion():
    """As for an involute with x1 + x2 = 0, of which the shifted spline is the same tooth."""
    shifted = STANDARD._replace(
        pinion=STANDARD.pinion._replace(profile_shift=0.2), gear=STANDARD.gear._replace(profile_shift=-0.2)
    )
    shape = SplineShape(np.full(5, STANDARD.pressure_angle), None, 0.03, 0.0)
    ours = check(FAMILY, shifted._replace(pressure_angle=0.0, shape=shape))
    theirs = check(involute.FAMILY, shifted)
    for side in SIDES:
        for name in ("form_radius", "tip_radius", "root_radius", "half_angle", "corner_x"):
            assert getattr(ours.tooth(side), name) == pytest.approx(
                getattr(theirs.tooth(side), name), rel=1e-10
            )
    assert flank_deviation(ours, theirs) < 1e-12


def test_a_pair_at_its_own_centre_distance_becomes_one_of_another_module():
    original = assemble(involute.FAMILY, SHIFTED)
    fitted = check(FAMILY, fit_spline(original, 5).drive)
    path = original.path
    assert fitted.drive.module * SHIFTED.pinion.teeth / 2 == pytest.approx(path.pinion_pitch_radius)
    assert sum(getattr(fitted.drive, side).profile_shift for side in SIDES) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("name", ["involute-23-47", "cycloidal-23-47", "crc-23-47"])
def test_thinner_teeth_stay_thinner(name):
    model = load_drive(name, {"drive.pinion.thickness_allowance": "-60 um"})
    original = assemble(family(model.family), model.drive)
    fitted = check(FAMILY, fit_spline(original, 7).drive)
    assert flank_deviation(original, fitted) < 0.1e-6


@pytest.mark.soak
def test_geometry_differentiates_by_every_value():
    """Contact ratio, tip thickness, form radius and curvature at the end, against central differences."""
    at = np.concatenate([ANGLES, [LENGTH, np.radians(0.5)]])

    def figures(values):
        shape = SplineShape(values[:-2], None, values[-2], values[-1])
        pair = assemble(FAMILY, FREE._replace(shape=shape))
        thickness = flank_point(pair.pinion, pair.pinion.tip_distance)[1]
        curvature = kinematics(pair.path, pair.r_end).relative_curvature
        return [pair.contact_ratio, thickness, pair.gear.form_radius, curvature]

    with jax.enable_x64(True):
        slopes = jax.jit(jax.jacfwd(figures), compiler_options=ONE_CALL)(at)
    value = figures(at)
    for i, place in enumerate(at):
        step = 1e-5 * place
        ends = [figures(at + sign * step * (np.arange(len(at)) == i)) for sign in (1, -1)]
        for k, slope in enumerate(slopes):
            difference = (ends[0][k] - ends[1][k]) / (2 * step)
            assert slope[i] == pytest.approx(difference, rel=1e-5, abs=1e-7 * abs(value[k]) / place)


MM = 1e-3
REFUSED = {
    "too few": (with_shape(angles=ANGLES[:3]), "angles = 3 values", "more"),
    "both": (with_shape(knots=knots()), "contradict", "one of them"),
    "neither": (with_shape(path_length=None), "missing", "one of them"),
    "another number": (with_shape(path_length=None, knots=knots()[:-1]), "7 knots and 8 angles", "as many"),
    "not ascending": (
        with_shape(path_length=None, knots=knots()[[0, 2, 1, 3, 4, 5, 6, 7]]),
        "knots.2",
        "sort",
    ),
    "no pitch point": (with_shape(path_length=None, knots=knots() + 1 * MM), "pitch point", "0 mm"),
    "one-sided": (with_shape(path_length=None, knots=knots() - knots()[0]), "either side", "0 mm"),
    "turned up": (with_shape(angles=np.where(np.arange(8) == 6, 1.5, ANGLES)), "angles.6", "change"),
    "swings": (with_shape(angles=np.radians([60, 2, 60, 2, 20, 20, 20, 20])), "between or beyond", "less"),
    "one shift": (
        FREE._replace(pinion=FREE.pinion._replace(profile_shift=0.1)),
        "gear.profile_shift",
        "use -0.1",
    ),
    "undercut": (with_shape(angles=np.radians([12, 12, 12, 16, 22, 22, 22, 22])), "undercut", ""),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name):
    drive, rule, advice = REFUSED[name]
    with pytest.raises(InputError) as caught:
        check(FAMILY, drive)
    message = str(caught.value)
    assert rule in message, message
    assert advice in message, message


@pytest.mark.parametrize("steep", [0, 1, 2])
def test_the_value_named_is_the_one_beside_the_swing(steep):
    """Of a path and of the one that runs the other way round."""
    named = []
    for order in (slice(None), slice(None, None, -1)):
        angles = np.radians(np.roll([70, 2, 60, 20, 20, 20, 20], steep))[order]
        with pytest.raises(InputError, match="between or beyond") as caught:
            check(FAMILY, with_shape(angles=angles))
        named.append(int(str(caught.value.key).rpartition(".")[2]))
    assert named[0] + named[1] == 6


@pytest.mark.parametrize(("half", "place"), [(-1, 0), (1, len(ANGLES) - 1)])
def test_advice_names_the_outermost_angle_of_the_half(half, place):
    key, value, _ = _advice(FREE, half)
    assert key == f"shape.angles.{place}"
    assert float(value.removesuffix(" deg")) == pytest.approx(np.degrees(ANGLES[place]), rel=1e-3)
