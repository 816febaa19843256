"""Native code: kernels compiled by numba once, kept as machine code, and called without numba from then on.

Importing this package imports neither numba nor llvmlite; the first call of a kernel imports llvmlite if its
machine code is on disk, and numba if it has to be compiled.
"""

from tribodyn.kernels.native.arguments import PackedValue, packed
from tribodyn.kernels.native.kernel import Kernel, kernel

__all__ = ["Kernel", "PackedValue", "kernel", "packed"]
