"""What the layout of a record says of one dataset."""

from typing import NamedTuple


class Variable(NamedTuple):
    """One dataset: its dimensions, SI unit (as xarray and pint read it) and meaning."""

    dims: tuple[str, ...]
    units: str
    long_name: str
