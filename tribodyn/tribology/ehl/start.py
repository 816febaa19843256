"""Where Newton starts: Hertz's pressure with an inlet by Reynolds' equation, and the film of Moes' survey."""

import math

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.elasticity import HERTZ_LOAD, hertz_gap
from tribodyn.tribology.ehl.fluid.fluid import Fluid, log_viscosity
from tribodyn.tribology.ehl.grid import FilmGrid
from tribodyn.tribology.ehl.reynolds import FilmState, film
from tribodyn.tribology.ehl.rough import Reduced
from tribodyn.tribology.film.moes import log_survey

#: Films (in b²/R) up to which the start is Hertz's pressure; thicker ones start rigid. Tried over the map of
#: `docs/ehl.md`, as the lengths below.
THIN = 2.5
#: Central film over the minimum of Martin's rigid contact, and its end in √(2 R h_min).
MARTIN_CENTRAL, MARTIN_END = 1.226, 0.4754


def survey_film(load: float, material: float) -> float:
    """Central film in b²/R by Moes' survey formula, of Moes' M and L."""
    return math.exp(log_survey(math.log(load), math.log(max(material, 1e-9)))) * math.pi / (8.0 * load)


def first_state(reduced: Reduced, grid: FilmGrid, central: float) -> FilmState:
    """Return pressures, films and end of the film near the solution, for a central film from the survey."""
    if central < THIN:
        return _elastic(reduced, grid, central)
    return _rigid(reduced, grid, central)


def _elastic(reduced: Reduced, grid: FilmGrid, central: float) -> FilmState:
    width = (1.06 * central) ** (2.0 / 3.0)
    end = 1.0 + 0.5 * width
    place = end + grid.node
    inlet = _drawn_in(reduced, grid, central, central + np.where(place < 0.0, hertz_gap(place), 0.0), 0.7)
    inlet = np.minimum(inlet, math.sqrt(min(2.0 * width, 0.5)))
    inlet = inlet * np.exp(-np.maximum(place + 1.0, 0.0) / (1.5 * width))
    pressure = np.sqrt(np.maximum(1.0 - place**2, 0.0) + inlet**2)
    return _loaded(reduced, grid, pressure, end, central, central)


def _rigid(reduced: Reduced, grid: FilmGrid, central: float) -> FilmState:
    least = central / MARTIN_CENTRAL
    end = MARTIN_END * math.sqrt(2.0 * least)
    place = end + grid.node
    pressure = _drawn_in(reduced, grid, central, least + 0.5 * place**2, 1.0)
    return _loaded(reduced, grid, pressure, end, central, least)


def _drawn_in(reduced: Reduced, grid: FilmGrid, central: float, thick: Array, most: float) -> Array:
    """Pressures of an incompressible fluid drawn into a given gap, up to a share of the reduced pressure."""
    thick = np.maximum(thick, 0.1 * central)
    rise = reduced.speed * (thick - central) / thick**3
    drawn = np.concatenate([[0.0], np.cumsum(0.5 * (rise[1:] + rise[:-1]) * grid.step)])
    known, saturating = _reduced_pressure(reduced.hertz_pressure, reduced.fluid)
    return np.interp(np.clip(drawn, 0.0, most * saturating[-1]), saturating, known)


def _reduced_pressure(scale: float, fluid: Fluid) -> tuple[Array, Array]:
    """∫ η0/η dP over P, as a table up to three times Hertz's pressure."""
    known = np.concatenate([[0.0], np.geomspace(1e-12, 3.0, 600)])
    fluidity = np.exp(-log_viscosity(scale * known, fluid)[0])
    steps = 0.5 * np.diff(known) * (fluidity[1:] + fluidity[:-1])
    return known, np.concatenate([[0.0], np.cumsum(steps)])


def _loaded(
    reduced: Reduced, grid: FilmGrid, pressure: Array, end: float, flow: float, middle: float
) -> FilmState:
    """Give pressures the contact's load, and the rigid film that leaves `middle` at X = 0."""
    pressure[0] = pressure[-1] = 0.0
    pressure = pressure * (HERTZ_LOAD / (grid.weight @ pressure))
    thick = film(FilmState(pressure, 0.0, flow, end), reduced, grid)
    return FilmState(pressure, middle - float(np.interp(0.0, end + grid.node, thick)), flow, end)
