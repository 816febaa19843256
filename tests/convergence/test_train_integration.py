"""Trains: the energy audit at every tolerance, and errors that fall with it."""

from itertools import product

import numpy as np
import pytest

from tests.support.soak_parameters import all_in_soak
from tests.support.states import sampled
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs, train_outputs
from tribodyn.gears.motion.running import energy_residual
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.layout import displacements

TRAINS = ["two-stage-reducer", "idler-train", "two-pinions-bull-gear"]
#: A motor behind a shaft that gives way, whose speed falls under load.
MOTOR = {
    "operating.source": "torque",
    "operating.drive_inertia": "0.05 kg*m**2",
    "operating.shaft_stiffness": "2e4 N*m/rad",
    "operating.shaft_damping": "2 N*m*s/rad",
    "operating.speed_regulation": "0.5 N*m*s/rad",
}
#: Flanks that separate and strike the back ones.
RATTLE = {
    "mesh.backlash": "20 um",
    "operating.output_torque": "20 N*m",
    "operating.output_torque_harmonics": [{"amplitude": "400 N*m", "frequency": "600 Hz"}],
    "load.0.torque": "8 N*m",
}
#: One law for all, so that they share their kernels.
RUBBING = {"friction.law": "coulomb", "friction.coefficient": 0.06}
CYCLES, SAMPLES = 6, 40


def model_of(name, formulation="classical", **overrides):
    return prepare(load_scenario(name, {"mesh.formulation": formulation, **RUBBING, **overrides})).model


def motion(model, method, rtol, initial="static"):
    settings = TransientSettings(method, rtol, CYCLES, 10**6, SAMPLES)
    return sampled(model, settings, initial_state(model, initial))


def missing(model, method, rtol, initial="static"):
    """What the works leave over, as a share of the largest."""
    cycles, states = motion(model, method, rtol, initial)
    seen = evaluated(cycles, states, model)
    of_meshes = [mesh_outputs(m, seen) for m in range(model.layout.meshes)]
    energy = train_outputs(seen, sum(each["sliding_loss"] for each in of_meshes))["stored_energy"]
    return abs(energy_residual(states[0], states[-1], float(energy[-1] - energy[0]), model.layout))


SOURCES = {"speed": {}, "motor": MOTOR}
#: Every train with either source, formulation and method, not each with each.
BALANCED = {
    *((name, "speed", "classical", "dopri5") for name in TRAINS),
    *((name, "motor", "energy-consistent", "rodas4") for name in TRAINS),
}


@pytest.mark.parametrize("rtol", [1e-6, 1e-8])
@pytest.mark.parametrize(
    ("name", "source", "formulation", "method"),
    all_in_soak(
        product(TRAINS, SOURCES, ["classical", "energy-consistent"], ["dopri5", "rodas4"]), BALANCED, names=4
    ),
)
def test_the_energy_balance_closes_within_ten_tolerances(name, source, formulation, method, rtol):
    assert missing(model_of(name, formulation, **SOURCES[source]), method, rtol) < 10 * rtol


@pytest.mark.parametrize("method", ["dopri5", "rodas4"])
def test_the_energy_balance_closes_when_flanks_strike(method):
    model = model_of("two-pinions-bull-gear", **RATTLE)
    cycles, states = motion(model, method, 1e-6, "unloaded")
    seen = evaluated(cycles, states, model)
    for m in range(2):
        load = mesh_outputs(m, seen)["normal_load"]
        sides = [load[:, np.asarray(model.meshes[m].table.side) == side].sum(axis=1) > 0 for side in (1, -1)]
        assert np.any(sides[0])
        assert np.any(sides[1])
        assert not np.all(sides[0] | sides[1])
    for rtol in (1e-6, 1e-8):
        assert missing(model, method, rtol, "unloaded") < 10 * rtol


#: Every train, either method.
SOME = [("two-stage-reducer", "dopri5"), ("idler-train", "rodas4"), ("two-pinions-bull-gear", "dopri5")]


@pytest.mark.parametrize(
    ("name", "method"), all_in_soak(product(TRAINS, ["dopri5", "rodas4"]), SOME, names=2)
)
def test_errors_fall_in_proportion_to_the_tolerance(name, method):
    """Over the range of the coordinate that is worst; steps end where the friction of any mesh reverses."""
    model = model_of(name, **{"friction.sliding": "kinematic"})
    places = displacements(model.layout)
    _, exact = motion(model, "dopri5", 1e-12)
    tolerances = np.array([1e-5, 1e-6, 1e-7, 1e-8])
    errors = []
    for rtol in tolerances:
        away = np.max(np.abs(motion(model, method, rtol)[1] - exact), axis=0)[places]
        errors.append(np.max(away / np.ptp(exact[:, places], axis=0)))
    slope = np.polyfit(np.log(tolerances), np.log(errors), 1)[0]
    assert 0.8 < slope < 1.3
    assert errors[1] < 1e-5


@pytest.mark.parametrize(
    ("name", "method"), all_in_soak(product(TRAINS, ["dopri5", "rodas4"]), SOME, names=2)
)
def test_friction_against_the_moving_bodies_costs_little_accuracy(name, method):
    """The places where it turns are found on the way, in any mesh."""
    model = model_of(name, **{"friction.sliding": "dynamic"})
    places = displacements(model.layout)
    (_, exact), (_, states) = motion(model, "rodas4", 1e-10), motion(model, method, 1e-7)
    away = np.max(np.abs(states - exact), axis=0)[places]
    assert np.max(away / np.ptp(exact[:, places], axis=0)) < 1e-5
