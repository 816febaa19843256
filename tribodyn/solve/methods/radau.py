"""Radau IIA 5, implicit, of SciPy."""

from scipy.integrate import Radau as METHOD

__all__ = ["METHOD"]
