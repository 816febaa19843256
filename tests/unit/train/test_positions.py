"""Axes of trains against triangles, and trains that have no room."""

from math import pi, sqrt

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.train.positions import Disc, Distance, check_room, places


def mesh(ends: tuple[int, int], distance: float, degrees: float | None = None, tolerance=1e-6) -> Distance:
    azimuth = None if degrees is None else degrees * pi / 180
    return Distance(f"stage.{ends[0]}{ends[1]}", ends, distance, azimuth, tolerance)


def test_a_chain_goes_along_x_unless_an_azimuth_says_otherwise():
    found = places(3, [mesh((0, 1), 0.1), mesh((1, 2), 0.2, 90.0)], [])
    np.testing.assert_allclose(found.centres, [[0, 0], [0.1, 0], [0.1, 0.2]], atol=1e-15)
    backward = places(3, [mesh((1, 0), 0.1), mesh((2, 1), 0.2)], [])
    np.testing.assert_allclose(backward.centres, [[0, 0], [0.1, 0], [0.3, 0]], atol=1e-15)
    assert np.cos(backward.azimuths) == pytest.approx(-1.0)


def test_an_azimuth_holds_for_the_order_in_which_the_gears_are_named():
    """From the first gear to the second, whichever of them is placed first."""
    found = places(2, [mesh((1, 0), 0.1, 30.0)], [])
    np.testing.assert_allclose(found.centres[1], [-0.05 * sqrt(3), -0.05], atol=1e-15)


def test_coupled_bodies_share_an_axis():
    found = places(4, [mesh((0, 1), 0.1), mesh((2, 3), 0.2)], [(1, 2)])
    np.testing.assert_allclose(found.centres, [[0, 0], [0.1, 0], [0.1, 0], [0.3, 0]])


def test_the_last_mesh_of_a_loop_needs_no_azimuth():
    """3-4-5."""
    found = places(4, [mesh((0, 1), 3.0, 0.0), mesh((1, 2), 4.0, 90.0), mesh((0, 3), 5.0)], [(2, 3)])
    assert found.azimuths[2] == pytest.approx(np.arctan2(4.0, 3.0), abs=1e-15)
    np.testing.assert_allclose(found.centres[3], [3, 4])


@pytest.mark.parametrize(
    ("last", "missed"), [(mesh((0, 2), 5.001), "1 mm"), (mesh((0, 2), 5.0, 53.0), "11.4 mm")]
)
def test_a_loop_that_does_not_close(last, missed):
    with pytest.raises(
        InputError, match=rf"does not close, by {missed}.*leave 5000 mm at 53\.1301 deg"
    ) as caught:
        places(3, [mesh((0, 1), 3.0, 0.0), mesh((1, 2), 4.0, 90.0), last], [])
    assert caught.value.key == "stage.02"


def disc(name: str, body: int, plane: int, radius: float) -> Disc:
    return Disc(name, f"gear.{name}", body, plane, radius)


def test_gears_of_one_plane_need_room_unless_they_mesh():
    """A driver of an idler, folded back upon the gear that the idler drives."""
    gears = [disc("a", 0, 1, 0.055), disc("idler", 1, 1, 0.055), disc("b", 2, 1, 0.055)]
    meshing = [(0, 1), (1, 2)]
    free = places(3, [mesh((0, 1), 0.1, 0.0), mesh((1, 2), 0.1, 110.0)], []).centres
    check_room(gears, free, meshing)
    folded = places(3, [mesh((0, 1), 0.1, 0.0), mesh((1, 2), 0.1, 125.0)], []).centres
    with pytest.raises(InputError, match=r"overlaps that of a by 17\.7 mm") as caught:
        check_room(gears, folded, meshing)
    assert caught.value.key == "gear.b"
    check_room([*gears[:2], gears[2]._replace(plane=2)], folded, meshing)
