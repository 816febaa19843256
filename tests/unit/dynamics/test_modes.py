"""Natural frequencies from matrices of single gears, with the loads solved for at every node."""

import numpy as np
import pytest
from scipy.linalg import eigh

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.parameters import DRIVE_SPEED
from tribodyn.train.structure import TURN, Y

BEARINGS = {
    "bearings.pinion.stiffness_x": "3e8 N/m",
    "bearings.pinion.stiffness_y": "2e8 N/m",
    "bearings.gear.stiffness_x": "5e8 N/m",
    "bearings.gear.stiffness_y": "2e7 N/m",
    "mesh.points": 5,
}
TORQUE = {"operating.source": "torque"}
SHAFT = {**TORQUE, "operating.shaft_stiffness": "2e6 N*m/rad", "operating.drive_inertia": "0.5 kg*m**2"}


def loads(compliance, hertz, cosine, sine, give, force):
    """Loads whose deflections, with that of the bearings across, are ξ cos α; Σ F cos α is given."""
    load = np.full(len(cosine), force / np.sum(cosine))
    xi = 0.0
    for _ in range(9):
        matrix = compliance + give * np.outer(sine, sine)
        missing = matrix @ load + hertz * load**0.9 - xi * cosine
        slope = matrix + np.diag(0.9 * hertz * load**-0.1)
        system = np.block([[slope, -cosine[:, None]], [cosine[None], np.zeros((1, 1))]])
        change = np.linalg.solve(system, -np.append(missing, cosine @ load - force))
        load, xi = load + change[:-1], xi + change[-1]
    assert np.all(load > 0.0)
    return load


def mesh_stiffness(case):
    """Mean over the mesh cycle, trapezoid by trapezoid; N/m along x and y."""
    cycle = case.cycle
    give = float(np.sum(1.0 / case.model.links.stiffness[:2, Y]))
    force = abs(case.model.bodies.load[1]) / cycle.gear_pitch_radius
    total = np.zeros((2, 2))
    for segment in range(len(cycle.boundary) - 1):
        inside = np.flatnonzero((cycle.in_contact[segment] > 0) & (cycle.side > 0))
        found = []
        for node in range(cycle.phase.shape[1]):
            angle = cycle.pressure_angle[segment, node, inside]
            compliance = np.diag(cycle.compliance[segment, node, inside])
            compliance = compliance + cycle.coupling[segment, node][np.ix_(inside, inside)]
            cosine, sine = np.cos(angle), np.sin(angle)
            load = loads(compliance, cycle.hertz_coefficient, cosine, sine, give, force)
            tangent = compliance + np.diag(0.9 * cycle.hertz_coefficient * load**-0.1)
            normal = np.stack([cosine, sine])
            found.append(normal @ np.linalg.solve(tangent, normal.T))
        width = (cycle.boundary[segment + 1] - cycle.boundary[segment]) / (len(found) - 1)
        total += width * (np.sum(found, axis=0) - 0.5 * (found[0] + found[-1]))
    return total


@pytest.mark.parametrize(
    ("name", "overrides"),
    [
        ("crc-23-47", {"mesh.hertz": "load-dependent", "operating.gear_torque": "60 N*m"}),
        ("crc-23-47", TORQUE),
        ("involute-23-47", SHAFT),
    ],
    ids=["speed", "torque", "shaft"],
)
def test_frequencies_are_those_of_gears_shafts_and_bearings(prepared, name, overrides):
    case = prepared(name, **BEARINGS, **overrides)
    model, links = case.model, case.model.links
    r_p, r_g = float(case.cycle.pinion_pitch_radius), float(case.cycle.gear_pitch_radius)
    # x_p, y_p, φ_p, x_g, y_g, φ_g and the motor's φ
    stretch = np.array([[1, 0, r_p, -1, 0, -r_g, 0], [0, 1, 0, 0, -1, 0, 0]])
    springs = [*links.stiffness[0], *links.stiffness[1], 0.0]
    stiffness = stretch.T @ mesh_stiffness(case) @ stretch + np.diag(springs)
    (m_p, m_g), (j_p, j_g, *motor) = model.bodies.mass, model.bodies.inertia
    inertia = [m_p, m_p, j_p, m_g, m_g, j_g, *motor]
    drive, free = model.options.drive, list(range(len(inertia)))
    if drive == DRIVE_SPEED:
        free.remove(2)
    elif motor:
        stiffness[np.ix_([2, 6], [2, 6])] += links.stiffness[2, TURN] * np.array([[1, -1], [-1, 1]])
    values = eigh(
        stiffness[np.ix_(free, free)], np.diag(np.array(inertia, dtype=float)[free]), eigvals_only=True
    )
    expected = np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi)
    # all gears may turn together where no speed is held
    rigid = 0 if drive == DRIVE_SPEED else 1
    found = natural_frequencies(model, [case.cycle])
    np.testing.assert_allclose(found, expected[rigid:], rtol=1e-6)
