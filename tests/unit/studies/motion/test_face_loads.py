"""Loads along the faces of gears on drawn shafts, in static equilibrium of the whole gearbox."""

from functools import lru_cache

import numpy as np
import pytest

from tests.support.overhung_train import overhung_train
from tests.support.train_scenarios import case_of_table
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.train.face_loads import FaceLoads, Spread, spread_of


@lru_cache
def spread(mirrored: bool = False, hand: str = "right") -> Spread:
    return spread_of(prepare(case_of_table(overhung_train(mirrored=mirrored, hand=hand))))


def only(found: Spread) -> FaceLoads:
    (loads,) = found.meshes
    assert loads is not None
    return loads


def test_the_mirror_image_is_loaded_at_the_other_end():
    one, other = only(spread()), only(spread(mirrored=True, hand="left"))
    assert other.misalignment == pytest.approx(-one.misalignment, rel=1e-9)
    assert other.centre == pytest.approx(-one.centre, rel=1e-9)
    np.testing.assert_allclose(other.line_load[::-1], one.line_load, rtol=1e-8, atol=1e-6)
    np.testing.assert_allclose(other.pressure[..., ::-1], one.pressure, rtol=1e-8, atol=1.0)


@pytest.mark.parametrize("hand", ["right", "left"])
def test_the_end_that_opens_carries_less(hand: str):
    loads = only(spread(hand=hand))
    assert loads.misalignment > 0.0  # the overhung pinion yields at its free end, at larger z
    assert loads.centre < 0.0
    assert loads.factor > 1.5
    assert np.all(np.diff(loads.line_load) < 0.0)


def test_the_loads_along_the_face_are_those_of_the_torque():
    """Along the normal, mean over the face: F_t/(cos α_n cos β), at the pitch circle of 25 of 75 parts."""
    loads, (mesh,) = only(spread()), spread().prepared.case.meshes
    radius = 50 * 3e-3 / np.cos(np.radians(15.0)) / 2.0
    normal = 300.0 / radius / np.cos(np.radians(20.0)) / np.cos(np.radians(15.0))
    assert float(mesh.pair.drive.gear.face_width) * np.mean(loads.line_load) == pytest.approx(
        normal, rel=2e-3
    )


def test_springs_stand_at_once():
    assert spread().passes == 0


def test_a_load_off_the_middle_tilts_the_gears_back():
    """The uneven load moves to the stiff end: less misalignment than under the load in the middle."""
    (mesh,) = spread().prepared.case.meshes
    in_the_middle = mesh.pair.supports.misalignment.in_plane * float(mesh.pair.drive.gear.face_width)
    assert 0.7 * in_the_middle < only(spread()).misalignment < in_the_middle
