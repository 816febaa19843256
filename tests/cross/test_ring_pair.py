"""A planet and its ring in motion: forces, moments and powers by vectors, and statics at creeping speed."""

import math
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from tests.support.creeping_drive import SLOW, creep, statics
from tests.support.mesh_balance import mesh_actions, residuals
from tests.support.states import sampled
from tests.support.train_matrices import Mesh
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs, train_outputs
from tribodyn.solve.transient import TransientSettings

#: Both turn clockwise, and the ring's axis lies below the pitch point like the planet's.
SENSES = np.array([-1, -1])
CYCLES, SAMPLES = 4, 200
RUNS = {
    "planet drives": ("ring-36-93", {}),
    "ring drives": ("ring-36-93", {"operating.gear_torque": "-600 kN*m"}),
    "cycloids": ("cycloidal-ring-24-72", {}),
}


@pytest.fixture(scope="module")
def runs(prepared: Any):
    @lru_cache
    def run(name: str) -> Any:
        scenario, overrides = RUNS[name]
        pair = prepared(scenario, **overrides)
        model = pair.model
        cycles, states = sampled(model, TransientSettings("dopri5", 1e-9, CYCLES, 10**6, SAMPLES))
        seen = evaluated(cycles, states, model)
        mesh = mesh_outputs(0, seen)
        return pair, mesh, train_outputs(seen, mesh["sliding_loss"])

    return run


def _actions(pair: Any, mesh: dict[str, Any], train: dict[str, Any]) -> tuple[Any, list[Mesh]]:
    radii = float(pair.cycle.pinion_pitch_radius), float(pair.cycle.gear_pitch_radius)
    meshes = [Mesh((0, 1), radii, math.pi / 2, np.nan, int(SENSES[0]), 0.0)]
    names = "normal_load", "friction_force", "pressure_angle", "signed_distance"
    record = {name: np.asarray(mesh[name])[:, None] for name in names}
    record["time"] = train["time"]
    record["velocity"] = np.stack([train[key] for key in ("x_rate", "y_rate", "speed")], axis=2)
    flanks = [int(side) for side in pair.model.meshes[0].table.side]
    return mesh_actions(record, meshes, SENSES, flanks), meshes


@pytest.mark.parametrize("name", RUNS)
def test_what_the_mesh_does_to_the_planet_it_takes_from_the_ring(runs: Any, name: str):
    pair, mesh, train = runs(name)
    actions, meshes = _actions(pair, mesh, train)
    left = residuals(actions, meshes)
    assert left["force"] == 0.0
    assert left["moment"] < 1e-13
    assert left["power"] < 1e-9
    # torques in the gears' own senses: against the motion of the driver, with that of the driven gear
    np.testing.assert_allclose(mesh["driver_torque"], -SENSES[0] * actions.moment[:, 0, 0], rtol=1e-9)
    np.testing.assert_allclose(mesh["driven_torque"], SENSES[1] * actions.moment[:, 0, 1], rtol=1e-9)
    np.testing.assert_allclose(mesh["sliding_loss"], actions.friction_power[:, 0], rtol=1e-7, atol=1e-3)


@pytest.mark.parametrize("name", RUNS)
def test_the_ring_turns_with_the_planet_and_works_add_up(runs: Any, name: str):
    pair, _, train = runs(name)
    speed = train["speed"].mean(axis=0)
    ratio = float(pair.cycle.pinion_pitch_radius / -pair.cycle.gear_pitch_radius)
    assert speed[1] == pytest.approx(speed[0] * ratio, rel=3e-4)
    gained = {
        key: values[-1] - values[0] for key, values in train.items() if "work" in key or "stored" in key
    }
    torque, turned = pair.warm_pairs[0].operating.gear_torque, train["angle"][-1, 1] - train["angle"][0, 1]
    assert gained["work_out"] == pytest.approx(torque * turned, rel=1e-7)
    assert gained["work_friction"] > 0.0
    left = (
        gained["work_in"]
        + gained["work_parametric"]
        - sum(gained[key] for key in ("work_out", "work_friction", "work_damping", "stored_energy"))
    )
    assert abs(left) < 1e-7 * abs(gained["work_in"])


@pytest.mark.parametrize("coefficient", [1e-9, 0.1])
def test_loads_at_creep_are_those_of_statics(prepared: Any, coefficient: float):
    pair = prepared("ring-36-93", **SLOW, **{"friction.coefficient": coefficient})
    found, checked = creep(pair, samples=50), 0
    boundary = np.asarray(pair.model.meshes[0].table.boundary)
    for k in range(50):
        phase = k / 50
        if min(abs(phase - b) for b in boundary) < 0.03:
            continue  # the engagement's own ringing, and friction that turns at the pitch point
        segment = int(np.searchsorted(boundary, phase, side="right") - 1)
        fronts = pair.cycle.front_pairs
        only = pair.cycle._replace(in_contact=pair.cycle.in_contact * (np.asarray(pair.cycle.side) > 0))
        slots, expected = statics(_with(pair, only), phase, segment, [coefficient] * fronts)
        np.testing.assert_allclose(found["normal_load"][k, slots], expected, rtol=5e-4)
        checked += 1
    assert checked > 30


def _with(pair: Any, cycle: Any) -> Any:
    """The pair with its driving flanks alone in contact."""
    return type("Pair", (), {"cycle": cycle, "model": pair.model})


def test_its_modes_are_those_of_a_spring_along_the_line_of_action(prepared: Any):
    """Planet held in rotation, both on bearings; the mean of k ε_α pairs between them, by vectors."""
    stiffness = 7.5e9
    pair = prepared("ring-36-93", **{"mesh.compliance": "constant", "mesh.stiffness": f"{stiffness} N/m"})
    angle = float(pair.cycle.pressure_angle.flat[0])
    along = np.array([math.cos(angle), math.sin(angle)])
    # x_p, y_p, x_g, y_g and the ring's rotation, clockwise, by which its flank moves along the line of action
    reach = along, -along, [-0.9176112]
    row = np.concatenate(reach)
    (mass_1, _), (mass_2, inertia) = pair.tables[0].masses
    mass = np.diag([mass_1, mass_1, mass_2, mass_2, inertia])
    bearings = np.diag([*4 * [2e9], 0.0])
    matrix = bearings + stiffness * float(pair.cycle.contact_ratio) * np.outer(row, row)
    squares = np.linalg.eigvals(np.linalg.solve(mass, matrix)).real
    expected = np.sort(np.sqrt(np.maximum(squares, 0.0))) / (2 * math.pi)
    found = np.sort(natural_frequencies(pair.model, [pair.cycle]))
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-2)
