"""A solver that gives up leaves a partial record, says when and why, and exits with 3."""

import numpy as np
import pytest

from tests.support.pair_outputs import outputs
from tests.support.states import SLIP, altered
from tribodyn.errors import SimulationError
from tribodyn.record.reader import Record
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion import run as simulate
from tribodyn.studies.protocol.load import load_scenario


def run(folder, **overrides):
    return simulate.run(load_scenario("crc-23-47", overrides), folder / "out.h5")


@pytest.mark.parametrize("method", ["dopri5", "rodas4", "lsoda", "radau"])
def test_too_many_steps(tmp_path, method):
    result = run(tmp_path, **{"solver.method": method, "solver.max_steps": 40, "solver.cycles": 3})
    assert result.status == "failed"
    assert "solver.max_steps" in result.message
    assert result.path == tmp_path / "out.partial.h5"
    assert not (tmp_path / "out.h5").exists()
    record = Record(result.path)
    assert record.status == "failed"
    assert record.message == result.message
    assert np.all(np.isfinite(record["time"]))
    stated = float(result.message.split("t = ")[1].split(" s")[0])
    assert -1e-12 < stated - record["time"][-1] < 2 * (record["time"][1] - record["time"][0])


@pytest.mark.parametrize("method", ["dopri5", "rodas4"])
def test_a_pinion_that_stalls(tmp_path, method):
    """A motor far too weak: the pinion comes to rest, and what was done until then is kept."""
    result = run(
        tmp_path,
        **{
            "operating.source": "torque",
            "operating.pinion_torque": "1 N*m",
            "operating.drive_inertia": "0.05 kg*m**2",
            "solver.cycles": 20,
            "solver.method": method,
        },
    )
    assert result.status == "failed"
    assert "came to rest" in result.message
    record = Record(result.path)
    assert 1 < record.samples < 20 * 200
    speed = np.asarray(record["velocity"])[:, 4]
    assert np.all(speed > 0)
    assert speed[-1] < speed[0]
    for name in ("pinion_angle", "transmission_error_rotational", "power_in"):
        assert np.all(np.isfinite(record[name]))


def test_a_sample_at_rest_is_recorded(prepared):
    """An engagement may stop the pinion: rates with respect to the phase have no limit, powers do."""
    model = prepared("crc-23-47").model
    state = static_equilibrium(model)
    state[SLIP] = -model.operation.nominal_speed
    block = outputs(np.array([0.3]), state[None], model)
    assert block["power_in"][0] == 0.0
    for name in ("velocity", "normal_load", "power_out", "power_friction", "power_damping", "stored_energy"):
        assert np.all(np.isfinite(block[name])), name


def test_no_equilibrium_at_the_start(prepared):
    """A load that pulls the flanks apart, without back flanks to catch it."""
    model = prepared("crc-23-47").model
    model = altered(model, bodies={"load": np.array([0.0, -100.0])})
    with pytest.raises(SimulationError, match="equilibrium"):
        static_equilibrium(model)


def test_a_solution_that_stops_being_finite_is_told(prepared):
    """NaN must end the run, not pass the error control."""
    model = prepared("crc-23-47").model
    state = static_equilibrium(model)
    broken = altered(model, mesh={"damping": float("nan")})
    tolerances = tolerances_from(model, state, 1e-6, 100000)
    for method in ("dopri5", "rodas4", "radau"):
        part = make_integrator(method, broken, 50, tolerances).integrate(state, 0, 2)
        assert part.status == Status.NOT_FINITE
        assert part.reached < 0.01
