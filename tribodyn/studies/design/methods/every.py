"""Every combination of whole numbers and choices."""

import math
from itertools import product

import numpy as np

from tribodyn.studies.design.candidates.archive import Archive
from tribodyn.studies.design.case import DesignCase, Free


def count_of(free: Free) -> float:
    """How many values a free key has."""
    return math.inf if free.continuous else free.high - free.low + 1.0


def count_of_all(case: DesignCase) -> float:
    """How many combinations there are."""
    return math.prod(count_of(one) for one in case.free)


def every(archive: Archive, _start: np.ndarray) -> None:
    """Evaluate every combination."""
    axes = []
    for one in archive.case.free:
        count = int(count_of(one))
        if one.choices:
            axes.append((np.arange(count) + 0.5) / count)
        else:
            axes.append(np.arange(count) / max(1, count - 1))
    archive.ask_all(list(product(*axes)))
