"""K_Hα of loads that are known."""

import numpy as np
import pytest

from tribodyn.standards.load_factors import shared_load, transverse_factor_b, transverse_load_factor


def test_even_loads_have_factors_of_one():
    assert transverse_load_factor(50.0, 50.0) == 1.0


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
