"""Heat in the film and into both surfaces: the energy equation over layers, and moving sources of heat.

In a layer of the film, with the flow ρ u of `Shear.velocity`, in the steady state:

    d/dx (ρ c u Θ) dz + exchange with the neighbouring layers (flow and conduction) = τ γ' dz

Θ is the temperature above the inlet's. The surfaces pass under the heat flux q at u_1 and u_2 (Jaeger 1942):

    Θ_s(x) = 1/(π k_s) ∫ q(x') exp(u (x − x')/2κ) K_0(u |x − x'|/2κ) dx',   κ = k_s/(ρ_s c_s)

which for u b/κ → ∞ is Blok's 1/√(π k_s ρ_s c_s u) ∫ q/√(x − x') dx'. All of it is one linear system.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.shear import LAYERS

#: Speed (over κ, 1/m) below which a surface counts as moving as slowly as this.
_SLOWEST = 1.0
#: Of the iteration for the surfaces, which gains two digits or more in each.
_SURFACE_STEPS = 40


class HeatProperties(NamedTuple):
    """What conducts and stores heat."""

    temperature_viscosity: float  # K_T = −d ln η/dT at ambient pressure, 1/K
    conductivity: float = 0.14  # of the oil, W/(m K)
    heat_capacity: float = 1.7e6  # of the oil, per volume at ambient pressure, J/(m³ K)
    #: solid_conductivity, solid_heat_capacity: of surfaces 1 and 2, W/(m K), J/(m³ K)
    solid_conductivity: tuple[float, float] = (46.0, 46.0)
    solid_heat_capacity: tuple[float, float] = (3.6e6, 3.6e6)


class FilmHeat(NamedTuple):
    """Temperatures above the inlet's, K, and where the heat goes, W/m."""

    layers: Array  # Θ (x, layer), from surface 2 to surface 1
    #: surface_1, surface_2: Θ of the surfaces (x)
    surface_1: Array
    surface_2: Array
    made: float  # by shear
    #: into_1, into_2: conducted into the surfaces
    into_1: float
    into_2: float
    carried: float  # by the oil out of the film


def moving_source(place: Array, edge: Array, speed: float, conductivity: float, capacity: float) -> Array:
    """Temperatures at places by unit fluxes through the cells between edges, K m²/W; (places, cells)."""
    from scipy.special import k0e, k1e

    rate = 0.5 * speed * capacity / conductivity
    if abs(rate) < _SLOWEST:
        rate = math.copysign(_SLOWEST, rate)
    ahead = rate * (place[:, None] - edge[None, :])
    size = np.maximum(np.abs(ahead), 1e-300)
    # ∫ e^s K_0(|s|) ds = s e^s (K_0(|s|) ± K_1(|s|)); scaled functions hold the exponentials in bounds
    after = size * (k0e(size) + k1e(size))
    before = -size * np.exp(-2.0 * size) * (k0e(size) - k1e(size))
    whole = np.where(ahead >= 0.0, after - 1.0, before - 1.0)
    return (whole[:, :-1] - whole[:, 1:]) / (math.pi * conductivity * abs(rate)) * math.copysign(1.0, rate)


class WarmedSurfaces(NamedTuple):
    """Both surfaces under the nodes of a film."""

    thermal: HeatProperties
    width: Array  # of the cells about the nodes, m (x)
    #: temperatures of surfaces 1 and 2 by the fluxes into their cells, K m²/W, each (x, x)
    response: tuple[Array, Array]


def surfaces_under(place: Array, speeds: tuple[float, float], thermal: HeatProperties) -> WarmedSurfaces:
    """Return how both surfaces warm, at u_1 and u_2, under the nodes at `place` (m)."""
    edge = np.concatenate([place[:1], 0.5 * (place[1:] + place[:-1]), place[-1:]])
    first, second = (
        moving_source(place, edge, speed, k, c)
        for speed, k, c in zip(speeds, thermal.solid_conductivity, thermal.solid_heat_capacity, strict=True)
    )
    return WarmedSurfaces(thermal, np.diff(edge), (first, second))


def heated(
    surfaces: WarmedSurfaces,
    film: Array,
    flow: Array,
    heating: Array,
    feedback: Array,
    rise: Array,
    guess: FilmHeat | None = None,
) -> FilmHeat:
    """Solve for the temperatures under a film (x,), m, with quantities of its layers (x, layer).

    They are `flow` of mass over the density at ambient pressure, m²/s, its sum the same at every x; heat of
    shear `heating`, W/m², at the temperatures `rise`, K; `feedback`, by how much less is made where the film
    is warmer as a whole, W/(m² K), ≥ 0. The temperatures of the surfaces start at those of `guess`.
    """
    # here and below: who asks for known contacts alone starts faster
    from scipy.linalg import get_lapack_funcs, lu_solve
    from scipy.sparse.linalg import LinearOperator, gmres

    band_factors, band_solves = get_lapack_funcs(("gbtrf", "gbtrs"), dtype=np.float64)
    thermal, width, response = surfaces
    count = len(film)
    source = (heating + feedback * rise) * width[:, None]
    feedback_sum = feedback * width[:, None]
    through = np.concatenate([flow[:1], 0.5 * (flow[1:] + flow[:-1]), flow[-1:]])
    band, wall = _layers_system(film, width, feedback_sum, through, thermal)
    lower_upper, pivots, failed = band_factors(band, LAYERS, LAYERS)
    if failed:
        raise SimulationError("the temperatures of the film have no solution")
    inverse = _coupling(response, _conductances(film, feedback, thermal))

    def answered(surface: Array, source: Array | float) -> tuple[Array, Array, Array]:
        """Temperatures of the layers, and fluxes into both surfaces, at temperatures of these."""
        right = np.zeros_like(heating) + source
        right[:, -1] += wall * width * surface[:count]
        right[:, 0] += wall * width * surface[count:]
        layers = band_solves(lower_upper, LAYERS, LAYERS, right.ravel(), pivots)[0].reshape(heating.shape)
        return layers, wall * (layers[:, -1] - surface[:count]), wall * (layers[:, 0] - surface[count:])

    def missing(surface: Array, source: Array | float = 0.0) -> Array:
        _, *flux = answered(surface, source)
        return surface - np.concatenate([response[0] @ flux[0], response[1] @ flux[1]])

    operator: Any = LinearOperator
    size, first = (2 * count, 2 * count), np.zeros(2 * count)
    surface, failed = gmres(
        operator(size, missing, dtype=float),
        -missing(first, source),
        np.concatenate([guess.surface_1, guess.surface_2]) if guess is not None else first,
        rtol=1e-10,
        restart=_SURFACE_STEPS,
        maxiter=2,
        M=operator(size, lambda right: lu_solve(inverse, right, check_finite=False), dtype=float),
    )
    layers, *flux = answered(surface, source)
    if failed or not np.all(np.isfinite(layers)):
        raise SimulationError("the temperatures of the line contact did not converge")
    left, right = np.minimum(flow[0], 0.0) @ layers[0], np.maximum(flow[-1], 0.0) @ layers[-1]
    return FilmHeat(
        layers,
        surface[:count],
        surface[count:],
        float(np.sum(source - feedback_sum * layers)),
        float(flux[0] @ width),
        float(flux[1] @ width),
        thermal.heat_capacity * float(right - left),
    )


def _conductances(film: Array, feedback: Array, thermal: HeatProperties) -> tuple[Array, Array, Array]:
    """Flux into surface 1 as it cools or surface 2 warms, and into surface 2 as it cools; W/(m² K).

    Of conduction across the film with the heat that a warmer film does not make, without flow along x.
    """
    layer = thermal.conductivity * LAYERS / film
    matrix = np.zeros((*feedback.shape, LAYERS))
    inner = np.arange(LAYERS)
    matrix[:, inner, inner] = feedback + 2.0 * layer[:, None]
    matrix[:, inner[1:], inner[:-1]] = matrix[:, inner[:-1], inner[1:]] = -layer[:, None]
    matrix[:, (0, -1), (0, -1)] += layer[:, None]
    right = np.zeros((len(film), LAYERS, 2))
    right[:, -1, 0] = right[:, 0, 1] = wall = 2.0 * layer
    warmed = np.linalg.solve(matrix, right)
    return wall * (1.0 - warmed[:, -1, 0]), wall * warmed[:, -1, 1], wall * (1.0 - warmed[:, 0, 1])


def _coupling(response: tuple[Array, Array], conductance: tuple[Array, Array, Array]) -> tuple[Array, Array]:
    """Factors of what couples the surfaces nearly alone: conduction across the film."""
    from scipy.linalg import lu_factor

    own_1, between, own_2 = conductance
    first, second = response
    matrix = np.block([[first * own_1, first * -between], [second * -between, second * own_2]])
    matrix[np.diag_indices(len(matrix))] += 1.0
    return lu_factor(matrix, overwrite_a=True, check_finite=False)


def _layers_system(
    film: Array, width: Array, feedback: Array, through: Array, thermal: HeatProperties
) -> tuple[Array, Array]:
    """Matrix of the layers' temperatures in LAPACK's band form, and conductance to the walls, W/(m² K).

    `through` is the flow of the layers through the edges of the cells, (x + 1, layer).
    """
    capacity = thermal.heat_capacity
    layer = thermal.conductivity * LAYERS / film
    wall = 2.0 * layer
    ahead, behind = np.maximum(through, 0.0) * capacity, np.minimum(through, 0.0) * capacity
    # flow between layers from what enters and leaves a cell along x; positive from surface 2 to surface 1
    across = -np.cumsum(np.diff(through, axis=0), axis=1)[:, :-1] * capacity
    conducted = (layer * width)[:, None]
    up, down = conducted + np.maximum(across, 0.0), conducted - np.minimum(across, 0.0)
    diagonal = feedback + ahead[1:] - behind[:-1]
    diagonal[:, :-1] += up
    diagonal[:, 1:] += down
    diagonal[:, 0] += wall * width
    diagonal[:, -1] += wall * width
    band = np.zeros((3 * LAYERS + 1, *diagonal.shape))
    middle = 2 * LAYERS
    band[middle] = diagonal
    band[middle - 1, :, 1:] = -down  # from the layer above into this one
    band[middle + 1, :, :-1] = -up
    band[middle + LAYERS, :-1] = -ahead[1:-1]
    band[middle - LAYERS, 1:] = behind[1:-1]
    return band.reshape(len(band), -1), wall
