"""Gears followed along a parameter: `continuation` over `gear_map.GearMap`."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.errors import InputError, SimulationError
from tribodyn.solve.branch.continuation import Arrival, Leg, follow
from tribodyn.solve.branch.unstable import UnstableBranch, unstable_branches
from tribodyn.solve.choice import choose
from tribodyn.solve.orbit.gear_map import FreeStates, GearMap, moving_states
from tribodyn.solve.orbit.motions import PeriodMap
from tribodyn.solve.orbit.periodic import FINE, SteadyMotion, sampled

ModelAt = Callable[[int, float], Model]
"""Gives the model on a line at a value of the parameter; raises InputError where there is none."""


class ContinuedBranch(NamedTuple):
    """A branch beyond the end of its stable part."""

    end: int  # number of that end among those of the leg
    branch: UnstableBranch
    steadies: list[SteadyMotion]  # its motions


class LegResult(NamedTuple):
    """What following one gearbox gave: the motion at the target, how the leg ended, what is unstable."""

    steady: SteadyMotion
    arrival: Arrival
    continued: list[ContinuedBranch]


class UnstableRange(NamedTuple):
    """What of the branches beyond their ends is wanted."""

    span: tuple[float, float]  # (lowest, highest), range of the parameter
    motions: int  # motions on a branch at most, evenly along its arclength


class GearLines:
    """Gearboxes on lines along a parameter, as `arclength.SystemFamily`; `starts` scale the states."""

    def __init__(self, model_at: ModelAt, starts: dict[int, np.ndarray], moving: FreeStates, **settings: Any):
        self.model_at, self.starts = model_at, starts
        self.moving, self.settings = moving, settings

    def at(self, lines: Sequence[int], values: Sequence[float]) -> tuple[PeriodMap, list[str]]:
        """See `arclength.SystemFamily`."""
        models, starts, refusals = [], [], []
        for line, value in zip(lines, values, strict=True):
            try:
                models.append(self.model_at(line, value))
            except (InputError, SimulationError) as error:
                refusals.append(str(error))
                continue
            starts.append(self.starts[line])
            refusals.append("")
        return GearMap(models, np.array(starts), self.moving, **self.settings), refusals


def followed_states(
    model_at: ModelAt,
    legs: Sequence[Leg],
    *,
    samples: int,
    rtol: float,
    max_cycles: int,
    solver: str,
    max_steps: int,
    workers: int | None,
    tolerance: float = 1e-7,
    unstable: UnstableRange | None = None,
) -> list[LegResult]:
    """Follow gearboxes, each along its leg, to the steady motions at the targets.

    States of the legs are at phase 0 after engagement, those that are handed on likewise; numbers
    are those of `periodic.steady_states`. Branches go on beyond the ends of their stable parts where
    `unstable` asks for it.
    """
    alike: dict[tuple[Any, ...], list[int]] = {}
    for number, leg in enumerate(legs):
        model = model_at(leg.line, leg.target)
        # lines are of one method each: it is estimated once
        key = moving_states(model), choose(solver, model, leg.state).method
        alike.setdefault(key, []).append(number)
    results: dict[int, LegResult] = {}
    for (moving, method), numbers in alike.items():
        rtols = {"rtol": rtol, "fine_rtol": FINE * tolerance}
        starts = {legs[number].line: legs[number].state for number in numbers}
        settings = {"solver": method, "max_steps": max_steps, "workers": workers, **rtols}
        family = GearLines(model_at, starts, moving, **settings)
        short = [legs[number]._replace(state=legs[number].state[list(moving.states)]) for number in numbers]
        most = max(1, max_cycles // moving.period)
        arrivals = follow(family, short, tolerance=tolerance, max_periods=most)
        period_map, _ = family.at([leg.line for leg in short], [leg.target for leg in short])
        assert isinstance(period_map, GearMap)
        steadies = sampled(period_map, [arrival.orbit for arrival in arrivals], samples)
        for number, steady, arrival in zip(numbers, steadies, arrivals, strict=True):
            next_state = period_map.full(arrival.next_state[None])[0]
            continued = _continued(family, legs[number].line, arrival, unstable, samples) if unstable else []
            results[number] = LegResult(steady, arrival._replace(next_state=next_state), continued)
    return [results[number] for number in range(len(legs))]


def _continued(
    family: GearLines, line: int, arrival: Arrival, unstable: UnstableRange, samples: int
) -> list[ContinuedBranch]:
    """The branches beyond the ends of a leg."""
    continuations = []
    branches = unstable_branches(family, line, arrival.seeds, unstable.span)
    for end, whole in enumerate(branches):
        if whole is None:
            continue
        branch = whole.thinned(unstable.motions)
        period_map, _ = family.at([line] * len(branch.values), branch.values.tolist())
        assert isinstance(period_map, GearMap)
        continuations.append(ContinuedBranch(end, branch, sampled(period_map, branch.orbits, samples)))
    return continuations
