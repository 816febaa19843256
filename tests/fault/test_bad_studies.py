"""Studies that cannot be: refused with key and remedy, or stopped with the reason."""

import numpy as np
import pytest

from tribodyn.errors import InputError, SimulationError
from tribodyn.record.reader import Record
from tribodyn.studies.pages import compare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

STUDY, OSCILLATOR = "efficiency-involute-18-36", "backlash-oscillator"
BACK = {"operating.gear_torque": "-5 N*m"}
BACKLASH = {"mesh.backlash": "0.05 mm"}
HARMONICS = {"mesh.transmission_error.harmonics": [{"order": 1, "amplitude": "2 um"}]}
NO_LOAD = {"operating.gear_torque": "0 N*m"}

#: Scenario, overrides, what is said.
MISTAKES = [
    ("crc-23-47", BACK, r"operating\.gear_torque = -5 N\*m: .*mesh\.backlash"),
    (
        "crc-23-47",
        BACKLASH | BACK | HARMONICS,
        r"mesh\.transmission_error\.harmonics.*driving flanks.*leave it out",
    ),
    (
        "involute-18-36-fem",
        BACKLASH | NO_LOAD,
        r'operating\.gear_torque = 0 N\*m: contradicts compliance = "fem"',
    ),
    ("efficiency-crc-23-47", NO_LOAD, r"operating\.gear_torque = 0 N\*m: must not be zero.*-500"),
    ("load-contact-18-36", BACK, r"operating\.gear_torque.*must be greater than zero"),
    *(
        (STUDY, overrides, said)
        for overrides, said in (
            ({"friction.law": "coulomb"}, r"friction\.coefficient: missing"),
            ({"friction.coefficient": 0.05}, r"friction\.coefficient = 0\.05: contradicts"),
            ({"friction.law": "xuu"}, r'did you mean "xu"'),
            ({"mesh.load_sharing": "half"}, r"mesh\.load_sharing"),
            ({"mesh.damping_ratio": 0.1}, r"mesh\.damping_ratio"),
            ({"output.samples_per_cycle": 2}, r"samples_per_cycle"),
        )
    ),
    *(
        (OSCILLATOR, overrides, said)
        for overrides, said in (
            ({"damping": -0.1}, r"damping = -0\.1: must be at least 0"),
            ({"stiffness_variation": 1.5}, r"stiffness_variation = 1\.5: must be at most 1"),
            ({"frequency": []}, r"frequency = \[\]: an empty list"),
            ({"frequency": [0.5, 0.5]}, "frequency = .*does not increase"),
            ({"frequency": [0.5, "fast"]}, r'frequency\.1 = "fast": not a plain number'),
            ({"frequency": [0.0, 0.5]}, r"frequency\.0 = 0\.0: must be greater than 0"),
            ({"frequency": 0.7}, r"frequency = 0\.7: not a list"),
            ({"frequency.to": 0.1}, r"ends at 0\.1 and starts at 0\.2"),
            ({"frequency.step": 5.0}, "longer than the range"),
            ({"frequency.step": 1e-9}, "more than 100000 frequencies"),
            ({"frequency.stop": 1.0}, r'frequency\.stop = 1\.0: unknown key; did you mean "step"'),
            ({"frequency": {"from": 0.2, "to": 1.0}}, r"frequency\.step: missing"),
            ({"solver.max_periods": 3}, r"solver\.max_periods = 3: must be at least 24"),
        )
    ),
]


@pytest.mark.parametrize(("name", "overrides", "said"), MISTAKES, ids=lambda value: str(value)[:40])
def test_what_is_wrong_is_named(name, overrides, said):
    with pytest.raises(InputError, match=said):
        load_scenario(name, overrides)


def test_loads_on_back_flanks_that_a_study_can_take():
    load_scenario("crc-23-47", BACKLASH | BACK)
    load_scenario("involute-18-36-fem", BACKLASH | BACK)
    load_scenario("rattle", HARMONICS)


@pytest.mark.parametrize(
    ("name", "overrides", "said"),
    [
        (STUDY, {"mesh.load_sharing": "single-pair", "drive.gear.addendum": 0.4}, "not cover half a pitch"),
        (STUDY, {"drive.pinion.profile_shift": 2.0}, "drive"),
        ("efficiency-cycloidal-23-47", {"friction.law": "iso-14179-1"}, r"friction\.law.*vanish"),
    ],
)
def test_teeth_that_do_not_fit_leave_no_file(name, overrides, said, tmp_path):
    with pytest.raises(InputError, match=said):
        run(load_scenario(name, overrides), tmp_path / "study.h5")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("sharing", ["elastic", "uniform", "single-pair"])
def test_friction_that_locks_the_mesh_is_told(sharing, tmp_path):
    locked = {"friction.law": "coulomb", "friction.coefficient": 6, "mesh.load_sharing": sharing}
    with pytest.raises(SimulationError, match="locks the mesh"):
        run(load_scenario(STUDY, locked), tmp_path / "study.h5")
    assert list(tmp_path.iterdir()) == []


UNBOUNDED = {"damping": 0.005, "mean_force": 50.0, "error_amplitude": 0.02, "stiffness_variation": 0.3}


def test_points_without_bounded_motion_are_reported_and_the_others_kept(tmp_path):
    result = run(load_scenario(OSCILLATOR, {**UNBOUNDED, "frequency": [1.5, 2.0, 2.5]}), tmp_path / "some.h5")
    assert result.status == "complete"
    assert result.summary["points_failed"] == 2
    assert "without bound" in result.summary["remark_1"]
    with Record(result.path) as record:
        assert np.all(np.isnan(record["rms_displacement"][1]))
        assert np.all(record["stable"][[0, 2]] == 1.0)


def test_a_sweep_without_any_bounded_motion_fails(tmp_path):
    result = run(load_scenario(OSCILLATOR, {**UNBOUNDED, "frequency": [2.0]}), tmp_path / "none.h5")
    assert result.status == "failed"
    assert "without bound" in result.message
    with Record(result.path) as record:
        assert record.status == "failed"
        assert record.path.name == "none.partial.h5"


def test_sweeps_are_drawn_together_and_not_compared(tmp_path):
    path = run(load_scenario(OSCILLATOR, {"frequency": [0.5]}), tmp_path / "sweep.h5").path
    with Record(path) as first, Record(path) as second:
        with pytest.raises(InputError, match="draw them into one figure"):
            compare([first, second])
