"""The native stiff solver: its coefficients, its Jacobian, its order, and its agreement with Radau."""

import numpy as np
import pytest

from tests.support.plain_kernels import interpreted
from tests.support.states import PAIR, TURN_G, random_place, random_state
from tribodyn.dynamics.parameters import DRIVE_SPEED, OutputDrive, with_shared_code
from tribodyn.solve.choice import STIFF, choose
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import Place
from tribodyn.solve.methods.rodas4 import ALPHA, GAMMA, GAMMAS, STAGES, A, C
from tribodyn.solve.right_hand_side import rhs, work_array
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.train.layout import works


@pytest.fixture(scope="module")
def tableau():
    """α, β = α + Γ and b of the method in Hairer & Wanner's untransformed form (IV.7)."""
    gamma = np.linalg.inv(np.eye(STAGES) / GAMMA - np.pad(C, ((0, 0), (0, 1))))
    alpha = np.pad(A, ((0, 0), (0, 1))) @ gamma
    return alpha, alpha + gamma, np.append(A[-1], 1.0) @ gamma


def test_order_conditions_up_to_four(tableau):
    """Hairer & Wanner II, table IV.7.1, and that α_i, γ_i are the rows' sums (systems with f(t, y))."""
    alpha, beta, b = tableau
    a, e = alpha.sum(axis=1), beta.sum(axis=1)
    found = [
        b.sum(),
        b @ e,
        b @ a**2,
        b @ beta @ e,
        b @ a**3,
        b @ (a * (alpha @ e)),
        b @ beta @ a**2,
        b @ beta @ beta @ e,
    ]
    expected = [1, 1 / 2, 1 / 3, 1 / 6, 1 / 4, 1 / 8, 1 / 12, 1 / 24]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(a, ALPHA, atol=1e-13)
    np.testing.assert_allclose(e - a, GAMMAS, atol=1e-13)


def test_it_is_stable_for_every_step(tableau):
    """|R(z)| ≤ 1 on the imaginary axis and R(∞) = 0, R(z) = 1 + z bᵀ(I − zβ)⁻¹1."""
    _, beta, b = tableau

    def growth(z):
        return abs(1 + z * b @ np.linalg.solve(np.eye(STAGES) - z * beta, np.ones(STAGES)))

    assert max(growth(1j * w) for w in np.geomspace(1e-2, 1e4, 200)) < 1 + 1e-12
    assert growth(-1e9) < 1e-7


@pytest.mark.parametrize(
    "overrides",
    [
        {},
        {"friction.sliding": "dynamic", "mesh.formulation": "energy-consistent"},
        {
            "operating.source": "torque",
            "operating.drive_inertia": "0.02 kg*m**2",
            "operating.shaft_stiffness": "3000 N*m/rad",
            "operating.shaft_damping": "0.5 N*m*s/rad",
            "operating.load_damping": "0.3 N*m*s/rad",
            "mesh.hertz": "load-dependent",
        },
        {
            "mesh.backlash": "12 um",
            "operating.gear_torque_harmonics": [
                {"frequency": "20 Hz", "amplitude": "40 N*m", "phase": "0 deg"}
            ],
        },
    ],
    ids=["speed", "dynamic", "shaft", "backlash"],
)
def test_jacobian_is_the_derivative_of_the_right_hand_side(prepared, rng, overrides):
    """Against central differences of all columns, over random states, loaded or apart."""
    model = prepared("crc-23-47", **overrides).model
    inputs = {"acceleration": 40.0, "output_torque": 5.0, "output_drive": OutputDrive(2e3, 5.0, slip=0.3)}
    model = model._replace(operation=model.operation._replace(**inputs))
    native = with_shared_code(model)
    layout, states = model.layout, model.layout.states
    work, scale = work_array(model), tolerances_from(model, np.zeros(states), 1.0, 1).atol
    still = [layout.half + layout.lag] if model.options.drive == DRIVE_SPEED else []
    columns = [i for i in range(layout.mechanical) if i not in still]
    # small against the width over which friction reverses, 3e-4 m/s
    steps = np.diag(np.minimum(1e-6 * scale, 3e-8))[columns]
    for _ in range(10):
        y = random_state(rng, model)
        y[still] = 0.0
        phase, segment = random_place(rng, model.schedule)
        f, trial, slope, jacobian = (
            np.empty(states),
            np.empty(states),
            np.empty(states),
            np.empty((states, states)),
        )
        rhs(phase, 0.0, segment, y, native, work, f)
        before = y.copy()
        place = Place(phase, 0.0, segment, 1.0)
        interpreted(differentiate, rhs)(place, y, f, scale, native, work, Differences(trial, jacobian, slope))
        np.testing.assert_array_equal(y, before)
        up, down = (accelerations(y + sign * steps, phase, segment, model) for sign in (1, -1))
        exact = (up - down).T / (2 * steps.sum(axis=1))
        size = np.abs(exact * scale[columns]).max(axis=1, keepdims=True)
        assert np.all(np.abs(jacobian[:, columns] - exact) * scale[columns] <= 1e-4 * size + 1e-12)
        up, down = (accelerations(y, phase + sign * 1e-7, segment, model) for sign in (1, -1))
        exact = (up - down) / 2e-7
        np.testing.assert_allclose(slope, exact, rtol=1e-4, atol=1e-5 * np.abs(exact).max())


def solve(model, method, rtol, cycles=2, samples=100):
    state = static_equilibrium(model)
    integrator = make_integrator(method, model, samples, tolerances_from(model, state, rtol, 10**6))
    result = integrator.integrate(state, 0, cycles)
    assert result.status == Status.DONE
    return result


def error(result, exact):
    found, expected = result.samples[:, TURN_G], exact.samples[:, TURN_G]
    return np.max(np.abs(found - expected)) / np.ptp(expected)


@pytest.mark.parametrize("sliding", ["kinematic", "dynamic"])
def test_order_four(prepared, sliding):
    """The work grows as tol^(−1/4), the error falls in proportion to the tolerance, works included."""
    model = prepared("crc-23-47", **{"operating.pinion_speed": "30 rad/s", "friction.sliding": sliding}).model
    exact = solve(model, "dopri5", 1e-11)
    tolerances = np.array([1e-5, 1e-6, 1e-7, 1e-8])
    results = [solve(model, "rodas4", rtol) for rtol in tolerances]
    errors = [error(result, exact) for result in results]
    order = -np.polyfit(np.log([result.steps for result in results]), np.log(errors), 1)[0]
    assert 3.6 < order < 4.6
    assert errors[1] < 2e-5
    apart = np.max(np.abs(results[-1].samples - exact.samples), axis=0) / np.ptp(exact.samples, axis=0).clip(
        1e-9
    )
    assert np.all(apart[works(PAIR)] < 1e-5)


def test_samples_between_long_steps_are_within_the_tolerance_of_a_step(prepared):
    """Long before the first change of pairs, at phase 0.52, the start's vibration has died at 1 rad/s."""
    model = prepared("crc-23-47", **{"operating.pinion_speed": "1 rad/s"}).model
    rtol = 1e-6
    found, exact = (
        solve(model, method, tolerance, cycles=1).samples[25:50, TURN_G]
        for method, tolerance in (("rodas4", rtol), ("dopri5", 1e-11))
    )
    assert np.max(np.abs(found - exact)) < 2.0 * rtol * np.max(np.abs(exact))


@pytest.mark.slow
def test_it_agrees_with_radau_where_it_is_stiff(prepared):
    model = prepared(
        "crc-23-47", **{"operating.pinion_speed": "1 rad/s", "friction.sliding": "dynamic"}
    ).model
    choice = choose("auto", model, static_equilibrium(model))
    assert choice.method == STIFF
    assert "stiff" in choice.reason
    theirs = solve(model, "radau", 1e-7, cycles=1)
    assert error(solve(model, "rodas4", 1e-7, cycles=1), theirs) < 1e-4


def test_explicit_and_stiff_are_chosen_by_speed(prepared):
    methods = []
    for speed in ("300 rad/s", "10 rad/s", "0.1 rad/s"):
        model = prepared("crc-23-47", **{"operating.pinion_speed": speed}).model
        methods.append(choose("auto", model, static_equilibrium(model)).method)
    assert methods == ["dopri5", "dopri5", "rodas4"]


@pytest.mark.parametrize("method", ["dopri5", "dop853", "rodas4", "switching"])
def test_no_result_depends_on_when_it_is_written(prepared, method):
    """Three cycles in one call, or in two."""
    model = prepared("crc-23-47").model
    state = static_equilibrium(model)
    tolerances = tolerances_from(model, state, 1e-6, 10**6)
    whole = make_integrator(method, model, 50, tolerances).integrate(state, 0, 3)
    integrator = make_integrator(method, model, 50, tolerances)
    first = integrator.integrate(state, 0, 1)
    second = integrator.integrate(first.state, 1, 2)
    np.testing.assert_array_equal(np.concatenate([first.samples, second.samples]), whole.samples)
    np.testing.assert_array_equal(second.state, whole.state)
    assert first.steps + second.steps == whole.steps
