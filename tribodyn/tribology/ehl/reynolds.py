"""Residual of Reynolds' equation, the film and the load of a line contact, and its Jacobian.

In units of Hertz's half width b, pressure p_H and film b²/R (Venner & Lubrecht 2000, ch. 2):

    ρ H³/(η λ) dP/dX − ρ H + Q + S = 0    flow Q constant: mass is conserved at every face; S: `Squeeze`
    H = H_0 + X²/2 + κ (D P)              D P = −1/π ∫ P ln|X − X'| dX'; κ = 0: rigid surfaces
    ∫ P dX = π/2
    P = 0 at both ends, ρ H = Q at the last: the film ends where dP/dX = 0 (Swift and Stieber)

λ = 12 u η0 R²/(b³ p_H). The end of the film X_e is an unknown like the pressures: the nodes X = X_e + ξ move
with it, so that D never changes and the equations stay smooth. Behind it the film is broken and carries Q in
the share Q/(ρ0 H) of the gap: mass is conserved there as well.

S is what the film stores over time. The nodes stand at x = b(t) (X_e(t) + ξ), so that they widen with Hertz's
contact and follow the end of the film. Between a face i and the end of the film

    d/dt ∫ ρ h dx + (q − ρ h v)_end − (q − ρ h v)_i = 0

v = dx/dt of a face: mass is conserved to rounding. The end meets a full gap where it moves outwards. Time
derivatives of masses and places are the same differences: nodes moving through a uniform film make no flow.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.fluid import Fluid, log_viscosity, relative_density
from tribodyn.tribology.ehl.grid import HERTZ_LOAD, FilmGrid, at_faces


class Squeeze(NamedTuple):
    """Time derivatives in Hertz's units of the instant: `rate` times what is, less what was."""

    rate: float  # c b/(Δt u), c the difference formula's weight of the instant itself
    mass: Array  # of the masses ρ H ΔX that nodes up to the end held before, in the same measure (nodes,)
    place: Array  # of the places of the faces and, last, of the end (faces + 1,)


class Snapshot(NamedTuple):
    """What nodes and faces were at an instant: s, m² (∫ ρ/ρ0 h dx about the nodes up to the end), m."""

    time: float
    mass: Array
    place: Array


def cells(grid: FilmGrid) -> Array:
    """Lengths about the nodes up to the end of the film, from face to face."""
    length = grid.weight[: grid.end + 1].copy()
    length[-1] = 0.5 * grid.step[grid.end - 1]
    return length


def faces(grid: FilmGrid) -> Array:
    """Places ξ of the faces of the film and, last, of its end, relative to the end."""
    node = grid.node[: grid.end + 1]
    return np.append(0.5 * (node[1:] + node[:-1]), 0.0)


def squeeze_of(
    time: float, before: list[Snapshot], half_width: float, speed: float, film_unit: float
) -> Squeeze:
    """Return the difference formula at a time, s, from the last one or two instants, the latest last.

    Backward differences of second order over unequal steps; of first order (Euler) from one instant.
    """
    last = before[-1]
    step = time - last.time
    if len(before) == 1:
        weight, mass, place = 1.0, last.mass, last.place
    else:
        ratio = step / (last.time - before[-2].time)
        older = ratio * ratio / (1.0 + ratio)
        weight = (1.0 + 2.0 * ratio) / (1.0 + ratio)
        mass, place = (
            (1.0 + ratio) * new - older * old for new, old in zip(last[1:], before[-2][1:], strict=True)
        )
    way = step * speed
    return Squeeze(weight * half_width / way, mass / (way * film_unit), place / way)


def mesh_speed(squeeze: Squeeze, end: float, grid: FilmGrid) -> Array:
    """Speed of the faces and, last, of the end, over u."""
    return squeeze.rate * (end + faces(grid)) - squeeze.place


def stored(squeeze: Squeeze, grid: FilmGrid, mass: Array) -> Array:
    """Rate at which mass is stored between each face and the end, over u ρ0 b²/R; `mass` is ρ H at nodes."""
    return behind(squeeze.rate * cells(grid) * mass - squeeze.mass)


def behind(value: Array) -> Array:
    """Sum, for each face, over the nodes between it and the end: over the first axis."""
    return np.cumsum(value[::-1], axis=0)[-2::-1]


#: Share of a pressure and of the flow that a step of Newton's method leaves, and how far the end may move.
KEPT_PRESSURE, KEPT_FLOW, LONGEST_WAY = 0.2, 0.3, 0.3


class SmoothReduced(NamedTuple):
    """A contact in Hertz's units."""

    speed: float  # λ
    hertz_pressure: float  # p_H, Pa, at which `fluid` is evaluated
    fluid: Fluid
    compliance: float = 1.0  # 1; 0: rigid surfaces


class FilmState(NamedTuple):
    """Unknowns: pressures at the nodes (zero at both ends), rigid film H_0, flow Q, end of the film X_e.

    Between rough surfaces the pressures are the fluid's, and the films H at the nodes are unknowns too.
    """

    pressure: Array
    rigid_film: float
    flow: float
    end: float
    film: Array = None


class FlowCorrection(NamedTuple):
    """What shear and heat make of the flow, at the nodes."""

    #: thinning, response: ln(η_effective/η0) is thinning + response · ln(η/η0), η the Newtonian isothermal
    #: viscosity, as the pressure varies about that at which they were made
    thinning: Array
    response: Array
    drift: Array  # flow that layers of unequal viscosity add, over ρ u h


def newtonian(grid: FilmGrid) -> FlowCorrection:
    """Return the closure of a Newtonian isothermal fluid."""
    zero = np.zeros(len(grid.node))
    return FlowCorrection(zero, zero + 1.0, zero)


def film(state: FilmState, reduced: Any, grid: FilmGrid) -> Array:
    """Film H at the nodes of a smooth or a rough contact."""
    place = state.end + grid.node
    bent = grid.deformation[:, 1:-1] @ state.pressure[1:-1]
    return state.rigid_film + 0.5 * place * place + reduced.compliance * bent


def films_of(state: FilmState, reduced: Any, grid: FilmGrid) -> Array:
    """Films H at the faces and, last, at the end of the film, of a smooth contact."""
    place = state.end + grid.node
    gap = np.append(at_faces(grid, 0.5 * place * place), 0.5 * state.end**2)
    return state.rigid_film + gap + reduced.compliance * _bent(state.pressure, grid)


def films_after(films: Array, before: FilmState, state: FilmState, reduced: Any, grid: FilmGrid) -> Array:
    """`films_of` a state, from those before a small change.

    A film of 1e-5 b²/R, what is left of terms of the size of 1, is rounded to ten digits; its change to
    fifteen of its own.
    """
    way, place = state.end - before.end, 0.5 * (state.end + before.end)
    gap = way * np.append(at_faces(grid, place + grid.node), place)
    bent = reduced.compliance * _bent(state.pressure - before.pressure, grid)
    return films + (state.rigid_film - before.rigid_film + gap + bent)


def _bent(pressure: Array, grid: FilmGrid) -> Array:
    inner = pressure[1:-1]
    return np.append(grid.face_deformation[:, 1:-1] @ inner, grid.deformation[-1, 1:-1] @ inner)


def mean_fluidity(exponent: Array) -> tuple[Array, Array, Array]:
    """Mean of exp(−g) between neighbouring nodes, for g linear between them, and its derivatives by both g.

    The flow through a face is then the difference of the reduced pressure ∫ exp(−g) dP, exact for an
    exponential viscosity however steep (as Scharfetter & Gummel 1969 discretise currents).
    """
    low, high = exponent[:-1], exponent[1:]
    half = 0.5 * (high - low)
    middle = np.exp(-0.5 * (high + low))
    small = np.abs(half) < 1e-2
    safe = np.where(small, 1.0, half)
    square = half * half
    # sinh(h)/h and its derivative; beyond 300 one of both fluidities is nothing beside the other
    with np.errstate(over="ignore"):
        ratio = np.where(small, 1.0 + square / 6.0 + square * square / 120.0, np.sinh(safe) / safe)
        slope = np.where(small, half / 3.0 + half * square / 30.0, (np.cosh(safe) - ratio) / safe)
    mean = middle * ratio
    return mean, -0.5 * (mean + middle * slope), -0.5 * (mean - middle * slope)


def residual(
    state: FilmState,
    reduced: SmoothReduced,
    grid: FilmGrid,
    closure: FlowCorrection,
    squeeze: Squeeze | None = None,
    films: Array | None = None,
) -> tuple[Array, Array]:
    """Residuals of all equations, and their Jacobian: faces, load, end; by pressures within, H_0, Q, X_e.

    `closure` says how the fluid departs from a Newtonian isothermal one; without `squeeze` the contact is
    steady. `films`: `films_of` the state, or `films_after` a change.
    """
    pressure, scale = state.pressure, reduced.hertz_pressure
    place = state.end + grid.node
    whole: Array = films_of(state, reduced, grid) if films is None else films
    thick, last = whole[:-1], whole[-1]
    exponent, slope = log_viscosity(scale * pressure, reduced.fluid)
    effective = closure.thinning + closure.response * exponent
    fluidity, upstream, downstream = mean_fluidity(effective)
    slope = scale * closure.response * slope
    upstream, downstream = slope[:-1] * upstream, slope[1:] * downstream
    density, growth = relative_density(scale * pressure, reduced.fluid)
    growth = scale * growth
    dense = at_faces(grid, density)
    share, kept = 1.0 + at_faces(grid, closure.drift), 1.0
    if squeeze is not None:
        speed = mesh_speed(squeeze, state.end, grid)
        share, kept = share - speed[:-1], 1.0 - speed[-1]
    volume = dense * thick**3 / reduced.speed
    mobility = volume * fluidity
    gradient = np.diff(pressure) / grid.step
    faces = mobility * gradient - share * dense * thick + kept * state.flow
    values = np.concatenate([faces, [grid.weight @ pressure - HERTZ_LOAD, state.flow - last]])
    size = len(faces)
    by_film = 3.0 * mobility * gradient / thick - share * dense
    by_density = mobility * gradient / dense - share * thick
    matrix = np.empty((size + 2, size + 2))
    inner = matrix[:size, : size - 1]
    np.multiply(grid.face_deformation[:, 1:-1], (reduced.compliance * by_film)[:, None], out=inner)
    through, bulk = mobility / grid.step, volume * gradient
    w, row = grid.upwind, np.arange(size)
    # pressures of the nodes i + 1, i, i − 1 of face i + ½; node k is column k − 1
    inner[row[:-1], row[:-1]] += (through + bulk * downstream + by_density * w[2] * growth[1:])[:-1]
    inner[row[1:], row[1:] - 1] += (-through + bulk * upstream + by_density * w[1] * growth[:-1])[1:]
    inner[row[2:], row[2:] - 2] += by_density[2:] * w[0][2:] * growth[1:-2]
    matrix[:size, size - 1] = by_film
    matrix[:size, size] = kept
    matrix[:size, size + 1] = by_film * at_faces(grid, place)
    matrix[size, : size - 1] = grid.weight[1:-1]
    matrix[size, size - 1 :] = 0.0
    matrix[size + 1, : size - 1] = -reduced.compliance * grid.deformation[-1, 1:-1]
    matrix[size + 1, size - 1 :] = (-1.0, 1.0, -state.end)
    if squeeze is not None:
        matrix[:size, size + 1] += squeeze.rate * (dense * thick - state.flow)
        _store(values, matrix, film(state, reduced, grid), state, reduced, grid, squeeze)
    return values, matrix


def _store(
    values: Array,
    matrix: Array,
    thick: Array,
    state: FilmState,
    reduced: SmoothReduced,
    grid: FilmGrid,
    squeeze: Squeeze,
) -> None:
    """Add what the film stores, and its derivatives, to residuals and Jacobian."""
    size = len(grid.step)
    density, growth = relative_density(reduced.hertz_pressure * state.pressure, reduced.fluid)
    values[:size] += stored(squeeze, grid, density * thick)
    length = squeeze.rate * cells(grid)
    by_film = length * density
    by_pressure = (reduced.compliance * by_film)[:, None] * grid.deformation[:, 1:-1]
    node = np.arange(1, size)
    by_pressure[node, node - 1] += (length * reduced.hertz_pressure * growth * thick)[1:-1]
    matrix[:size, : size - 1] += behind(by_pressure)
    matrix[:size, size - 1] += behind(by_film)
    matrix[:size, size + 1] += behind(by_film * (state.end + grid.node))


def moved(state: FilmState, change: Array, suction: float = 0.0, height: float = 0.0) -> FilmState:
    """Take a step of Newton's method, held where it would leave the meaning of an unknown.

    Between rough surfaces of σ = `height` no film changes by more than 2 σ and half of itself.
    """
    part, films, inner = 1.0, state.film, len(change) - 3
    if films is not None:
        inner -= len(films)
        most = 2.0 * height + 0.5 * np.abs(films)
        part = min(1.0, float(1.0 / np.max(np.abs(change[inner:-3]) / most)))
        films = films + part * change[inner:-3]
    pressure, within = state.pressure.copy(), slice(1, inner + 1)
    least = KEPT_PRESSURE * np.maximum(pressure[within], 0.0) - suction
    pressure[within] = np.maximum(pressure[within] + part * change[:inner], least)
    rigid_film, flow, end = (part * float(step) for step in change[-3:])
    return FilmState(
        pressure,
        state.rigid_film + rigid_film,
        max(state.flow + flow, KEPT_FLOW * state.flow),
        state.end + min(max(end, -LONGEST_WAY), LONGEST_WAY),
        films,
    )
