"""The right-hand side of an idler against Lagrange's equations of involutes that unwind, with friction."""

from functools import lru_cache

import jax
import numpy as np
import pytest
from scipy.optimize import brentq

from tests.support import idler_lagrangian as lagrange
from tests.support.idler_lagrangian import Idler
from tests.support.spring_trains import Gears, in_global_frame, scenario_of, spring_model
from tests.support.states import random_place, random_state
from tests.support.train_matrices import Bearing, Body, Mesh, Train
from tests.support.two_stage_histories import DAMPING_RATIO, damping_of
from tribodyn.dynamics.equations import derivatives
from tribodyn.solve.initial import accelerations
from tribodyn.solve.right_hand_side import contacts_of

TEETH, SHIFTS, MODULE, ALPHA = (24, 37, 41), ((0.25, 0.1), (0.1, -0.15)), 3e-3, np.radians(20.0)
INERTIA, MASS = (1.1e-3, 6.2e-3, 0.017), (1.3, 2.9, 4.1)
STIFFNESS, COEFFICIENT = (3.1e8, 4.3e8), 0.07
#: Stiffness and damping along x and y.
BEARINGS = (
    np.array([[1.1e8, 2.3e8], [3.7e8, 4.9e8], [2.2e8, 6.1e8]]),
    np.array([[510.0, 730.0], [970.0, 1300.0], [840.0, 620.0]]),
)
SPEED, TORQUE = 150.0, 310.0
PLACES = [(0.7, -1.1, 1), (2.9, 2.2, -1), (-3.1, 3.1, 1), (-1.0, -1.0, -1)]
#: Loads (N) from which on no smoothing of contact acts, and distances (m) at which no vibration turns the
#: sliding round.
PRESSED, BESIDE = 500.0, 1.5e-3


def operating_angle(mesh):
    """inv α_w = inv α + 2 tan α (x_1 + x_2)/(z_1 + z_2), without backlash."""
    teeth = TEETH[mesh] + TEETH[mesh + 1]
    involute = np.tan(ALPHA) - ALPHA + 2.0 * np.tan(ALPHA) * sum(SHIFTS[mesh]) / teeth
    return brentq(lambda angle: np.tan(angle) - angle - involute, 0.1, 0.8, xtol=1e-15)


def idler(first, second, sense):
    """What Lagrange's side is told: nothing of it comes from the package."""
    base = np.array([[0.5 * MODULE * z * np.cos(ALPHA) for z in TEETH[m : m + 2]] for m in range(2)])
    angles = np.array([operating_angle(m) for m in range(2)])
    radii = base / np.cos(angles)[:, None]
    damping = [damping_of(STIFFNESS[m], (INERTIA[m], INERTIA[m + 1]), tuple(radii[m])) for m in range(2)]
    return Idler(
        mass=np.array(MASS),
        inertia=np.array(INERTIA),
        bearing_stiffness=BEARINGS[0],
        bearing_damping=BEARINGS[1],
        torque=np.array([0.0, 0.0, -sense * TORQUE]),
        base_radii=base,
        pressure_angle=angles,
        azimuth=np.array([first, second]),
        sense=float(sense),
        stiffness=np.array(STIFFNESS),
        damping=np.array(damping),
        distance=np.zeros(2),
        friction=np.zeros(2),
    )


@lru_cache
def package(first, second, sense, source):
    given = idler(first, second, sense)
    radii = given.base_radii / np.cos(given.pressure_angle)[:, None]
    meshes = tuple(
        Mesh(lagrange.ENDS[m], tuple(radii[m]), given.azimuth[m], ALPHA, sense * (-1) ** m, STIFFNESS[m])
        for m in range(2)
    )
    train = Train(
        tuple(Body(*both) for both in zip(MASS, INERTIA, strict=True)),
        tuple(Bearing(i, tuple(BEARINGS[0][i]), tuple(BEARINGS[1][i])) for i in range(3)),
        meshes=meshes,
    )
    operating = {"input_speed": f"{SPEED} rad/s", "output_torque": f"{TORQUE} N*m", "source": source}
    friction = {"law": "coulomb", "coefficient": COEFFICIENT, "sliding": "dynamic"}
    gears = [Gears((TEETH[m], TEETH[m + 1]), MODULE) for m in range(2)]
    scenario = scenario_of(train, gears, DAMPING_RATIO, operating, friction)
    for mesh, shifts in zip(scenario["mesh"], SHIFTS, strict=True):
        mesh["profile_shift"] = list(shifts)
    return spring_model(scenario)


@jax.jit
def solved(q, v, given):
    """Lagrange's accelerations with Coulomb's friction against the sliding of the uniform rotation."""
    loads = lagrange.mesh_forces(q, v, given)
    slide = jax.numpy.stack([lagrange.sliding(given, m, SPEED) for m in range(2)])
    given = given._replace(friction=-COEFFICIENT * loads * jax.numpy.sign(slide))
    springs = lagrange.mesh_forces(q, 0.0 * v, given)
    return lagrange.accelerations(q, v, given), jax.numpy.minimum(loads, springs)


def distances(prepared, phase, interval):
    """Of the newest pair of either mesh from the pitch point: base radius times the driver's angle."""
    schedule, found = prepared.model.schedule, []
    for m, made in enumerate(prepared.tables):
        own = (schedule.offset[0, m] + phase) % 1.0  # the meshes of an idler have one rate
        assert own == pytest.approx(schedule.rate[m] * phase + schedule.offset[interval, m], abs=1e-12)
        roll = float(made.cycle.roll_start) + own * 2.0 * np.pi / TEETH[m]
        found.append(0.5 * MODULE * TEETH[m] * np.cos(ALPHA) * roll)
    return np.array(found)


@pytest.mark.parametrize("source", ["speed", "torque"])
@pytest.mark.parametrize("place", PLACES)
def test_accelerations_are_lagranges(place, source):
    """All coordinates, at random states with both meshes loaded; the held driver has none."""
    rng, prepared, given = np.random.default_rng(29), package(*place, source), idler(*place)
    model, senses = prepared.model, np.array(lagrange.senses(given))
    layout, checked = model.layout, 0
    for _ in range(60):
        phase, interval = random_place(rng, model.schedule)
        y = random_state(rng, model, SPEED)
        if source == "speed":
            y[layout.half + layout.lag] = 0.0
        slip = y[layout.half + layout.lag]
        ratio = np.asarray(model.bodies.ratio)
        seconds = model.operation.pitch_angle / (model.operation.nominal_speed + slip)
        rates = accelerations(y, phase, interval, model)
        own = np.zeros(layout.states)
        own[: layout.half] = rates[layout.half : layout.mechanical] / seconds
        reference = own[layout.lag]
        q, v, found = (
            in_global_frame(states[None], prepared, rates=of_rates).reshape(3, 3)
            for states, of_rates in ((y, False), (y, True), (own, False))
        )
        v[:, 2] += senses * ratio * slip
        found[:, 2] += senses * ratio * reference
        drive = derivatives(phase, 0.0, interval, y, model, contacts_of(model), {})[-1]
        torque = given.torque + np.array([senses[0] * drive, 0.0, 0.0])
        distance = distances(prepared, phase, interval)
        expected, pressed = solved(q, v, given._replace(torque=torque, distance=distance))
        if np.min(pressed) < PRESSED or np.min(np.abs(distance)) < BESIDE:
            continue
        if source == "speed":
            assert found[0, 2] == 0.0
        scale = np.max(np.abs(expected), axis=0)
        np.testing.assert_allclose(found / scale, np.asarray(expected) / scale, rtol=0.0, atol=1e-10)
        checked += 1
    assert checked > 8
