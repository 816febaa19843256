"""The matrices of trains that others are compared with, against closed forms."""

import numpy as np
import pytest

from tests.support.train_closed_forms import (
    elastic_two_stage,
    fixed_free_chain,
    free_chain,
    planar_idler_determinant,
    rigid_two_stage,
    torsional_idler,
)
from tests.support.train_matrices import (
    BACK,
    GROUND,
    Bearing,
    Body,
    Mesh,
    Shaft,
    Train,
    free_coordinates,
    natural_frequencies,
    rotations,
)

ALPHA = np.radians([20.0, 24.5])
INERTIAS = [0.03, 4e-4, 7e-3, 9e-4, 0.021, 0.4]
SHAFTS = [2.1e4, 5.7e4, 1.9e5]
RADII = [0.0375, 0.0765, 0.041, 0.098]
STIFFNESS = [3.1e8, 4.3e8]
#: Rounding of eigenvalues: 1e-15 of the largest, whose frequency is some hundred times the smallest.
EXACT = 1e-9


def two_stage(stiffness=STIFFNESS):
    meshes = (
        Mesh((1, 2), (RADII[0], RADII[1]), 0.3, ALPHA[0], 1, stiffness[0]),
        Mesh((3, 4), (RADII[2], RADII[3]), -1.9, ALPHA[1], -1, stiffness[1]),
    )
    shafts = tuple(Shaft((i, i + 1), k) for i, k in zip((0, 2, 4), SHAFTS, strict=True))
    return Train(tuple(Body(1.0, inertia) for inertia in INERTIAS), shafts=shafts, meshes=meshes)


@pytest.mark.parametrize("count", [1, 2, 3, 7])
def test_equal_discs_on_a_shaft_that_is_held(count):
    shafts = tuple(Shaft((i - 1 if i else GROUND, i), 3e4) for i in range(count))
    train = Train((Body(1.0, 0.02),) * count, shafts=shafts)
    expected = fixed_free_chain(count, 3e4, 0.02)
    np.testing.assert_allclose(natural_frequencies(train, rotations(train)), expected, rtol=EXACT)


def test_any_discs_on_a_free_shaft():
    stiffness = [2e4, 5e4, 1e3, 8e4, 3e4]
    shafts = tuple(Shaft((i, i + 1), k) for i, k in enumerate(stiffness))
    train = Train(tuple(Body(1.0, inertia) for inertia in INERTIAS), shafts=shafts)
    found = natural_frequencies(train, rotations(train))
    np.testing.assert_allclose(found, free_chain(INERTIAS, stiffness), rtol=EXACT)


def test_two_stages_with_elastic_teeth():
    train = two_stage()
    base = np.array(RADII) * np.cos(ALPHA)[[0, 0, 1, 1]]
    expected = elastic_two_stage(INERTIAS, SHAFTS, STIFFNESS, list(base))
    np.testing.assert_allclose(natural_frequencies(train, rotations(train)), expected, rtol=EXACT)


def test_two_stages_become_those_with_rigid_teeth():
    """By the first order in the teeth's compliance."""
    expected = rigid_two_stage(INERTIAS, SHAFTS, [RADII[0] / RADII[1], RADII[2] / RADII[3]])
    errors = []
    for factor in (1e2, 1e3):
        train = two_stage([factor * k for k in STIFFNESS])
        found = natural_frequencies(train, rotations(train))
        assert found[0] == 0.0
        errors.append(np.abs(found[1:4] / expected[1:] - 1.0))
    assert np.all(errors[1] < 1e-4)
    np.testing.assert_allclose(errors[0] / errors[1], 10.0, rtol=0.02)


def idler(azimuths, sense, flank, bearings=(2e8, 3e8, 5e8)):
    bodies = (Body(1.3, 1.1e-3), Body(2.9, 6.2e-3), Body(4.1, 0.017))
    meshes = (
        Mesh((0, 1), (0.03, 0.045), azimuths[0], ALPHA[0], sense, STIFFNESS[0], flank=flank),
        Mesh((1, 2), (0.046, 0.07), azimuths[1], ALPHA[1], -sense, STIFFNESS[1], flank=flank),
    )
    springs = tuple(Bearing(i, (k, k)) for i, k in enumerate(bearings))
    return Train(bodies, springs, meshes=meshes)


IDLER_BASE = [float(r) for r in np.array([0.03, 0.045, 0.046, 0.07]) * np.cos(ALPHA)[[0, 0, 1, 1]]]


def test_an_idler_on_rigid_bearings():
    train = idler((0.7, -1.1), 1, 1)
    inertias = [body.inertia for body in train.bodies]
    free = natural_frequencies(train, rotations(train))
    np.testing.assert_allclose(free, torsional_idler(inertias, IDLER_BASE, STIFFNESS), rtol=EXACT)
    held = natural_frequencies(train, [5, 8])
    inertias[0] = np.inf
    np.testing.assert_allclose(held, torsional_idler(inertias, IDLER_BASE, STIFFNESS)[1:], rtol=EXACT)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("flank", [1, BACK])
@pytest.mark.parametrize("azimuths", [(0.7, -1.1), (2.9, 2.2), (-1.0, -1.0)])
@pytest.mark.parametrize("held", [False, True])
def test_an_idler_on_elastic_bearings(azimuths, sense, flank, held):
    train = idler(azimuths, sense, flank)
    # the normal stands a quarter turn less the pressure angle from the line of centres, in the sense of the
    # driver for driving flanks, against it for back ones
    between = azimuths[0] - azimuths[1] + sense * flank * (np.pi - ALPHA[0] - ALPHA[1])
    inertias = [np.inf if held and i == 0 else body.inertia for i, body in enumerate(train.bodies)]
    masses, bearings = [body.mass for body in train.bodies], [2e8, 3e8, 5e8]
    found = natural_frequencies(train, free_coordinates(train, (0,) if held else ()))
    assert np.count_nonzero(found == 0.0) == (0 if held else 1)
    across = np.sqrt(np.array(bearings) / masses) / (
        2 * np.pi
    )  # bodies that move across their lines of action
    checked = 0
    for frequency in found[found > 0.0]:
        if np.min(np.abs(across / frequency - 1)) < 1e-6:
            continue
        ends = [
            planar_idler_determinant(
                frequency * (1 + step), masses, inertias, bearings, IDLER_BASE, STIFFNESS, between
            )
            for step in (-EXACT, EXACT)
        ]
        assert ends[0] * ends[1] < 0.0, frequency
        checked += 1
    # of the idler both directions are excited unless the lines of action are parallel
    assert checked == len(found) - (0 if held else 1) - 2
