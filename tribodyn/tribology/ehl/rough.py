"""The mixed contact: asperities share the load and stand in the way of the flow; its residual.

As `reynolds`, in Hertz's units, with the pressures P of the fluid and the films H at the nodes as unknowns:

    ρ φ_x H_T³/(η λ) dP/dX − ρ H_T + Q = 0        up to the end of the film; P = 0 from there on
    H = H_0 + X²/2 + κ D (P + P_a(H)),   ∫ P + P_a dX = π/2

with P_a by Greenwood & Tripp, the mean gap H_T and the flow factor φ_x by Patir & Cheng. Both surfaces are
equally rough, so that the shear flow factor drops out.
"""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl import reynolds
from tribodyn.tribology.ehl.fluid import Fluid, log_viscosity, relative_density
from tribodyn.tribology.ehl.grid import HERTZ_LOAD, FilmGrid, at_faces

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(48)
#: Separations over σ below which the asperities count as pressed flat.
_FLAT = -6.0


class Roughness(NamedTuple):
    """Two rough surfaces as one, pressed on a smooth one."""

    height: float  # σ, rms of both surfaces together, m
    #: σ β n, height times radius times number per area of the asperities; 0.03 … 0.05 of ground steel
    #: (Greenwood & Tripp 1970)
    density: float = 0.05
    slope: float = 0.01  # σ/β
    friction: float = 0.12  # f_c, friction coefficient of the asperities


def asperity_pressure(gap: Array, roughness: Roughness, modulus: float) -> tuple[Array, Array]:
    """Mean pressure of the asperities at gaps h (m), Pa, and its derivative by h, Pa/m.

    p_a = 16√2/15 π (σ β n)² √(σ/β) E'/2 F_5/2(h/σ), F_m(t) = ∫_t^∞ (s − t)^m exp(−s²/2) ds/√(2π): Greenwood &
    Tripp (1970), whose modulus is half of E'.
    """
    factor = 16.0 * math.sqrt(2.0) / 15.0 * math.pi * roughness.density**2 * math.sqrt(roughness.slope)
    factor *= 0.5 * modulus
    ratio = np.maximum(gap / roughness.height, _FLAT)
    value, slope = _overlap(ratio)
    # below `_FLAT` straight on
    below = np.minimum(gap / roughness.height - ratio, 0.0)
    return factor * (value + slope * below), factor * slope / roughness.height


def _overlap(ratio: Array) -> tuple[Array, Array]:
    """F_5/2 and its derivative −5/2 F_3/2, by Gauss' quadrature in the root of s − t."""
    reach = np.sqrt(9.0 + np.maximum(-ratio, 0.0))[:, None]
    root = 0.5 * reach * (_NODES + 1.0)
    square = root * root
    weight = 0.5 * reach * _WEIGHTS * np.exp(-0.5 * (square + ratio[:, None]) ** 2) * 2.0 * root**4
    weight /= math.sqrt(2.0 * math.pi)
    return np.sum(weight * square, axis=1), -2.5 * np.sum(weight, axis=1)


def mean_gap(gap: Array, roughness: Roughness) -> tuple[Array, Array]:
    """Mean distance h_T of two rough surfaces that do not overlap, m, and its derivative by the nominal gap.

    h_T = h Φ(h/σ) + σ φ(h/σ) of Gaussian heights (Patir & Cheng 1978); h_T = h of thick films.
    """
    from scipy.special import ndtr

    ratio = gap / roughness.height
    share = ndtr(ratio)
    normal = np.exp(-0.5 * np.minimum(ratio * ratio, 1400.0)) / math.sqrt(2.0 * math.pi)
    # of rough surfaces pressed together the tail itself, so that no film vanishes
    return np.maximum(gap * share + roughness.height * normal, 1e-12 * roughness.height), share


def pressure_flow_factor(mean: Array, roughness: Roughness) -> tuple[Array, Array]:
    """φ_x = 1 − 0.90 exp(−0.56 h/σ) of isotropic surfaces (Patir & Cheng 1978), and its derivative, 1/m."""
    part = 0.90 * np.exp(-0.56 * mean / roughness.height)
    return 1.0 - part, 0.56 / roughness.height * part


class RoughReduced(NamedTuple):
    """As `Reduced`, of rough surfaces; `modulus` is E' in Pa, `film_unit` b²/R in m."""

    speed: float
    hertz_pressure: float
    fluid: Fluid
    roughness: Roughness
    modulus: float
    film_unit: float
    compliance: float = 1.0


Reduced = reynolds.SmoothReduced | RoughReduced


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
    state: reynolds.FilmState,
    reduced: RoughReduced,
    grid: FilmGrid,
    closure: reynolds.FlowCorrection,
    squeeze: reynolds.Squeeze | None = None,
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
    fluidity, upstream, downstream = reynolds.mean_fluidity(
        closure.thinning[film] + closure.response[film] * exponent
    )
    slope = scale * closure.response[film] * slope
    density, growth = relative_density(scale * pressure, reduced.fluid)
    growth = scale * growth
    dense, share, kept = at_faces(grid, density), 1.0 + at_faces(grid, closure.drift[film]), 1.0
    if squeeze is not None:
        speed = reynolds.mesh_speed(squeeze, state.end, grid)
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
    diagonal = -mobility + volume * gradient * slope[:-1] * upstream + by_density * w[1] * growth[:-1]
    following = mobility + volume * gradient * slope[1:] * downstream + by_density * w[2] * growth[1:]
    matrix[face[:-1], face[:-1]] = following[:-1]
    matrix[face[1:], face[1:] - 1] = diagonal[1:]
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
        values[:last] += reynolds.stored(squeeze, grid, density * mean[film])
        length = squeeze.rate * reynolds.cells(grid)
        by_film = np.broadcast_to(length * density * opened[film], (last, last + 1))
        matrix[:last, inner : inner + last + 1] += np.triu(by_film, 1)
        by_pressure = np.broadcast_to((length * growth * mean[film])[1:last], (last, inner))
        matrix[:last, :inner] += np.triu(by_pressure)
    return values, matrix


def with_films(state: reynolds.FilmState, reduced: RoughReduced, grid: FilmGrid) -> reynolds.FilmState:
    """Return a state of smooth surfaces with its films, and no pressure behind the film."""
    pressure = state.pressure.copy()
    pressure[grid.end :] = 0.0
    place = state.end + grid.node
    bent = reduced.compliance * (grid.deformation @ state.pressure)
    return state._replace(pressure=pressure, film=state.rigid_film + 0.5 * place * place + bent)
