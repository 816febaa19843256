"""The contact of a fluid that thins with shear and heat: pressure, film, shear and temperature together."""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.fluid import (
    Rheology,
    hot_log_viscosity,
    log_viscosity,
    relative_density,
    stress_scale,
    thinned,
)
from tribodyn.tribology.ehl.grid import STEP
from tribodyn.tribology.ehl.heat import FilmHeat, HeatProperties, WarmedSurfaces, heated, surfaces_under
from tribodyn.tribology.ehl.problem import LineContact, Solution, check_heat, check_rheology
from tribodyn.tribology.ehl.reynolds import FlowCorrection
from tribodyn.tribology.ehl.shear import LAYERS, Shear, sheared
from tribodyn.tribology.ehl.steady import solve_steady

#: Change of film, friction and temperature, over each, at which all of them hold together.
TOLERANCE = 1e-7
MOST_ROUNDS = 100
#: Weight of a kelvin beside a change of ln η by 1, in what is mixed.
_KELVIN = 0.03
#: Smallest share of a change of the closure that a round takes.
_LEAST_SHARE = 0.05
#: Steps remembered by the mixing; singular values below this share of the largest are omitted.
MEMORY, _RANK = 5, 1e-8
#: Parts of a step between nodes in the integral of the shear stress.
_PARTS = 8


class CoupledSolution(NamedTuple):
    """A contact with its shear and heat."""

    solution: Solution  # pressures and films, under the closure that shear and heat make
    shear: Shear
    heat: FilmHeat | None  # Heat, or None of an isothermal contact
    friction: float  # ∫ τ_m + f_c p_a dx, N/m, of the sign of the sliding speed
    rounds: int  # of shear, heat and pressures

    @property
    def temperature(self) -> Array:
        """Mean over the film, K above the inlet's."""
        if self.heat is None:
            return np.zeros_like(self.solution.film)
        return np.mean(self.heat.layers, axis=1)


class Mixing:
    """Next argument of x = g(x) from those tried (Anderson 1965; Walker & Ni 2011)."""

    def __init__(self) -> None:
        self._tried: list[Array] = []
        self._change: list[Array] = []

    def next(self, tried: Array, image: Array) -> Array:
        """Return the argument to try after x = `tried` gave g(x) = `image`."""
        self._tried = [*self._tried[-MEMORY:], tried]
        self._change = [*self._change[-MEMORY:], image - tried]
        if len(self._tried) == 1:
            return image
        steps: Array = np.diff(np.array(self._tried), axis=0)
        changes: Array = np.diff(np.array(self._change), axis=0)
        weight = np.linalg.lstsq(changes.T, self._change[-1], rcond=_RANK)[0]
        return image - weight @ (steps + changes)

    def shorter(self, share: float) -> Array:
        """Return a shorter way from the last argument to what it gave, and forget what was before."""
        self._tried, self._change = self._tried[-1:], self._change[-1:]
        return self._tried[0] + share * self._change[0]


@one_blas_thread()
@np.errstate(over="ignore", divide="ignore", invalid="ignore")
def solve_coupled(
    problem: LineContact,
    rheology: Rheology,
    thermal: HeatProperties | None = None,
    start: Solution | None = None,
    step: float = STEP,
) -> CoupledSolution:
    """Solve pressures, film, shear and, with `thermal`, temperatures of a steady contact.

    Raises InputError if a value has no meaning, SimulationError if they do not converge.
    """
    check_rheology(rheology)
    if thermal is not None:
        check_heat(thermal)
    solution, surfaces = solve_steady(problem, start, step), None
    if thermal is not None:
        surfaces = surfaces_under(solution.place, problem.surface_speeds, thermal)
    mixing, share, last = Mixing(), 1.0, (math.inf,) * 3
    closure, rise = solution.closure, np.zeros((len(solution.place), LAYERS))
    heat: FilmHeat | None = None
    for rounds in range(1, MOST_ROUNDS + 1):
        shear, heat, image = _closed(solution, rheology, surfaces, heat, rise)
        warmed = heat.layers if heat is not None else rise
        target = _packed(image, warmed)
        if not np.all(np.isfinite(target)):
            raise _diverged(problem, rounds)
        trial = mixing.next(_packed(closure, rise), target)
        while True:
            closure, rise = _unpacked(trial)
            try:
                solution = solve_steady(problem, solution, closure=closure)
                break
            except SimulationError:
                share *= 0.5
                if share < _LEAST_SHARE:
                    raise
                trial = mixing.shorter(share)
        friction = _friction(solution, shear, rheology)
        now = (solution.central_film_thickness, friction, float(np.max(warmed)))
        least = (0.0, 1e-3 * problem.line_load, 1e-2)
        if all(abs(a - b) <= TOLERANCE * max(abs(a), c) for a, b, c in zip(now, last, least, strict=True)):
            return CoupledSolution(solution, shear, heat, friction, rounds)
        last = now
    raise _diverged(problem, MOST_ROUNDS)


def _diverged(problem: LineContact, rounds: int) -> SimulationError:
    return SimulationError(
        f"pressure, shear and heat of the line contact did not converge in {rounds} rounds (p_H "
        f"{problem.hertz_pressure / 1e9:.3g} GPa, sliding {problem.sliding_speed:.3g} m/s)"
    )


def _rubbing(problem: LineContact) -> float:
    return problem.roughness.friction if problem.roughness is not None else 0.0


def _packed(closure: FlowCorrection, rise: Array) -> Array:
    """Closure and temperatures of the layers as one vector, of like sizes."""
    return np.concatenate([np.array(closure).ravel(), _KELVIN * rise.ravel()])


def _unpacked(vector: Array) -> tuple[FlowCorrection, Array]:
    closure, rise = np.split(vector, [len(vector) * 3 // (3 + LAYERS)])
    return FlowCorrection(*closure.reshape(3, -1)), rise.reshape(-1, LAYERS) / _KELVIN


def friction_of(solution: Solution, rheology: Rheology, thermal: HeatProperties | None, rise: Array) -> float:
    """Friction ∫ τ_m + f_c p_a dx, N/m, under temperatures of the layers, K above the inlet's (x, layer)."""
    coefficient = thermal.temperature_viscosity if thermal is not None else 0.0
    shear, _ = _sheared(solution, rheology, coefficient, rise)
    return _friction(solution, shear, rheology)


def _friction(solution: Solution, shear: Shear, rheology: Rheology) -> float:
    """Of fluid and asperities, N/m."""
    film, problem = slice(0, solution.grid.end + 1), solution.problem
    of_fluid = shear_force(
        shear.newtonian[film], solution.fluid_pressure[film], solution.place[film], rheology
    )
    rubbing = _rubbing(problem) * (solution.asperity_load_ratio * problem.line_load)
    return of_fluid + (math.copysign(rubbing, problem.sliding_speed) if problem.sliding_speed else 0.0)


def shear_force(newtonian: Array, pressure: Array, place: Array, rheology: Rheology) -> float:
    """∫ τ_m dx over the nodes at places, N/m, from the stress of a Newtonian fluid that flows alike.

    Between two nodes the viscosity changes by powers of ten, and the stress bends where it comes near to what
    the oil bears: there ln η γ' and the pressure are taken as linear, and the law of shear does the rest.
    """
    at = np.linspace(0.0, len(place) - 1.0, _PARTS * (len(place) - 1) + 1)
    node = np.arange(len(place))
    equal = np.exp(np.interp(at, node, np.log(np.maximum(np.abs(newtonian), 1e-300))))
    stress = thinned(equal, stress_scale(np.interp(at, node, pressure), rheology), rheology)
    sign = np.sign(np.interp(at, node, np.sign(newtonian)))
    return float(np.trapezoid(sign * stress, np.interp(at, node, place)))


def _sheared(solution: Solution, rheology: Rheology, coefficient: float, rise: Array) -> tuple[Shear, Array]:
    """Shear under given pressures, films and temperatures, and d ln η/dT in the layers."""
    problem, fluid, pressure = solution.problem, solution.problem.fluid, solution.fluid_pressure
    gradient = np.gradient(pressure, solution.place)
    thickening, by_heat = hot_log_viscosity(pressure[:, None], rise, fluid, coefficient)
    log_eta = math.log(fluid.viscosity) + thickening
    shear = sheared(solution.mean_gap, pressure, gradient, log_eta, problem.surface_speeds, rheology)
    # the film behind its end is broken: it shears, but in shreds
    shear.stress[solution.grid.end + 1 :] = 0.0
    shear.heat[solution.grid.end + 1 :] = 0.0
    return shear, by_heat


def _closed(
    solution: Solution,
    rheology: Rheology,
    surfaces: WarmedSurfaces | None,
    heat: FilmHeat | None,
    rise: Array,
) -> tuple[Shear, FilmHeat | None, FlowCorrection]:
    """Shear and heat under given pressures, films and temperatures of the layers."""
    problem, fluid = solution.problem, solution.problem.fluid
    pressure, film = solution.fluid_pressure, solution.mean_gap
    coefficient = surfaces.thermal.temperature_viscosity if surfaces is not None else 0.0
    shear, by_heat = _sheared(solution, rheology, coefficient, rise)
    if surfaces is not None:
        flow = relative_density(pressure, fluid)[0][:, None] * shear.velocity * film[:, None] / LAYERS
        through = solution.flow_film_thickness * problem.entrainment_speed
        flow = flow + (through - np.sum(flow, axis=1, keepdims=True)) / LAYERS
        feedback = -by_heat * shear.response[:, None] * shear.heat
        rubbed = _rubbing(problem) * abs(problem.sliding_speed) / LAYERS * solution.asperity_pressure
        heat = heated(surfaces, film, flow, shear.heat + rubbed[:, None], feedback, rise, heat)
    cold = log_viscosity(pressure, fluid)[0]
    effective = -np.log(shear.fluidity * fluid.viscosity)
    return shear, heat, FlowCorrection(effective - shear.response * cold, shear.response, shear.drift)
