"""The right-hand side against Newton's and Euler's laws, written out with vectors for a few states.

Loads by trying every set of touching pairs, contact velocities from those of the bodies, the load torque by
SciPy's spline; masses, springs and dampers all different, so that none can take another's place.
"""

import math
from itertools import product

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from tests.support.states import random_place, random_state
from tribodyn.dynamics import contact_forces as contact
from tribodyn.dynamics import parameters as state
from tribodyn.dynamics.equations import derivatives, stored_energy
from tribodyn.mesh.cycle import CHANNELS

MECHANICS = {
    "pinion_mass": 1.3,
    "gear_mass": 4.1,
    "pinion_inertia": 1.1e-3,
    "gear_inertia": 0.017,
    "pinion_stiffness_x": 1.1e8,
    "pinion_stiffness_y": 2.3e8,
    "gear_stiffness_x": 3.7e8,
    "gear_stiffness_y": 4.9e8,
    "pinion_damping_x": 510.0,
    "pinion_damping_y": 730.0,
    "gear_damping_x": 970.0,
    "gear_damping_y": 1300.0,
    "drive_torque": 260.0,
    "speed_regulation": 0.7,
    "drive_inertia": 0.02,
    "shaft_stiffness": 3e3,
    "shaft_damping": 0.4,
    "load_torque": 420.0,
    "load_damping": 1.7,
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
    return made.model._replace(mechanics=made.model.mechanics._replace(**MECHANICS))


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
    m, t, s = model.mechanics, model.table, state
    channels, rates, coupling, coupling_rate = at(t, segment, phase)
    rp, rg = t.pinion_pitch_radius, t.gear_pitch_radius
    speed = m.nominal_speed + y[s.SLIP]
    gear_speed = (rp * speed - y[s.XI_RATE]) / rg
    pinion_centre, gear_centre = np.array([0.0, -rp]), np.array([0.0, rg])
    v_p, v_g = y[[s.VX_P, s.VY_P]], y[[s.VX_G, s.VY_G]]
    on = np.flatnonzero(t.in_contact[segment] > 0)
    normal, point, approach, rate, change = {}, {}, {}, {}, {}
    for i in on:
        side, cosine, sine = t.side[i], channels["cosine"][i], channels["sine"][i]
        normal[i] = np.array([side * cosine, sine])
        point[i] = channels["signed_distance"][i] * np.array([side * cosine, sine])
        given = np.array([y[s.XI] + y[s.X_P] - y[s.X_G], y[s.Y_P] - y[s.Y_G]])
        moving = np.array([y[s.XI_RATE] + y[s.VX_P] - y[s.VX_G], y[s.VY_P] - y[s.VY_G]])
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
        damped = m.mesh_damping / math.sqrt(channels["compliance"][i]) * rate[i] if elastic[i] > 0 else 0.0
        load = max(elastic[i] + damped, 0.0)
        tangent = side * np.array([-normal[i][1], normal[i][0]])
        # clockwise pinion, counter-clockwise gear
        arm_p, arm_g = point[i] - pinion_centre, point[i] - gear_centre
        nominal = (1 + rp / rg) * channels["signed_distance"][i] * side * speed
        surface_p = v_p + speed * np.array([arm_p[1], -arm_p[0]])
        surface_g = v_g + gear_speed * np.array([-arm_g[1], arm_g[0]])
        # friction on the pinion opposes its sliding: with the other sign of the tangent, the model's +t
        relative = -side * tangent @ (surface_p - surface_g)
        yield_in = relative if model.options.sliding == s.SLIDING_DYNAMIC else nominal
        width = (1 + rp / rg) * m.reversal_width * m.nominal_speed
        share = min(max(yield_in / width, -1.0), 1.0)
        size = MU * load * 0.5 * (3 * share - share**3)
        on_pinion = -load * normal[i] + size * side * tangent
        force += on_pinion
        pinion_moment += -(arm_p[1] * on_pinion[0] - arm_p[0] * on_pinion[1])
        gear_moment += arm_g[1] * on_pinion[0] - arm_g[0] * on_pinion[1]
        friction += size * relative
        sliding_power += size * nominal
        damping += (load - elastic[i]) * rate[i]
        parametric += load * change[i] - 0.5 * elastic[i] ** 2 * rates["compliance"][i]
        parametric -= 0.5 * sum(coupling_rate[i, j] * elastic[i] * elastic[j] for j in on if j != i)
    time = (cycle + phase) * t.pitch_angle / m.nominal_speed + y[s.LAG]
    resisting = m.load_torque + m.load_damping * (gear_speed - rp / rg * m.nominal_speed)
    resisting += float(np.sum(m.load_amplitudes * np.sin(m.load_frequencies * time + m.load_phases)))
    resisting += float(CubicHermiteSpline(m.load_times, m.load_torques, m.load_slopes)(time))
    springs = np.array([m.pinion_stiffness_x, m.pinion_stiffness_y, m.gear_stiffness_x, m.gear_stiffness_y])
    dampers = np.array([m.pinion_damping_x, m.pinion_damping_y, m.gear_damping_x, m.gear_damping_y])
    places, speeds = y[[s.X_P, s.Y_P, s.X_G, s.Y_G]], np.concatenate([v_p, v_g])
    pull = np.concatenate([force, -force]) - springs * places - dampers * speeds
    damping += float(dampers @ speeds**2)
    motor_slip, twist_rate, motor = 0.0, 0.0, m.drive_torque - m.speed_regulation * y[s.SLIP]
    power_in = motor * speed
    given = motor
    if model.options.drive == s.DRIVE_SHAFT:
        motor = m.drive_torque - m.speed_regulation * y[s.MOTOR_SLIP]
        twist_rate = y[s.MOTOR_SLIP] - y[s.SLIP]
        given = m.shaft_stiffness * y[s.TWIST] + m.shaft_damping * twist_rate
        motor_slip = (motor - given) / m.drive_inertia
        damping += m.shaft_damping * twist_rate**2
        power_in = motor * (m.nominal_speed + y[s.MOTOR_SLIP])
    slip = (given - pinion_moment) / m.pinion_inertia
    if model.options.drive == s.DRIVE_SPEED:
        motor, slip = pinion_moment, 0.0
        power_in = motor * speed
    gear = (gear_moment - resisting) / m.gear_inertia
    found = np.zeros(s.STATES)
    found[[s.X_P, s.Y_P, s.X_G, s.Y_G]] = speeds
    found[[s.VX_P, s.VY_P, s.VX_G, s.VY_G]] = pull / np.array([m.pinion_mass] * 2 + [m.gear_mass] * 2)
    found[s.LAG] = 1.0 - speed / m.nominal_speed
    found[s.XI], found[s.XI_RATE] = y[s.XI_RATE], rp * slip - rg * gear
    found[s.TWIST], found[s.SLIP], found[s.MOTOR_SLIP] = twist_rate, slip, motor_slip
    powers = (power_in, resisting * gear_speed, friction, damping, parametric * speed)
    found[[s.WORK_IN, s.WORK_OUT, s.WORK_FRICTION, s.WORK_DAMPING, s.WORK_PARAMETRIC]] = powers
    found[s.WORK_SLIDING] = sliding_power
    energy = 0.5 * (m.pinion_mass * v_p @ v_p + m.gear_mass * v_g @ v_g)
    energy += 0.5 * (m.pinion_inertia * speed**2 + m.gear_inertia * gear_speed**2 + springs @ places**2)
    energy += 0.5 * sum(approach[i] * elastic[i] for i in on)
    if model.options.drive == s.DRIVE_SHAFT:
        energy += 0.5 * m.drive_inertia * (m.nominal_speed + y[s.MOTOR_SLIP]) ** 2
        energy += 0.5 * m.shaft_stiffness * y[s.TWIST] ** 2
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


@pytest.mark.parametrize("drive", [state.DRIVE_SPEED, state.DRIVE_TORQUE, state.DRIVE_SHAFT])
@pytest.mark.parametrize("sliding", [state.SLIDING_KINEMATIC, state.SLIDING_DYNAMIC])
def test_every_rate_is_newtons(model, rng, drive, sliding):
    model = model._replace(options=model.options._replace(drive=drive, sliding=sliding, sweeps=20))
    width = model.mechanics.contact_width
    checked = 0
    while checked < 5:
        y = random_state(rng)
        phase, segment = random_place(rng, model.table.boundary)
        work, dy = {}, {}
        powers = derivatives(phase, 3.0, segment, y, model, work, dy)
        on = np.flatnonzero(model.table.in_contact[segment] > 0)
        if any(abs(work[contact.EFFECTIVE_APPROACH, i]) < 10 * width for i in on):
            continue
        if sum(work[contact.ELASTIC_LOAD, i] > 0 for i in on) == 0:
            continue
        checked += 1
        rates, motor, energy = expected(model, y, phase, segment, 3.0)
        found = np.array([dy[i] for i in range(state.STATES)])
        found /= model.table.pitch_angle / (model.mechanics.nominal_speed + y[state.SLIP])
        # the loads set in over a width
        np.testing.assert_allclose(found, rates, rtol=1e-5, atol=1e-9 * np.abs(rates).max())
        assert powers[5] == pytest.approx(motor, rel=1e-6)
        assert stored_energy(y, model, work) == pytest.approx(energy, rel=1e-5)
