"""What `check` prints of an oscillator with backlash: linear theory while contact lasts."""

import numpy as np

from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.protocol.study import CheckResult, TextTable


def check(case: BacklashOscillatorCase) -> CheckResult:
    """Print what linear theory predicts."""
    figures = linear_figures(case)
    rows = [(name, "none" if value is None else f"{value:.6g}") for name, value in figures.items()]
    table = TextTable("Linear theory, while contact lasts", ("quantity", "value"), rows)
    return CheckResult({"linear": figures}, (table,))


def linear_figures(case: BacklashOscillatorCase) -> dict[str, float | None]:
    """Number of frequencies, and by linear theory at constant stiffness the figures of the sweep.

    Returns
    -------
    dict
        `frequencies`; `resonance`, the frequency of the largest amplitude; `contact_loss_from`, the lowest
        frequency at which the amplitude F_e Ω² / |1 − Ω² + 2iζΩ| reaches the mean force, both None where
        there is none; and `tongue_half_width` of the instability at Ω = 2, √(ε²/4 − 4ζ²), None where damping
        closes it.
    """
    damping, force, error = case.damping, case.mean_force, case.error_amplitude
    resonance = 1.0 / np.sqrt(1.0 - 2.0 * damping**2) if damping < np.sqrt(0.5) else None
    # F_e² z² = F_m² ((1 − z)² + 4 ζ² z) in z = Ω²
    roots = np.roots([force**2 - error**2, force**2 * (4.0 * damping**2 - 2.0), force**2])
    real = [float(root.real) for root in roots if abs(root.imag) < 1e-12 and root.real > 0.0]
    tongue = case.stiffness_variation**2 / 4.0 - 4.0 * damping**2
    return {
        "frequencies": float(len(case.frequencies)),
        "resonance": None if resonance is None else float(resonance),
        "contact_loss_from": float(np.sqrt(min(real))) if real and error > 0.0 else None,
        "tongue_half_width": float(np.sqrt(tongue)) if tongue > 0.0 else None,
    }
