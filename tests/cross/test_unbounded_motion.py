"""A motion that grows without bound ends every method, lane and batch in the same way, early."""

import numpy as np
import pytest

from tests.support.feeding_bearing import fed_by_a_bearing
from tribodyn.record.reader import Record
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.step_control import unbounded
from tribodyn.solve.methods import METHODS, Runs
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion import run as simulate
from tribodyn.studies.protocol.load import load_scenario

SAMPLES = 50
#: Friction that presses the flanks together the more, the more they are pressed: no bearings would hold it.
RUNAWAY = {
    "friction.law": "coulomb",
    "friction.coefficient": 5.0,
    **{f"bearings.{gear}.stiffness_{axis}": "3e6 N/m" for gear in ("pinion", "gear") for axis in "xy"},
}
METHODS_ON_CPU = [name for name, entry in METHODS.items() if entry.runs is not Runs.JAX]


@pytest.fixture(scope="module")
def tame(prepared):
    """A model of the kind that most tests integrate, so that no kernel is compiled for these."""
    return prepared("crc-23-47-300").model


@pytest.fixture(scope="module")
def case(tame):
    """Model and state: a bearing that feeds whatever moves in it."""
    fed = fed_by_a_bearing(tame)
    return fed, static_equilibrium(fed)


def reached(case, method):
    model, state = case
    tolerances = tolerances_from(model, state, 1e-6, 10**6)
    found = make_integrator(method, model, SAMPLES, tolerances).integrate(state, 0, 5)
    assert found.status == Status.UNBOUNDED
    assert not any(unbounded(sample, model) for sample in found.samples)
    return found.reached


@pytest.fixture(scope="module")
def by_dopri5(case):
    """Mesh cycles after which the explicit native method stops: exponential growth, and early."""
    cycles = reached(case, "dopri5")
    assert 0.1 < cycles < 5.0
    return cycles


@pytest.mark.parametrize("method", [name for name in METHODS_ON_CPU if name != "dopri5"])
def test_every_method_stops_at_the_same_place(case, by_dopri5, method):
    assert reached(case, method) == pytest.approx(by_dopri5, abs=0.02)


def test_lanes_stop_it_and_leave_the_others_alone(case, by_dopri5, tame):
    states = np.array([case[1], static_equilibrium(tame)])
    found = march([case[0], tame], states, cycles=5, window=5, samples=SAMPLES, rtol=1e-6)
    assert found.status.tolist() == [Status.UNBOUNDED, Status.DONE]
    assert found.reached[0] == pytest.approx(by_dopri5, abs=0.02)
    assert not unbounded(found.state[0], case[0])
    assert np.isfinite(found.samples[1]).all()


def test_a_run_fails_and_says_what_to_do(tmp_path):
    result = simulate.run(load_scenario("crc-23-47", RUNAWAY), tmp_path / "out.h5")
    assert result.status == "failed"
    assert "the motion grew without bound" in result.message
    assert "t = " in result.message
    assert "less friction" in result.message
    with Record(result.path) as record:
        assert np.max(np.abs(record["transmission_error_rotational"])) < 0.2
