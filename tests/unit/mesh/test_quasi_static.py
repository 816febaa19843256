"""Shares of the load against every set of loaded pairs that could be; integrals against SciPy's splines."""

from itertools import combinations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from tribodyn.mesh.quasi_static import cycle_integral, cycle_mean, quasi_static

PAIRS, NODES = 3, 2


class Table:
    """What `quasi_static` reads of a table, any numbers: three driving pairs and the back flank of one."""

    slices = 1

    def __init__(self, rng: np.random.Generator, hertz: float) -> None:
        shape = (2, NODES, PAIRS + 1)
        self.side = np.array([1.0, 1.0, 1.0, -1.0])
        self.in_contact = np.array([[1.0, 1.0, 1.0, 1.0], [0.0, 1.0, 1.0, 0.0]])
        self.compliance = rng.uniform(3e-9, 6e-9, shape)
        mutual = rng.uniform(0.1e-9, 0.4e-9, (*shape, PAIRS + 1))
        self.coupling = (mutual + np.swapaxes(mutual, -1, -2)) * (1 - np.eye(PAIRS + 1))
        self.hertz_coefficient = hertz
        self.pressure_angle = rng.uniform(0.25, 0.5, shape)
        self.signed_distance = rng.uniform(-6e-3, 6e-3, shape)
        self.gap = rng.uniform(0.0, 12e-6, shape)
        self.gear_pitch_radius = 0.0705

    def __iter__(self):
        return iter(())


def state_with(table: Table, place: tuple[int, int], loaded: list[int], friction: np.ndarray, torque: float):
    """Deflection, loads and stiffness where these pairs carry, written out; None where that cannot be."""
    s, n = place
    angle, gap = table.pressure_angle[s, n], table.gap[s, n]
    count = len(loaded)
    load = np.full(PAIRS + 1, torque / table.gear_pitch_radius / count)
    deflection, stiffness = 0.0, 0.0
    for _ in range(14):  # the Hertz deflection A F^0.9 by its secant
        matrix, right = np.zeros((count + 1, count + 1)), np.zeros(count + 1)
        for row, i in enumerate(loaded):
            for column, j in enumerate(loaded):
                matrix[row, column] = table.coupling[s, n, i, j]
            own = table.compliance[s, n, i] + table.hertz_coefficient * load[i] ** -0.1
            matrix[row, row] += own
            matrix[row, count], right[row] = -np.cos(angle[i]), -gap[i]
            lever = table.gear_pitch_radius * np.sin(angle[i]) - table.signed_distance[s, n, i]
            matrix[count, row] = table.gear_pitch_radius * np.cos(angle[i]) + friction[s, n, i] * lever
        right[count] = torque
        *some, deflection = np.linalg.solve(matrix, right)
        # of the load alone, without gaps
        without_gaps = np.linalg.solve(matrix, torque * np.eye(count + 1)[count])[count]
        stiffness = torque / table.gear_pitch_radius / without_gaps
        if min(some) <= 0:
            return None
        load = np.zeros(PAIRS + 1)
        load[loaded] = some
    touching = deflection * np.cos(angle) - gap - table.coupling[s, n] @ load
    idle = [i for i in range(PAIRS) if table.in_contact[s, i] and i not in loaded]
    return None if any(touching[i] > 0 for i in idle) else (deflection, load, stiffness)


@pytest.mark.parametrize("rubbed", [False, True])
def test_loads_are_those_of_the_only_set_of_pairs_that_can_be(rng, rubbed: bool):
    table = Table(rng, 6e-9)
    friction = rng.uniform(-0.1, 0.1, table.gap.shape) * rubbed
    torque = 150.0
    found = quasi_static(table, torque, friction if rubbed else None)  # pyright: ignore[reportArgumentType]
    counts = set()
    for s, n in np.ndindex(2, NODES):
        there = [i for i in range(PAIRS) if table.in_contact[s, i]]
        sets = [list(some) for k in range(1, len(there) + 1) for some in combinations(there, k)]
        states = [(some, state_with(table, (s, n), some, friction, torque)) for some in sets]
        [(loaded, state)] = [(some, state) for some, state in states if state]
        deflection, load, stiffness = state
        counts.add(len(loaded))
        np.testing.assert_allclose(found.normal_load[s, n], load, rtol=1e-8, atol=1e-6)
        assert found.deflection[s, n] == pytest.approx(deflection, rel=1e-9)
        assert found.mesh_stiffness[s, n] == pytest.approx(stiffness, rel=1e-8)
    assert len(counts) > 1


def test_integrals_are_those_of_scipys_splines(rng):
    """Of rough values, up to any phase of any segment, one of no length among them."""
    values = rng.uniform(-1.0, 1.0, (4, 7, 2))

    class Bounds:
        slices = 1
        boundary = np.array([0.0, 0.2, 0.2, 0.55, 1.0])

        def __iter__(self):
            return iter(())

    b = Bounds.boundary
    splines = [
        CubicSpline(np.linspace(b[s], b[s + 1], 7), values[s], bc_type="not-a-knot")
        if b[s + 1] > b[s]
        else None
        for s in range(4)
    ]

    def exact(upto):
        ends = [min(upto, end) for end in b[1:]]
        parts = zip(splines, b, ends, strict=False)
        return sum(spline.integrate(start, end) for spline, start, end in parts if spline and end > start)

    for upto in (0.0, 0.07, 0.2, 0.31, 0.5499, 0.55, 0.93, 1.0):
        found = cycle_integral(Bounds(), values, np.full((4, 2), upto))  # pyright: ignore[reportArgumentType]
        np.testing.assert_allclose(found, exact(upto) * np.ones(2), atol=1e-13)
    each = cycle_integral(Bounds(), values, np.array([[0.31, 0.93]] * 4))  # pyright: ignore[reportArgumentType]
    np.testing.assert_allclose(each, [exact(0.31)[0], exact(0.93)[1]], atol=1e-13)
    whole = exact(1.0)
    np.testing.assert_allclose(cycle_mean(Bounds(), values), whole, atol=1e-13)  # pyright: ignore
    assert float(cycle_mean(Bounds(), values[..., 1])) == pytest.approx(whole[1], abs=1e-13)  # pyright: ignore
