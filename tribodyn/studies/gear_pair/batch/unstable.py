"""Figures of the unstable motions beyond the ends of the branches that were followed to a case."""

from collections.abc import Callable, Sequence

import numpy as np

from tribodyn.dynamics.parameters import XI
from tribodyn.solve.branch.followed import Continued
from tribodyn.studies.gear_pair.batch.figures import window_figures
from tribodyn.studies.gear_pair.batch.outcome import Passage
from tribodyn.studies.gear_pair.prepare import Prepared
from tribodyn.studies.gear_pair.sweep_layout import UNSTABLE_FIGURES
from tribodyn.studies.sweeping.unstable import PREFIX, fill_branch


def fill_unstable(
    rows: dict[str, np.ndarray],
    i: int,
    branches: Sequence[Continued],
    prepared_at: Callable[[float], Prepared],
    samples: int,
) -> None:
    """Put branches into the row of a case, with the figures of their motions over one period each.

    Parameters
    ----------
    rows : dict
        See `evaluate.evaluate`.
    i : int
        The case's row.
    branches : sequence of Continued
    prepared_at : callable
        Gives the prepared case at a value of the first parameter.
    samples : int
        Per mesh cycle.
    """
    for end, branch, steadies in branches:
        if end >= rows["unstable_period"].shape[1]:
            break
        fill_branch(rows, i, end, branch)
        for motion, (value, steady) in enumerate(zip(branch.values.tolist(), steadies, strict=True)):
            if not len(steady.samples):  # it cannot be integrated over its period once more
                continue
            passage = Passage(0, steady.samples, steady.state, steady.end, steady.extremes)
            figures, _ = window_figures(prepared_at(value), passage, samples)
            for name in UNSTABLE_FIGURES:
                rows[PREFIX + name][i, end, motion] = figures[name]
            section = steady.samples[::samples, XI]
            rows["unstable_poincare_error"][i, end, motion, : len(section)] = section
