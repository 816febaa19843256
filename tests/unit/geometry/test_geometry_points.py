"""A path of contact through given points, from its first to its last."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

from tests.support.sample_drives import LIU_NI
from tribodyn.errors import InputError
from tribodyn.geometry.families import points

PLACES = 0.003 * np.linspace(-6.0, 6.0, 13)
#: Angles that bend at the pitch point.
BENT = LIU_NI.pressure_angle + 0.05 * np.tanh(PLACES / 0.009)


def through(r, alpha):
    """A drive whose path has the angles at the distances from the pitch point."""
    place = np.stack([r * np.cos(alpha), r * np.sin(alpha)], axis=-1)
    return LIU_NI._replace(shape=points.PointsShape(place))


def test_rotation_is_the_integral_between_all_points():
    """Also between the outermost two of each end, which working flanks seldom reach."""
    path = points.FAMILY.working_path(through(PLACES, BENT))

    def slope(s):
        return 1.0 / (path.pinion_pitch_radius * np.cos(path.pressure_angle(s)))

    for low, high in pairwise(PLACES):
        turned, _ = quad(slope, low, high)
        inside = 1e-9 * (high - low)
        found = path.rotation(high - inside) - path.rotation(low + inside)
        assert found == pytest.approx(turned, rel=1e-8)
        assert path.rotation(high + inside) == pytest.approx(path.rotation(high - inside), abs=1e-9)
    assert path.rotation(0.0) == 0.0


@pytest.mark.parametrize("half", [-1, 1])
def test_a_pressure_angle_that_the_points_do_not_go_on_from_is_refused(half: int):
    """On either side of P; the advice is the angle there, by the parabola through the nearest points."""
    r = PLACES
    # of the other half the angle at P is the one that is given
    off = np.where(half * r > 0, np.radians(3.0), 0.0)
    alpha = LIU_NI.pressure_angle + off + 0.02 * r / 0.018 + 0.03 * (r / 0.018) ** 2
    with pytest.raises(InputError, match=r"does not go on from the path's points") as error:
        points.FAMILY.check(through(r, alpha))
    advised = float(error.value.remedy.split('"')[1].removesuffix(" deg"))
    assert advised == pytest.approx(np.degrees(LIU_NI.pressure_angle) + 3.0, abs=2e-3)


def test_the_angle_is_held_beyond_the_points():
    path = points.FAMILY.working_path(through(PLACES, BENT))
    for place, inside in ((0, 1.0), (-1, -1.0)):
        beyond = PLACES[place] - inside * np.array([1e-6, 0.004])
        np.testing.assert_array_equal(path.pressure_angle_slope(beyond), 0.0)
        np.testing.assert_allclose(path.pressure_angle(beyond), BENT[place], rtol=1e-12)
        assert path.pressure_angle_slope(PLACES[place]) != 0.0


@pytest.mark.parametrize("half", [-1, 1])
def test_each_side_of_the_pitch_point_needs_its_points(half: int):
    least = points._MINIMUM_POINTS

    def refusal(count):
        r = np.sort(0.003 * half * np.append(np.arange(-6.0, 1.0), np.arange(1.0, count + 1.0)))
        try:
            points.FAMILY.check(through(r, LIU_NI.pressure_angle))
        except InputError as error:
            return f"{error.value} {error.rule}"
        return ""

    side = "after" if half > 0 else "before"
    assert refusal(least - 1) == f"{least - 1} points fewer than {least} {side} the pitch point"
    assert "fewer than" not in refusal(least)  # whether or not it is long enough for the teeth


def test_each_half_is_the_spline_through_its_points():
    """Not-a-knot by itself, so that the angle may bend at P."""
    r = 0.003 * np.array([-6.0, -4.7, -3.9, -2.2, -1.0, 0.0, 0.8, 2.1, 2.9, 4.4, 6.0])
    alpha = LIU_NI.pressure_angle + np.where(r < 0, 3.0, 5.0) * np.abs(r) + 0.02 * np.sin(400.0 * r)
    path = points.FAMILY.working_path(through(r, alpha))
    for half in (slice(0, 6), slice(5, 11)):
        spline = CubicSpline(r[half], alpha[half], bc_type="not-a-knot")
        at = np.linspace(r[half][0], r[half][-1], 40)[1:-1]
        np.testing.assert_allclose(path.pressure_angle(at), spline(at), rtol=1e-10)
        np.testing.assert_allclose(path.pressure_angle_slope(at), spline(at, 1), rtol=1e-9)
