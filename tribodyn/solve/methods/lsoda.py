"""Adams and backward differentiation formulas with automatic switching, of SciPy."""

from scipy.integrate import LSODA as METHOD

__all__ = ["METHOD"]
