"""Derivatives of the map over a mesh cycle: against differences of a finer map, and Liouville's formula."""

from itertools import pairwise

import numpy as np
import pytest

from tests.support.soak_parameters import all_in_soak
from tests.support.states import SLIP
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.march.reversal import stops
from tribodyn.solve.orbit.gear_map import GearMap, moving_states
from tribodyn.solve.orbit.motions import DIFFERENCE

SPEED = {"operating.pinion_speed": "400 rad/s"}
MOTOR = {
    **SPEED,
    "operating.source": "torque",
    "operating.speed_regulation": "10 N*m*s/rad",
    "operating.gear_torque": "300 N*m",
}
SHAFT = {
    **MOTOR,
    "operating.shaft_stiffness": "2e4 N*m/rad",
    "operating.drive_inertia": "0.02 kg*m**2",
    "operating.shaft_damping": "2 N*m*s/rad",
}
CONSISTENT = {"mesh.formulation": "energy-consistent"}
FRICTIONLESS = {"friction.law": "none"}
#: The published sliding velocity: with the vibration's, friction has its reversal within the motion.
FILM = {"friction.sliding": "kinematic"}


def gear_map(model, **settings):
    start = static_equilibrium(model)
    given = {"solver": "dopri5", "rtol": 1e-6, "fine_rtol": 1e-9, "max_steps": 10**6, "workers": 1}
    return GearMap([model], start[None], moving_states(model), **{**given, **settings})


def settled(model):
    """The map and a state near the steady one."""
    period_map = gear_map(model)
    marched = period_map.march(
        static_equilibrium(model)[None, period_map.moving], np.zeros(1, dtype=int), 10, True
    )
    return period_map, marched.states[0, -1]


def scaled(jacobian, scale):
    """In units of the scale, as which multipliers do not change."""
    return jacobian * scale / scale[:, None]


def by_central_differences(model, state, share):
    """Extrapolated from two steps, of a map integrated to 1e-12."""
    fine = gear_map(model, rtol=1e-12, fine_rtol=1e-12)
    scale, size = fine.scale[0], len(state)
    found = []
    for part in (share, share / 2):
        shift = part * np.diag(scale)
        rows = np.concatenate([state + shift, state - shift])
        end = fine.march(rows, np.zeros(2 * size, dtype=int), 1, True).states[:, -1]
        found.append(((end[:size] - end[size:]) / (2 * part)).T / scale[:, None])
    return (4 * found[1] - found[0]) / 3


CASES = {
    "without friction": {**SPEED, **FRICTIONLESS},
    "without friction, motor": {**MOTOR, **FRICTIONLESS},
    "without friction, motor, energy-consistent": {**MOTOR, **FRICTIONLESS, **CONSISTENT},
    "film": {**SPEED, **FILM},
    "film, energy-consistent": {**SPEED, **FILM, **CONSISTENT},
    "film, motor": {**MOTOR, **FILM},
    "without friction, shaft": {**SHAFT, **FRICTIONLESS},
    "film, shaft": {**SHAFT, **FILM},
    "film, shaft, energy-consistent": {**SHAFT, **FILM, **CONSISTENT},
}


@pytest.mark.parametrize("name", all_in_soak(CASES, lambda name: not name.startswith("film, shaft")))
def test_multipliers_are_exact(prepared, name):
    model = prepared("crc-23-47", **CASES[name]).model
    period_map, state = settled(model)
    assert period_map.blur == 0.0
    tangent = period_map.tangent(state[None], np.zeros(1, dtype=int), 1)
    assert tangent.reasons == [""]
    scale = period_map.scale[0]
    image = period_map.march(state[None], np.zeros(1, dtype=int), 1, True).states[0, -1]
    assert np.max(np.abs(tangent.image[0] - image) / scale) < 1e-8
    exact = by_central_differences(model, state, 4e-3)
    multipliers = np.linalg.eigvals(scaled(tangent.jacobian[0], scale))
    for multiplier in np.linalg.eigvals(exact):
        assert np.min(np.abs(multipliers - multiplier)) < 1e-8


def test_the_stiff_method_gives_the_same(prepared):
    """With the vibration's sliding, for which it is chosen at low speed."""
    constant = {"friction.law": "coulomb", "friction.coefficient": 0.05}
    slow = {"operating.pinion_speed": "30 rad/s", "friction.sliding": "dynamic"}
    model = prepared("crc-23-47", **slow, **constant).model
    state = static_equilibrium(model)[None]
    explicit, stiff = (gear_map(model, solver=solver) for solver in ("dopri5", "rodas4"))
    mine, other = (
        period_map.tangent(state[:, period_map.moving], np.zeros(1, dtype=int), 1).jacobian[0]
        for period_map in (explicit, stiff)
    )
    difference = scaled(mine - other, explicit.scale[0])
    assert np.max(np.abs(difference)) < 1e-7


def test_over_several_cycles_it_is_the_product(prepared):
    model = prepared("crc-23-47", **MOTOR, **FRICTIONLESS, **CONSISTENT).model
    period_map, state = settled(model)
    case = np.zeros(1, dtype=int)
    first = period_map.tangent(state[None], case, 1)
    second = period_map.tangent(first.image, case, 1)
    both = period_map.tangent(state[None], case, 2)
    scale = period_map.scale[0]
    product = scaled(second.jacobian[0] @ first.jacobian[0], scale)
    np.testing.assert_allclose(scaled(both.jacobian[0], scale), product, atol=1e-8)


def test_its_determinant_is_what_damping_takes_from_phase_space(prepared):
    """Liouville: det Φ = exp ∫ tr ∂f/∂y; the trace by differences of the right-hand side on NumPy."""
    model = prepared(
        "crc-23-47",
        **FILM,
        **{"operating.pinion_speed": "1200 rad/s", "mesh.damping_ratio": 0.01},
        **{f"bearings.{side}.damping_ratio": 0.01 for side in ("pinion", "gear")},
    ).model
    period_map, state = settled(model)
    case = np.zeros(1, dtype=int)
    tangent = period_map.tangent(state[None], case, 1)
    # a march from the same state, sampled where the trace is needed
    samples = 4000
    track = period_map.integrate(period_map.full(state[None]), case, 1, samples, True).samples[0]
    phases = np.arange(samples) / samples
    scale, moving = period_map.scale[0], period_map.moving
    shift = np.zeros((len(moving), model.layout.states))
    shift[range(len(moving)), moving] = 1e-6 * scale
    total = 0.0
    boundary = np.asarray(model.meshes[0].table.boundary)
    for segment, (start, end) in enumerate(pairwise(boundary)):
        places = [start, *(stop for stop in stops(model)[segment] if stop < end), end]
        for low, high in pairwise(places):
            nodes, weights = np.polynomial.legendre.leggauss(20)
            at = low + (high - low) * (nodes + 1) / 2
            y = np.array([np.interp(at, phases, column, period=1.0) for column in track.T]).T
            up, down = (
                accelerations(y[:, None] + sign * shift, at[:, None], segment, model) for sign in (1, -1)
            )
            trace = np.sum([(up - down)[:, i, j] / (2e-6 * scale[i]) for i, j in enumerate(moving)], axis=0)
            total += np.sum(weights * trace) * (high - low) / 2
    assert -10.0 < total < -0.1
    determinant = np.linalg.det(scaled(tangent.jacobian[0], scale))
    assert np.log(determinant) == pytest.approx(total, rel=1e-6)


def test_a_march_that_fails_says_why(prepared):
    stalls = prepared(
        "crc-23-47",
        **{
            "operating.source": "torque",
            "operating.pinion_torque": "1 N*m",
            "operating.pinion_speed": "5 rad/s",
        },
    ).model
    period_map = gear_map(stalls)
    start = static_equilibrium(stalls)[None, period_map.moving]
    tangent = period_map.tangent(start, np.zeros(1, dtype=int), 4)
    assert "came to rest" in tangent.reasons[0]
    assert np.all(np.isnan(tangent.image))
    assert SLIP in period_map.moving


def test_a_method_that_is_not_native_is_differenced_and_says_so(prepared):
    model = prepared("crc-23-47", **SPEED, **FRICTIONLESS).model
    foreign = gear_map(model, solver="dop853")
    assert not foreign.exact
    assert foreign.blur == DIFFERENCE
