"""Steps over the revolutions: Heun's method, each step as long as the loads let it be.

No step moves the load of any place, from its beginning to its predictor or to its end, by more than a share
of the largest load: one that does is halved and taken again. The volume that load, sliding and coefficient
wear off is integrated with the same weights as the depths.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.studies.wear.passage import Depths, Wearing, WearPassage, passage

#: Depth over the module at which a flank is no flank any more, as of modifications.
DEEPEST = 0.1
# Growth of a step at most, and the share of what the load change allows that the next one aims at.
_GROWTH, _AIM = 2.0, 0.8
# A step below this share of the revolutions to come leads nowhere; where nothing wears any step will do.
_SHORTEST, _ANY = 1e-9, 1e30


class Worn(NamedTuple):
    """State after some revolutions; all of it is needed to go on."""

    revolutions: float
    depths: Depths
    next_step: float  # revolutions
    volume: float  # ∫ K F |v_s| dt so far, m³
    steps: int
    rejected: int


def unworn(study: Wearing) -> Worn:
    """New flanks."""
    nodes, slices = len(study.places.node), study.places.held.shape[-1]
    counts = study.case.counts if study.case.each_tooth else (1, 1)
    pinion, gear = (np.zeros((count, nodes, slices)) for count in counts)
    return Worn(0.0, (pinion, gear), 0.0, 0.0, 0, 0)


def march(study: Wearing, start: Worn, rows: np.ndarray) -> Iterator[tuple[Worn, WearPassage]]:
    """Go on from a state; yield the state and its loads at every row, in revolutions, increasing.

    The loads at a row do not depend on the way there: who goes on from it takes the same steps. Raises
    SimulationError as `passage`, where a flank is worn away, or where no step is short enough.
    """
    state, at = start, None
    for row in rows:
        at = at or passage(study, state.depths, state.revolutions)
        while state.revolutions < row:
            state, at = _step(study, state, at, float(row))
        at = passage(study, state.depths, state.revolutions)
        yield state, at


def _step(study: Wearing, state: Worn, at: WearPassage, row: float) -> tuple[Worn, WearPassage]:
    """Take one step, to a row at most."""
    limit, remaining = study.case.load_change, row - state.revolutions
    wished = state.next_step or _first(study, at)
    rejected, running_in = state.rejected, study.case.running_in
    longest = np.inf if running_in is None else running_in.step_at(state.revolutions)
    while True:
        step = min(wished, remaining, longest)
        there = _ahead(state.depths, at.rates, step)
        ahead = row if step == remaining else state.revolutions + step
        trial = passage(study, there, ahead, at.friction)
        moved, passed = trial.moved_from(at), None
        if moved <= limit:
            rates = tuple((a + b) / 2.0 for a, b in zip(at.rates, trial.rates, strict=True))
            depths = _ahead(state.depths, (rates[0], rates[1]), step)
            passed = passage(study, depths, ahead, trial.friction)
            moved = max(moved, passed.moved_from(at))
        if passed is not None and moved <= limit:
            break
        wished, rejected = step / 2.0, rejected + 1
        if step < _SHORTEST * remaining:
            raise SimulationError(
                f"after {state.revolutions:.6g} revolutions no step is short enough: loads still move by "
                f"{100.0 * moved:.2g} %"
            )
    deepest = float(max(np.max(depth) for depth in passed.depths)) / study.case.drive.module
    if deepest > DEEPEST:
        raise SimulationError(
            f"after {state.revolutions + step:.6g} revolutions flanks are worn by more than a tenth of the "
            "module"
        )
    growth = min(_GROWTH, _AIM * limit / max(moved, 1e-12))
    # a step that was cut short at a row says little of the next one
    next_step = min(step * growth if step == wished else max(wished, step * growth), _ANY)
    volume = state.volume + step * (at.volume_rate + trial.volume_rate) / 2.0
    return Worn(ahead, passed.depths, next_step, volume, state.steps + 1, rejected), passed


def _first(study: Wearing, at: WearPassage) -> float:
    """A step that moves the flanks by a share of how far the load brings them together."""
    rate = float(np.max(at.rates[0])) + float(np.max(at.rates[1]))
    return study.case.load_change * at.approach / rate if rate > 0.0 else _ANY


def _ahead(depths: Depths, rates: Depths, step: float) -> Depths:
    pinion, gear = (depth + step * rate for depth, rate in zip(depths, rates, strict=True))
    return pinion, gear
