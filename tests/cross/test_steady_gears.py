"""Steady states of gear pairs against exact linear maps, another solver, and each other."""

import numpy as np
import pytest

from tests.support.linear_mesh import FREE, OVERRIDES, SEGMENTS, generator, over_a_cycle
from tests.support.states import TURN_G
from tribodyn.errors import InputError
from tribodyn.solve.integrator import Status
from tribodyn.solve.orbit.periodic import WANDERING, steady_states
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.solve.tolerances import scales_from, table_scales, tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.train.layout import displacements, velocities, work_of, work_of_mesh, works
from tribodyn.train.structure import (
    DAMPING,
    FRICTION,
    OUT,
    slip_of_body,
)

#: A lightly damped mesh in its parametric resonance, where the load of 100 N m is lost for part of the cycle.
RESONANT = {
    **OVERRIDES,
    "mesh.backlash": "20 um",
    "mesh.damping_ratio": 0.01,
    "operating.gear_torque": "100 N*m",
}

#: The same resonance of the drive as it is shipped.
INVOLUTE_AT_RESONANCE = {
    "friction.law": "none",
    "mesh.damping_ratio": 0.01,
    "operating.gear_torque": "100 N*m",
}


@pytest.fixture(scope="module")
def linear(prepared):
    return [
        prepared("involute-23-47", **{**OVERRIDES, "operating.pinion_speed": f"{speed} rad/s"})
        for speed in (60, 300, 800)
    ]


@pytest.fixture(scope="module")
def film(prepared):
    """The CRC drive with mixed-EHL friction, whose forces are neither linear nor smooth."""
    return [
        prepared("crc-23-47", **{"operating.pinion_speed": f"{speed} rad/s", "mesh.damping_ratio": 0.05})
        for speed in (150, 400)
    ]


def models(cases):
    return [case.model for case in cases]


def scaled(model, difference):
    tables = [table_scales(mesh) for mesh in model.meshes]
    scale = scales_from(model, tables, np.array([3e-5]), [0.0])
    free = [*displacements(model.layout), *velocities(model.layout)]
    return np.max(np.abs(difference[free]) / scale[free])


def by_another_solver(model, state, cycles):
    """State after some cycles by SciPy's DOP853, engaged into the next."""
    tolerances = tolerances_from(model, state, 1e-10, 10**6)
    part = make_integrator("dop853", model, 8, tolerances).integrate(state, 0, cycles)
    assert part.status == Status.DONE
    end = part.state.copy()
    engage_next(end, cycles, model)
    return end


@pytest.mark.parametrize("method", ["auto", "marching", "shooting"])
def test_a_linear_mesh_has_the_exact_steady_state_and_multipliers(linear, method):
    """Its map over a cycle is a product of two matrix exponentials."""
    for case, steady in zip(linear, steady_states(models(linear), samples=20, method=method), strict=True):
        exact = over_a_cycle(case)
        multipliers = np.linalg.eigvals(exact[:10, :10])
        assert steady.kind == "period-1"
        assert steady.residual <= 1e-7
        state = np.linalg.solve(np.eye(10) - exact[:10, :10], exact[:10, 10])
        difference = np.zeros_like(steady.state)
        difference[FREE] = steady.state[FREE] - state
        # a residual of 1e-7 leaves the state as far off as the slowest mode takes to carry it away
        assert scaled(case.model, difference) <= 2e-7 / (1.0 - np.max(np.abs(multipliers)))
        for multiplier in multipliers:
            assert np.min(np.abs(steady.multipliers - multiplier)) < 5e-9


def test_their_product_is_what_damping_takes_from_phase_space(linear):
    """Liouville's formula: the determinant of the monodromy is exp ∫ trace."""
    boundary = np.asarray(linear[0].model.meshes[0].table.boundary)
    for case, steady in zip(linear, steady_states(models(linear), samples=1), strict=True):
        trace = sum(
            np.trace(generator(case, pairs)) * (boundary[segment + 1] - boundary[segment])
            for segment, pairs in SEGMENTS
        )
        if trace > -20.0:  # otherwise the smallest multipliers are below what the integration tolerates
            assert np.prod(steady.multipliers).real == pytest.approx(np.exp(trace), rel=1e-6)


def test_marching_and_shooting_come_to_the_same_state(film):
    marched = steady_states(models(film), samples=4, method="marching", tolerance=1e-8)
    shot = steady_states(models(film), samples=4, method="shooting", tolerance=1e-8)
    for case, steady, other in zip(film, marched, shot, strict=True):
        assert steady.kind == other.kind == "period-1"
        assert (steady.method, other.method) == ("marching", "shooting")
        assert scaled(case.model, steady.state - other.state) < 1e-7
        np.testing.assert_allclose(np.abs(steady.multipliers[:4]), np.abs(other.multipliers[:4]), atol=1e-4)


def test_another_solver_comes_back_to_the_state(film):
    for case, steady in zip(film, steady_states(models(film), samples=50), strict=True):
        end = by_another_solver(case.model, steady.state, 1)
        assert scaled(case.model, end - steady.state) < 1e-6
        np.testing.assert_allclose(steady.samples[0], steady.state, rtol=1e-12)
        assert steady.samples.shape[0] == 50
        whole = steady.end.copy()
        engage_next(whole, 1, case.model)
        work_in, work_out, damping, parametric, friction, _ = whole[works(case.model.layout)]
        # over a whole period nothing is stored: what goes in, the varying stiffness included, comes out
        assert work_in + parametric - work_out - friction - damping == pytest.approx(0.0, abs=1e-6 * work_in)
        assert friction > 0.0


@pytest.fixture(scope="module")
def resonance(prepared):
    speeds = (640, 1040, 1076)
    cases = [
        prepared("involute-23-47", **{**RESONANT, "operating.pinion_speed": f"{speed} rad/s"})
        for speed in speeds
    ]
    return cases, steady_states(models(cases), samples=50, max_cycles=300)


def test_period_doubling_in_the_parametric_resonance(resonance):
    """Twice the mesh's natural frequency: contact is lost and the motion takes two mesh cycles."""
    (_, case, _), (single, double, _) = resonance
    assert (single.kind, double.kind) == ("period-1", "period-2")
    assert double.samples.shape[0] == 100
    halfway = by_another_solver(case.model, double.state, 1)
    back = by_another_solver(case.model, double.state, 2)
    assert scaled(case.model, back - double.state) < 1e-5
    assert scaled(case.model, halfway - double.state) > 0.05
    # the flanks come apart
    assert np.min(double.samples[:, TURN_G]) < 0.0 < np.max(double.samples[:, TURN_G])


def test_what_is_returned_is_the_motion_and_not_the_unstable_state_beside_it(resonance):
    (_, _, case), (_, _, wandering) = resonance
    assert wandering.period == 0
    assert wandering.kind in ("quasi-periodic", "chaotic", "longer period", "not periodic")
    assert "unstable state of period" in wandering.message
    assert len(wandering.samples) == 50 * WANDERING
    # the samples go on where the state is: another solver comes by them
    end = by_another_solver(case.model, wandering.state, 1)
    assert scaled(case.model, end - wandering.samples[50]) < 1e-4


def test_shooting_alone_finds_the_unstable_state(resonance):
    (_, _, case), (_, _, wandering) = resonance
    (unstable,) = steady_states([case.model], samples=50, method="shooting")
    assert unstable.kind == "unstable"
    assert not unstable.stable
    assert abs(unstable.multipliers[0]) > 1.0
    end = by_another_solver(case.model, unstable.state, unstable.period)
    assert scaled(case.model, end - unstable.state) < 1e-5
    assert scaled(case.model, wandering.state - unstable.state) > 1e-2


def test_a_motion_of_two_cycles_is_recognised_from_afar(prepared):
    """From the neighbour's motion: Newton's method for one cycle would find an unstable state there."""
    near, here = [
        prepared("involute-23-47", **{**INVOLUTE_AT_RESONANCE, "operating.pinion_speed": f"{speed} rad/s"})
        for speed in (1038, 1036)
    ]
    given = steady_states([near.model], samples=1)[0]
    assert given.kind == "period-2"
    (steady,) = steady_states([here.model], given.state[None], samples=20, max_cycles=400)
    assert steady.kind == "period-2"
    assert scaled(here.model, by_another_solver(here.model, steady.state, 2) - steady.state) < 1e-5


SHAFT = {
    "operating.shaft_stiffness": "2e4 N*m/rad",
    "operating.shaft_damping": "2 N*m*s/rad",
    "operating.drive_inertia": "0.02 kg*m**2",
}


@pytest.mark.parametrize(
    ("shaft", "states"), [({}, 11), pytest.param(SHAFT, 13, marks=pytest.mark.soak)], ids=["rigid", "shaft"]
)
def test_with_a_motor_the_speed_is_a_state(prepared, shaft, states):
    motor = {
        "operating.source": "torque",
        "operating.speed_regulation": "10 N*m*s/rad",
        "operating.gear_torque": "300 N*m",
        "operating.pinion_speed": "200 rad/s",
        "mesh.formulation": "energy-consistent",
    }
    model = prepared("crc-23-47", **motor, **shaft).model
    (steady,), layout = steady_states([model], samples=1000), model.layout
    assert steady.kind == "period-1"
    assert len(steady.multipliers) == states
    # the losses slow the motor down along its line: mean slip over the angle = loss torque / regulation
    lost = [work_of_mesh(layout, 0, FRICTION), work_of(layout, DAMPING)]
    loss = np.sum(steady.end[lost]) / model.operation.pitch_angle
    mean = np.mean(slip_of_body(layout.input, steady.samples.T, model))
    assert mean == pytest.approx(-loss / 10.0, rel=2e-3)
    assert steady.end[layout.lag] > 0.0
    turned = 23 / 47 * model.operation.pitch_angle
    assert steady.end[work_of(layout, OUT)] == pytest.approx(300.0 * turned, rel=1e-4)
    end = by_another_solver(model, steady.state, 1)
    assert scaled(model, end - steady.state) < 1e-6


def test_a_case_that_fails_leaves_the_others_alone(prepared, linear):
    stalls = prepared(
        "crc-23-47",
        **{
            "operating.source": "torque",
            "operating.pinion_torque": "1 N*m",
            "operating.pinion_speed": "5 rad/s",
        },
    )
    failed, fine = steady_states([stalls.model, linear[1].model], samples=10)
    (alone,) = steady_states([linear[1].model], samples=10)
    assert failed.kind == "failed"
    assert "came to rest" in failed.message
    assert len(failed.samples) == 0
    assert fine.kind == "period-1"
    np.testing.assert_array_equal(fine.state, alone.state)


def test_a_load_that_changes_with_time_is_refused(prepared):
    for name in ("load-step", "rattle"):
        with pytest.raises(InputError, match=r"operating\.gear_torque_"):
            steady_states([prepared(name).model])


def test_a_load_that_repeats_with_the_mesh_is_not(prepared):
    harmonic = {"amplitude": "30 N*m", "frequency": f"{23 * 300} rad/s", "phase": "0 deg"}
    case = prepared("involute-23-47", **OVERRIDES, **{"operating.gear_torque_harmonics": [harmonic]})
    (steady,) = steady_states([case.model], samples=10)
    assert steady.kind == "period-1"
    end = by_another_solver(case.model, steady.state, 1)
    assert scaled(case.model, end - steady.state) < 1e-6


def test_where_contact_opens_and_closes_noise_is_not_taken_for_a_motion(prepared):
    """Just above the jump marching at 1e-6 never repeats better than 2e-4; DOP853 comes back to the state."""
    model = prepared("crc-23-47", **{"operating.pinion_speed": "500 rad/s", "mesh.damping_ratio": 0.05}).model
    (steady,) = steady_states([model], max_cycles=200)
    assert steady.kind == "period-1"
    assert steady.residual <= 1e-7
    back = by_another_solver(model, steady.state, 1)
    assert scaled(model, back - steady.state) < 1e-5
