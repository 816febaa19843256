"""Tolerances of single flanks by grade: ISO 1328-1:2013."""

import math


def _graded(at_five: float, grade: float) -> float:
    return at_five * math.sqrt(2.0) ** (grade - 5.0)


def single_pitch(diameter: float, module: float, grade: float) -> float:
    """Single pitch tolerance f_pT = (0.001 d + 0.4 m_n + 5) √2^(A−5), in mm and µm; here all in m."""
    return 1e-6 * _graded(diameter + 400.0 * module + 5.0, grade)


def profile_form(module: float, grade: float) -> float:
    """Profile form tolerance f_fαT = (0.55 m_n + 5) √2^(A−5), m_n in mm, µm; here in m."""
    return 1e-6 * _graded(550.0 * module + 5.0, grade)
