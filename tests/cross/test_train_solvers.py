"""Every way to integrate the same train: one answer, whose energy balances."""

from typing import Any

import numpy as np
import pytest

from tests.support.states import sampled
from tests.support.train_scenarios import prepared_train
from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.extremes import no_extremes, take_in
from tribodyn.dynamics.recorded.outputs import evaluated, evaluated_with_extremes, mesh_outputs, train_outputs
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import initial_state
from tribodyn.solve.integrator import Status
from tribodyn.solve.methods import METHODS
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import SampledStates, TransientSettings, make_integrator, transient
from tribodyn.train.structure import rotational_error

REDUCER = "two-stage-reducer"
#: One law for all, so that they share their kernels.
RUBBING = {"friction.law": "coulomb", "friction.coefficient": 0.06}
#: Methods that XLA compiles for a minute.
SLOW = {"tsit5", "dopri8", "kvaerno5"}
SPEEDS = (300, 1480, 2500, 6000)

MOTOR = {"operating.source": "torque", "operating.drive_inertia": "0.05 kg*m**2"}
SHAFT = {
    "operating.shaft_stiffness": "2e4 N*m/rad",
    "operating.shaft_damping": "2 N*m*s/rad",
    "operating.speed_regulation": "10 N*m*s/rad",
}
HARMONIC = [{"amplitude": "200 N*m", "frequency": "100 Hz", "phase": "0 deg"}]
RATTLE = {
    "operating.output_torque": "60 N*m",
    "operating.output_torque_harmonics": HARMONIC,
    "mesh.backlash": "30 um",
}
RUN_UP = MOTOR | {
    "operating.input_speed": "200 rpm",
    "operating.input_torque": "400 N*m",
    "operating.speed_regulation": "0.5 N*m*s/rad",
    "operating.load_damping": "1 N*m*s/rad",
}
STEP = {"operating.output_torque_table": "load-step.csv"}
#: Overrides, where the run starts, cycles.
RUNS: dict[str, tuple[dict[str, Any], str, int]] = {
    "steady": ({}, "static", 3),
    "energy-consistent": ({"mesh.formulation": "energy-consistent"}, "static", 3),
    "back flanks": ({"operating.output_torque": "-900 N*m", "mesh.backlash": "30 um"}, "static", 3),
    "rattle": (RATTLE, "static", 9),
    "harmonics": (
        {"operating.output_torque_harmonics": HARMONIC},
        "static",
        6,
    ),
    "step": (STEP, "static", 27),
    "motor": (MOTOR, "static", 3),
    "run-up": (RUN_UP, "unloaded", 30),
    "run-up, energy-consistent": (RUN_UP | {"mesh.formulation": "energy-consistent"}, "unloaded", 30),
    "shaft": (MOTOR | SHAFT, "static", 3),
}


@pytest.fixture(scope="module")
def exact():
    """The reducer, and samples of SciPy's DOP853."""
    model = prepared_train(REDUCER, **RUBBING).model
    return model, sampled(model, TransientSettings("dop853", 1e-11, 4, 10**6, 25))[1]


def off(model: Model, states: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference of the mechanical states over what each ranges through."""
    layout = model.layout
    free = np.delete(np.arange(layout.mechanical), [layout.lag, layout.half + layout.lag])
    return float(np.max(np.max(np.abs(states - exact), axis=0)[free] / np.ptp(exact, axis=0)[free]))


@pytest.mark.parametrize(
    "method",
    [
        pytest.param(name, marks=[pytest.mark.soak] * (name in SLOW))
        for name in METHODS
        if name not in ("dop853", "bdf")
    ],
)
def test_integrators_agree_on_a_train(exact, method):
    model, expected = exact
    found = sampled(model, TransientSettings(method, 1e-9, 4, 10**6, 25))[1]
    assert found.shape == expected.shape
    assert off(model, found, expected) < 2e-6
    for mesh in range(2):
        errors = [rotational_error(states, mesh, model) for states in (found, expected)]
        assert np.max(np.abs(errors[0] - errors[1])) < 1e-6 * np.ptp(errors[1])


@pytest.mark.parametrize("run", RUNS)
def test_energy_balances_whatever_drives_and_loads_a_train(run):
    """What goes in is stored or lost, or done by the varying stiffness, in every sort of run."""
    overrides, initial, cycles = RUNS[run]
    model = prepared_train(REDUCER, **RUBBING | overrides).model
    at, states = sampled(
        model, TransientSettings("dopri5", 1e-8, cycles, 10**6, 50), initial_state(model, initial)
    )
    seen = evaluated(at, states, model)
    meshes = [mesh_outputs(mesh, seen) for mesh in range(2)]
    whole = train_outputs(seen, sum(mesh["sliding_loss"] for mesh in meshes))
    change = {name[5:]: whole[name][-1] - whole[name][0] for name in whole if name.startswith("work_")}
    stored = whole["stored_energy"][-1] - whole["stored_energy"][0]
    left = change["in"] + change["parametric"] - change["out"] - stored
    left -= change["friction"] + change["damping"]
    assert abs(left) < 2e-8 * max(abs(change["in"]), abs(change["out"]))
    assert min(change["friction"], change["damping"]) > 0.0
    loads = [mesh["normal_load"].sum(axis=1) for mesh in meshes]
    if run == "rattle":
        assert all(np.min(load) == 0.0 < np.max(load) for load in loads)
    if run.startswith("run-up"):
        assert whole["speed"][-1, 0] > 1.1 * whole["speed"][0, 0]


def test_the_extremes_of_every_mesh_are_found():
    """Where flanks part: not missed by what 2000 samples in a cycle see, and no farther from it."""
    model = prepared_train(REDUCER, **RUBBING | RATTLE).model
    settings = TransientSettings("dopri5", 1e-8, 6, 10**6, 2000, extremes=True)
    *parts, _ = transient(model, initial_state(model, "static"), settings)
    chunks = [part for part in parts if isinstance(part, SampledStates)]
    at, states = (np.concatenate([getattr(chunk, of) for chunk in chunks]) for of in ("cycles", "states"))
    found = no_extremes(model.layout)
    for chunk in chunks:
        if chunk.extremes is not None:
            take_in(found, chunk.extremes)
    both, _, _ = evaluated_with_extremes(at[:1], states[:1], found, model)
    dense = evaluated(at, states, model)
    for mesh in range(2):
        expected, seen = (mesh_outputs(mesh, samples) for samples in (dense, both))
        for name, sign in (
            ("normal_load", 1),
            ("transmission_error_rotational", 1),
            ("hertz_pressure", 1),
            ("transmission_error_rotational", -1),
            ("central_film_thickness", -1),
        ):
            there, most = (sign * np.nanmax(sign * values[name]) for values in (expected, seen))
            size = np.nanmax(np.abs(expected[name]))
            assert -1e-9 * size <= sign * (most - there) <= 1e-5 * size


@pytest.fixture(scope="module")
def speeds():
    """The reducer at several speeds, and where it starts."""
    models = [
        prepared_train(REDUCER, **{"operating.input_speed": f"{speed} rpm"} | RUBBING).model
        for speed in SPEEDS
    ]
    return models, np.array([initial_state(model, "static") for model in models])


@pytest.mark.slow
@pytest.mark.parametrize("method", ["dopri5", pytest.param("tsit5", marks=pytest.mark.soak)])
def test_a_batch_of_trains_is_so_many_single_runs(speeds, method):
    """Over cycles that are no whole number of common periods."""
    models, states = speeds
    plan = {"cycles": 7, "window": 2, "samples": 20, "rtol": 1e-9, "method": method, "workers": 1}
    found = march(models, states, **plan)
    for case, model in enumerate(models):
        tolerances = tolerances_from(model, states[case], 1e-9, 10**6)
        alone = make_integrator("dopri5", model, 20, tolerances).integrate(states[case], 0, 7)
        assert found.status[case] == alone.status == Status.DONE
        assert off(model, found.samples[case], alone.samples[-40:]) < (1e-7 if method == "dopri5" else 3e-6)


@pytest.mark.slow
def test_a_batch_goes_on_where_another_ended(speeds):
    """Within the common period of three cycles: the meshes stand where they stood."""
    models, states = speeds
    given = {"window": 0, "samples": 0, "rtol": 1e-9, "workers": 1}
    whole = march(models, states, cycles=5, **given).state
    first = march(models, states, cycles=2, **given).state
    second = march(models, first, cycles=3, started=True, first_cycle=2, **given).state
    mechanical = models[0].layout.mechanical
    scale = np.maximum(np.max(np.abs(whole), axis=0), 1e-30)  # the slip is nothing
    np.testing.assert_allclose(second / scale, whole / scale, rtol=0.0, atol=1e-6)
    beside = march(models, first, cycles=3, started=True, first_cycle=3, **given).state
    assert np.max(np.abs(beside / scale - whole / scale)[:, :mechanical]) > 1e-3
