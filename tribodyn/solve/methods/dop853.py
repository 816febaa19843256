"""Dormand-Prince 8(5,3), explicit, of SciPy."""

from scipy.integrate import DOP853 as METHOD

__all__ = ["METHOD"]
