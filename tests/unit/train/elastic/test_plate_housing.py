"""A box of plates: mass, surface and rigid motions in closed form; bores that stay round are stiffer."""

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.train.elastic.plate_housing import PlateMetal, plate_housing
from tribodyn.train.elastic.superelement import frequencies, rigid_motions, sound

SIZE, WALL, RADIUS = (0.2, 0.16, 0.15), 0.012, 0.03
BORES = {"A": (0.1, 0.08, "front", RADIUS), "B": (0.1, 0.08, "back", RADIUS)}
COARSE = {"element_size": 0.2, "highest": 3000.0}


@pytest.fixture(scope="module")
def box():
    return plate_housing(SIZE, WALL, BORES, points={"top": (0.1, 0.16, 0.075)}, held=False, **COARSE)


def test_mass_and_rigid_motions(box):
    found = sound(box)[1]
    inside = np.prod(np.array(SIZE) - 2.0 * WALL)
    eight = 4.0 * np.sqrt(2.0) / 2.0 * RADIUS**2  # a circle through eight nodes
    volume = np.prod(SIZE) - inside - 2.0 * WALL * eight
    assert found.free
    assert found.mass == pytest.approx(PlateMetal().density * volume, rel=1e-6)
    motions = rigid_motions(box.places, box.modes)
    strained = np.abs(np.linalg.eigvalsh(motions.T @ box.stiffness @ motions)).max()
    assert np.sqrt(strained / found.mass) < 1e-6 * 2.0 * np.pi * found.lowest


def test_area_of_a_rigid_shift_is_that_of_both_walls_across_it(box):
    shift = rigid_motions(box.places, box.modes)[:, 1]
    assert shift @ box.radiation.area @ shift == pytest.approx(2.0 * SIZE[0] * SIZE[2], rel=1e-9)


def test_area_of_a_rigid_turn_about_the_middle_axis(box):
    """Walls beside and above move along their normals by the distance from their middle: ∫ s² dS."""
    turn = rigid_motions(box.places, box.modes, about=np.array(SIZE) / 2.0)[:, 5]
    expected = 2.0 * SIZE[2] * (SIZE[0] ** 3 + SIZE[1] ** 3) / 12.0
    assert turn @ box.radiation.area @ turn == pytest.approx(expected, rel=1e-9)


def test_the_point_on_top_moves_as_the_box_is_turned(box):
    turn = rigid_motions(box.places, box.modes, about=np.zeros(3))[:, 5]
    np.testing.assert_allclose(box.motion_of("top") @ turn, [-0.16, 0.1, 0.0], atol=1e-9)


def test_bolts_and_round_bores_stiffen(box):
    held, rigid = (plate_housing(SIZE, WALL, BORES, rigid_bores=ring, **COARSE) for ring in (False, True))
    assert not sound(held)[1].free
    assert np.all(frequencies(held)[:6] > frequencies(box)[:6] + 1.0)
    assert frequencies(rigid)[0] > frequencies(held)[0]


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"thickness": 0.1}, "thickness"),
        ({"bores": {"A": (0.02, 0.08, "front", RADIUS)}}, "bores.A"),
        ({"bores": {**BORES, "C": (0.11, 0.08, "front", RADIUS)}}, "bores.A"),
        ({"bores": {"A": (0.1, 0.08, "top", RADIUS)}}, "bores.A.wall"),
    ],
)
def test_what_is_no_box_is_refused(change, key):
    with pytest.raises(InputError) as refused:
        plate_housing(**{"size": SIZE, "thickness": WALL, "bores": BORES, **change})
    assert refused.value.key == key
