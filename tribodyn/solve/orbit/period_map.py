"""What the search for steady states needs of a periodically driven system: its map over one period.

The state of the map is what the motion depends on at the start of a period, sampled once per period (Poincaré
section by the phase of the excitation). A steady state of n periods is a fixed point of the n-fold map.
"""

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.numerics.shapes import Array, Float, Int

#: Step of a difference quotient, as a share of the state's scale: divides the noise of a map integrated to
#: 1e-9 down to 1e-4 or less of the largest multiplier (measured on the CRC drive at 1 and 5 % damping, where
#: truncation stays below that up to 3e-3), and is a third of the width over which contact sets in.
DIFFERENCE = 1e-3


class Marched(NamedTuple):
    """States once per period, and what stopped a row."""

    states: Float[Array, "row period state"]  # after one, two, … periods; NaN from a failure on
    reasons: list[str]  # one per row, empty where all went well


class Tangent(NamedTuple):
    """The image of states under the n-fold map, and its derivative there."""

    image: Float[Array, "row state"]  # NaN where a row failed
    jacobian: Float[Array, "row state state"]  # ∂image_i/∂state_j: at a fixed point the monodromy matrix
    reasons: list[str]


class PeriodMap(Protocol):
    """A family of systems driven with one period each, marched many at a time.

    Rows are independent of each other: `cases` says which system a row belongs to, and a system may have any
    number of rows.
    """

    #: (cases, N): sizes by which states are measured.
    scale: Float[Array, "case state"]
    #: Distance, over the scale, within which one derivative has another's multipliers: 0 where it is exact,
    #: the step of the difference quotient where it is not.
    blur: float

    def march(
        self, states: Float[Array, "row state"], cases: Int[Array, " row"], periods: int, fine: bool
    ) -> Marched:
        """States (R, N) over some periods; `fine` asks for the accuracy that a fixed point needs."""
        ...

    def tangent(self, states: Float[Array, "row state"], cases: Int[Array, " row"], periods: int) -> Tangent:
        """Image after some periods, finely integrated, and its derivative."""
        ...


def by_differences(
    march: Callable[[np.ndarray, np.ndarray, int, bool], Marched],
    states: Float[Array, "row state"],
    cases: Int[Array, " row"],
    periods: int,
    scale: Float[Array, "case state"],
) -> Tangent:
    """The tangent of a map by one-sided differences: N companions per row, all marched in one batch."""
    rows, size = states.shape
    shift = DIFFERENCE * scale[cases]
    moved = states[:, None, :] + shift[:, :, None] * np.eye(size)
    batch = np.concatenate([states[:, None, :], moved], axis=1).reshape(-1, size)
    marched = march(batch, np.repeat(cases, size + 1), periods, True)
    end = marched.states[:, -1].reshape(rows, size + 1, size)
    jacobian = np.swapaxes(end[:, 1:] - end[:, :1], 1, 2) / shift[:, None, :]
    by_row = np.reshape(np.array(marched.reasons, dtype=object), (rows, size + 1))
    return Tangent(end[:, 0], jacobian, [next(filter(None, row), "") for row in by_row])
