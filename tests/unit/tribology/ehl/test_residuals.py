"""Residuals of the line contact: their equations face by face in plain loops, and their Jacobians.

Small grids and states that solve nothing, so that every term counts.
"""

import math

import numpy as np
import pytest

from tribodyn.tribology.ehl import reynolds, rough
from tribodyn.tribology.ehl.fluid import Fluid
from tribodyn.tribology.ehl.grid import made
from tribodyn.tribology.ehl.reynolds import Squeeze
from tribodyn.tribology.ehl.rough import Roughness

FLUID = Fluid(0.05, 2e-8, 0.6)
SCALE = 2e8
#: Uneven nodes; of the rough contact three more behind the film.
NODES = np.array([-4.0, -2.9, -2.1, -1.6, -1.0, -0.7, -0.4, -0.15, 0.0])
BEYOND = np.array([0.2, 0.5, 1.1])


def ln_viscosity(pressure):
    return 2e-8 * 1.962e8 / 0.6 * ((1 + pressure / 1.962e8) ** 0.6 - 1)


def density(pressure):
    return 1 + 0.6e-9 * pressure / (1 + 1.7e-9 * pressure)


def at_face(node, value, i):
    """Value half way between nodes i and i + 1, of the parabola with node i − 1."""
    x = 0.5 * (node[i] + node[i + 1])
    if i == 0:
        return 0.5 * (value[0] + value[1])
    return np.polyval(np.polyfit(node[i - 1 : i + 2] - x, value[i - 1 : i + 2], 2), 0.0)


def mean_inverse(low, high):
    """∫ exp(−g) for g from one end to the other."""
    return (math.exp(-low) - math.exp(-high)) / (high - low)


def random_case(rng, nodes, film):
    """A grid, a closure and a squeeze term."""
    grid, faces = made(nodes), film - 1
    closure = reynolds.FlowCorrection(
        *(rng.uniform(*ends, len(nodes)) for ends in ((-0.5, 0.0), (0.5, 1.0), (-0.1, 0.1)))
    )
    squeeze = Squeeze(0.7, rng.uniform(0.5, 1.0, film), rng.uniform(-1.0, 1.0, faces + 1))
    pressure = np.where(np.arange(len(nodes)) < film - 1, rng.uniform(0.3, 1.2, len(nodes)), 0.0)
    pressure[0] = 0.0
    return grid, closure, squeeze, pressure


def flows(node, last, thick, squeeze, end, pressure, closure, speed, factor=lambda h: 1.0):
    """Mass balance of every face by its terms, with films at the nodes of the flow."""
    place = [end + 0.5 * (node[i] + node[i + 1]) for i in range(last)] + [end]
    moves = (
        [squeeze.rate * x - old if squeeze else 0.0 for x, old in zip(place, squeeze.place, strict=True)]
        if squeeze
        else [0.0] * (last + 1)
    )
    dense = density(SCALE * pressure[: last + 1])
    g = closure.thinning + closure.response * ln_viscosity(SCALE * pressure)
    length = [0.5 * (node[1] - node[0])]
    length += [0.5 * (node[k + 1] - node[k - 1]) for k in range(1, last)]
    length += [0.5 * (node[last] - node[last - 1])]
    found = []
    for i in range(last):
        h, rho = at_face(node, thick, i), at_face(node, dense, i)
        gradient = (pressure[i + 1] - pressure[i]) / (node[i + 1] - node[i])
        couette = 1 + at_face(node, closure.drift, i) - moves[i]
        pushed = rho * factor(h) * h**3 / speed * mean_inverse(g[i], g[i + 1]) * gradient
        stored = 0.0
        if squeeze:
            stored = sum(
                squeeze.rate * length[k] * dense[k] * thick[k] - squeeze.mass[k]
                for k in range(i + 1, last + 1)
            )
        found.append((pushed - couette * rho * h, 1 - moves[last], stored))
    return found


def assert_derivative(values, matrix, unknowns, step=1e-6):
    for column, value in enumerate(unknowns):
        by = step * max(abs(value), 0.1)
        change = np.eye(len(unknowns))[column] * by
        slope = (values(unknowns + change) - values(unknowns - change)) / (2 * by)
        np.testing.assert_allclose(matrix[:, column], slope, rtol=1e-5, atol=1e-6 * np.abs(slope).max())


@pytest.mark.parametrize("squeezed", [False, True])
@pytest.mark.parametrize("compliance", [1.0, 0.0])
def test_smooth_surfaces(rng, squeezed, compliance):
    grid, closure, squeeze, pressure = random_case(rng, NODES, len(NODES))
    squeeze = squeeze if squeezed else None
    reduced = reynolds.SmoothReduced(0.3, SCALE, FLUID, compliance)
    last = len(NODES) - 1
    unknowns = np.concatenate([pressure[1:-1], [0.4, 0.9, 0.2]])

    def state(values):
        return reynolds.FilmState(np.concatenate([[0.0], values[:-3], [0.0]]), *values[-3:])

    values, matrix = reynolds.residual(state(unknowns), reduced, grid, closure, squeeze)
    rigid, flow, end = unknowns[-3:]
    thick = rigid + 0.5 * (end + NODES) ** 2 + compliance * (grid.deformation @ pressure)
    np.testing.assert_allclose(reynolds.film(state(unknowns), reduced, grid), thick, rtol=1e-12)
    expected = flows(NODES, last, thick, squeeze, end, pressure, closure, 0.3)
    expected = [moved + kept * flow + stored for moved, kept, stored in expected]
    expected += [np.trapezoid(pressure, NODES) - math.pi / 2, flow - thick[-1]]
    np.testing.assert_allclose(values, expected, rtol=1e-9)
    assert_derivative(
        lambda given: reynolds.residual(state(given), reduced, grid, closure, squeeze)[0], matrix, unknowns
    )


@pytest.mark.parametrize("squeezed", [False, True])
def test_rough_surfaces(rng, squeezed):
    nodes = np.concatenate([NODES, BEYOND])
    last, count = len(NODES) - 1, len(nodes)
    grid, closure, squeeze, pressure = random_case(rng, nodes, len(NODES))
    assert grid.end == last
    squeeze = squeeze if squeezed else None
    sigma, unit, modulus = 3e-7, 5e-7, 2.2e11
    surfaces = Roughness(sigma, 0.05, 0.01)
    reduced = rough.RoughReduced(0.3, SCALE, FLUID, surfaces, modulus, unit)
    films = rng.uniform(0.5, 1.4, count)
    unknowns = np.concatenate([pressure[1:last], films, [0.4, 0.9, 0.2]])

    def state(values):
        whole = np.zeros(count)
        whole[1:last] = values[: last - 1]
        return reynolds.FilmState(whole, *values[-3:], values[last - 1 : -3])

    values, matrix = rough.rough_residual(state(unknowns), reduced, grid, closure, squeeze)
    rigid, flow, end = unknowns[-3:]
    ratio = films * unit / sigma
    # Gaussian heights by quadrature: ∫ (t + s)⁺ φ ds and the integral of Greenwood & Tripp
    s = np.linspace(-9.0, 9.0, 18001)
    normal = np.exp(-0.5 * s * s) / math.sqrt(2 * math.pi)
    mean = np.array([np.trapezoid(np.maximum(given + s, 0.0) * normal, s) for given in ratio]) * sigma / unit
    overlap = np.array([np.trapezoid(np.maximum(s - given, 0.0) ** 2.5 * normal, s) for given in ratio])
    carried = 16 * math.sqrt(2) / 15 * math.pi * 0.05**2 * math.sqrt(0.01) * modulus / 2 * overlap / SCALE
    whole = pressure + carried
    faces = flows(
        nodes[: last + 1],
        last,
        mean[: last + 1],
        squeeze,
        end,
        pressure[: last + 1],
        reynolds.FlowCorrection(*(given[: last + 1] for given in closure)),
        0.3,
        lambda h: 1 - 0.9 * math.exp(-0.56 * h * unit / sigma),
    )
    expected = [moved + kept * flow + stored for moved, kept, stored in faces]
    expected += list(films - rigid - 0.5 * (end + nodes) ** 2 - grid.deformation @ whole)
    expected += [np.trapezoid(whole, nodes) - math.pi / 2, flow - mean[last]]
    np.testing.assert_allclose(values, expected, rtol=1e-6, atol=1e-6)
    assert_derivative(
        lambda given: rough.rough_residual(state(given), reduced, grid, closure, squeeze)[0], matrix, unknowns
    )


@pytest.mark.parametrize("gap", [0.0, 3e-9, -4e-3, 0.0195, -0.0205, 1.7, -40.0, 700.0])
def test_mean_fluidity_is_the_mean_of_the_exponential(gap):
    """(e^−g1 − e^−g2)/(g2 − g1), and the derivatives −∫ (1 − s) e^−g ds, −∫ s e^−g ds by quadrature."""
    low = np.array([0.3, 0.3 + gap])
    found = [float(value[0]) for value in reynolds.mean_fluidity(low)]
    exact = math.exp(-0.3) * (-math.expm1(-gap) / gap if gap else 1.0)
    assert found[0] == pytest.approx(exact, rel=1e-12)
    node, weight = np.polynomial.legendre.leggauss(400)
    s, weight = 0.5 * (node + 1.0), 0.5 * weight
    values = np.exp(-(0.3 + gap * s))
    assert found[1] == pytest.approx(-np.sum(weight * (1.0 - s) * values), rel=1e-8)
    assert found[2] == pytest.approx(-np.sum(weight * s * values), rel=1e-8, abs=1e-10 * exact)


def test_rough_steps_are_held_where_films_would_jump(rng):
    """No film changes by more than 2 σ and half of itself: the whole step is as much shorter."""
    nodes = np.concatenate([NODES, BEYOND])
    grid, count = made(nodes), len(nodes)
    pressure = np.where(np.arange(count) < grid.end, rng.uniform(0.5, 1.0, count), 0.0)
    pressure[0] = 0.0
    state = reynolds.FilmState(pressure, 0.4, 0.9, 0.2, rng.uniform(0.5, 1.4, count))
    inner = grid.end - 1
    change = np.concatenate([rng.uniform(-0.1, 0.1, inner + count), [0.03, -0.02, 0.05]])
    small = reynolds.moved(state, change, 0.0, 3e-7 / 5e-7)
    np.testing.assert_allclose(small.pressure[1 : grid.end], pressure[1 : grid.end] + change[:inner])
    np.testing.assert_allclose(small.film, state.film + change[inner:-3])
    assert (small.rigid_film, small.flow, small.end) == pytest.approx((0.43, 0.88, 0.25))
    assert np.all(small.pressure[grid.end :] == 0.0)
    # one film that would change by four times what it may
    change[inner + 3] = 4.0 * (2 * 3e-7 / 5e-7 + 0.5 * state.film[3])
    held = reynolds.moved(state, change, 0.0, 3e-7 / 5e-7)
    np.testing.assert_allclose(held.film, state.film + 0.25 * change[inner:-3])
    np.testing.assert_allclose(held.pressure[1 : grid.end], pressure[1 : grid.end] + 0.25 * change[:inner])
    assert (held.rigid_film, held.flow, held.end) == pytest.approx((0.4075, 0.895, 0.2125))
    far = np.concatenate([np.full(inner, -50.0), np.full(count, 1e-12), [0.0, -9.0, 7.0]])
    bound = reynolds.moved(state, far, 0.0, 3e-7 / 5e-7)
    np.testing.assert_allclose(bound.pressure[1 : grid.end], 0.2 * pressure[1 : grid.end])
    assert (bound.flow, bound.end) == pytest.approx((0.3 * 0.9, 0.5))
    far[-1] = -7.0
    sucked = reynolds.moved(state, far, 0.05, 3e-7 / 5e-7)
    np.testing.assert_allclose(sucked.pressure[1 : grid.end], 0.2 * pressure[1 : grid.end] - 0.05)
    assert sucked.end == pytest.approx(-0.1)


def test_films_of_a_smooth_state(rng):
    """H_0 + x²/2 + D P at all nodes; behind the end of the film no pressure stays."""
    nodes = np.concatenate([NODES, BEYOND])
    grid = made(nodes)
    state = reynolds.FilmState(rng.uniform(0.3, 1.0, len(nodes)), 0.4, 0.9, 0.2)
    for compliance in (1.0, 0.6):
        reduced = rough.RoughReduced(0.3, SCALE, FLUID, Roughness(3e-7), 2.2e11, 5e-7, compliance)
        found = rough.with_films(state, reduced, grid)
        np.testing.assert_array_equal(found.pressure[: grid.end], state.pressure[: grid.end])
        assert np.all(found.pressure[grid.end :] == 0.0)
        bent = compliance * grid.deformation @ state.pressure
        np.testing.assert_allclose(found.film, 0.4 + 0.5 * (0.2 + nodes) ** 2 + bent)
        assert found[1:4] == (0.4, 0.9, 0.2)


def test_deformation_is_that_of_a_half_space(rng):
    """−1/π ∫ P ln|x − x'| dx' of a pressure that is linear between the nodes, by fine quadrature."""
    grid = made(NODES)
    pressure = rng.uniform(0.3, 1.2, len(NODES))
    fine = np.linspace(NODES[0], NODES[-1], 80001)
    middle = 0.5 * (fine[1:] + fine[:-1])
    value = np.interp(middle, NODES, pressure)
    for i, x in enumerate(NODES):
        exact = -np.sum(value * np.log(np.abs(middle - x))) * (fine[1] - fine[0]) / math.pi
        assert grid.deformation[i] @ pressure == pytest.approx(exact, rel=2e-4, abs=1e-4)
    for i in range(len(NODES) - 1):
        assert grid.face_deformation[i] @ pressure == pytest.approx(
            at_face(NODES, grid.deformation @ pressure, i), rel=1e-9
        )


def test_steps_are_held_where_unknowns_lose_their_meaning():
    pressure = np.array([0.0, 1.0, 2.0, 0.0])
    state = reynolds.FilmState(pressure, 0.5, 1.0, 0.1)
    small = reynolds.moved(state, np.array([0.1, -0.2, 0.3, -0.4, 0.05]))
    np.testing.assert_allclose(small.pressure, [0.0, 1.1, 1.8, 0.0])
    assert (small.rigid_film, small.flow, small.end) == pytest.approx((0.8, 0.6, 0.15))
    far = reynolds.moved(state, np.array([-5.0, 1.0, 0.0, -4.0, 2.0]))
    np.testing.assert_allclose(far.pressure, [0.0, reynolds.KEPT_PRESSURE, 3.0, 0.0])
    assert far.flow == pytest.approx(reynolds.KEPT_FLOW)
    assert far.end == pytest.approx(0.1 + reynolds.LONGEST_WAY)
    back = reynolds.moved(state, np.array([-5.0, 1.0, 0.0, 0.0, -2.0]), suction=0.3)
    assert back.pressure[1] == pytest.approx(reynolds.KEPT_PRESSURE - 0.3)
    assert back.end == pytest.approx(0.1 - reynolds.LONGEST_WAY)
