"""The steady line contact, by Newton's method on pressures, films, end of the film and load at once."""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.blas_threads import one_blas_thread
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.elasticity import HERTZ_LOAD
from tribodyn.tribology.ehl.grid import STEP, FilmGrid, film_width, made, placed
from tribodyn.tribology.ehl.problem import LineContact, check
from tribodyn.tribology.ehl.reynolds import (
    FilmState,
    FlowCorrection,
    SmoothReduced,
    film,
    moved,
    newtonian,
    residual,
)
from tribodyn.tribology.ehl.rough import (
    Reduced,
    RoughReduced,
    asperities,
    gap,
    rough_moved,
    rough_residual,
    with_films,
)
from tribodyn.tribology.ehl.squeeze import Squeeze
from tribodyn.tribology.ehl.start import first_state, survey_film

#: Mass and force balance: largest residual of a face over the flow, and of the load over the load.
TOLERANCE = 1e-10
#: Newton's method needs 4 to 14 steps over the whole map of Moes.
MOST_STEPS = 40
#: Pressure below ambient over Hertz's that a changing contact may have in its inlet, where the gap may open
#: faster than the oil is drawn in: a bar of 1 GPa.
SUCTION = 1e-4
#: Shortest step of a continuation, over the whole pressure-viscosity coefficient.
_SHORTEST_WAY = 1.0 / 64.0


class Solution(NamedTuple):
    """A solved contact."""

    problem: LineContact
    reduced: Reduced
    grid: FilmGrid
    state: FilmState  # State, in Hertz's units
    film: Array  # H at the nodes
    closure: FlowCorrection  # what shear and heat make of the flow
    steps: int  # of Newton's method
    imbalance: float  # largest residual: of mass flow over the flow, of force over the load

    @property
    def place(self) -> Array:
        """Place x of the nodes, m; 0 on the line of centres, the film ends at the last."""
        return (self.state.end + self.grid.node) * self.problem.half_width

    @property
    def pressure(self) -> Array:
        """Of fluid and asperities together, Pa."""
        return self.fluid_pressure + self.asperity_pressure

    @property
    def asperity_pressure(self) -> Array:
        """Mean pressure of the asperities, Pa; 0 between smooth surfaces."""
        if not isinstance(self.reduced, RoughReduced):
            return np.zeros_like(self.film)
        return asperities(self.film, self.reduced)[0] * self.problem.hertz_pressure

    @property
    def fluid_pressure(self) -> Array:
        """Pa; 0 behind the film."""
        return self.state.pressure * self.problem.hertz_pressure

    @property
    def mean_gap(self) -> Array:
        """Mean distance of the surfaces, m: the film of smooth ones, never zero between rough ones."""
        if not isinstance(self.reduced, RoughReduced):
            return self.film_thickness
        return gap(self.film, self.reduced)[0] * self.problem.film_unit

    @property
    def asperity_load_ratio(self) -> float:
        """Share of the load that the asperities carry."""
        carried = float(self.grid.weight @ self.asperity_pressure)
        return carried / self.problem.line_load * self.problem.half_width

    @property
    def film_thickness(self) -> Array:
        """Film thickness, m."""
        return self.film * self.problem.film_unit

    @property
    def central_film_thickness(self) -> float:
        """Film on the line of centres, x = 0, m."""
        return _parabola(self.place, self.film_thickness, int(np.argmin(np.abs(self.place))))[0]

    @property
    def minimum_film_thickness(self) -> float:
        """Minimum film thickness, m."""
        return _parabola(self.place, self.film_thickness, int(np.argmin(self.film)))[1]

    @property
    def flow_film_thickness(self) -> float:
        """Flow per width over u ρ0: film where the pressure is highest, times relative density there, m."""
        return self.state.flow * self.problem.film_unit

    @property
    def rolling_drag(self) -> float:
        """Drag of the pressure flow on each surface, ½ ∫ h dp/dx dx, N/m (Biboulet & Houpert 2010).

        With τ = τ_m + (z − h/2) dp/dx in the film, ∫ τ_m dx holds back the faster surface, this one both.
        """
        pressure, thick = self.fluid_pressure, self.mean_gap
        return 0.25 * float(np.sum((thick[1:] + thick[:-1]) * np.diff(pressure)))


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

    Parameters
    ----------
    start : of a similar contact: its grid and its state are taken. Default: by `first_state`, on a new grid.
    step : of a new grid; the errors of the film are of second order in it
    closure : on the nodes of `start` or of `grid`. Default: that of `start`, or a Newtonian isothermal fluid.
    grid : of a contact without `start`. Default: `grid_of` it.

    Returns
    -------
    Solution

    Raises
    ------
    InputError
        If a value has no meaning.
    SimulationError
        If Newton's method does not converge.
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
    """Take steps of Newton's method; returns the state, the number of steps, the imbalance (NaN: failed)."""
    equations: Any = rough_residual if isinstance(reduced, RoughReduced) else residual
    imbalance = math.inf
    for number in range(most_steps + 1):
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            values, matrix = equations(state, reduced, grid, closure, squeeze)
            imbalance = _imbalance(values, state, grid, squeeze)
        if imbalance <= TOLERANCE or not math.isfinite(imbalance) or number == most_steps:
            return state, number, imbalance
        try:
            change = np.linalg.solve(matrix, -values)
        except np.linalg.LinAlgError:
            return state, number, math.nan
        suction = 0.0 if squeeze is None else SUCTION
        if isinstance(reduced, RoughReduced):
            state = rough_moved(state, change, grid, reduced, suction)
        else:
            state = moved(state, change, suction)
    return state, most_steps, imbalance


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
            found, steps, imbalance = converged(state, reduced._replace(roughness=part), grid, closure)
            total += steps
            if imbalance <= TOLERANCE:
                state, done, factor = found, share, factor**1.5
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
    whole = reduced.fluid.pressure_viscosity
    done, way, total, imbalance = 0.0, 0.5, 0, math.nan
    while way >= _SHORTEST_WAY and done < 1.0:
        share = min(done + way, 1.0)
        fluid = reduced.fluid._replace(pressure_viscosity=share * whole)
        found, steps, imbalance = converged(state, reduced._replace(fluid=fluid), grid, closure)
        total += steps
        if imbalance <= TOLERANCE:
            state, done, way = found, share, 2.0 * way
        else:
            way *= 0.5
    return state, total, imbalance if done >= 1.0 else math.nan


def _imbalance(values: Array, state: FilmState, grid: FilmGrid, squeeze: Squeeze | None) -> float:
    flow = np.full(len(values) - 2, state.flow)
    if squeeze is not None:
        # far out what is stored is a small difference of large masses
        flow[: grid.end] += 0.5 * (state.end + grid.node[: grid.end]) ** 2
    return float(max(np.max(np.abs(values[:-2]) / flow), abs(values[-2]) / HERTZ_LOAD))


def _parabola(place: Array, value: Array, at: int) -> tuple[float, float]:
    """Value at x = 0, and extreme value, of the parabola through a node and its neighbours."""
    at = min(max(at, 1), len(place) - 2)
    c2, c1, c0 = np.polyfit(place[at - 1 : at + 2] / place[-1], value[at - 1 : at + 2] / value[at], 2)
    extreme = c0 - c1 * c1 / (4.0 * c2) if c2 > 0.0 else 1.0
    return float(c0 * value[at]), float(min(extreme, 1.0) * value[at])
