"""Residual of the mixed contact: asperities share the load, and stand in the way of the flow.

As `reynolds`, in Hertz's units, with the pressures P of the fluid and the films H at the nodes as unknowns:

    ρ φ_x H_T³/(η λ) dP/dX − ρ H_T + Q = 0        up to the end of the film; P = 0 from there on
    H = H_0 + X²/2 + κ D (P + P_a(H)),   ∫ P + P_a dX = π/2

with P_a by Greenwood & Tripp, the mean gap H_T and the flow factor φ_x by Patir & Cheng. Both surfaces are
equally rough, so that the shear flow factor drops out.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.asperities import Roughness, asperity_pressure, mean_gap, pressure_flow_factor
from tribodyn.tribology.ehl.elasticity import HERTZ_LOAD
from tribodyn.tribology.ehl.fluid.fluid import Fluid, log_viscosity, relative_density
from tribodyn.tribology.ehl.grid import FilmGrid, at_faces
from tribodyn.tribology.ehl.reynolds import (
    KEPT_FLOW,
    LONGEST_WAY,
    FilmState,
    FlowCorrection,
    SmoothReduced,
    least_pressure,
    mean_fluidity,
)
from tribodyn.tribology.ehl.squeeze import Squeeze, cells, mesh_speed, stored


class RoughReduced(NamedTuple):
    """As `Reduced`, of rough surfaces; `modulus` is E' in Pa, `film_unit` b²/R in m."""

    speed: float
    hertz_pressure: float
    fluid: Fluid
    roughness: Roughness
    modulus: float
    film_unit: float
    compliance: float = 1.0


Reduced = SmoothReduced | RoughReduced


def asperities(thick: Array, reduced: RoughReduced) -> tuple[Array, Array]:
    """P_a at films H, and its derivative."""
    unit, scale = reduced.film_unit, reduced.hertz_pressure
    value, slope = asperity_pressure(thick * unit, reduced.roughness, reduced.modulus)
    return value / scale, slope * unit / scale


def gap(thick: Array, reduced: RoughReduced) -> tuple[Array, Array]:
    """H_T at films H, and its derivative."""
    value, slope = mean_gap(thick * reduced.film_unit, reduced.roughness)
    return value / reduced.film_unit, slope


def rough_residual(
    state: FilmState,
    reduced: RoughReduced,
    grid: FilmGrid,
    closure: FlowCorrection,
    squeeze: Squeeze | None = None,
) -> tuple[Array, Array]:
    """Residuals and Jacobian: faces, films, load, end; by pressures within the film, films, H_0, Q, X_e."""
    last, nodes, thick = grid.end, len(grid.node), state.film
    film, inner = slice(0, last + 1), last - 1
    place = state.end + grid.node
    carried, harder = asperities(thick, reduced)
    mean, opened = gap(thick, reduced)
    unit, scale = reduced.film_unit, reduced.hertz_pressure
    pressure = state.pressure[film]
    exponent, slope = log_viscosity(scale * pressure, reduced.fluid)
    fluidity, upstream, downstream = mean_fluidity(closure.thinning[film] + closure.response[film] * exponent)
    slope = scale * closure.response[film] * slope
    density, growth = relative_density(scale * pressure, reduced.fluid)
    growth = scale * growth
    dense, share, kept = at_faces(grid, density), 1.0 + at_faces(grid, closure.drift[film]), 1.0
    if squeeze is not None:
        speed = mesh_speed(squeeze, state.end, grid)
        share, kept = share - speed[:-1], 1.0 - speed[-1]
    middle = at_faces(grid, mean[film])
    factor, widened = pressure_flow_factor(middle * unit, reduced.roughness)
    volume = dense * factor * middle**3 / reduced.speed
    gradient = np.diff(pressure) / grid.step[:last]
    faces = volume * fluidity * gradient - share * dense * middle + kept * state.flow
    whole = state.pressure + carried
    bent = reduced.compliance * grid.deformation
    films = thick - state.rigid_film - 0.5 * place * place - bent @ whole
    values = np.concatenate([faces, films, [grid.weight @ whole - HERTZ_LOAD, state.flow - mean[last]]])

    size = inner + nodes + 3
    matrix = np.zeros((size, size))
    w, face = grid.upwind, np.arange(last)
    mobility = volume * fluidity / grid.step[:last]
    by_density = volume * fluidity * gradient / dense - share * middle
    by_gap = volume * fluidity * gradient * (3.0 / middle + widened * unit / factor) - share * dense
    own = -mobility + volume * gradient * slope[:-1] * upstream + by_density * w[1] * growth[:-1]
    following = mobility + volume * gradient * slope[1:] * downstream + by_density * w[2] * growth[1:]
    matrix[face[:-1], face[:-1]] = following[:-1]
    matrix[face[1:], face[1:] - 1] = own[1:]
    matrix[face[2:], face[2:] - 2] = (by_density * w[0])[2:] * growth[1:-2]
    column = inner + face
    matrix[face, column + 1] = by_gap * w[2] * opened[1 : last + 1]
    matrix[face, column] = by_gap * w[1] * opened[:last]
    matrix[face[1:], column[1:] - 1] = (by_gap * w[0])[1:] * opened[: last - 1]
    matrix[:last, size - 2] = kept
    row, films_at = slice(last, last + nodes), slice(inner, inner + nodes)
    matrix[row, :inner] = -bent[:, 1:last]
    np.multiply(bent, -harder, out=matrix[row, films_at])
    matrix[last + np.arange(nodes), inner + np.arange(nodes)] += 1.0
    matrix[row, size - 3] = -1.0
    matrix[row, size - 1] = -place
    matrix[size - 2, :inner] = grid.weight[1:last]
    matrix[size - 2, films_at] = grid.weight * harder
    matrix[size - 1, inner + last] = -opened[last]
    matrix[size - 1, size - 2] = 1.0
    if squeeze is not None:
        matrix[:last, size - 1] += squeeze.rate * (dense * middle - state.flow)
        values[:last] += stored(squeeze, grid, density * mean[film])
        length = squeeze.rate * cells(grid)
        by_film = np.broadcast_to(length * density * opened[film], (last, last + 1))
        matrix[:last, inner : inner + last + 1] += np.triu(by_film, 1)
        by_pressure = np.broadcast_to((length * growth * mean[film])[1:last], (last, inner))
        matrix[:last, :inner] += np.triu(by_pressure)
    return values, matrix


def rough_moved(
    state: FilmState, change: Array, grid: FilmGrid, reduced: RoughReduced, suction: float = 0.0
) -> FilmState:
    """Take a step of Newton's method, held where films would change by more than roughness and own size."""
    inner = grid.end - 1
    most = 2.0 * reduced.roughness.height / reduced.film_unit + 0.5 * np.abs(state.film)
    films = change[inner:-3]
    part = min(1.0, float(1.0 / np.max(np.abs(films) / most)))
    pressure = state.pressure.copy()
    within = slice(1, grid.end)
    least = least_pressure(pressure[within], suction)
    pressure[within] = np.maximum(pressure[within] + part * change[:inner], least)
    rigid_film, flow, end = (part * float(step) for step in change[-3:])
    return FilmState(
        pressure,
        state.rigid_film + rigid_film,
        max(state.flow + flow, KEPT_FLOW * state.flow),
        state.end + min(max(end, -LONGEST_WAY), LONGEST_WAY),
        state.film + part * films,
    )


def with_films(state: FilmState, reduced: RoughReduced, grid: FilmGrid) -> FilmState:
    """Return a state of smooth surfaces with its films, and no pressure behind the film."""
    pressure = state.pressure.copy()
    pressure[grid.end :] = 0.0
    place = state.end + grid.node
    bent = reduced.compliance * (grid.deformation @ state.pressure)
    return state._replace(pressure=pressure, film=state.rigid_film + 0.5 * place * place + bent)
