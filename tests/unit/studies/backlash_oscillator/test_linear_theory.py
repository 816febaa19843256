"""Linear theory of the oscillator against its equation: amplitudes by complex forces, figures by search."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from tribodyn.studies.backlash_oscillator.run import linear_theory


def case(damping=0.05, force=0.3, error=0.05, variation=0.3):
    return cast(
        Any,
        SimpleNamespace(
            damping=damping,
            mean_force=force,
            error_amplitude=error,
            stiffness_variation=variation,
            frequencies=np.linspace(0.5, 2.0, 7),
        ),
    )


def test_resonance_and_where_contact_is_lost():
    oscillator = case()
    found = linear_theory(oscillator)

    def amplitude(frequency):
        return 0.05 * frequency**2 / abs(1.0 - frequency**2 + 2j * 0.05 * frequency)

    options = {"xatol": 1e-9}
    top: Any = minimize_scalar(lambda f: -amplitude(f), bounds=(0.8, 1.2), method="bounded", options=options)
    assert found["resonance"] == pytest.approx(top.x, rel=1e-6)
    lost = brentq(lambda f: amplitude(f) - 0.3, 0.3, top.x)
    assert found["contact_loss_from"] == pytest.approx(lost, rel=1e-9)
    assert found["frequencies"] == 7.0
    assert linear_theory(case(damping=0.8))["resonance"] is None
    assert linear_theory(case(error=0.0))["contact_loss_from"] is None
    assert linear_theory(case(error=0.02))["contact_loss_from"] is None
    assert linear_theory(case(damping=0.2))["tongue_half_width"] is None


@pytest.mark.parametrize(("share", "grows"), [(0.8, True), (1.25, False)])
def test_the_tongue_at_twice_the_resonance(share, grows):
    """x'' + 2ζ x' + (1 + ε cos Ωτ) x: its map over a period grows inside √(ε²/4 − 4ζ²) of Ω = 2."""
    damping, variation = 0.01, 0.08
    width = linear_theory(case(damping, variation=variation))["tongue_half_width"]
    assert width is not None
    frequency = 2.0 + share * width

    def slope(t, y):
        stiffness = 1.0 + variation * np.cos(frequency * t)
        return [y[1], -2 * damping * y[1] - stiffness * y[0], y[3], -2 * damping * y[3] - stiffness * y[2]]

    end = solve_ivp(slope, (0.0, 2 * np.pi / frequency), [1.0, 0.0, 0.0, 1.0], rtol=1e-8, atol=1e-10).y[:, -1]
    multipliers = np.linalg.eigvals(end.reshape(2, 2))
    assert bool(np.abs(multipliers).max() > 1.0) == grows
