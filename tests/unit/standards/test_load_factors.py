"""K_Hα of loads that are known."""

import numpy as np
import pytest

from tribodyn.standards.load_factors import (
    disc_mass,
    face_load_factor_c,
    helix_running_in,
    run_in,
    running_in,
    shared_load,
    transverse_factor_b,
    transverse_load_factor,
)


def test_the_excess_counts_where_pairs_share():
    # ε_α = 1.5 from 0 to 1.5: two pairs up to a phase of 0.5, then one that carries everything
    phase = np.arange(10) / 10.0
    roll = np.stack([phase + 1.0, phase], axis=1)
    two = (phase <= 0.5)[:, None]
    accurate = np.where(two, [[50.0, 50.0]], [[0.0, 100.0]])
    deviating = np.where(two, [[30.0, 70.0]], [[0.0, 100.0]])
    loads = [shared_load(load, roll, (0.0, 1.5)) for load in (deviating, accurate)]
    assert loads == [70.0, 50.0]
    assert transverse_load_factor(*loads) == pytest.approx(1.4)
    assert transverse_load_factor(45.0, 50.0) == 1.0
    assert np.isnan(shared_load(accurate[6:], roll[6:], (0.0, 1.5)))


def test_method_b_of_example_1_of_iso_tr_6336_30_and_its_ends():
    # printed: K_Hα 1.0
    deviation = 0.925 * 8.5e-6
    assert transverse_factor_b((1.55, 1.083), 17.465e9, deviation, 1273.5e3 * 1.003 * 1.16) == 1.0
    # one pair carries all at no load: ε_γ/(ε_α Z_ε²), Z_ε² = (4 − ε_α)/3
    assert transverse_factor_b((1.5, 0.0), 20e9, 20e-6, 1.0) == pytest.approx(1.0 / (2.5 / 3.0))
    light, heavy = (transverse_factor_b((1.6, 0.0), 20e9, 10e-6, load) for load in (150e3, 160e3))
    assert light > heavy > 1.0


def test_running_in_by_material_and_speed():
    """y_α of ISO 6336-1: hard flanks 0.075 f_pb up to 3 µm, through-hardened 160/σ_Hlim, grey iron 0.275."""
    hard = running_in("case-hardened", 1500e6, 20.0)
    assert [hard.of(f) for f in (20e-6, 100e-6)] == pytest.approx([1.5e-6, 3e-6])
    slow, middle, fast = (running_in("through-hardened", 640e6, speed) for speed in (4.0, 8.0, 12.0))
    assert slow.of(200e-6) == pytest.approx(50e-6)
    assert middle.of(200e-6) == pytest.approx(12800 / 640 * 1e-6)
    assert fast.of(200e-6) == pytest.approx(6400 / 640 * 1e-6)
    iron = running_in("grey-iron", 300e6, 8.0)
    assert [iron.of(f) for f in (40e-6, 200e-6)] == pytest.approx([11e-6, 22e-6])
    assert run_in(40e-6, (hard, iron)) == pytest.approx(7e-6)
    assert helix_running_in("case-hardened", 1500e6, 20.0).of(100e-6) == pytest.approx(6e-6)
    assert helix_running_in("through-hardened", 640e6, 4.0).of(20e-6) == pytest.approx(10e-6)


def test_face_load_factor_of_method_c_is_continuous_where_the_load_leaves_an_end():
    # F_βy c_γβ/(F_m/b) = 2: the end of the face is just unloaded, K_Hβ = 2 by either formula
    assert face_load_factor_c(20e-6, 20e9, 200e3) == pytest.approx(2.0)
    assert face_load_factor_c(10e-6, 20e9, 200e3) == pytest.approx(1.5)
    assert face_load_factor_c(80e-6, 20e9, 200e3) == pytest.approx(4.0)


def test_two_discs_have_the_mass_of_the_general_formula():
    # base circles where d_m is: J = m d²/8, m_red = m_1 m_2/(m_1 + m_2)/2 with one density
    first, second = (7830.0 * np.pi * d**2 / 4.0 for d in (0.1, 0.3))
    expected = first * second / (first + second) / 2.0
    assert disc_mass(0.1, 0.1, 3.0, (7830.0, 7830.0)) == pytest.approx(expected)
