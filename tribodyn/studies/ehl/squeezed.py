"""A pair's way with squeeze: the film of one position carried on to the next.

Shear and heat are quasi-steady: what they make of the flow, and the temperatures under which the oil shears,
are those of the steady contact at the same position. The way begins with the steady film of the first loaded
position. Where the pair loses its load, or no instant can be solved, it begins anew behind that.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.shapes import Array
from tribodyn.studies.ehl.along_path import PairWay, contact_for, pressure_and_film
from tribodyn.studies.ehl.scenario import SQUEEZED, EhlCase, unsolved
from tribodyn.studies.protocol.study import Progress
from tribodyn.tribology.ehl.coupled import CoupledSolution, friction_of
from tribodyn.tribology.ehl.grid import FilmGrid
from tribodyn.tribology.ehl.of_case import Contact
from tribodyn.tribology.ehl.problem import LineContact, Solution
from tribodyn.tribology.ehl.reynolds import FilmState, FlowCorrection, film
from tribodyn.tribology.ehl.rough import RoughReduced, with_films
from tribodyn.tribology.ehl.shear import LAYERS
from tribodyn.tribology.ehl.steady import grid_of, reduced_problem, solve_steady
from tribodyn.tribology.ehl.transient import Instant, march

#: Longest time step, over that in which the oil is drawn through half a contact: films within 0.1 %.
WAY_OF_A_STEP = 0.1
PREFIX = "transient_"


class SteadyContact(NamedTuple):
    """What is kept of a position's steady contact; arrays over the places ξ of its own grid."""

    problem: LineContact
    state: FilmState
    node: Array
    whole: Array  # pressure of fluid and asperities over Hertz's
    closure: FlowCorrection
    rise: Array  # temperature of the layers


class Stretch(NamedTuple):
    """Positions one after another at which the pair carries load, on one grid."""

    times: Array
    steady: Sequence[SteadyContact]
    closures: Array
    rises: Array
    grid: FilmGrid
    loads: tuple[Array, Array]


def steady_of(coupled: CoupledSolution) -> SteadyContact:
    """Return what is kept of a steady contact."""
    solution = coupled.solution
    rise = np.zeros((len(solution.place), LAYERS)) if coupled.heat is None else coupled.heat.layers
    whole = solution.pressure / solution.problem.hertz_pressure
    return SteadyContact(solution.problem, solution.state, solution.grid.node, whole, solution.closure, rise)


def squeezed(
    over: PairWay, case: EhlCase, steady: Sequence[SteadyContact | None], progress: Progress
) -> dict[str, Array]:
    """Datasets of the way with squeeze, NaN where it was not solved, and `restarts` within the way.

    `steady` is of each position; None: unloaded or not solved.
    """
    arrays, contact, begun = unsolved(SQUEEZED, len(over.roll)), contact_for(case), 0
    for first, last in _runs([position is not None for position in steady]):
        chosen = [position for position in steady[first : last + 1] if position is not None]
        stretch = _stretch(chosen, over, np.arange(first, last + 1), case)
        begun += _through(stretch, contact, arrays, first, progress)
    return arrays | {"restarts": np.array(max(begun - 1, 0))}


def _runs(good: Sequence[bool]) -> list[tuple[int, int]]:
    """First and last number of each run of two or more true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], np.asarray(good, dtype=int), [0]])))
    pairs = edges.reshape(-1, 2)
    return [(int(a), int(b) - 1) for a, b in pairs if b - a > 1]


def _stretch(steady: Sequence[SteadyContact], over: PairWay, at: Array, case: EhlCase) -> Stretch:
    """One grid for all positions, with shear and heat of the steady contacts on its nodes."""
    problems = [position.problem for position in steady]
    grid = grid_of(problems[0], case.step, *problems[1:])
    closures, rises = (
        np.array([[np.interp(grid.node, at.node, row) for row in rows(at)] for at in steady])
        for rows in (lambda at: at.closure, lambda at: at.rise.T)
    )

    (nodes, loads), speed = over.table, case.operating.pinion_speed
    return Stretch(over.roll[at] / speed, steady, closures, rises, grid, (nodes / speed, loads))


def _through(
    stretch: Stretch, contact: Contact, arrays: dict[str, Array], first: int, progress: Progress
) -> int:
    """Fill in the positions of a stretch; returns how often the film began as a steady one."""
    at, begun, last = 0, 0, len(stretch.times) - 1
    while at < last:
        reached = at
        for reached, solution in _carried(stretch, at):
            _put(arrays, first + reached, solution, contact, stretch.rises[reached])
            progress((first + reached + 1) / len(next(iter(arrays.values()))))
        begun += reached > at
        at = reached + 1
    return begun


def _carried(stretch: Stretch, begin: int) -> Iterator[tuple[int, Solution]]:
    """Go through the positions from a steady one on until one cannot be reached; none if that is the next."""
    try:
        start = _begun(stretch, begin)
        times, marks = _times(stretch, begin)
        for number, solution in enumerate(march(_instants(stretch), times, start), start=1):
            at = marks.get(number)
            if at == begin + 1:
                yield begin, start
            if at is not None:
                yield at, solution
    except (SimulationError, InputError):
        return


def _begun(stretch: Stretch, at: int) -> Solution:
    """Steady contact of a position, on the grid of the stretch."""
    contact, grid = stretch.steady[at], stretch.grid
    reduced = reduced_problem(contact.problem)

    def seen(values: Array) -> Array:
        return np.interp(grid.node, contact.node, values, left=0.0, right=0.0)

    state = contact.state._replace(pressure=seen(contact.whole))
    if isinstance(reduced, RoughReduced):
        state = with_films(state, reduced, grid)._replace(pressure=seen(contact.state.pressure))
    closure = FlowCorrection(*stretch.closures[at])
    start = Solution(contact.problem, reduced, grid, state, film(state, reduced, grid), closure, 0, math.nan)
    return solve_steady(contact.problem, start)


def _times(stretch: Stretch, at: int) -> tuple[Array, dict[int, int]]:
    """Times from a position to the last, and which of them are those of which position."""
    times, marks = [stretch.times[at]], {}
    for number in range(at, len(stretch.times) - 1):
        whole = stretch.times[number + 1] - stretch.times[number]
        problem = stretch.steady[number + 1].problem
        lengths = whole * problem.entrainment_speed / problem.half_width
        parts = max(math.ceil(lengths / WAY_OF_A_STEP), 1)
        times.extend(stretch.times[number] + whole * np.arange(1, parts + 1) / parts)
        marks[len(times) - 1] = number + 1
    return np.array(times), marks


def _instants(stretch: Stretch) -> Callable[[float], Instant]:
    """The contact at any time of a stretch."""
    problems = [position.problem for position in stretch.steady]
    values = [(state.radius, state.entrainment_speed, state.sliding_speed) for state in problems]
    smooth, numbers = CubicSpline(stretch.times, np.array(values)), np.arange(len(stretch.times))

    def at(time: float) -> Instant:
        place = np.interp(time, stretch.times, numbers)
        low = min(int(place), len(stretch.times) - 2)
        part = place - low
        closure = (1.0 - part) * stretch.closures[low] + part * stretch.closures[low + 1]
        radius, entrainment, sliding = map(float, smooth(time))
        problem = problems[0]._replace(
            line_load=float(np.interp(time, *stretch.loads)),
            radius=radius,
            entrainment_speed=entrainment,
            sliding_speed=sliding,
        )
        return Instant(problem, FlowCorrection(*closure))

    return at


def _put(arrays: dict[str, Array], at: int, solution: Solution, contact: Contact, rise: Array) -> None:
    """Write an instant into the datasets."""
    gap = solution.mean_gap
    friction = friction_of(solution, contact.rheology, contact.thermal, rise.T)
    values = pressure_and_film(solution) | {
        "central_film_thickness": float(np.interp(0.0, solution.place, gap)),
        "minimum_film_thickness": float(np.min(gap)),
        "friction_coefficient": abs(friction) / solution.problem.line_load,
    }
    for name, value in values.items():
        arrays[PREFIX + name][at] = value
