"""What a sweep takes, estimated before it begins."""

from itertools import chain
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.scenario.vary import VARY
from tribodyn.studies.protocol import estimate as of_a_run
from tribodyn.studies.protocol.estimate import Driver, Estimate, described
from tribodyn.sweep.grid import Grid

#: Above this a sweep is refused unless it is asked for: surely a step was mistyped.
MOST_CASES = 1_000_000
#: Cases that are usual, for what to reduce; bytes that a case takes in memory whatever it is.
USUAL_CASES, A_CASE = 1000, 24.0


def estimate_of(grid: Grid, settings: Any, directions: int, width: int = 1) -> Estimate:
    """What a sweep takes, from its cases at both ends of the grid.

    Parameters
    ----------
    settings : from `sweep.run.settings_of`
    directions : senses in which the first parameter is followed; 0: cases begin by themselves
    width : see `engines.Engine`
    """
    cases = float(np.prod(grid.shape, dtype=float)) * max(1, directions)
    together = int(min(cases, 10.0**9))
    ends = [grid.batch.estimate(case, settings, together, width) for case in grid.ends()]
    seconds, shared = max(end.seconds for end in ends), max(end.shared for end in ends)
    every = Driver(VARY, cases, USUAL_CASES, f"choose larger steps than for {cases:.4g} cases")
    return Estimate(
        max(end.memory for end in ends) + A_CASE * cases,
        of_a_run.HEAD + cases * max(end.record for end in ends),
        cases * seconds,
        (every, *chain.from_iterable(end.drivers for end in ends)),
        _tables(grid) * shared if shared else 0.0,
    )


def _tables(grid: Grid) -> float:
    """How many tables the cases have among them."""
    differ = [size > 1 and grid.changes_what_is_shared(axis) for axis, size in enumerate(grid.shape)]
    return float(np.prod([n for n, other in zip(grid.shape, differ, strict=True) if other], dtype=float))


def refuse_large(estimate: Estimate, allow_large: bool) -> None:
    """Refuse a sweep that takes more than a run may, or has more than `MOST_CASES`, unless it is allowed.

    Raises
    ------
    InputError
        It names what is furthest above what is usual.
    """
    of_a_run.refuse_large(estimate, allow_large)
    cases = estimate.drivers[0].value
    if cases > MOST_CASES and not allow_large:
        raise InputError(
            VARY,
            f"{cases:.10g} cases",
            f"takes about {described(estimate)}",
            f"choose larger steps: {MOST_CASES} cases at most, or add --allow-large",
        )
