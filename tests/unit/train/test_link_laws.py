"""Two laws in one train: their columns of the Jacobian, the energy of their torques, the train at rest."""

import json
from typing import Any

import numpy as np
import pytest

from tests.support.plain_kernels import plain
from tests.support.states import random_state
from tests.support.train_scenarios import REDUCER, case_of_table
from tribodyn import LinkLaw, Parameter
from tribodyn.dynamics.loads import link_energy, link_forces
from tribodyn.solve.initial import initial_state
from tribodyn.solve.march.jacobian import differentiate_links
from tribodyn.solve.tolerances import state_scales
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.run import with_link_law
from tribodyn.train.layout import displacements, velocities
from tribodyn.train.structure import (
    DAMPING,
    turned,
)

PLAY = {"law": "play", "play": "0.02 deg"}


def hardening(twist, stiffness, parameters):
    """Stiffer with the square of the twist."""
    ratio = twist / parameters.reference
    torque = stiffness * twist * (1.0 + ratio * ratio)
    return torque, stiffness * twist * twist * (0.5 + 0.25 * ratio * ratio), 1.0


HARDENING = LinkLaw(
    "hardening", "cubic", hardening, keys=(Parameter("reference", "angle", "twist of twice", 2e-4, "test"),)
)


def scenario(**link: Any) -> dict[str, Any]:
    """A reducer whose middle shaft gives way, with a flywheel behind a coupling."""
    shaft = {"name": "middle", "gears": ["wheel-1", "pinion-2"], "stiffness": "4e5 N*m/rad"}
    coupling = {
        "name": "coupling",
        "ends": ["flywheel", "wheel-2"],
        "stiffness": "3e5 N*m/rad",
        "damping_ratio": 0.05,
    }
    flywheel = {"name": "flywheel", "mass": "3 kg", "inertia": "0.02 kg*m**2"}
    more = {"shaft": [shaft | {"damping_ratio": 0.03}], "body": [flywheel], "link": [coupling | link]}
    return json.loads(json.dumps(REDUCER | more))


def prepared():
    return prepare(with_link_law(case_of_table(scenario(**PLAY)), "middle", HARDENING))


def test_their_columns_of_the_jacobian_are_central_differences(rng):
    """Of forces and of the power that damping takes."""
    train = prepared().model
    layout, y = train.layout, random_state(rng, train)
    scale = state_scales(train, y)
    found = np.zeros((layout.states, layout.mechanical))
    plain(differentiate_links)(y, scale, train, found)

    def forces(state):
        into = np.zeros(layout.states)
        into[layout.mechanical + DAMPING] = link_forces(state, train, into)[0]
        return into

    for j in [*displacements(layout), *velocities(layout)]:
        step = np.zeros(layout.states)
        step[j] = 1e-5 * scale[j]
        expected = (forces(y + step) - forces(y - step)) / (2.0 * step[j])
        np.testing.assert_allclose(found[:, j], expected, rtol=1e-6, atol=1e-7 * np.abs(expected).max())


def test_energy_and_torques_of_a_train_are_its_laws(rng):
    """Virtual work of the torques at rest is the change of the energy."""
    train = prepared().model
    layout, y = train.layout, random_state(rng, train)
    y[layout.half :] = 0.0
    into = np.zeros(layout.states)
    link_forces(y, train, into)
    for j in displacements(layout):
        step = np.zeros(layout.states)
        step[j] = 1e-9
        slope = (link_energy(y + step, train) - link_energy(y - step, train)) / 2e-9
        assert -into[layout.half + j] == pytest.approx(slope, rel=1e-5, abs=1e-3)


def test_at_rest_every_link_bears_its_torque():
    """The middle shaft that of the output by the ratio; the coupling none, and stays in its play."""
    train = prepared()
    layout, state = train.model.layout, initial_state(train.model, "static")
    wheel, pinion, output, flywheel = (
        float(turned(train.names.index(name), state, layout))
        for name in ("wheel-1", "pinion-2", "wheel-2", "flywheel")
    )
    twist = wheel - pinion
    assert 4e5 * twist * (1.0 + (twist / 2e-4) ** 2) == pytest.approx(1800.0 * 23 / 57, rel=1e-6)
    assert abs(output - flywheel) < np.radians(0.01)
