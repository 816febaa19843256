"""C code from laws and kernels, for programs without Python: one C function for each of Python's."""

from tribodyn.kernels.c.sources import OutsideSubsetError
from tribodyn.kernels.c.translation import CEntry, Translation, translated

__all__ = ["CEntry", "OutsideSubsetError", "Translation", "translated"]
