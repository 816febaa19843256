import numpy as np
import pytest

from tests.support.states import (
    LAG,
    PAIR,
    SLIP,
    TURN_G,
    altered,
    random_place,
    random_state,
    with_motor,
)
from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.energy import engagement, stored_energy, strain_energy
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.loads import load_torque
from tribodyn.dynamics.mesh_motion import locate
from tribodyn.dynamics.parameters import (
    CLASSICAL,
    DRIVE_SPEED,
    DRIVE_TORQUE,
    ENERGY_CONSISTENT,
    SLIDING_DYNAMIC,
)
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.right_hand_side import contacts_of, engage
from tribodyn.train.layout import velocities
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.law import ActiveLaw

OVERRIDES = [
    {},
    {"friction.sliding": "dynamic"},
    {"mesh.hertz": "load-dependent"},
    {"friction.law": "coulomb", "film.law": "masjedi-khonsari", "friction.coefficient": 0.08},
    {"mesh.backlash": "12 um"},
]


@pytest.fixture(params=OVERRIDES, ids=["default", "dynamic", "hertz", "coulomb", "backlash"])
def model(request, prepared):
    return prepared("crc-23-47", **request.param).model


def evaluate(model, y, phase, interval):
    """Contacts of the mesh, rates, powers."""
    work, rates = contacts_of(model), {}
    powers = derivatives(phase, 3.0, interval, y, model, work, rates)
    return work[0], np.array([rates[i] for i in range(len(y))]), powers


def seconds_per_cycle(model, y):
    return model.operation.pitch_angle / (model.operation.nominal_speed + y[SLIP])


def test_friction_power_is_minus_mu_load_times_sliding(model, rng):
    """F_f ω_p (−L_p + w L_g) = −μ F_n |v_s| outside the width of reversal, in rigid rotation.

    The flanks' speeds differ by (1 + w) r ω_p; on Liu & Ni's path their product goes with sin α.
    """
    mesh, operation = model.meshes[0], model.operation
    side, ratio = mesh.table.side, mesh.driver_radius / mesh.driven_radius
    checked = 0
    for _ in range(80):
        y = random_state(rng, model)
        y[velocities(PAIR)] = 0.0
        work, _, _ = evaluate(model, y, *random_place(rng, model.schedule))
        for i in range(side.shape[0]):
            r, sine = work[contact.DISTANCE, i], work[contact.SIN, i]
            if abs(r) < 2 * operation.reversal_width:
                continue
            lever_p = r + mesh.driver_radius * sine
            lever_g = mesh.driven_radius * sine - r
            force = side[i] * work[contact.FRICTION_FORCE, i]
            speed = operation.nominal_speed + y[SLIP]
            power = force * speed * (-lever_p + ratio * lever_g)
            loss = work[contact.FRICTION_COEFFICIENT, i] * work[contact.NORMAL_LOAD, i]
            sliding = (1 + ratio) * r * speed
            assert power == pytest.approx(-loss * abs(sliding), rel=1e-10)
            fast, slow = (side[i] * work[row, i] for row in (contact.DRIVER_SPEED, contact.DRIVEN_SPEED))
            assert fast - slow == pytest.approx(sliding, rel=1e-10)
            product = (speed * mesh.driver_radius) ** 2 * np.sin(np.radians(22.81)) * sine
            assert fast * slow == pytest.approx(product, rel=1e-4)
            checked += loss > 0
    assert checked > 20


def test_friction_never_gives_energy_and_no_load_is_tensile(model, rng):
    """With the vibration's sliding, at every state; with the nominal sliding, on the nominal motion."""
    dynamic = model.options.sliding == SLIDING_DYNAMIC
    row = contact.RELATIVE_VELOCITY if dynamic else contact.SLIDING
    apart = loaded = 0
    for _ in range(200):
        work, _, _ = evaluate(model, random_state(rng, model), *random_place(rng, model.schedule))
        for i in range(model.meshes[0].table.side.shape[0]):
            assert work[contact.FRICTION_FORCE, i] * work[row, i] >= 0.0
            load = work[contact.NORMAL_LOAD, i]
            assert load >= 0.0
            if work[contact.EFFECTIVE_APPROACH, i] <= 0.0:
                assert load == 0.0
                apart += 1
            loaded += load > 0.0
    assert apart > 50
    assert loaded > 50


def test_mesh_damping_never_gives_energy(model, rng):
    """Nor where a pair barely touches."""
    light = 0
    for _ in range(300):
        y = 1e-3 * random_state(rng, model)
        work, _, _ = evaluate(model, y, *random_place(rng, model.schedule))
        for i in range(model.meshes[0].table.side.shape[0]):
            elastic, load = work[contact.ELASTIC_LOAD, i], work[contact.NORMAL_LOAD, i]
            assert (load - elastic) * work[contact.APPROACH_RATE, i] >= 0.0
            light += 0.0 < elastic < model.operation.contact_width * work[contact.STIFFNESS, i]
    assert light > 20


def test_every_quantity_of_a_contact_has_a_row_of_its_own():
    names = list(vars(contact))
    named = names[names.index("DISTANCE") : names.index("QUANTITIES")]
    # the couplings come last, a row for every slot
    assert [getattr(contact, name) for name in named] == list(range(contact.QUANTITIES + 1))


@pytest.mark.parametrize("overrides", [{}, {"mesh.backlash": "12 um"}], ids=["front", "backlash"])
def test_coupled_loads_solve_the_contact_problem(prepared, rng, overrides):
    """Against the search over all sets of loaded pairs, on the smooth contact law."""
    model = prepared("crc-23-47", **overrides).model
    t, width = model.meshes[0].table, model.operation.contact_width
    for _ in range(100):
        y = random_state(rng, model)
        phase, segment = random_place(rng, model.schedule)
        work, _, _ = evaluate(model, y, phase, segment)
        slots = [i for i in range(t.side.shape[0]) if t.in_contact[segment, i]]
        matrix = np.array([[work[contact.COUPLING + j, i] if j != i else 0.0 for j in slots] for i in slots])
        matrix += np.diag([work[contact.COMPLIANCE, i] for i in slots])
        approach = np.array([work[contact.APPROACH, i] for i in slots])
        if np.any(np.abs([work[contact.EFFECTIVE_APPROACH, i] for i in slots]) < 2 * width):
            continue  # inside the smoothing no set is exact
        found = None
        for mask in range(1 << len(slots)):
            on = [k for k in range(len(slots)) if mask >> k & 1]
            force = np.zeros(len(slots))
            force[on] = np.linalg.solve(matrix[np.ix_(on, on)], approach[on])
            free = approach - matrix @ force
            if np.all(force >= 0) and all(free[k] <= 1e-18 for k in range(len(slots)) if k not in on):
                found = force
        assert found is not None
        ours = [work[contact.ELASTIC_LOAD, i] for i in slots]
        np.testing.assert_allclose(ours, found, rtol=1e-9, atol=1e-4)


def _strain(model, y, phase, segment):
    return strain_energy(phase, segment, 0, 0, y, model, {})


@pytest.mark.parametrize("key", [{}, {"mesh.hertz": "load-dependent"}, {"mesh.backlash": "12 um"}])
def test_loads_and_parametric_torque_are_slopes_of_the_strain_energy(prepared, rng, key):
    """Below the contact width too, made wide enough to be resolved."""
    model = prepared("crc-23-47", **key).model
    model = altered(
        model,
        mesh={"damping": 0.0},
        operation={"contact_width": 20e-6},
        options={"sweeps": 12},  # the onset is not in the tabulated start
    )
    side, radius = model.meshes[0].table.side, model.meshes[0].driven_radius
    within = 0
    for _ in range(80):
        y = random_state(rng, model)
        y[velocities(PAIR)] = 0.0
        phase, segment = random_place(rng, model.schedule)
        work, _, powers = evaluate(model, y, phase, segment)
        loads = [work[contact.ELASTIC_LOAD, i] for i in range(side.shape[0])]
        free = [work[contact.EFFECTIVE_APPROACH, i] for i in range(len(loads)) if loads[i] > 0.0]
        within += any(0.0 < value < model.operation.contact_width for value in free)
        step = 1e-9
        up, down = y.copy(), y.copy()
        up[TURN_G] -= step / radius
        down[TURN_G] += step / radius
        slope = (_strain(model, up, phase, segment) - _strain(model, down, phase, segment)) / (2 * step)
        pull = sum(side[i] * load * work[contact.COS, i] for i, load in enumerate(loads) if load > 0.0)
        assert slope == pytest.approx(pull, rel=1e-5, abs=1e-4)
        turn = 1e-6  # stays in the interval
        ahead, behind = (_strain(model, y, phase + by, segment) for by in (turn, -turn))
        torque = (ahead - behind) / (2 * turn * model.operation.pitch_angle)
        speed = model.operation.nominal_speed + y[SLIP]
        assert powers[4] / speed == pytest.approx(torque, rel=1e-4, abs=1e-5)
    assert within >= 15


@pytest.mark.parametrize("formulation", [CLASSICAL, ENERGY_CONSISTENT])
@pytest.mark.parametrize("drive", [DRIVE_SPEED, DRIVE_TORQUE, "shaft"])
def test_instantaneous_powers_balance(model, rng, formulation, drive):
    """P_in + P_parametric − P_out − P_friction − P_damping = d(stored energy)/dt, along the derivative."""
    if drive == "shaft":
        model = with_motor(model, inertia=0.02, stiffness=3e3, damping=0.4)
    else:
        model = altered(model, options={"drive": drive})
    model = altered(model, operation={"speed_regulation": 0.3}, options={"formulation": formulation})
    slip = model.layout.half + LAG
    for _ in range(20):
        y = random_state(rng, model)
        if drive == DRIVE_SPEED:
            y[slip] = 0.0
        phase, segment = random_place(rng, model.schedule)
        _, dy, powers = evaluate(model, y, phase, segment)
        rate = model.operation.pitch_angle / (model.operation.nominal_speed + y[slip])

        def stored(shift, y=y, dy=dy, phase=phase, segment=segment):
            work = contacts_of(model)
            moved = y + shift * dy
            derivatives(phase + shift, 3.0, segment, moved, model, work, {})
            return stored_energy(0.0, moved, model, work)

        step = 2e-7
        change = (stored(step) - stored(-step)) / (2 * step) / rate
        balance = powers[0] + powers[4] - powers[1] - powers[2] - powers[3]
        scale = abs(powers[0]) + abs(powers[1]) + abs(powers[3]) + abs(change)
        assert balance == pytest.approx(change, abs=3e-6 * scale + 1e-3)


def test_a_state_jumps_where_a_pair_comes_or_goes_and_nowhere_else(prepared, rng):
    """Of the cycloid's three segments one begins at the pitch point, where no pair does."""
    model, jumps = prepared("cycloidal-23-47").model, []
    for segment in range(3):
        state = random_state(rng, model)
        state[TURN_G] = -4e-5 / model.meshes[0].driven_radius
        behind = state.copy()
        engage(segment, True, behind, model, contacts_of(model), behind)
        jumps.append(np.abs(behind - state).max())
    assert jumps[2] < 1e-9 < 1e-3 < min(jumps[:2])


@pytest.mark.parametrize("inertia", [0.02, 1e-9], ids=["heavy", "light"])
def test_engagement_keeps_the_energy_with_a_free_pinion(prepared, rng, inertia):
    """A light one comes to rest, and what it lacks is counted as parametric work."""
    model = prepared("crc-23-47").model
    model = altered(
        model,
        options={"formulation": ENERGY_CONSISTENT, "drive": DRIVE_TORQUE},
        bodies={"inertia": np.array([inertia, model.bodies.inertia[1]])},
    )
    stopped = 0
    y = random_state(rng, model)
    y[TURN_G] = -4e-5 / model.meshes[0].driven_radius
    boundary = model.meshes[0].table.boundary
    segments = len(boundary) - 1
    places = [(0, boundary[1], 1, boundary[1]), (segments - 1, 1.0, 0, 0.0)]
    for before, phase_before, after, phase_after in places:
        work = contacts_of(model)
        strain_energy(phase_before, before, before, 0, y, model, work[0])
        energy = stored_energy(0.0, y, model, work)
        slip, work_in, parametric = engagement(after, y, model, contacts_of(model))
        z = y.copy()
        engage(after, True, y, model, contacts_of(model), z)
        assert z[SLIP] == y[SLIP] + slip
        strain_energy(phase_after, after, after, 0, z, model, work[0])
        # only the pinion's speed jumps: the gear's does not
        assert stored_energy(0.0, z, model, work) == pytest.approx(energy + parametric, rel=1e-12)
        assert slip != 0.0
        assert work_in == 0.0
        assert parametric >= 0.0
        assert (parametric > 0.0) == (abs(model.operation.nominal_speed + z[SLIP]) < 1e-12)
        stopped += parametric > 0.0
    assert (stopped > 0) == (inertia < 1e-3)


def test_locate_stays_inside_the_given_segment(prepared):
    table = prepared("crc-23-47").model.meshes[0].table
    cells = table.channel.shape[1]
    for segment in range(2):
        start, end = table.boundary[segment], table.boundary[segment + 1]
        assert locate(float(start), segment, 0.0, 0.0, table)[:3] == (segment, 0, 0.0)
        there, cell, u, *_ = locate(float(end), segment, 0.0, 0.0, table)
        assert there == segment
        assert cell == cells - 1
        assert u == pytest.approx(1.0, abs=1e-8)


def test_friction_is_that_of_the_uneven_faces_line_load(prepared):
    model = prepared("crc-23-47", **{"friction.sliding": "kinematic"}).model
    mesh = model.meshes[0]
    channel = np.array(mesh.table.channel)
    channel[..., CHANNELS.index("line_load_friction"), :] = [1.6, 0.0, 0.0, 0.0]
    uneven = altered(model, mesh={"table": mesh.table._replace(channel=channel)})
    state, coefficients = static_equilibrium(model), []
    for case, factor in ((model, 1.0), (uneven, 1.6)):
        work, _, _ = evaluate(case, state, 0.3 * float(mesh.table.boundary[1]), 0)
        load = factor * work[contact.NORMAL_LOAD, 0] / mesh.table.slice_width
        speeds = work[contact.DRIVER_SPEED, 0], work[contact.DRIVEN_SPEED, 0]
        state_there = local_contact(
            load, 1.0 / work[contact.RADIUS, 0], np.mean(speeds), work[contact.SLIDING, 0], *speeds
        )
        film = ActiveLaw(model.options.film, mesh.film)
        expected = model.options.friction.coefficient(state_there, film, mesh.surfaces, mesh.friction)
        assert work[contact.FRICTION_COEFFICIENT, 0] == pytest.approx(expected, rel=1e-12)
        coefficients.append(expected)
    assert coefficients[0] != pytest.approx(coefficients[1], rel=1e-3)


def test_load_torque_adds_table_and_harmonics(prepared):
    operation = prepared("crc-23-47").model.operation._replace(
        load_times=np.array([0.0, 1.0, 2.0]),
        load_torques=np.array([0.0, 50.0, 50.0]),
        load_slopes=np.zeros(3),
        load_amplitudes=np.array([10.0]),
        load_frequencies=np.array([3.0]),
        load_phases=np.array([0.5]),
    )
    harmonic = 10.0 * np.sin(3.0 * 0.5 + 0.5)
    assert load_torque(0.5, operation) == pytest.approx(25.0 + harmonic)
    assert load_torque(9.0, operation) == pytest.approx(50.0 + 10.0 * np.sin(27.5))
