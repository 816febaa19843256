"""What slices cost, as a ratio to the spur pair in the same run."""

import pytest

from tests.support.timing import least
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

pytestmark = pytest.mark.bench

CYCLES, SAMPLES = 20, 200


def test_eleven_slices_run_in_twelve_times_the_time_of_the_spur_pair(capsys):
    """Teeth, duty and laws alike; in space, with friction."""

    def run(**keys):
        model = prepare(load_scenario("involute-23-47", keys)).model
        state = static_equilibrium(model)
        tolerances = tolerances_from(model, state, 1e-6, 10**6)
        return lambda: make_integrator("dopri5", model, SAMPLES, tolerances).integrate(state, 0, CYCLES)

    helical = run(**{"drive.helix_angle": "20 deg", "mesh.slices": 11})
    times = least([helical, run()], 5)
    ratio = times[0] / times[1]
    with capsys.disabled():
        milliseconds = [f"{1e3 * time:.1f} ms" for time in times]
        print(f"\n{CYCLES} cycles of 11 slices and of the spur pair: {', '.join(milliseconds)}")
    assert ratio < 12.0
