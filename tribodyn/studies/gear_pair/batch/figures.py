"""The figures of one case, from its states in the window, and of unstable motions beyond branches' ends."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.dynamics.outputs import outputs_with_extremes
from tribodyn.dynamics.parameters import XI
from tribodyn.record.trust import Judge, judge_tribology
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.studies.gear_pair.assumptions import judge_block
from tribodyn.studies.gear_pair.batch.marched import CaseWindow
from tribodyn.studies.gear_pair.prepare import PreparedPair
from tribodyn.studies.gear_pair.summary import RunningExtremes, steady_figures
from tribodyn.studies.gear_pair.sweep_layout import SWEPT, UNSTABLE_QUANTITIES
from tribodyn.studies.gears.temperature import thermal_figures
from tribodyn.studies.sweeping.branches import PREFIX, fill_branch

if TYPE_CHECKING:
    from tribodyn.solve.branch.gear_pairs import ContinuedBranch


def window_figures(
    prepared: PreparedPair, window: CaseWindow, samples: int
) -> tuple[dict[str, float], dict[str, Any]]:
    """Return the figures of `sweep_layout.SWEPT` over a window, SI units, and what is said of their trust.

    `samples` are those in a mesh cycle of the window.
    """
    count, last = len(window.states), window.end.copy()
    engage_next(last, prepared.model)
    cycles = window.first_cycle + np.arange(count + 1) / samples
    states = np.concatenate([window.states, last[None]])
    block, extreme, at = outputs_with_extremes(cycles, states, window.extremes, prepared.model)
    extremes = RunningExtremes(prepared.cycle)
    extremes.add(cycles, block)
    extremes.add(at, extreme)
    speed = prepared.case.operating.pinion_speed
    work = window.end - window.start
    inside = {name: values[:count] for name, values in block.items()}
    figures = steady_figures(inside, work, prepared.cycle, samples, speed, extremes)
    figures |= extremes.values()
    figures |= thermal_figures(prepared.thermal, figures["power_in_mean"], figures["efficiency"])
    judge = Judge()
    judge_block(judge, cycles, block, prepared)
    judge_block(judge, at, extreme, prepared, between_samples=True)
    judge.take({"efficiency": figures["efficiency"]})
    judge_tribology(judge, figures)
    values = ((quantity.name, figures.get(quantity.name)) for quantity in SWEPT)
    return {name: float("nan") if value is None else value for name, value in values}, judge.summary()


def fill_unstable(
    rows: dict[str, np.ndarray],
    i: int,
    branches: "Sequence[ContinuedBranch]",
    prepared_at: Callable[[float], PreparedPair],
    samples: int,
) -> None:
    """Put branches into the row of a case, with the figures of their motions over one period each.

    `prepared_at` gives the prepared case at a value of the first parameter.
    """
    for end, branch, steadies in branches:
        if end >= rows["unstable_period"].shape[1]:
            break
        fill_branch(rows, i, end, branch)
        for motion, (value, steady) in enumerate(zip(branch.values.tolist(), steadies, strict=True)):
            if not len(steady.samples):  # it cannot be integrated over its period once more
                continue
            window = CaseWindow(0, steady.samples, steady.state, steady.end, steady.extremes)
            figures, _ = window_figures(prepared_at(value), window, samples)
            for name in UNSTABLE_QUANTITIES:
                rows[PREFIX + name][i, end, motion] = figures[name]
            section = steady.samples[::samples, XI]
            rows["unstable_poincare_error"][i, end, motion, : len(section)] = section
