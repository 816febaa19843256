"""The figures of one case, from its states in the window."""

from typing import Any

import numpy as np

from tribodyn.dynamics.outputs import outputs_with_extremes
from tribodyn.dynamics.parameters import XI
from tribodyn.record.trust import Judge, judge_tribology
from tribodyn.solve.engagement import engage_next
from tribodyn.studies.gear_pair.assumptions import judge_block
from tribodyn.studies.gear_pair.batch.outcome import Passage
from tribodyn.studies.gear_pair.prepare import Prepared
from tribodyn.studies.gear_pair.summary import RunningExtremes, steady_figures
from tribodyn.studies.gear_pair.sweep_layout import FIGURES
from tribodyn.studies.gears.temperature import thermal_figures


def window_figures(
    prepared: Prepared, passage: Passage, samples: int
) -> tuple[dict[str, float], dict[str, Any]]:
    """Return the figures of `sweep_layout.FIGURES` over a window, SI units, and what is said of their trust.

    Parameters
    ----------
    prepared : Prepared
    passage : Passage
    samples : int
        Per mesh cycle of the window.
    """
    count, last = len(passage.window), passage.end.copy()
    engage_next(last, prepared.model)
    cycles = passage.first_cycle + np.arange(count + 1) / samples
    states = np.concatenate([passage.window, last[None]])
    block, extreme, at = outputs_with_extremes(cycles, states, passage.extremes, prepared.model)
    extremes = RunningExtremes(prepared.cycle)
    extremes.add(cycles, block)
    extremes.add(at, extreme)
    error = passage.window[:, XI]
    speed = prepared.case.operating.pinion_speed
    work = passage.end - passage.start
    window = {name: values[:count] for name, values in block.items()}
    figures = steady_figures(window, work, prepared.cycle, samples, speed, extremes)
    # a run's summary means the newest pair's; over a sweep only the error of the whole mesh is continuous
    figures |= extremes.values() | {
        "transmission_error_rms": float(np.std(error)),
        "transmission_error_peak_to_peak": figures["transmission_error_rotational_peak_to_peak"],
        "transmission_error_mean": float(np.mean(error)),
    }
    figures |= thermal_figures(prepared.thermal, figures["power_in_mean"], figures["efficiency"])
    judge = Judge()
    judge_block(judge, cycles, block, prepared)
    judge_block(judge, at, extreme, prepared, between_samples=True)
    judge.take({"efficiency": figures["efficiency"]})
    judge_tribology(judge, figures)
    named = {name: float("nan") if (value := figures.get(name)) is None else value for name in FIGURES}
    return named, judge.figures()
