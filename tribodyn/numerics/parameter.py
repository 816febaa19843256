"""What is said of a value: the key of a scenario that gives it, or the dataset of a record that holds it."""

import math
from typing import NamedTuple

from tribodyn.numerics.files.rows import table_rows


class Parameter(NamedTuple):
    """A number, or a table of points, that one tooth family or law has and others have not.

    Parameters
    ----------
    name : key in the scenario, and name under which the family or law receives the value
    kind : "number" for a plain number; "path" for points x, y (m) of a path; else the name of a quantity that
        is written with a unit, as `tribodyn.input.units.QUANTITIES` has it: "length", "pressure", "dynamic
        viscosity". "signed length" is a length of either sign.
    about : what it means, in a line
    default : float, optional
        Value where the scenario gives none, in SI units; None: the scenario must give it.
    source : where the default comes from: no number stands without a source
    allowed : {"", "any", "not negative", "positive"}
        Signs that are allowed; "": any for a plain number, positive for a quantity with a unit. There is no
        upper limit: what depends on other keys, the family's `check` or the law's `parameters` refuses.
    example : A good value as TOML writes it, for messages; "": one that fits the kind
    listed : whether the key takes a list of such values; the family or law receives an array
    optional : whether the scenario may leave out a key without a default; the family or law then receives
        None
    fixed : whether quantities cannot be differentiated by it, because it says where the other values stand
    """

    name: str
    kind: str
    about: str
    default: float | None = None
    source: str = ""
    allowed: str = ""
    example: str = ""
    listed: bool = False
    optional: bool = False
    fixed: bool = False


class Variable(NamedTuple):
    """One dataset: its dimensions, unit, meaning, and how it is stored."""

    dims: tuple[str, ...]  # none of a single number
    units: str  # SI, as xarray and pint read it
    long_name: str
    dtype: str = "<f8"  # in the file, as NumPy names it
    fill: float | bytes = math.nan  # stands where nothing was written
    flags: str = ""  # meanings of whole numbers that stand for words, the first being `fill`; empty: none


def flag(dims: tuple[str, ...], long_name: str, meanings: str, first: int = -1) -> Variable:
    """A dataset of whole numbers from `first` on that stand for words; `first` where nothing was written."""
    return Variable(dims, "1", long_name, "i1", first, meanings)


def datasets_of(package: str | None) -> dict[str, dict[str, Variable]]:
    """Datasets by group and name, as ``datasets.csv`` beside the modules of a package lists them."""
    groups: dict[str, dict[str, Variable]] = {}
    for row in table_rows(package, "datasets.csv"):
        dims, meaning, flags = tuple(row["dims"].split()), row["meaning"], row["flags"]
        made = flag(dims, meaning, flags) if flags else Variable(dims, row["units"], meaning)
        groups.setdefault(row["group"], {})[row["name"]] = made
    return groups
