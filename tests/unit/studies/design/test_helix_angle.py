"""A search over the helix angle, with the overlap that it must keep."""

import pytest

from tests.support.helical_pair import HELICAL
from tribodyn.studies.design.run import run
from tribodyn.studies.protocol.load import load_scenario

SEARCH = """
title = "Helix angle of least loss"
kind = "design"
scenario = "base.toml"

[design]
minimise = "power_friction_mean"
subject_to = ["overlap_ratio <= 1.2"]
free = [{ key = "drive.helix_angle", from = "10 deg", to = "28 deg" }]
evaluations = 14
sensitivities = false
"""


def test_the_helix_angle_is_free(tmp_path):
    """A larger helix shortens the path, up to the limit of the overlap: sin β = 1.2 sin 20°."""
    friction = '[friction]\nlaw = "coulomb"\ncoefficient = 0.05\n'
    base = f'kind = "efficiency"\n{HELICAL}\n{friction}[mesh]\nslices = 11\n'
    (tmp_path / "base.toml").write_text(base)
    (tmp_path / "search.toml").write_text(SEARCH)
    found = run(load_scenario(tmp_path / "search.toml"), tmp_path / "found.h5").summary
    angle = float(found["best"]["drive.helix_angle"].removesuffix(" deg"))
    assert angle == pytest.approx(24.23, abs=0.1)
    assert found["quantities_best"]["overlap_ratio"] <= 1.2 + 1e-6
    assert found["quantities_best"]["power_friction_mean"] < found["quantities_start"]["power_friction_mean"]
