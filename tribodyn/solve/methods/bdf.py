"""Backward differentiation formulas of orders 1 to 5, implicit, of SciPy."""

from scipy.integrate import BDF as METHOD

__all__ = ["METHOD"]
