"""Refinement: tolerance, table, smoothing widths; and the energy balance at every tolerance."""

from itertools import product
from typing import Any

import numpy as np
import pytest

from tests.support.pair_outputs import outputs
from tests.support.soak_parameters import all_in_soak
from tests.support.states import TURN_G, WORK_IN, WORK_PARAMETRIC, recorded, sampled
from tribodyn.gears.motion.running import energy_residual
from tribodyn.solve.choice import choose
from tribodyn.solve.initial import initial_state
from tribodyn.solve.march.reversal import SHARES, stops
from tribodyn.solve.transient import SampledStates, TransientSettings, transient

SAMPLES = 100


def solve(model, rtol=1e-9, cycles=4, method="dopri5", initial="static"):
    settings = TransientSettings(method, rtol, cycles, 200000, SAMPLES)
    return sampled(model, settings, initial_state(model, initial))


def error(states, reference):
    return np.max(np.abs(states[:, TURN_G] - reference[:, TURN_G])) / np.ptp(reference[:, TURN_G])


def test_native_solver_converges_with_its_tolerance(prepared):
    """Fifth order: the work grows as tol^(−1/5), the error falls in proportion to the tolerance."""
    model = prepared("crc-23-47", **{"operating.pinion_speed": "300 rad/s"}).model
    _, reference = solve(model, 1e-12)
    tolerances = np.array([1e-4, 1e-5, 1e-6, 1e-7, 1e-8])
    errors = np.array([error(solve(model, rtol)[1], reference) for rtol in tolerances])
    slope = np.polyfit(np.log(tolerances), np.log(errors), 1)[0]
    assert 0.8 < slope < 1.3
    # the design asks for 2e-5; a step across a friction reversal costs 30 times this
    assert errors[2] < 5e-6


def test_steps_end_where_friction_reverses(prepared):
    """At the pitch point and beside it, against the table's own nodes."""
    case = prepared("crc-23-47")
    width = case.model.operation.reversal_width
    found = stops(case.model)
    boundary = np.asarray(case.cycle.boundary)
    np.testing.assert_array_equal(found[:, -1], boundary[1:])
    assert np.all(np.diff(found, axis=1) >= 0.0)
    inside = [(segment, phase) for segment in range(len(boundary) - 1) for phase in found[segment]]
    inside = [(segment, phase) for segment, phase in inside if phase < boundary[segment + 1]]
    assert len(inside) == len(SHARES)  # one pair passes its pitch point in a mesh cycle
    for (segment, phase), share in zip(inside, SHARES, strict=True):
        at = np.interp(phase, case.cycle.phase[segment], case.cycle.signed_distance[segment, :, -1])
        assert at == pytest.approx(share * width, abs=0.02 * width)


def _closes(case, rtol, **options):
    cycles, states = solve(case.model, rtol, cycles=6, **options)
    found = outputs(cycles, states, case.model)
    stored = found["stored_energy"][-1] - found["stored_energy"][0]
    return abs(energy_residual(states[0], states[-1], stored, case.model.layout))


DRIVES: dict[str, dict[str, Any]] = {
    "speed": {},
    "sliding": {"friction.sliding": "dynamic"},
    "torque": {"operating.source": "torque", "operating.drive_inertia": "0.02 kg*m**2"},
    "shaft": {
        "operating.source": "torque",
        "operating.drive_inertia": "0.02 kg*m**2",
        "operating.shaft_stiffness": "3000 N*m/rad",
        "operating.shaft_damping": "0.5 N*m*s/rad",
        "operating.speed_regulation": "0.5 N*m*s/rad",
    },
    "hertz": {"mesh.hertz": "load-dependent"},
    "backlash": {"mesh.backlash": "15 um", "operating.gear_torque": "20 N*m"},
}


#: Drive, formulation and method of the balances: every one with some of the others, for each is compiled.
BALANCED = {
    ("speed", "classical", "dopri5"),
    ("speed", "energy-consistent", "rodas4"),
    ("sliding", "classical", "rodas4"),
    ("torque", "energy-consistent", "dopri5"),
    ("shaft", "classical", "dopri5"),
    ("hertz", "energy-consistent", "rodas4"),
    ("backlash", "classical", "dopri5"),
    ("backlash", "classical", "rodas4"),
}


@pytest.mark.parametrize(
    ("drive", "formulation", "method"),
    all_in_soak(product(DRIVES, ["classical", "energy-consistent"], ["dopri5", "rodas4"]), BALANCED, names=3),
)
@pytest.mark.parametrize("rtol", [1e-5, 1e-7])
def test_energy_balance_closes_within_ten_tolerances(prepared, formulation, drive, rtol, method):
    case = prepared(
        "crc-23-47",
        **DRIVES[drive],
        **{"operating.pinion_speed": "300 rad/s", "mesh.formulation": formulation},
    )
    assert _closes(case, rtol, method=method) < 10 * rtol


@pytest.mark.parametrize("formulation", ["classical", "energy-consistent"])
def test_energy_balance_closes_at_the_published_speed(prepared, formulation):
    case = prepared("crc-23-47", **{"mesh.formulation": formulation})
    assert _closes(case, 1e-6) < 1e-5


BEARINGS = [f"bearings.{gear}.stiffness_{axis}" for gear in ("pinion", "gear") for axis in "xy"]


@pytest.mark.parametrize(
    ("sliding", "speed", "torque", "method"),
    [
        ("dynamic", "10 rad/s", "500 N*m", "switching"),
        ("dynamic", "300 rad/s", "2500 N*m", "dopri5"),
        ("dynamic", "3000 rad/s", "2500 N*m", "dopri5"),
        ("kinematic", "300 rad/s", "2500 N*m", "rodas4"),
        ("dynamic", "300 rad/s", "500 N*m", "dop853"),
    ],
)
def test_energy_balance_closes_on_soft_bearings(prepared, sliding, speed, torque, method):
    """They move by a hundred times the deflection of the mesh, which alone makes the forces."""
    overrides = {key: "1e6 N/m" for key in BEARINGS} | {"friction.sliding": sliding}
    overrides |= {"operating.pinion_speed": speed, "operating.gear_torque": torque}
    assert _closes(prepared("crc-23-47", **overrides), 1e-6, method=method) < 1e-5


@pytest.mark.parametrize("method", ["dopri5", "rodas4"])
def test_energy_balance_closes_without_load(prepared, method):
    """Flanks that a transmission error rattles: the works are a millionth of those of a loaded mesh."""
    overrides = {
        "operating.gear_torque": "0 N*m",
        "operating.pinion_speed": "40 rad/s",
        "mesh.backlash": "40 um",
        "mesh.transmission_error.harmonics": [{"order": 5, "amplitude": "15 um", "phase": "86 deg"}],
    }
    assert _closes(prepared("crc-23-47", **overrides), 1e-7, method=method) < 1e-6


def test_steps_find_where_friction_turns(prepared):
    """With dynamic sliding; steps across the reversal cost five times this."""
    model = prepared("crc-23-47-300").model
    _, reference = solve(model, 1e-11)
    assert error(solve(model, 1e-6)[1], reference) < 4e-6
    assert error(solve(model, 1e-6, method="rodas4")[1], reference) < 4e-6


def test_switching_gives_the_same_motion_at_less_cost(prepared):
    """Flanks stick for a tenth of the cycle at 10 rad/s; nothing else is stiff."""
    model = prepared("crc-23-47", **{"friction.sliding": "dynamic"}).model
    state = initial_state(model, "static")
    assert choose("auto", model, state).method == "switching"
    _, reference = solve(model, 1e-9, method="rodas4", cycles=3)
    cost = {}
    for method in ("switching", "dopri5", "rodas4"):
        parts = list(transient(model, state, TransientSettings(method, 1e-6, 3, 200000, SAMPLES)))
        states = np.concatenate([part.states for part in parts if isinstance(part, SampledStates)])
        assert error(states, reference) < 3e-5
        cost[method] = parts[-1].evaluations
    assert cost["switching"] < 0.5 * cost["dopri5"]
    assert cost["switching"] < 0.7 * cost["rodas4"]


def test_stick_converges_as_the_width_shrinks(prepared):
    """At 10 rad/s, where flanks stick: creep within the width is no part of the answer."""
    found = []
    for width in ("40 um", "20 um", "10 um", "5 um"):
        overrides = {"friction.sliding": "dynamic", "friction.reversal_width": width}
        found.append(solve(prepared("crc-23-47", **overrides).model, 1e-7, 2, "switching")[1])
    changes = [error(a, found[-1]) for a in found[:-1]]
    assert changes[0] > changes[1] > changes[2]
    assert changes[1] < 5e-3


def test_parametric_work_is_there_only_in_the_classical_formulation(prepared):
    """Sizes of the prototype: 0.04 J per cycle in engagement, of 68 J transmitted."""
    work = {}
    for formulation in ("classical", "energy-consistent"):
        case = prepared("crc-23-47", **{"mesh.formulation": formulation})
        _, states = solve(case.model, 1e-7)
        work[formulation] = states[-1] - states[0]
    assert np.all(work["energy-consistent"][WORK_PARAMETRIC] == 0.0)
    per_cycle = work["classical"][WORK_PARAMETRIC] / 4
    assert 0.01 < abs(per_cycle) < 0.1
    # the motion is the same, only the drive's work differs, by exactly that
    assert work["energy-consistent"][WORK_IN] - work["classical"][WORK_IN] == pytest.approx(
        work["classical"][WORK_PARAMETRIC], rel=1e-6
    )


#: A light load, so that teeth separate.
LIGHT = {
    "operating.gear_torque": "30 N*m",
    "mesh.transmission_error.harmonics": [{"order": 1, "amplitude": "8 um", "phase": "0 deg"}],
}


@pytest.mark.parametrize(
    ("key", "widths", "load"),
    [
        ("friction.reversal_width", ["160 um", "80 um", "40 um", "20 um"], {}),
        ("mesh.contact_width", ["1.6 um", "0.8 um", "0.4 um", "0.2 um"], LIGHT),
    ],
)
def test_answer_converges_as_a_smoothing_width_shrinks(prepared, key, widths, load):
    overrides = {"operating.pinion_speed": "300 rad/s", **load}
    found = [solve(prepared("crc-23-47", **overrides, **{key: width}).model)[1] for width in widths]
    changes = [error(a, found[-1]) for a in found[:-1]]
    assert changes[0] > changes[1] > changes[2]
    assert changes[2] < 5e-3


def test_contact_is_lost_and_found(prepared):
    """The case of the test above does separate: otherwise it would prove nothing."""
    model = prepared("crc-23-47", **LIGHT, **{"operating.pinion_speed": "300 rad/s"}).model
    total = outputs(*solve(model), model)["normal_load"].sum(axis=1)
    assert np.any(total == 0.0)
    assert np.any(total > 100.0)


def test_table_converges_with_its_nodes(prepared):
    found = [
        solve(
            prepared("crc-23-47", **{"operating.pinion_speed": "300 rad/s", "mesh.points": n}).model, 1e-11
        )[1]
        for n in (5, 9, 17, 65)
    ]
    errors = [error(states, found[-1]) for states in found[:-1]]
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 1e-6


@pytest.mark.parametrize("speed", ["100 rad/s", "300 rad/s"])
def test_friction_does_its_work_on_the_recorded_sliding(speed, prepared):
    """∫ Σ F_f v_s dt of the samples is the integrated work of friction.

    Where F_f v_s is monotone between samples, jumps of an engagement included, the trapezoidal rule errs by
    no more than half its change times the step.
    """
    model = prepared("crc-23-47", **{"friction.sliding": "dynamic", "operating.pinion_speed": speed}).model
    found = recorded(model, TransientSettings("dopri5", 1e-8, 3, 200000, 2000))
    power = np.nansum(found["friction_force"] * found["sliding_speed"], axis=1)
    step, change = np.diff(found["time"]), np.abs(np.diff(power))
    work = found["work_friction"][-1] - found["work_friction"][0]
    bound = np.sum(change * step) / 2
    assert bound < 2e-3 * work
    assert np.sum((power[1:] + power[:-1]) / 2 * step) == pytest.approx(work, rel=0, abs=bound)
    np.testing.assert_allclose(power, found["power_friction"], rtol=1e-9, atol=1e-9 * np.max(power))
