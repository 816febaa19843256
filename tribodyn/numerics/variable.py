"""What is said of one dataset of a record."""

import math
from typing import NamedTuple


class Variable(NamedTuple):
    """One dataset: its dimensions, SI unit (as xarray and pint read it), meaning, and how it is stored.

    Parameters
    ----------
    dims : dimensions; none of a single number
    dtype : type in the file, as NumPy names it
    fill : stands where nothing was written
    flags : meanings of whole numbers that stand for words, the first of them being `fill`; empty: none
    """

    dims: tuple[str, ...]
    units: str
    long_name: str
    dtype: str = "<f8"
    fill: float | bytes = math.nan
    flags: str = ""


def flag(dims: tuple[str, ...], long_name: str, meanings: str, first: int = -1) -> Variable:
    """A dataset of whole numbers from `first` on that stand for words; `first` where nothing was written."""
    return Variable(dims, "1", long_name, "i1", first, meanings)
