"""Modes from the assembled matrices against the Jacobian of the right-hand side itself."""

from itertools import pairwise

import numpy as np
import pytest

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.parameters import frictionless
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.train.layout import displacements, velocities

PHASES = 8


def by_differences(model) -> np.ndarray:
    """Frequencies (Hz) of the mean over the mesh cycle of the frictionless right-hand side's Jacobian.

    At every phase about the state at which the loads there balance.
    """
    model = frictionless(model)
    free = displacements(model.layout)
    shift = np.zeros((len(free), model.layout.states))
    shift[range(len(free)), free] = 1e-9
    seconds = model.operation.pitch_angle / model.operation.nominal_speed
    mean = 0.0
    for segment, (start, end) in enumerate(pairwise(model.meshes[0].table.boundary)):
        for phase in start + (end - start) * (np.arange(PHASES) + 0.5) / PHASES:
            at = static_equilibrium(model, phase, segment)
            up, down = (accelerations(at + sign * shift, phase, segment, model) for sign in (1, -1))
            slope = (up - down) / 2e-9 / seconds
            mean = mean + slope[:, velocities(model.layout)].T * (end - start) / PHASES
    return np.sqrt(np.sort(np.linalg.eigvals(-mean).real)) / (2 * np.pi)


#: Bearings that shift load between pairs of different pressure angles.
SOFT = {f"bearings.{side}.stiffness_y": "2e8 N/m" for side in ("pinion", "gear")}


@pytest.mark.parametrize(
    ("name", "overrides"),
    [
        ("crc-23-47", {}),
        ("crc-23-47", {"mesh.hertz": "load-dependent", "operating.gear_torque": "60 N*m", **SOFT}),
        ("involute-18-36-fem", {}),  # pairs that touch beyond the path, or not
        ("high-contact-ratio", {}),
        ("rattle", {}),
        ("load-step", {}),
        ("load-step", {"operating.shaft_stiffness": "2e6 N*m/rad", "operating.drive_inertia": "0.5 kg*m**2"}),
    ],
)
def test_modes_are_those_of_the_right_hand_side(prepared, name, overrides):
    case = prepared(name, **overrides)
    model = case.model
    found = natural_frequencies(model, [case.cycle])
    assert len(found) == (6 if model.layout.bodies == 3 else 5)
    # the mean is over the nodes of the table here, over a few midpoints there
    np.testing.assert_allclose(found, by_differences(model), rtol=1e-3)


def test_a_single_mode_without_bearings_that_give_way(prepared):
    """Rigid bearings, constant stiffness of single pairs: √(k̄ cos²α / m_e) with k̄ = contact ratio × k."""
    stiffness = 2e8
    case = prepared(
        "involute-23-47",
        **{
            "mesh.compliance": "constant",
            "mesh.stiffness": f"{stiffness} N/m",
            **{
                f"bearings.{side}.stiffness_{axis}": "1e14 N/m"
                for side in ("pinion", "gear")
                for axis in "xy"
            },
        },
    )
    cosine = np.cos(float(case.cycle.pressure_angle[0, 0, 0]))
    # the pinion's rotation is prescribed
    mass = case.model.bodies.inertia[1] / case.model.meshes[0].driven_radius ** 2
    mean = float(case.cycle.contact_ratio) * stiffness
    expected = np.sqrt(mean * cosine**2 / mass) / (2 * np.pi)
    assert natural_frequencies(case.model, [case.cycle])[0] == pytest.approx(expected, rel=1e-5)
