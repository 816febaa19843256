"""A line contact whose load, radius and speed change with time: steady contact and squeeze, step by step.

The equations are those of the steady contact with the squeeze term on (`reynolds`): at each instant Newton's
method finds pressures, rigid displacement, flow, end of the film and load balance together. In time:
backward differences of second order over steps that need not be equal, begun by one step of Euler's backward
formula; both are L-stable. A step that does not converge is halved.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.fluid import relative_density
from tribodyn.tribology.ehl.problem import LineContact, Solution, check
from tribodyn.tribology.ehl.reynolds import (
    FilmState,
    FlowCorrection,
    Snapshot,
    cells,
    faces,
    film,
    squeeze_of,
)
from tribodyn.tribology.ehl.steady import TOLERANCE, converged, reduced_problem

#: Newton's method needs 2 to 6 steps from one instant to the next.
MOST_STEPS = 15
#: Shortest step, over that from one time to the next; growth of a step over the one before.
_SHORTEST, _GROWTH = 1.0 / 64.0, 2.0


class Instant(NamedTuple):
    """A contact at an instant."""

    problem: LineContact
    #: what shear and heat make of its flow, on the nodes of the start's grid; None: as at the start
    closure: FlowCorrection | None = None


def march(
    instant_at: Callable[[float], Instant], times: Sequence[float] | Array, start: Solution
) -> Iterator[Solution]:
    """Go through the solutions at the increasing times (s) after the first, at which the contact is `start`.

    The film is steady before the first time, and its grid suits the contact at all times (`grid_of`). Load,
    radius and speeds may change with the time, fluid and roughness may not. Raises InputError if a value has
    no meaning, SimulationError where the shortest step does not converge.
    """
    earlier, before = [start], [_snapshot(start, float(times[0]))]
    for goal in times[1:]:
        whole = shorter = float(goal) - before[-1].time
        while (missing := float(goal) - before[-1].time) > 1e-9 * whole:
            step = min(missing, shorter)
            if len(before) == 2:
                step = min(step, _GROWTH * (before[1].time - before[0].time))
            # equal parts, so that no sliver is left
            step = missing / math.ceil(missing / step - 1e-9)
            solution = _stepped(instant_at, before[-1].time + step, before, earlier)
            if solution is None:
                shorter = 0.5 * step
                if shorter < _SHORTEST * whole:
                    problem = instant_at(before[-1].time + step).problem
                    raise SimulationError(
                        f"the transient line contact did not converge after {before[-1].time:.4g} s (p_H "
                        f"{problem.hertz_pressure / 1e9:.3g} GPa, line load {problem.line_load:.3g} N/m): "
                        "its load may rise faster than the oil is drawn in; start again from a steady contact"
                    )
                continue
            earlier = [earlier[-1], solution]
            before = [before[-1], _snapshot(solution, before[-1].time + step)]
        yield earlier[-1]


def _stepped(
    instant_at: Callable[[float], Instant], time: float, before: list[Snapshot], earlier: list[Solution]
) -> Solution | None:
    """Return the solution at a time; None: Newton's method did not converge."""
    problem, closure = instant_at(time)
    check(problem)
    last = earlier[-1]
    closure = last.closure if closure is None else closure
    reduced, grid = reduced_problem(problem), last.grid
    squeeze = squeeze_of(time, before, problem.half_width, problem.entrainment_speed, problem.film_unit)
    guess = _same_film(last, problem)
    if len(earlier) == 2:
        guess = _gone_on(earlier[0], earlier[1], (time - before[1].time) / (before[1].time - before[0].time))
    state, steps, imbalance = converged(guess, reduced, grid, closure, squeeze, MOST_STEPS)
    if not imbalance <= TOLERANCE:
        return None
    films = film(state, reduced, grid) if state.film is None else state.film
    return Solution(problem, reduced, grid, state, films, closure, steps, imbalance)


def _same_film(last: Solution, problem: LineContact) -> FilmState:
    """Pressures of the last instant over Hertz's, and its film in the units of this one."""
    state = last.state
    ratio = last.problem.film_unit / problem.film_unit
    shift = (ratio - 1.0) * state.flow
    films = None if state.film is None else state.film + shift
    return state._replace(rigid_film=state.rigid_film + shift, flow=ratio * state.flow, film=films)


def _gone_on(earlier: Solution, last: Solution, ratio: float) -> FilmState:
    """State to which the last two lead in a straight line, in Hertz's units; `ratio` of the steps in time."""
    old, new = earlier.state, last.state

    def on(name: str) -> Any:
        return getattr(new, name) + ratio * (getattr(new, name) - getattr(old, name))

    return FilmState(
        np.maximum(on("pressure"), 0.5 * new.pressure),
        on("rigid_film"),
        max(on("flow"), 0.5 * new.flow),
        on("end"),
        None if new.film is None else on("film"),
    )


def _snapshot(solution: Solution, time: float) -> Snapshot:
    """Masses and places of a solution."""
    problem, grid = solution.problem, solution.grid
    upto = slice(0, grid.end + 1)
    density = relative_density(solution.fluid_pressure[upto], problem.fluid)[0]
    mass = density * solution.mean_gap[upto] * cells(grid) * problem.half_width
    return Snapshot(time, mass, (solution.state.end + faces(grid)) * problem.half_width)
