"""Equations of helical pairs: projection rows against rigid bodies in space, mirrored hands, modes."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.helical_motion import EVEN, HELICAL, mirrored
from tests.support.plain_kernels import make_plain, plain
from tests.support.states import altered, random_state
from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.solve.initial import accelerations
from tribodyn.solve.march import jacobian
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import Place
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.solve.tolerances import state_scales
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.positions import moves_of
from tribodyn.train.structure import place_in_space, shift_of, turn_of

E_X, E_Y, E_Z = np.eye(3)


@pytest.fixture
def pair(prepared):
    return lambda **more: prepared("involute-23-47", **{**HELICAL, **more})


def row_by_hand(slot, work, mesh, layout, at):
    """∂δ_n by all coordinates, δ_n = n·(u_1 − u_2) with u = d + ψ × r, m per m or rad."""
    (axis, along, across, hand), places = at
    side, r = float(mesh.table.side[slot]), float(work[contact.DISTANCE, slot])
    radii = float(mesh.driver_radius), float(mesh.driven_radius)
    transverse = side * work[contact.COS, slot] * along + work[contact.SIN, slot] * across
    # the driver's tooth: a right-hand one goes counter-clockwise as z rises
    trace = E_Z + hand * float(mesh.table.pitch_slope) * np.cross(E_Z, across)
    normal = transverse - (transverse @ trace) * E_Z
    normal /= np.linalg.norm(normal)
    z = float(work[contact.AXIAL_PLACE, slot])
    late = float(np.asarray(mesh.table.face_position)[slot % len(mesh.table.face_position)])
    # late: the tooth is behind; the middle slice touches beside the middle while it enters or leaves
    assert np.sign(-trace @ along * z) == np.sign(late) or late == 0.0
    row = np.zeros(layout.half)
    for body, (sign, centre) in enumerate(((1.0, radii[0]), (-1.0, -radii[1]))):
        arm = centre * across + r * transverse + (places[body] + z) * E_Z
        moved = E_X, E_Y, E_Z, np.cross(E_X, arm), np.cross(E_Y, arm)
        for direction, by in enumerate(moved):
            row[place_in_space(body, direction, layout)] = sign * (normal @ by)
    row[turn_of(1, layout)] = -(normal @ np.cross(-axis, arm))
    return row


@pytest.mark.parametrize("hand", [1.0, -1.0], ids=["right", "left"])
@pytest.mark.parametrize("clockwise", [True, False])
@pytest.mark.parametrize("angle", [0.0, 1.1, -2.3])
def test_approach_and_forces_are_those_of_rigid_bodies_in_space(pair, rng, angle, clockwise, hand):
    """The rows by virtual displacements; forces and moments on both bodies are their transpose."""
    base = pair(**{"mesh.backlash": "12 um"}).model
    across = np.array([np.cos(angle), np.sin(angle), 0.0])
    axis = -E_Z if clockwise else E_Z
    along = np.cross(axis, across)
    places = tuple(rng.uniform(-0.02, 0.02, 2))
    radii = float(base.meshes[0].driver_radius), float(base.meshes[0].driven_radius)
    names = zip(("along_x", "along_y", "across_x", "across_y"), [*along[:2], *across[:2]], strict=True)
    frame = (tuple(along[:2]), tuple(across[:2]))
    mesh = {**dict(names), "hand": hand if clockwise else -hand, "moves": moves_of(frame, radii, places)}
    springs = {"own", "coupled", "bearings"} ^ set(base.links._fields)
    free = {name: 0.0 * getattr(base.links, name) for name in springs}
    model = altered(base, mesh=mesh, links=free, bodies={"load": np.zeros(2)})
    layout, part, bodies = model.layout, model.meshes[0], model.bodies
    y = random_state(rng, model)
    y[layout.half :] = 0.0
    y[turn_of(1, layout)] = -80e-6 / radii[1]
    (work,), rates = contacts_of(model), {}
    derivatives(0.37, 0.0, 0, y, model, [work], rates)
    rate = model.operation.pitch_angle / model.operation.nominal_speed
    inertia = np.zeros(layout.half)
    for body in range(2):
        inertia[shift_of(body) : shift_of(body) + 2] = bodies.mass[body]
        inertia[layout.tilts + 3 * body] = bodies.mass[body]
        inertia[layout.tilts + 3 * body + 1 : layout.tilts + 3 * body + 3] = bodies.tilting[body]
    inertia[turn_of(1, layout)] = bodies.inertia[1]
    forces = inertia * np.array([rates[layout.half + i] for i in range(layout.half)]) / rate
    expected, sides = np.zeros(layout.half), set()
    for slot in range(part.table.side.shape[0]):
        if work[contact.PRESENT, slot] == 0.0:
            continue
        row = row_by_hand(slot, work, part, layout, ((axis, along, across, hand), places))
        assert work[contact.TRANSMISSION_ERROR, slot] == pytest.approx(row @ y[: layout.half], abs=1e-17)
        expected -= row * work[contact.NORMAL_LOAD, slot]
        sides.add(float(part.table.side[slot]))
    assert sides == {1.0, -1.0}
    np.testing.assert_allclose(forces, expected, rtol=1e-11, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("source", ["speed", "torque"])
def test_every_column_of_the_jacobian_is_that_of_central_differences(pair, monkeypatch, rng, source):
    model = pair(**{"operating.source": source, "mesh.formulation": "energy-consistent"}).model
    make_plain(monkeypatch, jacobian)
    monkeypatch.setattr(jacobian, "rhs", derivatives)
    layout = model.layout
    states, mechanical, slip = layout.states, layout.mechanical, layout.half + layout.lag
    for phase in (0.13, 0.77):
        y = random_state(rng, model, float(model.operation.nominal_speed))
        y[turn_of(1, layout)] = -60e-6 / model.meshes[0].driven_radius
        f, work = accelerations(y, phase, 0, model), contacts_of(model)
        derivatives(phase, 0.0, 0, y, model, work, {})
        scale = state_scales(model, y)
        found = Differences(np.zeros(states), np.full((states, mechanical), np.nan), np.zeros(states))
        plain(differentiate)(Place(phase, 0.0, 0, 1.0), y, f, scale, model, work, found)
        step = 1e-5 * scale[:mechanical]
        step[slip] = min(step[slip], 1e-5 * float(model.operation.nominal_speed))
        shift = np.zeros((mechanical, states))
        shift[:, :mechanical] = np.diag(step)
        up, down = (accelerations(y + sign * shift, phase, 0, model) for sign in (1, -1))
        expected = (up - down).T / (2.0 * step)
        unknown = {layout.lag} | ({slip} if source == "speed" else set())
        for j in set(range(mechanical)) - unknown:
            tolerance = 3e-6 * np.abs(expected[:, j]).max()
            np.testing.assert_allclose(found.jacobian[:, j], expected[:, j], atol=tolerance, err_msg=j)


def test_mirrored_hands_have_mirrored_accelerations(pair, rng):
    right, left = (pair(**{"drive.hand": hand}).model for hand in ("right", "left"))
    for _ in range(10):
        y, phase = random_state(rng, right), rng.uniform()
        ours = accelerations(y, phase, 0, right)
        factors = mirrored(right)
        np.testing.assert_allclose(
            factors * accelerations(factors * y, phase, 0, left), ours, atol=1e-13 * np.abs(ours).max()
        )


def test_slices_of_a_spur_pair_are_the_pair(rng):
    """Right-hand sides at states without z and tilts."""
    case = load_scenario("involute-23-47", EVEN)
    spur = prepare(case).model
    cut = prepare(case.with_pair(mesh=replace(case.pair.mesh, slices=7))).model
    thin, wide = spur.layout, cut.layout
    same = [*range(thin.half), *(wide.half + i for i in range(thin.half))]
    same += range(wide.mechanical, wide.states)
    for interval in (0, 1):
        phase = 0.3 if interval == 0 else 0.8
        y, z = random_state(rng, spur), np.zeros(wide.states)
        z[same] = y
        one, many = accelerations(y, phase, interval, spur), accelerations(z, phase, interval, cut)
        np.testing.assert_allclose(many[same], one, rtol=1e-11, atol=1e-12 * np.abs(one).max())


def test_modes_are_those_of_hand_assembled_matrices(pair):
    """Mean over the mesh cycle of share × stiffness × rows of an involute's own geometry."""
    case, slices, stiffness = pair(), 5, 4e8
    model, layout = case.model, case.model.layout
    module, beta, normal_angle = 3e-3, np.radians(20.0), np.radians(20.0)
    angle = np.arctan(np.tan(normal_angle) / np.cos(beta))
    base = np.arcsin(np.sin(beta) * np.cos(normal_angle))
    radii = [module / np.cos(beta) * teeth / 2.0 for teeth in (23, 47)]
    ends = [
        np.sqrt((r + module) ** 2 - (r * np.cos(angle)) ** 2) - r * np.sin(angle) for r in radii
    ]  # of the path, beyond the pitch point
    pitch = np.pi * module / np.cos(beta) * np.cos(angle)
    drive = case.case.pair.drive
    width = float(min(side.face_width for side in (drive.pinion, drive.gear)))
    normal = np.array([np.cos(angle) * np.cos(base), np.sin(angle) * np.cos(base), np.sin(base)])
    half = width / slices * np.tan(base) / 2.0
    matrix, phases = np.zeros((11, 11)), (np.arange(1500) + 0.5) / 1500
    for pair_number in range(-4, 5):
        for z in (np.arange(slices) - (slices - 1) / 2) * width / slices:
            at = -ends[1] + (phases + pair_number) * pitch - z * np.tan(base)
            low, high = (np.clip(at + by, -ends[1], ends[0]) for by in (-half, half))
            share, middle = (high - low) / (2.0 * half), (low + high) / 2.0
            # where the part touches
            beside = np.clip((at - middle) / half, -1.0, 1.0) * width / slices / 2.0
            rows = np.zeros((len(phases), 11))
            for body, (sign, centre) in enumerate(((1.0, radii[0]), (-1.0, -radii[1]))):
                arm = np.stack([middle * np.cos(angle), middle * np.sin(angle) + centre, z + beside], axis=1)
                moved = (np.broadcast_to(e, arm.shape) for e in (E_X, E_Y, E_Z))
                columns = [*moved, np.cross(E_X, arm), np.cross(E_Y, arm)]
                rows[:, 5 * body : 5 * body + 5] = sign * np.stack([c @ normal for c in columns], axis=1)
            rows[:, 10] = -(np.cross(E_Z, arm) @ normal)
            matrix += np.einsum("p,pi,pj->ij", share, rows, rows) * stiffness / slices / len(phases)
    masses = []
    for body in range(2):
        matrix[5 * body : 5 * body + 5, 5 * body : 5 * body + 5] += model.links.stiffness_in_space[body]
        masses += [model.bodies.mass[body]] * 3 + [model.bodies.tilting[body]] * 2
    root = 1.0 / np.sqrt([*masses, model.bodies.inertia[1]])
    expected = np.sqrt(np.linalg.eigvalsh(root[:, None] * matrix * root)) / (2.0 * np.pi)
    assert layout.half == len(expected) + 1
    np.testing.assert_allclose(natural_frequencies(model, [case.cycle]), expected, rtol=1e-5)
