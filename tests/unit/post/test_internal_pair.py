"""Pictures of an internal pair whose pitch point lies before its path of contact."""

from pathlib import Path

import numpy as np
import pytest

from tribodyn.post.cycles import key_points, outside_of
from tribodyn.post.figures.path_of_contact import key_positions
from tribodyn.post.page.motion import rolling_teeth
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

SCENARIO = """
title = "losses of a planet and its ring"
kind = "efficiency"
drive = "ring-36-93"
lubricant = "iso-vg-320-mineral"
operating = { pinion_speed = "20 rpm", gear_torque = "600 kN*m", oil_temperature = "60 degC" }
mesh = { compliance = "constant", stiffness = "7.5e9 N/m" }
friction = { law = "coulomb", coefficient = 0.06 }
output = { samples_per_cycle = 40 }
"""


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Record:
    folder: Path = tmp_path_factory.mktemp("ring")
    (folder / "ring.toml").write_text(SCENARIO, encoding="utf-8")
    result = run(load_scenario(folder / "ring.toml"), folder / "ring.h5")
    return Record(result.path)


def test_no_pair_passes_the_pitch_point(record: Record):
    names = [name for point in key_points(record) for name in point.names.values()]
    assert sorted(names) == ["B_g", "B_p", "C_g", "C_p"]
    for point in key_points(record):
        assert set(point.names) <= {0, 1}


def test_key_points_lie_on_the_line_of_action(record: Record):
    places = key_positions(record)
    assert places["P"] == (0.0, 0.0)
    angle = np.radians(15.62948932)
    for name, distance in (("B_g", 0.7354127e-3), ("B_p", 101.0197956e-3)):
        np.testing.assert_allclose(
            places[name], distance * np.array([np.cos(angle), np.sin(angle)]), rtol=1e-6
        )


def test_the_ring_is_a_hole_in_its_body(record: Record):
    assert outside_of(record.geometry) == (0.0, 1.1)
    teeth = rolling_teeth(record)
    assert teeth is not None
    assert teeth["outside"] == (0.0, 1.1)
    assert np.max(np.hypot(*record.geometry["gear_outline"].T)) < 1.1
    # the ring turns as the planet does
    column = list(record["dof"]).index("theta_g")
    assert np.all(record["velocity"][:, column] > 0.0)
