"""The steady line contact, by Newton's method on pressures, films, end of the film and load at once.

It starts from Hertz's pressure with an inlet by Reynolds' equation, and the film of Moes' survey.
"""

import math

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.fluid import Fluid, log_viscosity
from tribodyn.tribology.ehl.grid import HERTZ_LOAD, STEP, FilmGrid, film_width, hertz_gap, made, placed
from tribodyn.tribology.ehl.problem import LineContact, Solution, check
from tribodyn.tribology.ehl.reynolds import (
    FilmState,
    FlowCorrection,
    SmoothReduced,
    Squeeze,
    film,
    films_after,
    films_of,
    moved,
    newtonian,
    residual,
)
from tribodyn.tribology.ehl.rough import Reduced, RoughReduced, rough_residual, with_films
from tribodyn.tribology.film.moes import log_survey

#: Mass and force balance: largest residual of a face over the flow, and of the load over the load.
TOLERANCE = 1e-10
#: Newton's method needs 4 to 14 steps over the whole map of Moes.
MOST_STEPS = 40
#: Pressure below ambient over Hertz's that a changing contact may have in its inlet, where the gap may open
#: faster than the oil is drawn in: a bar of 1 GPa.
SUCTION = 1e-4
#: Shortest step of a continuation, over the whole pressure-viscosity coefficient.
_SHORTEST_WAY = 1.0 / 64.0
#: Films (in b²/R) up to which the start is Hertz's pressure; thicker ones start rigid. Tried over the map of
#: `docs/ehl.md`, as the lengths below.
THIN = 2.5
#: Central film over the minimum of Martin's rigid contact, and its end in √(2 R h_min).
MARTIN_CENTRAL, MARTIN_END = 1.226, 0.4754


def reduced_problem(problem: LineContact) -> Reduced:
    """Return the contact in Hertz's units."""
    numbers = problem.speed_number, problem.hertz_pressure, problem.fluid
    if problem.roughness is None:
        return SmoothReduced(*numbers)
    return RoughReduced(*numbers, problem.roughness, problem.effective_modulus, problem.film_unit)


def expected_film(problem: LineContact) -> float:
    """Central film in b²/R by Moes' survey formula, and σ with it where the surfaces are rough."""
    height = problem.roughness.height if problem.roughness is not None else 0.0
    return survey_film(problem.moes_load, problem.moes_material) + height / problem.film_unit


def grid_of(problem: LineContact, step: float = STEP, *others: LineContact) -> FilmGrid:
    """Return the grid that suits the films expected of contacts; behind it as far as asperities may touch."""
    problems = (problem, *others)
    films = [expected_film(each) for each in problems]
    beyond = 0.0
    if problem.roughness is not None:
        unit = min(each.film_unit for each in problems)
        beyond = 1.5 + 2.0 * film_width(4.0 * problem.roughness.height / unit)
    return made(placed(min(films), step, beyond, max(films)))


def solve_steady(
    problem: LineContact,
    start: Solution | None = None,
    step: float = STEP,
    closure: FlowCorrection | None = None,
    grid: FilmGrid | None = None,
) -> Solution:
    """Solve a steady contact.

    Raises InputError if a value has no meaning, SimulationError if Newton's method does not converge.

    Parameters
    ----------
    start : of a similar contact: its grid and its state are taken. Default: by `first_state`, on a new grid.
    step : of a new grid; the errors of the film are of second order in it
    closure : on the nodes of `start` or of `grid`. Default: that of `start`, or a Newtonian isothermal fluid.
    grid : of a contact without `start`. Default: `grid_of` it.
    """
    check(problem)
    reduced = reduced_problem(problem)
    if start is not None:
        grid, state = start.grid, start.state
        closure = start.closure if closure is None else closure
    else:
        grid = grid_of(problem, step) if grid is None else grid
        state = first_state(reduced, grid, expected_film(problem))
        if isinstance(reduced, RoughReduced):
            state = with_films(state, reduced, grid)
    closure = newtonian(grid) if closure is None else closure
    first = state
    state, steps, imbalance = converged(first, reduced, grid, closure)
    if not imbalance <= TOLERANCE and start is None:
        if isinstance(reduced, RoughReduced):
            state, more, imbalance = _roughened(problem, first, reduced, grid, closure)
        else:
            state, more, imbalance = _continued(first, reduced, grid, closure)
        steps += more
    if not imbalance <= TOLERANCE:
        raise SimulationError(
            f"the line contact did not converge in {steps} steps (Moes' M {problem.moes_load:.3g}, "
            f"L {problem.moes_material:.3g}, p_H {problem.hertz_pressure / 1e9:.3g} GPa; imbalance "
            f"{imbalance:.1e}); start from the solution of a similar contact"
        )
    films = film(state, reduced, grid) if state.film is None else state.film
    return Solution(problem, reduced, grid, state, films, closure, steps, imbalance)


@one_blas_thread()
def converged(
    state: FilmState,
    reduced: Reduced,
    grid: FilmGrid,
    closure: FlowCorrection,
    squeeze: Squeeze | None = None,
    most_steps: int = MOST_STEPS,
) -> tuple[FilmState, int, float]:
    """Take steps of Newton's method; returns the state, the number of steps, the imbalance (NaN: failed).

    Between smooth surfaces it is the imbalance of the unknowns before they are rounded: where the film is
    1e-5 b²/R, the last digits of pressures would unbalance it by 1e-10.
    """
    suction, height, imbalance = 0.0 if squeeze is None else SUCTION, 0.0, math.inf
    films, rounded = np.zeros((2, 0))
    if isinstance(reduced, RoughReduced):
        height = reduced.roughness.height / reduced.film_unit
    else:
        films = films_of(state, reduced, grid)
        rounded = np.zeros(len(films) + 1)
    for number in range(most_steps + 1):
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            if isinstance(reduced, RoughReduced):
                values, matrix = rough_residual(state, reduced, grid, closure, squeeze)
            else:
                values, matrix = residual(state, reduced, grid, closure, squeeze, films)
                values += matrix @ rounded
            imbalance = _imbalance(values, state, grid, squeeze)
        if imbalance <= TOLERANCE or not math.isfinite(imbalance) or number == most_steps:
            return state, number, imbalance
        try:
            change = np.linalg.solve(matrix, -values)
        except np.linalg.LinAlgError:
            return state, number, math.nan
        if isinstance(reduced, RoughReduced):
            state = moved(state, change, suction, height)
            continue
        change += rounded
        before, state = state, moved(state, change, suction, height)
        films = films_after(films, before, state, reduced, grid)
        rounded = _rounded_off(change, before, state)
    return state, most_steps, imbalance


def _rounded_off(change: Array, before: FilmState, state: FilmState) -> Array:
    """What rounding has left of a change of the unknowns; 0 of what was held for another reason."""
    unknowns, start = (np.append(each.pressure[1:-1], each[1:4]) for each in (state, before))
    left = change - (unknowns - start)
    return np.where(np.abs(left) <= np.spacing(np.abs(unknowns)), left, 0.0)


def _roughened(
    problem: LineContact, first: FilmState, reduced: RoughReduced, grid: FilmGrid, closure: FlowCorrection
) -> tuple[FilmState, int, float]:
    """Raise the density of the asperities, or else their height, by factors that Newton's method takes."""
    whole, total = reduced.roughness, 0
    film = survey_film(problem.moes_load, problem.moes_material)
    smooth = with_films(first_state(reduced, grid, film), reduced, grid)
    least = min(0.3 * film * reduced.film_unit / whole.height, 0.5)
    for name, state, share, factor in (("density", first, 1e-3, 10.0), ("height", smooth, least, 2.5)):
        done, imbalance = 0.0, math.nan
        while factor > 1.02 and done < 1.0:
            part = whole._replace(**{name: share * getattr(whole, name)})
            solved, steps, imbalance = converged(state, reduced._replace(roughness=part), grid, closure)
            total += steps
            if imbalance <= TOLERANCE:
                state, done, factor = solved, share, factor**1.5
            elif done == 0.0:
                break
            else:
                factor **= 0.4
            share = min(done * factor, 1.0)
        if done >= 1.0:
            return state, total, imbalance
    return first, total, math.nan


def _continued(
    state: FilmState, reduced: Reduced, grid: FilmGrid, closure: FlowCorrection
) -> tuple[FilmState, int, float]:
    """Raise the pressure-viscosity coefficient from a part of it, in steps that Newton's method takes."""
    done, way, total, imbalance = 0.0, 0.5, 0, math.nan
    while way >= _SHORTEST_WAY and done < 1.0:
        share = min(done + way, 1.0)
        softer = reduced._replace(fluid=reduced.fluid.softened(share))
        solved, steps, imbalance = converged(state, softer, grid, closure)
        total += steps
        if imbalance <= TOLERANCE:
            state, done, way = solved, share, 2.0 * way
        else:
            way *= 0.5
    return state, total, imbalance if done >= 1.0 else math.nan


def _imbalance(values: Array, state: FilmState, grid: FilmGrid, squeeze: Squeeze | None) -> float:
    flow = np.full(len(values) - 2, state.flow)
    if squeeze is not None:
        # far out what is stored is a small difference of large masses
        flow[: grid.end] += 0.5 * (state.end + grid.node[: grid.end]) ** 2
    return float(max(np.max(np.abs(values[:-2]) / flow), abs(values[-2]) / HERTZ_LOAD))


def survey_film(load: float, material: float) -> float:
    """Central film in b²/R by Moes' survey formula, of Moes' M and L."""
    return math.exp(log_survey(math.log(load), math.log(max(material, 1e-9)))) * math.pi / (8.0 * load)


def first_state(reduced: Reduced, grid: FilmGrid, central: float) -> FilmState:
    """Return pressures, films and end of the film near the solution, for a central film from the survey."""
    if central >= THIN:
        least = central / MARTIN_CENTRAL
        end = MARTIN_END * math.sqrt(2.0 * least)
        rigid = least + 0.5 * (end + grid.node) ** 2
        pressure = _drawn_in(reduced, grid, central, rigid, 1.0)
        return _loaded(reduced, grid, pressure, end, central, least)
    width = (1.06 * central) ** (2.0 / 3.0)
    end = 1.0 + 0.5 * width
    place = end + grid.node
    inlet = _drawn_in(reduced, grid, central, central + np.where(place < 0.0, hertz_gap(place), 0.0), 0.7)
    inlet = np.minimum(inlet, math.sqrt(min(2.0 * width, 0.5)))
    inlet = inlet * np.exp(-np.maximum(place + 1.0, 0.0) / (1.5 * width))
    pressure = np.sqrt(np.maximum(1.0 - place**2, 0.0) + inlet**2)
    return _loaded(reduced, grid, pressure, end, central, central)


def _drawn_in(reduced: Reduced, grid: FilmGrid, central: float, thick: Array, most: float) -> Array:
    """Pressures of an incompressible fluid drawn into a given gap, up to a share of the reduced pressure."""
    thick = np.maximum(thick, 0.1 * central)
    rise = reduced.speed * (thick - central) / thick**3
    inflow = np.concatenate([[0.0], np.cumsum(0.5 * (rise[1:] + rise[:-1]) * grid.step)])
    pressures, saturating = _reduced_pressure(reduced.hertz_pressure, reduced.fluid)
    return np.interp(np.clip(inflow, 0.0, most * saturating[-1]), saturating, pressures)


def _reduced_pressure(scale: float, fluid: Fluid) -> tuple[Array, Array]:
    """∫ η0/η dP over P, as a table up to three times Hertz's pressure."""
    pressures = np.concatenate([[0.0], np.geomspace(1e-12, 3.0, 600)])
    fluidity = np.exp(-log_viscosity(scale * pressures, fluid)[0])
    steps = 0.5 * np.diff(pressures) * (fluidity[1:] + fluidity[:-1])
    return pressures, np.concatenate([[0.0], np.cumsum(steps)])


def _loaded(
    reduced: Reduced, grid: FilmGrid, pressure: Array, end: float, flow: float, middle: float
) -> FilmState:
    """Give pressures the contact's load, and the rigid film that leaves `middle` at X = 0."""
    pressure[0] = pressure[-1] = 0.0
    pressure = pressure * (HERTZ_LOAD / (grid.weight @ pressure))
    thick = film(FilmState(pressure, 0.0, flow, end), reduced, grid)
    return FilmState(pressure, middle - float(np.interp(0.0, end + grid.node, thick)), flow, end)
