"""Fixed points by Anderson's mixing: of the last steps, the combination whose change is smallest."""

from typing import Any

import numpy as np

Array = Any

#: Steps remembered; singular values below this share of the largest are left out.
MEMORY, _RANK = 5, 1e-8


class Mixing:
    """Next argument of x = g(x) from those tried (Anderson 1965; Walker & Ni 2011)."""

    def __init__(self) -> None:
        self._tried: list[Array] = []
        self._change: list[Array] = []

    def next(self, tried: Array, found: Array) -> Array:
        """Return the argument to try after x = `tried` gave g(x) = `found`."""
        self._tried = [*self._tried[-MEMORY:], tried]
        self._change = [*self._change[-MEMORY:], found - tried]
        if len(self._tried) == 1:
            return found
        steps: Array = np.diff(np.array(self._tried), axis=0)
        changes: Array = np.diff(np.array(self._change), axis=0)
        weight = np.linalg.lstsq(changes.T, self._change[-1], rcond=_RANK)[0]
        return found - weight @ (steps + changes)

    def shorter(self, share: float) -> Array:
        """Return a shorter way from the last argument to what it gave, and forget what was before."""
        self._tried, self._change = self._tried[-1:], self._change[-1:]
        return self._tried[0] + share * self._change[0]
