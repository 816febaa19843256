"""Right-hand side and march by time as C code against Python's own arithmetic and the native kernels."""

import ctypes
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from tests.support.bearings_in_time import shafts_of
from tests.support.c_code import address, called, compiled, floats, zig_compiler
from tests.support.drawn_shafts import ROLLER
from tests.support.helical_motion import HELICAL
from tests.support.states import random_place, random_state
from tests.support.time_runs import Walker, train
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.kernels.c import CEntry, translated
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.by_time import advance, time_buffer
from tribodyn.solve.march.crossing import INTERVAL, STEPS, WHOLE
from tribodyn.solve.march.time_outputs import outputs, time_outputs
from tribodyn.solve.right_hand_side import contacts_of, rhs, work_array
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

#: Whole cycles before; loads may depend on time.
CYCLE = 2.0


def model_of(name: str, overrides: dict[str, Any]) -> Model:
    return prepare(load_scenario(name, overrides)).model


def in_c(model: Model) -> str:
    """The right-hand side of a model, and the model."""
    state = np.zeros(model.layout.states)
    arguments = (0.0, CYCLE, 0, state, model, work_array(model), state.copy())
    return translated({"derivatives": CEntry(derivatives, arguments)}, {"model": model}).source


def assert_alike(model: Model, library: Any, rng: np.random.Generator, *, native: bool) -> None:
    """Derivatives and powers at a random state of every interval, those of a run up to eight."""
    count = model.layout.states
    shared = with_shared_code(model)
    for interval in range(min(len(model.schedule.start), 8)):
        y, phase = random_state(rng, model), float(random_place(rng, model.schedule, interval)[0])
        expected, found = np.empty(count), np.empty(count)
        if native:
            powers = rhs(phase, CYCLE, interval, y, shared, work_array(model), expected)
        else:
            plain: dict = {}
            powers = derivatives(phase, CYCLE, interval, y, model, contacts_of(model), plain)
            expected[:] = [plain[i] for i in range(count)]
        arguments = phase, CYCLE, interval, y, address(library, "model"), work_array(model), found
        powers_in_c = called(library.derivatives, *arguments, result=floats(6))
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-13 * np.abs(expected).max())
        np.testing.assert_allclose(powers_in_c, powers, rtol=1e-10, atol=1e-13 * np.abs(powers).max())


#: A shaft with play under a light load.
LIGHT = {
    "friction.law": "coulomb",
    "friction.coefficient": 0.06,
    "shaft.0.stiffness": "2e5 N*m/rad",
    "shaft.0.damping_ratio": 0.05,
    "shaft.0.law": "play",
    "shaft.0.play": "0.02 deg",
    "operating.output_torque": "20 N*m",
    "operating.output_torque_harmonics": [{"amplitude": "60 N*m", "frequency": "300 Hz"}],
    "mesh.backlash": "0.1 mm",
}
CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "helical": ("helical-23-47", HELICAL),
    "two-stage-reducer": ("two-stage-reducer", {}),
    "planetary": ("planetary-24-84", {}),
    "xu": ("crc-23-47", {"friction.law": "xu"}),
    "benedict-kelley, moes": ("crc-23-47", {"friction.law": "benedict-kelley", "film.law": "moes"}),
    "masjedi-khonsari, dowson-higginson": ("crc-23-47", {"film.law": "dowson-higginson"}),
    "veciana": ("crc-23-47", {"friction.law": "masjedi-khonsari-veciana"}),
    "coulomb": ("crc-23-47", {"friction.law": "coulomb", "friction.coefficient": 0.05}),
    "clutch": ("clutch-flywheel", {}),
    "own teeth": ("run-out-25-51", {"solver.cycles": 5}),
    "ball and roller bearings in time": (
        "involute-23-47",
        {"friction.law": "none", "shaft": shafts_of(ROLLER, "in-time")},
    ),
    "play under a load that varies": ("two-stage-reducer", LIGHT),
    "three meshes, energy-consistent": (
        "two-pinions-bull-gear",
        {"mesh.formulation": "energy-consistent", "friction.law": "iso-14179-1", "mesh.backlash": "20 um"},
    ),
    "torque, energy-consistent": (
        "involute-18-36",
        {"operating.source": "torque", "mesh.formulation": "energy-consistent"},
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_c_agrees_with_python(case, tmp_path: Path, rng):
    model = model_of(*CASES[case])
    assert_alike(model, compiled(in_c(model), tmp_path), rng, native=False)


def test_c_agrees_with_the_native_kernel(tmp_path: Path, rng):
    model = model_of("crc-23-47", {})
    assert_alike(model, compiled(in_c(model), tmp_path), rng, native=True)


def test_zig_compiles_it_without_a_warning(tmp_path: Path, rng):
    model = model_of("crc-23-47", {})
    assert_alike(model, compiled(in_c(model), tmp_path, zig_compiler()), rng, native=False)


class Answer(ctypes.Structure):
    """What `advance` returns: status, steps, right-hand sides."""

    _fields_: ClassVar[Any] = [(name, ctypes.c_int64) for name in ("status", "steps", "evaluations")]


def test_a_march_by_time_in_c_takes_the_steps_of_the_native_one(tmp_path: Path):
    """Past pairs that come and go, from call to call; with its outputs."""
    walker = Walker.begun(train(start_speed="150 rad/s").model)
    model, control = walker.model, walker.control
    y, clock, work, buffer = (
        walker.y.copy(),
        walker.clock.copy(),
        work_array(model),
        time_buffer(model.layout),
    )
    out = np.zeros(len(time_outputs(model)))
    entries = {
        "advance": CEntry(advance, (0.0, control, model, y, clock, work, buffer)),
        "outputs": CEntry(outputs, (model, y, clock, work, buffer, out)),
    }
    source = translated(entries, {"model": model, "control": control}).source
    library = compiled(source, tmp_path)
    places = [address(library, name) for name in ("control", "model")]
    for time in (4e-3, 9e-3, 1.5e-2):
        expected = walker.to(time)
        found = called(library.advance, time, *places, y, clock, work, buffer, result=Answer)
        assert found[0] == Status.DONE.value
        called(library.outputs, places[1], y, clock, work, buffer, out)
        np.testing.assert_allclose(y, walker.y, rtol=1e-9, atol=1e-11 * np.abs(walker.y).max())
        np.testing.assert_array_equal(clock[[WHOLE, INTERVAL, STEPS]], walker.clock[[WHOLE, INTERVAL, STEPS]])
        np.testing.assert_allclose(out, list(expected.values()), rtol=1e-7, atol=1e-9 * np.abs(out).max())
    assert clock[WHOLE] > 3
