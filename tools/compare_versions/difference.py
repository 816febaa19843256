"""How two tables of one file differ: numbers, what only one of them has, words."""

from fnmatch import fnmatchcase
from typing import NamedTuple

import numpy as np

from tools.compare_versions.results import Table

#: Ends of the names of texts that say how something is called, not what came out.
WORDS = tuple("@units _units @long_name /unit /quantity /note /title @flag_meanings message".split())


class Difference(NamedTuple):
    """Of one quantity: `relative` is NaN where shape, type, NaN pattern, or text differ; `how` says it.

    A residual is a share already, of the work or the torque, and 0 but for rounding: its difference counts as
    it is.
    """

    name: str
    relative: float
    how: str


class Compared(NamedTuple):
    """Of one file: how many quantities both have, their differences, largest first, what one alone has."""

    case: str
    file: str
    common: int
    differences: list[Difference]
    words: list[Difference]
    only_old: list[str]
    only_new: list[str]


def compare(case: str, file: str, old: Table, new: Table) -> Compared:
    """Compare two tables of one file of a case."""
    common = [name for name in old if name in new]
    differences, words = [], []
    for name in common:
        found = _difference(name, old[name], new[name])
        if found.how or found.relative:
            (words if name.endswith(WORDS) and isinstance(old[name], str) else differences).append(found)
    differences.sort(key=lambda difference: -np.inf if difference.how else -difference.relative)
    only_old = [name for name in old if name not in new]
    return Compared(case, file, len(common), differences, words, only_old, [n for n in new if n not in old])


def _difference(name: str, old: np.ndarray | str, new: np.ndarray | str) -> Difference:
    if isinstance(old, str) or isinstance(new, str):
        same = isinstance(old, str) and isinstance(new, str) and old == new
        return Difference(name, 0.0, "") if same else Difference(name, np.nan, f"{old!s} → {new!s}")
    if old.shape != new.shape:
        return Difference(name, np.nan, f"shape {old.shape} → {new.shape}")
    if old.dtype != new.dtype:
        return Difference(name, np.nan, f"type {old.dtype} → {new.dtype}")
    before, after = old.astype(float), new.astype(float)
    apart = np.isfinite(before) != np.isfinite(after)
    apart |= ~np.isfinite(before) & ~np.isclose(before, after, equal_nan=True)
    if apart.any():
        return Difference(name, np.nan, f"NaN or infinite in one alone at {np.count_nonzero(apart)} places")
    if "residual" in name:
        return Difference(name, float(np.max(np.abs(np.nan_to_num(after - before)), initial=0.0)), "")
    return Difference(name, relative(before, after, by_column=name in ("displacement", "velocity")), "")


def relative(old: np.ndarray, new: np.ndarray, *, by_column: bool = False) -> float:
    """Return the largest difference over the largest magnitude; 0 where both are equal.

    Coordinates of different units in one dataset (m and rad) are each related to their own column's largest
    magnitude.
    """
    axis = tuple(range(old.ndim - 1)) if by_column and old.ndim > 1 else None
    finite = np.isfinite(old) & np.isfinite(new)
    if not finite.any():
        return 0.0
    change = np.max(np.abs(np.where(finite, new - old, 0.0)), axis=axis)
    size = np.max(np.where(finite, np.maximum(np.abs(old), np.abs(new)), 0.0), axis=axis)
    return float(np.max(np.divide(change, size, out=np.zeros_like(change), where=size > 0)))


class Explained(NamedTuple):
    """A difference with a reason: `pattern` matches ``CASE``, or ``CASE:QUANTITY``, with wildcards."""

    pattern: str
    reason: str

    @classmethod
    def parse(cls, text: str) -> "Explained":
        """Read ``PATTERN: REASON``; the first colon followed by a space parts them."""
        pattern, colon, reason = text.partition(": ")
        if not colon or not reason.strip():
            raise SystemExit(f'--explained "{text}": write it "NAME: reason"')
        return cls(pattern.strip(), reason.strip())

    def covers(self, case: str, quantity: str) -> bool:
        """Tell whether this explains a quantity of a case."""
        return fnmatchcase(case, self.pattern) or fnmatchcase(f"{case}:{quantity}", self.pattern)
