"""Shear and heat of the film by second methods: roots by bisection, and the heat balance cell by cell."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq as scipy_brentq
from scipy.special import k0

from tribodyn.tribology.ehl.fluid import Rheology
from tribodyn.tribology.ehl.heat import HeatProperties, heated, surfaces_under
from tribodyn.tribology.ehl.shear import LAYERS, sheared

#: SciPy's says that it may return more than the root.
brentq: Any = scipy_brentq
SPEEDS = (1.3, 0.9)
MIDDLES = [(k + 0.5) / LAYERS - 0.5 for k in range(LAYERS)]


def rate(law, stress, viscosity):
    """γ' at a stress, of laws with the default constants."""
    if law == "eyring":
        return 5e6 / viscosity * math.sinh(stress / 5e6)
    if law == "carreau":

        def missing(size):
            return size * (1 + (size / 5e6) ** 2) ** -0.25 - abs(stress)

        return math.copysign(brentq(missing, 0.0, 4 * abs(stress) + (stress / 1e3) ** 2), stress) / viscosity
    return stress / viscosity


@pytest.mark.parametrize("law", ["newtonian", "eyring", "carreau"])
@pytest.mark.parametrize("gradient", [-2e13, 6e13])
def test_layers_under_gradient_and_unequal_viscosity(law, gradient):
    """Rates at τ_m + s dp/dx add up to the sliding; heat, velocity and flow follow from them."""
    film = 3e-7
    logs = np.array([math.log(15.0) - 1.2 * s + 0.9 * s * s for s in MIDDLES])
    found = sheared(
        np.array([film]), np.array([3e8]), np.array([gradient]), logs[None, :], SPEEDS, Rheology(law)
    )
    thick, sliding = film / LAYERS, SPEEDS[0] - SPEEDS[1]

    def rates(mean, slope):
        return [
            rate(law, mean + s * film * slope, math.exp(log)) for s, log in zip(MIDDLES, logs, strict=True)
        ]

    def mean_of(slope):
        return brentq(lambda mean: sum(rates(mean, slope)) * thick - sliding, -1e9, 1e9, xtol=1e-6)

    mean = mean_of(gradient)
    assert found.stress[0] == pytest.approx(mean, rel=1e-7)
    each = rates(mean, gradient)
    heat = [flow * (mean + s * film * gradient) * thick for flow, s in zip(each, MIDDLES, strict=True)]
    np.testing.assert_allclose(found.heat[0], heat, rtol=1e-6, atol=1e-6 * max(heat))
    below = np.concatenate([[0.0], np.cumsum(each)[:-1]])
    np.testing.assert_allclose(
        found.velocity[0], SPEEDS[1] + (below + 0.5 * np.array(each)) * thick, rtol=1e-7
    )
    # without the gradient the unequal layers alone move the flow
    level = rates(mean_of(0.0), 0.0)
    drift = -sum(flow * s * film for flow, s in zip(level, MIDDLES, strict=True)) * thick
    assert found.drift[0] == pytest.approx(drift / (film * 1.1), rel=1e-6)
    # what the gradient adds is −h³/12 fluidity dp/dx; layers are taken as whole, ±t/2 about their middles
    fine = 0.0
    for s, flow, log in zip(MIDDLES, each, logs, strict=True):
        stress = mean + s * film * gradient
        step = 1e2
        tangent = (rate(law, stress + step, math.exp(log)) - rate(law, stress - step, math.exp(log))) / (
            2 * step
        )
        fine -= (flow * s * film + tangent * gradient * thick**2 / 12) * thick
    assert found.fluidity[0] == pytest.approx(12 * (drift - fine) / gradient / film**3, rel=1e-5)
    thicker = brentq(
        lambda m: sum(flow * 1e-4 for flow in rates(m, gradient)) - sum(rates(mean, gradient)) * 1e-4 * 1.001,
        -1e9,
        1e9,
        xtol=1e-6,
    )
    response = (thicker - mean) / mean / 0.001
    assert found.response[0] == pytest.approx(min(max(response, 0.0), 1.0), abs=2e-3)
    assert rate(law, found.stress[0], 1.0) == pytest.approx(found.newtonian[0], rel=1e-6)


def test_a_limiting_stress_by_its_closed_form():
    film, viscosity, gradient, limit = 3e-7, 40.0, 5e13, 2e6 + 0.05 * 3e8
    found = sheared(
        np.array([film]),
        np.array([3e8]),
        np.array([gradient]),
        np.full((1, LAYERS), math.log(viscosity)),
        SPEEDS,
        Rheology("limiting"),
    )
    newtonian = viscosity * 0.4 / film
    stress = limit * (1 - math.exp(-newtonian / limit))
    assert found.stress[0] == pytest.approx(stress, rel=1e-10)
    assert found.newtonian[0] == pytest.approx(newtonian, rel=1e-10)
    secant = 0.4 / film / stress
    assert found.fluidity[0] == pytest.approx(secant, rel=1e-10)
    assert found.drift[0] == 0.0
    ratio = newtonian / limit
    assert found.response[0] == pytest.approx(ratio / (math.exp(ratio) - 1), rel=1e-9)
    # rate Δu/h + secant dp/dx s, linear: the mean over a layer is that of its middle
    thick = film / LAYERS
    for k, s in enumerate(MIDDLES):
        ends = [SPEEDS[1] + quad(lambda z: 0.4 / film + secant * gradient * z, -film / 2, s * film)[0]]
        assert found.velocity[0, k] == pytest.approx(ends[0], rel=1e-3)
        worked = stress * 0.4 / LAYERS
        through = quad(
            lambda z: secant * gradient**2 * z * z, (s * film) - thick / 2, (s * film) + thick / 2
        )[0]
        assert found.heat[0, k] == pytest.approx(worked + through, rel=1e-9)


def line_source(x, at, scale):
    """exp(s) K_0(|s|) of a source at x."""
    ahead = scale * (at - x)
    return math.exp(ahead) * k0(abs(ahead) + 1e-300)


def test_the_temperatures_balance_every_cell_and_both_surfaces(rng):
    """Convection, conduction and shear of each layer's cell; Jaeger's integral for each surface."""
    count = 7
    place = np.sort(rng.uniform(-1e-4, 1e-4, count))
    thermal = HeatProperties(0.03, 0.14, 1.7e6, (40.0, 55.0), (3.6e6, 3.1e6))
    film = rng.uniform(1.5e-7, 3e-7, count)
    share = rng.uniform(0.5, 1.5, (count, LAYERS))
    flow = 3e-7 * share / share.sum(axis=1, keepdims=True)
    made, feedback = (
        rng.uniform(0.5, 1.5, (count, LAYERS)) * 1e7,
        rng.uniform(0.0, 1.0, (count, LAYERS)) * 1e4,
    )
    known = rng.uniform(0.0, 30.0, (count, LAYERS))
    speeds = (1.1, 0.4)
    found = heated(surfaces_under(place, speeds, thermal), film, flow, made, feedback, known)
    edge = [place[0], *(0.5 * (place[1:] + place[:-1])), place[-1]]
    edges = [flow[0], *(0.5 * (flow[1:] + flow[:-1])), flow[-1]]
    theta, total = found.layers, 0.0
    for i in range(count):
        width = edge[i + 1] - edge[i]
        layer = thermal.conductivity * LAYERS / film[i] * width
        up = 0.0  # flow of mass from this layer into the one above
        for k in range(LAYERS):
            heat = made[i, k] * width - feedback[i, k] * width * (theta[i, k] - known[i, k])
            total += heat
            if i > 0:
                heat += 1.7e6 * edges[i][k] * theta[i - 1, k]
            heat -= 1.7e6 * edges[i + 1][k] * theta[i, k]
            below = up
            up = below + edges[i][k] - edges[i + 1][k]
            if k > 0:
                heat += layer * (theta[i, k - 1] - theta[i, k])
                heat += 1.7e6 * below * (theta[i, k - 1] if below > 0 else theta[i, k])
            else:
                heat += 2 * layer * (found.surface_2[i] - theta[i, k])
            if k < LAYERS - 1:
                heat += layer * (theta[i, k + 1] - theta[i, k])
                heat -= 1.7e6 * up * (theta[i, k] if up > 0 else theta[i, k + 1])
            else:
                heat += 2 * layer * (found.surface_1[i] - theta[i, k])
            assert heat == pytest.approx(0.0, abs=1e-7 * 1e7 * width)
    assert found.made == pytest.approx(total, rel=1e-9)
    assert found.carried == pytest.approx(1.7e6 * flow[-1] @ theta[-1], rel=1e-9)
    for surface, last, into, speed, k, c in (
        (
            found.surface_1,
            theta[:, -1],
            found.into_1,
            *(each[0] for each in (speeds, thermal[3], thermal[4])),
        ),
        (found.surface_2, theta[:, 0], found.into_2, *(each[1] for each in (speeds, thermal[3], thermal[4]))),
    ):
        flux = 2 * thermal.conductivity * LAYERS / film * (last - surface)
        assert into == pytest.approx(flux @ np.diff(edge), rel=1e-9)
        i = count // 2
        by_parts = 0.0
        scale = speed * c / (2 * k)
        for j in range(count):
            cuts = sorted({edge[j], edge[j + 1], float(np.clip(place[i], edge[j], edge[j + 1]))})
            for low, high in pairwise(cuts):
                by_parts += flux[j] * quad(line_source, low, high, args=(place[i], scale))[0]
        assert surface[i] == pytest.approx(by_parts / (math.pi * k), rel=1e-5)
