"""Whole numbers that structure gives: what a kernel is compiled for, and what it looks up."""

from typing import Any, Self

import numpy as np


class Fixed(int):
    """A number that kernels are compiled for, e.g. the number of states, so that their loops are unrolled."""


class Indices(tuple[int, ...]):
    """Whole numbers by place, which kernels read from memory: no other ones are compiled anew.

    Hashable, as everything that is static for JAX.
    """

    array: Any  # (n,) int64, the same numbers

    def __new__(cls, numbers: Any = ()) -> Self:
        """Indices of whole numbers."""
        made = super().__new__(cls, (int(number) for number in numbers))
        made.array = np.array(made, dtype=np.int64)
        return made
