"""A shaft on springs in a housing that gives: springs in series; one that hardly gives is a stiff one."""

import numpy as np
import pytest

from tests.support.beam_element import STEEL, bar
from tribodyn.input.tables.housing_matrices import without
from tribodyn.train.elastic.beam import ShaftSection
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.system import PlacedBearing, PlacedShaft, ShaftSystem, settled, structure_of

#: Springs at both ends of a shaft, one of which holds it along its axis.
LEFT = tuple(map(tuple, np.diag([2e8, 1e8, 1e8, 0.0, 0.0]).tolist()))
RIGHT = tuple(map(tuple, np.diag([1e8, 3e8, 0.0, 0.0, 0.0]).tolist()))
LENGTH, PLACE = 0.2, 0.08
LOAD = (1500.0, -3000.0, 400.0, 20.0, 0.0)


def _system(housing):
    seats = (None, None) if housing is None else ("A", None)
    bearings = (PlacedBearing(0.0, LEFT, seats[0]), PlacedBearing(LENGTH, RIGHT, seats[1]))
    sections = (ShaftSection(LENGTH, 0.04),)
    shaft = PlacedShaft(sections, STEEL, 7850.0, (PLACE,), bearings, 10.0)
    return structure_of(ShaftSystem((shaft,), housing))


def test_the_housing_yields_in_series_with_the_bearing():
    """Equilibrium alone gives the forces of the bearings: the shaft goes rigidly where its seat goes."""
    housing = without(bar(diameter=0.1), ("B",))
    stiff, given = settled(_system(None), [LOAD]), settled(_system(housing), [LOAD])
    for one, other in zip(stiff.bearings, given.bearings, strict=True):
        np.testing.assert_allclose(one.force, other.force, rtol=1e-6, atol=1e-6)
    force = np.zeros(housing.coordinates)
    force[:5] = given.bearings[0].force
    seat = np.linalg.solve(housing.stiffness, force)
    expected = stiff.points[0][:3] + seat[:3] * np.array([1.0 - PLACE / LENGTH, 1.0 - PLACE / LENGTH, 1.0])
    np.testing.assert_allclose(given.points[0][:3], expected, rtol=1e-6)
    np.testing.assert_allclose(given.moved[-housing.coordinates :][:SIX], seat[:SIX], rtol=1e-5, atol=1e-12)


def test_a_housing_a_million_times_as_stiff_is_a_stiff_one():
    housing = without(bar(diameter=0.1), ("B",))
    stiff = settled(_system(None), [LOAD]).points
    housed = settled(_system(housing._replace(stiffness=1e6 * housing.stiffness)), [LOAD]).points
    np.testing.assert_allclose(housed[0][:5], stiff[0][:5], rtol=1e-3, atol=1e-9)
    assert housed[0][0] == pytest.approx(stiff[0][0], rel=1e-3)
