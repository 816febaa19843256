"""Timoshenko elements: closed forms of beams with shear, rigid motions, and Jourawski's shear factors."""

import math

import numpy as np
import pytest

from tribodyn.train.elastic.beam import DIRECTIONS, ShaftMetal, ShaftSection, element, shear_factor
from tribodyn.train.elastic.system import PlacedShaft, ShaftSystem, structure_of

STEEL = ShaftMetal(206e9, 0.3)
LENGTH, DIAMETER, BORE = 0.12, 0.04, 0.015


def numbers(section: ShaftSection) -> tuple[float, float, float]:
    """E I, κ G A and E A."""
    area = math.pi / 4.0 * (section.diameter**2 - section.bore**2)
    inertia = math.pi / 64.0 * (section.diameter**4 - section.bore**4)
    shear = shear_factor(0.3, section.bore / section.diameter) * 206e9 / 2.6 * area
    return 206e9 * inertia, shear, 206e9 * area


def stiffness_between(sections: list[ShaftSection], places: list[float]) -> np.ndarray:
    """Of a free shaft in x, y, z and tilts of places along it; other nodes carry no load."""
    shaft = PlacedShaft(tuple(sections), STEEL, 7850.0, tuple(places), (), 0.0)
    structure = structure_of(ShaftSystem((shaft,)))
    kept = [first + direction for first in structure.points for direction in range(DIRECTIONS)]
    rest = np.setdiff1d(np.arange(structure.nodal), [*kept, *structure.turns])
    whole = structure.stiffness
    follows = np.linalg.solve(whole[np.ix_(rest, rest)], whole[np.ix_(rest, kept)])
    return whole[np.ix_(kept, kept)] - whole[np.ix_(kept, rest)] @ follows


@pytest.mark.parametrize("bore", [0.0, BORE])
@pytest.mark.parametrize("pieces", [1, 3])
def test_a_cantilever_with_shear(bore: float, pieces: int):
    """At its end under a force w = F L³/(3 E I) + F L/(κ G A), θ = F L²/(2 E I)."""
    section = ShaftSection(LENGTH / pieces, DIAMETER, bore)
    ends = stiffness_between([section] * pieces, [0.0, LENGTH])
    flexible = np.linalg.inv(ends[5:, 5:])
    bending, shear, axial = numbers(section)
    deflection, slope = LENGTH**3 / (3.0 * bending) + LENGTH / shear, LENGTH**2 / (2.0 * bending)
    expected = np.diag(
        [deflection, deflection, LENGTH / axial, LENGTH / bending, LENGTH / bending],
    )
    expected[0, 4] = expected[4, 0] = slope  # dx/dz = tilt_y
    expected[1, 3] = expected[3, 1] = -slope  # dy/dz = −tilt_x
    assert flexible == pytest.approx(expected, rel=1e-9, abs=1e-9 * LENGTH / axial)


def test_a_simply_supported_beam_with_shear():
    """Load at a of L: w = F a² b²/(3 E I L) + F a b/(κ G A L)."""
    section, a = ShaftSection(LENGTH, DIAMETER), 0.05
    b = LENGTH - a
    places = stiffness_between([section], [0.0, a, LENGTH])
    free = [3, 4, 5, 6, 8, 9, 13, 14]  # tilts of the ends; the load's place, but along z
    deflection = np.linalg.inv(places[np.ix_(free, free)])[2, 2]
    bending, shear, _ = numbers(section)
    expected = a**2 * b**2 / (3.0 * bending * LENGTH) + a * b / (shear * LENGTH)
    assert deflection == pytest.approx(expected, rel=1e-9)


def test_rigid_motions_take_no_force():
    sections = [ShaftSection(0.03, 0.03), ShaftSection(0.05, 0.05, 0.02), ShaftSection(0.02, 0.025)]
    places = np.array([0.012, 0.055, 0.1])
    stiffness = stiffness_between(sections, places.tolist())
    assert stiffness == pytest.approx(stiffness.T, rel=1e-9)
    rigid = np.zeros((15, 5))
    for node, z in enumerate(places):
        rigid[5 * node : 5 * node + 5] = np.eye(5)
        rigid[5 * node, 4], rigid[5 * node + 1, 3] = z, -z
    assert np.max(np.abs(stiffness @ rigid)) < 1e-8 * np.max(np.abs(stiffness))


@pytest.mark.parametrize(("places", "order"), [([0.1, 0.02], [1, 0])])
def test_places_come_in_the_order_asked_for(places: list[float], order: list[int]):
    section = ShaftSection(0.12, 0.03)
    one, other = (
        stiffness_between([section], places),
        stiffness_between([section], places[::-1]),
    )
    rows = np.concatenate([np.arange(5 * k, 5 * k + 5) for k in order])
    assert one == pytest.approx(other[np.ix_(rows, rows)])


def test_shear_factors_of_cowper():
    """Full round sections 6 (1 + ν)/(7 + 6 ν), thin tubes 2 (1 + ν)/(4 + 3 ν)."""
    assert shear_factor(0.3, 0.0) == pytest.approx(7.8 / 8.8)
    assert shear_factor(0.3, 1.0) == pytest.approx(2.6 / 4.9)


def test_a_short_element_shears_alone():
    section = ShaftSection(1e-4, DIAMETER)
    _, shear, _ = numbers(section)
    assert element(section, 1e-4, STEEL)[0, 0] == pytest.approx(shear / 1e-4, rel=1e-3)
