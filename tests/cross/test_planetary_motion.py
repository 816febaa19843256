"""Planetary sets of constant mesh stiffness: right-hand side, its derivative, equilibrium, load shares."""

import numpy as np
import pytest

from tests.support.plain_kernels import interpreted
from tests.support.planetary_springs import (
    CARRIER,
    RING,
    SUN,
    Member,
    PlanetarySet,
    planetary_springs,
)
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.states import random_place, random_state
from tribodyn.dynamics.approach import NORMAL_LOAD
from tribodyn.dynamics.energy import stored_energy
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.modes import modes
from tribodyn.dynamics.parameters import DRIVE_SPEED, DRIVE_TORQUE, with_shared_code
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.link_jacobian import SHARE
from tribodyn.solve.march.marching import Place
from tribodyn.solve.right_hand_side import contacts_of, rhs, work_array
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.train.layout import displacements, velocities, work_of
from tribodyn.train.structure import (
    DAMPING,
    IN,
    OUT,
    PARAMETRIC,
    shift_of,
    turn_of,
)

TEETH, MODULE, ALPHA = (27, 35, 97), 3e-3, np.radians(24.6)
RADII = [MODULE * teeth / 2 for teeth in TEETH]
LOAD = 900.0  # N m on the carrier


def a_set(planets, pin_offsets=()):
    return PlanetarySet(
        Member(0.4, 0.39 * RADII[0] ** 2, 1e8),
        Member(2.35, 3.0 * RADII[2] ** 2, 1e8),
        Member(5.43, 6.29 * (RADII[0] + RADII[1]) ** 2, 1e8),
        Member(0.66, 0.61 * RADII[1] ** 2, 1e8),
        tuple(2.0 * np.pi * np.arange(planets) / planets),
        TEETH,
        MODULE,
        ALPHA,
        (5e8, 4e8),
        1e9 * RADII[2] ** 2,
        0.05,
        pin_offsets,
    )


def test_every_compiler_makes_the_same_of_a_planetary_set(rng):
    offsets = ((3e-6, 5e-6), (0.0, 0.0), (-2e-6, 1e-6))
    model, _ = planetary_springs(a_set(3, offsets), DRIVE_TORQUE, torque=LOAD, turning=True)
    assert_right_hand_sides_agree(at_several_conditions(model), rng, rtol=1e-11)


@pytest.mark.parametrize("drive", [DRIVE_SPEED, DRIVE_TORQUE])
def test_jacobian_is_the_derivative_of_the_right_hand_side(rng, drive):
    """Against central differences, over random states: levers, offsets, a held ring, a negative radius."""
    model, _ = planetary_springs(a_set(3, ((3e-6, 5e-6),) * 3), drive, 300.0, LOAD, turning=True)
    native = with_shared_code(model)
    layout, states = model.layout, model.layout.states
    work, scale = work_array(model), tolerances_from(model, np.zeros(states), 1.0, 1).atol
    still = [layout.half + layout.lag] if drive == DRIVE_SPEED else []
    columns = [i for i in range(layout.mechanical) if i not in still]
    steps = np.diag(1e-6 * scale)[columns]
    for _ in range(4):
        y = random_state(rng, model)
        y[still] = 0.0
        phase, interval = random_place(rng, model.schedule)
        f, trial, slope, jacobian = (*np.empty((3, states)), np.empty((states, states)))
        rhs(phase, 0.0, interval, y, native, work, f)
        interpreted(differentiate, rhs)(
            Place(phase, 0.0, interval, 1.0), y, f, scale, native, work, Differences(trial, jacobian, slope)
        )
        up, down = (accelerations(y + sign * steps, phase, interval, model) for sign in (1, -1))
        exact = (up - down).T / (2 * steps.sum(axis=1))
        size = np.abs(exact * scale[columns]).max(axis=1, keepdims=True)
        # a few last bits over the package's differences: work in over the slip does not change at all
        rounding = 4.0 * np.finfo(float).eps / SHARE * np.abs(f)[:, None]
        error = np.abs(jacobian[:, columns] - exact) * scale[columns]
        assert np.all(error <= 1e-4 * size + rounding + 1e-12)


def mesh_loads(model, state):
    """Normal load of every mesh, N."""
    work = contacts_of(model)
    derivatives(0.3, 0.0, 0, state, model, work, {})
    count = model.meshes[0].table.side.shape[0]
    return np.array([sum(float(each.get((NORMAL_LOAD, i), 0.0)) for i in range(count)) for each in work])


@pytest.mark.parametrize("planets", [3, 4, 5])
def test_equal_planets_share_the_load(planets):
    """Equally, and as torque over the radii has it; the ring's support bears what sun and carrier leave."""
    model, _ = planetary_springs(a_set(planets), DRIVE_SPEED, torque=LOAD)
    state = static_equilibrium(model)
    tangential = LOAD / (2.0 * (RADII[0] + RADII[1])) / planets
    np.testing.assert_allclose(mesh_loads(model, state), tangential / np.cos(ALPHA), rtol=1e-6)
    layout = model.layout
    held = float(model.links.stiffness[RING, 2]) * state[turn_of(RING, layout)]
    sun = LOAD * TEETH[0] / (TEETH[0] + TEETH[2])
    assert abs(held) == pytest.approx(LOAD - sun, rel=1e-6)
    still = [state[shift_of(body) : shift_of(body) + 2] for body in (SUN, RING, CARRIER)]
    np.testing.assert_allclose(still, 0.0, atol=1e-12)


@pytest.mark.parametrize("drive", [DRIVE_SPEED, DRIVE_TORQUE])
def test_motions_are_those_of_the_modes(drive):
    """Natural frequencies of the equations of motion, differenced where it is loaded, without damping."""
    given = a_set(3)._replace(damping_ratio=0.0)
    model, cycles = planetary_springs(given, drive, torque=LOAD)
    layout = model.layout
    state = static_equilibrium(model)
    unknown, equation = displacements(layout), velocities(layout)
    rate = float(model.operation.pitch_angle) / float(model.operation.nominal_speed)
    steps = np.zeros((len(unknown), layout.states))
    steps[np.arange(len(unknown)), unknown] = 1e-7
    up, down = (accelerations(state + way * steps, 0.3, 0, model)[:, equation] for way in (1, -1))
    squares = np.linalg.eigvals(-(up - down).T / 2e-7 / rate)
    found = np.sort(np.sqrt(squares.real)) / (2.0 * np.pi)
    np.testing.assert_allclose(found, modes(model, cycles).frequency, rtol=1e-6)


def test_centrifugal_forces_press_planets_outwards():
    """All alike, as far as their pins let them: they roll so that no mesh is pressed by it."""
    given = a_set(3)
    still, turning = (
        static_equilibrium(planetary_springs(given, DRIVE_SPEED, 500.0, LOAD, turning=on)[0])
        for on in (False, True)
    )
    model, _ = planetary_springs(given, DRIVE_SPEED, 500.0, LOAD, turning=True)
    radius, speed = RADII[0] + RADII[1], float(model.bodies.frame_speed[3])
    outward, expected = [], []
    force = 0.66 * speed**2
    for body, angle in enumerate(given.angles, start=3):
        moved = (turning - still)[shift_of(body) : shift_of(body) + 2]
        outward.append(moved @ [np.cos(angle), np.sin(angle)])
        before = still[shift_of(body) : shift_of(body) + 2] @ [np.cos(angle), np.sin(angle)]
        expected.append(force * (radius + before) / (1e8 - force))
    np.testing.assert_allclose(outward, expected, rtol=1e-7)


@pytest.mark.parametrize(
    ("drive", "turning"), [(DRIVE_SPEED, False), (DRIVE_TORQUE, False), (DRIVE_SPEED, True)]
)
def test_energy_balances_over_a_load_step(drive, turning):
    """What the drive gives, less what the carrier passes on and damping takes, is stored; by two methods."""
    given = a_set(3, ((3e-6, 5e-6), (0.0, 0.0), (-2e-6, 1e-6)))
    before, after = (planetary_springs(given, drive, 400.0, load, turning)[0] for load in (LOAD, 1.3 * LOAD))
    start = static_equilibrium(before)
    ends = []
    for method in ("dopri5", "rodas4"):
        tolerances = tolerances_from(after, start, 1e-8, 10**6)
        result = make_integrator(method, after, 20, tolerances).integrate(start, 0, 6)
        assert result.status == Status.DONE
        ends.append(result.state)
        samples = result.samples
    layout = after.layout
    moving = displacements(layout)
    size = np.max(np.abs(ends[0][moving] - start[moving]))
    assert size > 1e-6
    np.testing.assert_allclose(ends[0][moving], ends[1][moving], rtol=0.0, atol=1e-5 * size)
    stored = []
    for state in (start, ends[0]):
        work = work_array(after)
        rhs(0.0, 0.0, 0, state, with_shared_code(after), work, np.empty(layout.states))
        stored.append(float(stored_energy(0.0, state, after, work)))
    work_in, work_out, damped, parametric = (
        float(ends[0][work_of(layout, which)]) for which in (IN, OUT, DAMPING, PARAMETRIC)
    )
    gained = work_in - work_out - damped + parametric
    assert damped > 2e-5 * work_in
    # with centrifugal forces less what displaced ones do not turn the carrier by, see `dynamics.loads`
    speed = float(after.bodies.frame_speed[3])
    moved = samples[:, [[9, 10], [12, 13], [15, 16]]].transpose(1, 2, 0)
    taken = np.asarray(after.links.lever)[3:, 1, :, None] * samples[:, turn_of(CARRIER, layout)]
    arms = after.bodies.place[3:, :, None] * (moved - taken)[:, ::-1]
    duration = 6.0 * float(after.operation.pitch_angle) / 400.0
    missing = 0.66 * speed**3 * float(np.mean(np.sum(arms[:, 0] - arms[:, 1], axis=0))) * duration
    assert gained + missing == pytest.approx(stored[1] - stored[0], abs=1e-8 * work_in + 0.02 * abs(missing))
