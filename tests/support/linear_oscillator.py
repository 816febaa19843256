"""The linear oscillator, for comparison with the one with backlash while contact lasts."""

import numpy as np


def linear_amplitude(case, frequency):
    """Amplitude of x at constant stiffness without loss of contact, F_e Ω² / |1 − Ω² + 2iζΩ|."""
    stiffness = 1.0 - frequency**2 + 2j * case.damping * frequency
    return case.error_amplitude * frequency**2 / np.abs(stiffness)
