"""Efficiency studies that cannot be: refused with key and remedy, or stopped with the reason."""

import pytest

from tribodyn.errors import InputError, SimulationError
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

STUDY = "efficiency-involute-18-36"


@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        ({"friction.law": "coulomb"}, r"friction\.coefficient: missing"),
        ({"friction.coefficient": 0.05}, r"friction\.coefficient = 0\.05: contradicts"),
        ({"friction.law": "xuu"}, r'did you mean "xu"'),
        ({"operating.gear_torque": "0 N*m"}, r"operating\.gear_torque"),
        ({"mesh.load_sharing": "half"}, r"mesh\.load_sharing"),
        ({"mesh.damping_ratio": 0.1}, r"mesh\.damping_ratio"),
        ({"output.samples_per_cycle": 2}, r"samples_per_cycle"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_what_is_wrong_is_named(overrides, said):
    with pytest.raises(InputError, match=said):
        load_scenario(STUDY, overrides)


@pytest.mark.parametrize(
    ("name", "overrides", "said"),
    [
        (
            STUDY,
            {"mesh.load_sharing": "single-pair", "drive.gear.addendum": 0.4},
            "does not cover half a pitch",
        ),
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
