"""The right-hand side against Newton's and Euler's laws, written out with vectors for a few states.

Loads by trying every set of touching pairs, contact velocities from those of the bodies, the load torque by
SciPy's spline; masses, springs and dampers all different, so that none can take another's place.
"""

import math
from itertools import product

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from tests.support.states import (
    LAG,
    PAIR_WITH_MOTOR,
    TURN_G,
    TURN_M,
    X_G,
    X_P,
    Y_G,
    Y_P,
    altered,
    random_place,
    random_state,
    with_motor,
)
from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.energy import stored_energy
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import DRIVE_SPEED, DRIVE_TORQUE, SLIDING_DYNAMIC, SLIDING_KINEMATIC
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.solve.right_hand_side import contacts_of

#: Masses and inertias of pinion and gear, springs and dampers of the bearings along x and y, the shaft.
MASS, INERTIA = np.array([1.3, 4.1]), np.array([1.1e-3, 0.017])
STIFFNESS = np.array([[1.1e8, 2.3e8], [3.7e8, 4.9e8]])
DAMPING = np.array([[510.0, 730.0], [970.0, 1300.0]])
MOTOR = {"inertia": 0.02, "stiffness": 3e3, "damping": 0.4}
LOAD, LOAD_DAMPING = 420.0, 1.7
OPERATION = {
    "drive_torque": 260.0,
    "speed_regulation": 0.7,
    "load_times": np.array([0.0, 0.03, 0.07, 0.2]),
    "load_torques": np.array([0.0, 25.0, -40.0, 10.0]),
    "load_slopes": np.array([100.0, -900.0, 300.0, 0.0]),
    "load_amplitudes": np.array([30.0, 11.0]),
    "load_frequencies": np.array([70.0, 333.0]),
    "load_phases": np.array([0.4, -1.1]),
}
MU = 0.08


@pytest.fixture(scope="module")
def model(prepared):
    made = prepared(
        "crc-23-47", **{"friction.law": "coulomb", "friction.coefficient": MU, "mesh.backlash": "12 um"}
    )
    bearings = [[[*pair, 0.0] for pair in each] for each in (STIFFNESS, DAMPING)]
    return altered(
        made.model,
        bodies={
            "mass": MASS,
            "inertia": INERTIA,
            "load": np.array([0.0, LOAD]),
            "load_damping": np.array([0.0, LOAD_DAMPING]),
        },
        links=dict(zip(("stiffness", "damping"), map(np.array, bearings), strict=True)),
        operation=OPERATION,
    )


def at(table, segment, phase):
    """Channels, coupling matrix and their derivatives by the pinion's angle, from the cell's cubics."""
    start, end = table.boundary[segment : segment + 2]
    cells = table.channel.shape[1]
    place = (phase - start) / (end - start) * cells
    cell = int(place)
    u = place - cell
    powers, slopes = np.array([1, u, u * u, u**3]), np.array([0, 1, 2 * u, 3 * u * u])
    slopes = slopes * cells / (end - start) / table.pitch_angle
    values, rates = table.channel[segment, cell] @ powers, table.channel[segment, cell] @ slopes
    lower, lower_rate = table.coupling[segment, cell] @ powers, table.coupling[segment, cell] @ slopes
    return (
        dict(zip(CHANNELS, values.T, strict=False)),
        dict(zip(CHANNELS, rates.T, strict=False)),
        *(np.tril(triangle, -1) + np.tril(triangle, -1).T for triangle in (lower, lower_rate)),
    )


def expected(model, y, phase, segment, cycle):
    """Rates of all states per second, and the powers, of a classical model with its drive."""
    m, mesh, half = model.operation, model.meshes[0], model.layout.half
    slip_at, vx_p, vx_g, spin_g = (half + place for place in (LAG, X_P, X_G, TURN_G))
    t = mesh.table
    channels, rates, coupling, coupling_rate = at(t, segment, phase)
    rp, rg = mesh.driver_radius, mesh.driven_radius
    speed = m.nominal_speed + y[slip_at]
    gear_speed = rp / rg * speed + y[spin_g]
    turning, turning_rate = -rg * y[TURN_G], -rg * y[spin_g]
    pinion_centre, gear_centre = np.array([0.0, -rp]), np.array([0.0, rg])
    v_p, v_g = y[vx_p : vx_p + 2], y[vx_g : vx_g + 2]
    on = np.flatnonzero(t.in_contact[segment] > 0)
    normal, point, approach, rate, change = {}, {}, {}, {}, {}
    for i in on:
        side, cosine, sine = t.side[i], channels["cosine"][i], channels["sine"][i]
        normal[i] = np.array([side * cosine, sine])
        point[i] = channels["signed_distance"][i] * np.array([side * cosine, sine])
        given = np.array([turning + y[X_P] - y[X_G], y[Y_P] - y[Y_G]])
        moving = np.array([turning_rate, 0.0]) + v_p - v_g
        turned = np.array([side * rates["cosine"][i], rates["sine"][i]])
        change[i] = turned @ given - rates["gap"][i]
        approach[i] = normal[i] @ given - channels["gap"][i]
        rate[i] = normal[i] @ moving + change[i] * speed
    elastic = loads_of(on, approach, channels["compliance"], coupling)
    force, pinion_moment, gear_moment, friction, damping, sliding_power, parametric = (
        np.zeros(2),
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    )
    for i in on:
        side = t.side[i]
        # a pair that hardly touches is the business of the smoothing
        damped = mesh.damping / math.sqrt(channels["compliance"][i]) * rate[i] if elastic[i] > 0 else 0.0
        load = max(elastic[i] + damped, 0.0)
        tangent = np.array([normal[i][1], -normal[i][0]])
        # clockwise pinion, counter-clockwise gear
        arm_p, arm_g = point[i] - pinion_centre, point[i] - gear_centre
        turn_p, turn_g = np.array([arm_p[1], -arm_p[0]]), np.array([-arm_g[1], arm_g[0]])
        relative = tangent @ (v_p + speed * turn_p - v_g - gear_speed * turn_g)
        nominal = tangent @ (speed * turn_p - rp / rg * speed * turn_g)
        yield_in = relative if model.options.sliding == SLIDING_DYNAMIC else nominal
        width = (1 + rp / rg) * m.reversal_width * m.nominal_speed
        share = min(max(yield_in / width, -1.0), 1.0)
        size = MU * load * 0.5 * (3 * share - share**3)
        on_pinion = -load * normal[i] - size * tangent  # friction opposes the pinion's sliding
        force += on_pinion
        pinion_moment += -(arm_p[1] * on_pinion[0] - arm_p[0] * on_pinion[1])
        gear_moment += arm_g[1] * on_pinion[0] - arm_g[0] * on_pinion[1]
        friction += size * relative
        sliding_power += size * nominal
        damping += (load - elastic[i]) * rate[i]
        parametric += load * change[i] - 0.5 * elastic[i] ** 2 * rates["compliance"][i]
        parametric -= 0.5 * sum(coupling_rate[i, j] * elastic[i] * elastic[j] for j in on if j != i)
    time = (cycle + phase) * t.pitch_angle / m.nominal_speed + y[LAG]
    resisting = LOAD + LOAD_DAMPING * (gear_speed - rp / rg * m.nominal_speed)
    resisting += float(np.sum(m.load_amplitudes * np.sin(m.load_frequencies * time + m.load_phases)))
    resisting += float(CubicHermiteSpline(m.load_times, m.load_torques, m.load_slopes)(time))
    springs, dampers = STIFFNESS.ravel(), DAMPING.ravel()
    places, speeds = y[[X_P, Y_P, X_G, Y_G]], np.concatenate([v_p, v_g])
    pull = np.concatenate([force, -force]) - springs * places - dampers * speeds
    damping += float(dampers @ speeds**2)
    motor = given = m.drive_torque - m.speed_regulation * y[slip_at]
    power_in = motor * speed
    behind_shaft = model.layout == PAIR_WITH_MOTOR
    if behind_shaft:
        twist, twist_rate = y[TURN_M], y[half + TURN_M]
        motor = m.drive_torque - m.speed_regulation * (y[slip_at] + twist_rate)
        given = MOTOR["stiffness"] * twist + MOTOR["damping"] * twist_rate
        damping += MOTOR["damping"] * twist_rate**2
        power_in = motor * (speed + twist_rate)
    slip = (given - pinion_moment) / INERTIA[0]
    if model.options.drive == DRIVE_SPEED:
        motor, slip = pinion_moment, 0.0
        power_in = motor * speed
    gear = (gear_moment - resisting) / INERTIA[1]
    found = np.zeros(model.layout.states)
    found[[X_P, Y_P, X_G, Y_G]] = speeds
    found[[vx_p, vx_p + 1, vx_g, vx_g + 1]] = pull / np.repeat(MASS, 2)
    found[LAG], found[slip_at] = 1.0 - speed / m.nominal_speed, slip
    found[TURN_G], found[spin_g] = y[spin_g], gear - rp / rg * slip
    if behind_shaft:
        found[TURN_M], found[half + TURN_M] = twist_rate, (motor - given) / MOTOR["inertia"] - slip
    powers = (power_in, resisting * gear_speed, damping, parametric * speed, friction, sliding_power)
    found[2 * half :] = powers
    energy = 0.5 * (MASS @ [v_p @ v_p, v_g @ v_g] + INERTIA @ [speed**2, gear_speed**2])
    energy += 0.5 * (springs @ places**2 + sum(approach[i] * elastic[i] for i in on))
    if behind_shaft:
        energy += 0.5 * (MOTOR["inertia"] * (speed + twist_rate) ** 2 + MOTOR["stiffness"] * twist**2)
    return found, motor, energy


def loads_of(on, approach, compliance, coupling):
    """Loads of the pairs, each touching or apart."""
    for touching in product((True, False), repeat=len(on)):
        chosen = [i for i, contact in zip(on, touching, strict=True) if contact]
        matrix = np.array([[compliance[i] if i == j else coupling[i, j] for j in chosen] for i in chosen])
        found = dict.fromkeys(on, 0.0)
        if chosen:
            found |= dict(zip(chosen, np.linalg.solve(matrix, [approach[i] for i in chosen]), strict=True))
        apart = [approach[i] - sum(coupling[i, j] * found[j] for j in chosen) for i in on if i not in chosen]
        if all(found[i] >= 0 for i in chosen) and all(load <= 0 for load in apart):
            return found
    raise AssertionError("no set of pairs carries")


@pytest.mark.parametrize("drive", [DRIVE_SPEED, DRIVE_TORQUE, "shaft"])
@pytest.mark.parametrize("sliding", [SLIDING_KINEMATIC, SLIDING_DYNAMIC])
def test_every_rate_is_newtons(model, rng, drive, sliding):
    model = with_motor(model, **MOTOR) if drive == "shaft" else altered(model, options={"drive": drive})
    model = altered(model, options={"sliding": sliding, "sweeps": 20})
    width, table = model.operation.contact_width, model.meshes[0].table
    checked = 0
    while checked < 5:
        y = random_state(rng, model)
        phase, segment = random_place(rng, model.schedule)
        works, dy = contacts_of(model), {}
        powers = derivatives(phase, 3.0, segment, y, model, works, dy)
        (work,) = works
        on = np.flatnonzero(table.in_contact[segment] > 0)
        if any(abs(work[contact.EFFECTIVE_APPROACH, i]) < 10 * width for i in on):
            continue
        if sum(work[contact.ELASTIC_LOAD, i] > 0 for i in on) == 0:
            continue
        checked += 1
        rates, motor, energy = expected(model, y, phase, segment, 3.0)
        found = np.array([dy[i] for i in range(model.layout.states)])
        found /= table.pitch_angle / (model.operation.nominal_speed + y[model.layout.half + LAG])
        # the loads set in over a width
        np.testing.assert_allclose(found, rates, rtol=1e-5, atol=1e-9 * np.abs(rates).max())
        assert powers[5] == pytest.approx(motor, rel=1e-6)
        assert stored_energy(0.0, y, model, works) == pytest.approx(energy, rel=1e-5)
