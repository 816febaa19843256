"""Natural frequencies of planetary sets: a published table, and a closed form."""

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.support.planetary_springs import (
    CARRIER,
    FIRST_PLANET,
    RING,
    SUN,
    Member,
    PlanetarySet,
    planetary_springs,
)
from tribodyn.dynamics.modes import MIXED, PLANET, ROTATIONAL, TRANSLATIONAL, linearised, mode_kinds, modes
from tribodyn.train.structure import shift_of, turn_of

ALPHA = np.radians(24.6)
TEETH, MODULE = (27, 35, 97), 3e-3
BASE = [MODULE * teeth / 2 * np.cos(ALPHA) for teeth in TEETH]
PINS = MODULE * (TEETH[0] + TEETH[1]) / 2
#: Lin & Parker, J. Vib. Acoust. 121 (1999) 316, Tables 1 and 2, Hz: rotational, translational (each twice)
#: and planet modes (each N - 3 times).
PUBLISHED = {
    3: (
        (0.0, 1475.7, 1930.3, 2658.3, 7462.8, 11775.3),
        (743.2, 1102.4, 1896.0, 2276.4, 6986.3, 9647.9),
        (),
    ),
    4: (
        (0.0, 1536.6, 1970.6, 2625.7, 7773.6, 13071.1),
        (727.0, 1091.0, 1892.8, 2342.5, 7189.9, 10437.6),
        (1808.2, 5963.8, 6981.7),
    ),
}


def lin_parker(planets):
    """The helicopter set of the paper; I/r² by base radii, the carrier's by that of the pins."""
    angles = tuple(2.0 * np.pi * np.arange(planets) / planets)
    return PlanetarySet(
        Member(0.4, 0.39 * BASE[0] ** 2, 1e8),
        Member(2.35, 3.0 * BASE[2] ** 2, 1e8),
        Member(5.43, 6.29 * PINS**2, 1e8),
        Member(0.66, 0.61 * BASE[1] ** 2, 1e8),
        angles,
        TEETH,
        MODULE,
        ALPHA,
        (5e8, 5e8),
        1e9 * BASE[2] ** 2,
    )


@pytest.mark.parametrize("planets", [3, 4])
def test_of_lin_and_parker(planets):
    """The torque drives: the rigid rotation, of 0 Hz, is not among the modes."""
    rotational, translational, planet = PUBLISHED[planets]
    model, cycles = planetary_springs(lin_parker(planets))
    found = modes(model, cycles)
    kinds = np.array(mode_kinds(found, model, (SUN, RING, CARRIER)))
    expected = {
        ROTATIONAL: rotational[1:],
        TRANSLATIONAL: np.repeat(translational, 2),
        PLANET: np.repeat(planet, planets - 3),
    }
    assert len(kinds) == sum(map(len, expected.values()))
    for kind, frequencies in expected.items():
        np.testing.assert_allclose(found.frequency[kinds == kind], frequencies, rtol=0.0, atol=0.5)


def test_unequal_planets_mix_the_kinds():
    angles = (0.0, 2.0, 4.4)
    model, cycles = planetary_springs(lin_parker(3)._replace(angles=angles))
    assert MIXED in mode_kinds(modes(model, cycles), model, (SUN, RING, CARRIER))


@pytest.mark.parametrize("planets", [3, 4, 5])
def test_of_kahraman(planets):
    """Torsion alone, the ring held (Kahraman 1994): planets go with their pins, all other axes are fixed."""
    given = lin_parker(planets)._replace(mesh_stiffness=(5e8, 3e8))
    mass, stiffness = linearised(*planetary_springs(given))
    layout = planetary_springs(given)[0].layout
    kept = np.zeros((layout.half, planets + 2))
    kept[turn_of(SUN, layout), 0] = 1.0
    kept[turn_of(CARRIER, layout), 1] = 1.0
    for i, angle in enumerate(given.angles):
        body = FIRST_PLANET + i
        kept[turn_of(body, layout), 2 + i] = 1.0
        place = shift_of(body)
        kept[place : place + 2, 1] = PINS * np.array([-np.sin(angle), np.cos(angle)])
    assert not np.any(kept[turn_of(RING, layout)])
    found = eigh(kept.T @ stiffness @ kept, kept.T @ mass @ kept, eigvals_only=True)
    k2, k1 = given.mesh_stiffness  # k2 of the sun, k1 of the ring
    m_s, m_p = 0.39, 0.61
    m_c = (6.29 + planets * 0.66) / np.cos(ALPHA) ** 2  # on the pins' motion along the lines of action
    rest = np.roots(
        [
            m_p * m_c * m_s,
            -(planets * k2 * m_p * m_c + (k1 + k2) * m_c * m_s + planets * (k1 + k2) * m_p * m_s),
            planets * k1 * k2 * (planets * m_p + m_c + 4.0 * m_s),
        ]
    )
    expected = np.sort([0.0, *[(k1 + k2) / m_p] * (planets - 1), *rest])
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * expected[-1])
