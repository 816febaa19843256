"""Periodic motions of trains over their common period: against exact linear maps, differences, SciPy."""

from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

from tests.support.train_matrices import (
    Bearing,
    Body,
    Mesh,
    Shaft,
    Train,
    damping_matrix,
    free_coordinates,
    mass_matrix,
    senses,
    stiffness_matrix,
)
from tests.support.train_scenarios import prepared_train
from tests.support.two_stage_histories import output_load
from tribodyn.errors import InputError
from tribodyn.solve.branch.continuation import Leg
from tribodyn.solve.branch.gear_pairs import followed_states
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.orbit.gear_map import GearMap, moving_states
from tribodyn.solve.orbit.periodic import steady_states
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.solve.tolerances import state_scales, tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.train.layout import displacements, velocities, work_of, works_of_meshes
from tribodyn.train.structure import (
    DAMPING,
    FRICTION,
    IN,
    OUT,
    PARAMETRIC,
    TURN,
)

REDUCER, HUNTING = "two-stage-reducer", "two-stage-reducer-hunting"
STIFFNESS = 4e8
#: What makes a train linear in each interval of its schedule.
LINEAR = {
    "friction.law": "coulomb",
    "friction.coefficient": 0.0,
    "mesh.compliance": "constant",
    "mesh.stiffness": f"{STIFFNESS} N/m",
}
RUBBING = {"friction.law": "coulomb", "friction.coefficient": 0.06}
SPEEDS = (700, 1480, 3000)


def at_speed(name: str, speed: float, **overrides: Any) -> PreparedGearbox:
    return prepared_train(name, **{"operating.input_speed": f"{speed} rpm"} | overrides)


def linear_train(train: PreparedGearbox, pairs: list[int]) -> Train:
    """The train in the matrices' own convention, with so many pairs in contact in every mesh."""
    case, model = train.case, train.model
    layout, bodies, links = model.layout, model.bodies, model.links
    meshes = []
    for count, part, mesh, made in zip(pairs, case.meshes, model.meshes, train.tables, strict=True):
        alpha = float(np.asarray(made.cycle.pressure_angle)[0, 0, 0])
        radii = float(mesh.driver_radius), float(mesh.driven_radius)
        sense = case.bodies[part.driver].sense
        damping = count * mesh.damping * np.sqrt(STIFFNESS)
        ends = part.driver, part.driven
        meshes.append(Mesh(ends, radii, part.azimuth, alpha, sense, count * STIFFNESS, damping))
    bearings, shafts = [], []
    for k, (first, second) in enumerate(zip(layout.first, layout.second, strict=True)):
        stiffness, damping = links.stiffness[k], links.damping[k]
        if second < 0:
            bearings.append(Bearing(first, tuple(stiffness[:TURN]), tuple(damping[:TURN])))
        else:
            shafts.append(Shaft((first, second), stiffness[TURN], damping[TURN]))
    masses = [Body(float(m), float(j)) for m, j in zip(bodies.mass, bodies.inertia, strict=True)]
    return Train(tuple(masses), tuple(bearings), tuple(shafts), tuple(meshes))


def over_the_period(train: PreparedGearbox) -> tuple[np.ndarray, np.ndarray]:
    """Exact map of (displacements, velocities, 1) over the common period, and senses of the coordinates."""
    model, schedule = train.model, train.model.schedule
    cycle = float(model.operation.pitch_angle / model.operation.nominal_speed)
    one = linear_train(train, [1] * len(model.meshes))
    free = free_coordinates(one, (0,))
    inside, count = np.ix_(free, free), len(free)
    inverse = np.linalg.inv(mass_matrix(one)[inside])
    load = output_load(one, float(model.bodies.load[-1]))[free]
    elapsed, whole = 0.0, np.eye(2 * count + 1)
    for k, row in enumerate(np.asarray(schedule.segment).astype(int)):
        counts = [
            int(np.sum(np.asarray(mesh.table.in_contact)[segment]))
            for segment, mesh in zip(row, model.meshes, strict=True)
        ]
        linear = linear_train(train, counts)
        flow = np.zeros((2 * count + 1, 2 * count + 1))
        flow[:count, count:-1] = np.eye(count)
        flow[count:-1, :count] = -inverse @ stiffness_matrix(linear)[inside]
        flow[count:-1, count:-1] = -inverse @ damping_matrix(linear)[inside]
        flow[count:-1, -1] = inverse @ load
        duration = float(schedule.end[k] - schedule.start[k]) * cycle
        elapsed += duration
        whole = expm(flow * duration) @ whole
    assert elapsed == pytest.approx(schedule.period * cycle)
    own = np.ones(3 * len(one.bodies))
    own[2::3] = senses(one)
    return whole, own[free]


def scaled(model: Any, difference: np.ndarray) -> float:
    """A difference of states over their scales, of all that the map over a period acts on."""
    moving = list(moving_states(model).states)
    return float(np.max(np.abs(difference[moving]) / state_scales(model, 0.0 * difference)[moving]))


def by_another_solver(model: Any, state: np.ndarray, cycles: int, rtol: float = 1e-11) -> np.ndarray:
    """State after some reference cycles by SciPy's DOP853, engaged into the next."""
    part = make_integrator("dop853", model, 4, tolerances_from(model, state, rtol, 10**6))
    found = part.integrate(state, 0, cycles)
    assert found.status == Status.DONE
    end = found.state.copy()
    engage_next(end, cycles, model)
    return end


def assert_exact(trains: list[PreparedGearbox]) -> None:
    """Fixed points and multipliers are those of the product of matrix exponentials."""
    for train, steady in zip(trains, steady_states([t.model for t in trains], samples=8), strict=True):
        layout, (whole, own) = train.model.layout, over_the_period(train)
        count = len(own)
        exact = np.linalg.solve(np.eye(2 * count) - whole[:-1, :-1], whole[:-1, -1])
        assert steady.kind == "period-1"
        expected = np.zeros(layout.states)
        expected[displacements(layout)], expected[velocities(layout)] = (
            own * exact[:count],
            own * exact[count:],
        )
        multipliers = np.linalg.eigvals(whole[:-1, :-1])
        away = 1.0 - np.max(np.abs(multipliers))
        assert scaled(train.model, steady.state - expected) < 2e-7 / away
        assert len(steady.multipliers) == len(multipliers)
        for multiplier in multipliers:
            assert np.min(np.abs(steady.multipliers - multiplier)) < 1e-8


def test_a_linear_train_has_the_exact_steady_state_and_multipliers():
    """Two stages over three cycles, an idler whose axes stand at an angle over one."""
    trains = [at_speed(REDUCER, speed, **LINEAR) for speed in SPEEDS]
    assert_exact([*trains, at_speed("idler-train", 1450, **LINEAR)])


@pytest.mark.slow
def test_so_has_one_with_a_compliant_shaft_over_a_whole_turn_of_it():
    assert_exact([at_speed(HUNTING, 6000, **LINEAR)])


def test_leading_directions_of_a_long_period_have_its_multipliers():
    """Of a linear train they are the same from every state."""
    train = at_speed(HUNTING, 6000, **LINEAR)
    model = train.model
    start = static_equilibrium(model)[None]
    period_map = GearMap(
        [model],
        start,
        moving_states(model),
        solver="dopri5",
        rtol=1e-6,
        fine_rtol=1e-9,
        max_steps=100_000,
        workers=1,
    )
    leading = period_map.leading_tangent(start[:, period_map.moving], np.array([0]), 1, count=8)
    assert leading is not None
    exact = np.linalg.eigvals(over_the_period(train)[0][:-1, :-1])
    assert len(exact) == len(period_map.moving) > 20
    for multiplier in exact[np.abs(exact) > 1e-3]:
        assert np.min(np.abs(np.linalg.eigvals(leading.jacobian[0]) - multiplier)) < 2e-3


@pytest.fixture(scope="module")
def rubbing():
    trains = [at_speed(REDUCER, speed, **RUBBING) for speed in SPEEDS]
    return trains, steady_states([train.model for train in trains], samples=20, tolerance=1e-8)


def test_another_solver_comes_back_after_a_common_period(rubbing):
    """And not before; over it nothing is stored: what goes in comes out, or is lost."""
    for train, steady in zip(*rubbing, strict=True):
        model = train.model
        layout, period = model.layout, model.schedule.period
        assert (period, steady.kind, steady.samples.shape[0]) == (3, "period-1", 60)
        assert scaled(model, by_another_solver(model, steady.state, period) - steady.state) < 1e-6
        assert scaled(model, by_another_solver(model, steady.state, 1) - steady.state) > 1e-2
        end = steady.end.copy()
        engage_next(end, period, model)
        work = [float(end[work_of(layout, which)]) for which in (IN, PARAMETRIC, OUT, DAMPING)]
        friction = end[works_of_meshes(layout, FRICTION)]
        assert np.all(friction > 0.0)
        assert work[0] + work[1] - work[2] - work[3] == pytest.approx(np.sum(friction), rel=1e-6)


def test_multipliers_are_those_of_differences_of_the_map(rubbing):
    """Central differences of SciPy's marches over the period, along directions at random.

    At a tolerance of 1e-11 a march may pass over a reversal of friction and miss by 1e-4; at 1e-13
    differences over 3e-5, 1e-4 and 3e-4 are within 4e-7 of the derivative.
    """
    trains, steadies = rubbing
    model, steady = trains[1].model, steadies[1]
    moving = list(moving_states(model).states)
    scale = state_scales(model, steady.state)[moving]
    ways = np.random.default_rng(4).standard_normal((3, len(moving)))
    slopes = []
    for way in ways:
        ends = []
        for sign in (1.0, -1.0):
            state = steady.state.copy()
            state[moving] += sign * 1e-4 * scale * way
            ends.append(by_another_solver(model, state, model.schedule.period, 1e-13)[moving])
        slopes.append((ends[0] - ends[1]) / scale / 2e-4)
    settings: dict[str, Any] = {"solver": "auto", "rtol": 1e-6, "fine_rtol": 1e-10, "max_steps": 10**6}
    period_map = GearMap([model], steady.state[None], moving_states(model), workers=1, **settings)
    exact = period_map.tangent(steady.state[None][:, moving], np.zeros(1, dtype=int), 1).jacobian[0]
    exact *= scale / scale[:, None]
    assert np.max(np.abs(ways @ exact.T - slopes)) < 1e-5
    found = np.linalg.eigvals(exact)
    for multiplier in steady.multipliers[np.abs(steady.multipliers) > 0.01]:
        assert np.min(np.abs(found - multiplier)) < 1e-5


def test_a_train_is_followed_along_its_speed(rubbing):
    trains, (_, steady, _) = rubbing

    def model_at(line: int, value: float) -> Any:
        del line
        operation = trains[1].model.operation._replace(nominal_speed=value)
        return trains[1].model._replace(operation=operation)

    speed = float(trains[1].model.operation.nominal_speed)
    leg = Leg(0, speed, 1.04 * speed, steady.state, 1, reach=2.0 * speed)
    settings: dict[str, Any] = {"samples": 20, "rtol": 1e-6, "max_cycles": 2000, "solver": "auto"}
    ((found, arrival, _),) = followed_states(model_at, [leg], max_steps=10**6, workers=1, **settings)
    assert (found.kind, arrival.ends) == ("period-1", ())
    (expected,) = steady_states([model_at(0, 1.04 * speed)], samples=20)
    assert scaled(trains[1].model, found.state - expected.state) < 1e-6


def test_a_lightly_damped_train_need_not_repeat():
    """Another solver comes by its samples, and they are of whole common periods."""
    light = {"mesh.backlash": "20 um", "mesh.damping_ratio": 0.005, "bearings.default.damping_ratio": 0.003}
    light["mesh.body"] = "held"  # this speed is in a resonance of these
    model = at_speed(REDUCER, 7800, **RUBBING, **light, **{"operating.output_torque": "150 N*m"}).model
    (steady,) = steady_states([model], samples=10, max_cycles=60)
    assert steady.period == 0
    # whether a shot then meets the unstable motion of one period depends on where the march happens to end
    assert "unstable state of period 1" in steady.message or "Lyapunov exponent +" in steady.message
    assert steady.samples.shape[0] == 10 * 15
    end = by_another_solver(model, steady.state, 3)
    assert scaled(model, end - steady.samples[30]) < 1e-4
    assert scaled(model, end - steady.state) > 1e-1


def harmonic(train: PreparedGearbox, mesh: int, times: float) -> list[dict[str, str]]:
    """A load that varies with a mesh's frequency, times a number."""
    reference = train.model.operation
    frequency = float(train.case.meshes[mesh].rate) * times
    frequency *= reference.nominal_speed * 2.0 * np.pi / reference.pitch_angle
    return [{"amplitude": "100 N*m", "frequency": f"{frequency!r} rad/s", "phase": "20 deg"}]


def test_a_load_may_vary_with_any_mesh_of_a_train():
    """It repeats over the common period, as with the shaft that all repeats with, but not in between."""
    train = at_speed(REDUCER, 1480, **RUBBING)
    for mesh, times in ((0, 1.0), (1, 1.0), (1, 2.0), (0, 1.0 / 3.0)):
        load = {"operating.output_torque_harmonics": harmonic(train, mesh, times)}
        model = at_speed(REDUCER, 1480, **RUBBING, **load).model
        (steady,) = steady_states([model], samples=8)
        assert steady.kind == "period-1"
        assert scaled(model, by_another_solver(model, steady.state, 3) - steady.state) < 1e-6
    load = {"operating.output_torque_harmonics": harmonic(train, 0, 0.5)}
    with pytest.raises(InputError, match="does not repeat"):
        steady_states([at_speed(REDUCER, 1480, **RUBBING, **load).model])
