"""A helical run as its verbs see it: summary, figures, page, sweep; and what is refused."""

from importlib import import_module

import numpy as np
import pytest

import tribodyn as td
from tribodyn.dynamics.parameters import frictionless
from tribodyn.post.cycles import key_points, path_limits
from tribodyn.post.figures.over_face import flank_map
from tribodyn.post.figures.path_of_contact import key_positions
from tribodyn.post.page.motion import rolling_teeth
from tribodyn.record.reader import Record
from tribodyn.solve.initial import static_equilibrium
from tribodyn.studies.motion.batch import BATCH
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.pages import figure
from tribodyn.studies.protocol.load import load_scenario

SHORT = {"solver.cycles": 3, "mesh.slices": 5, "friction.law": "none"}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory):
    return td.run("helical-23-47", SHORT, output=tmp_path_factory.mktemp("helical") / "one.h5")


@pytest.fixture(scope="module")
def record(run) -> Record:
    return Record(run.path)


def test_the_summary_has_what_the_helix_adds(run):
    found = run.summary
    overlap = 25.0 * np.sin(np.radians(20.0)) / (np.pi * 3.0)
    assert found["overlap_ratio"] == pytest.approx(overlap, rel=1e-12)
    assert found["total_contact_ratio"] == pytest.approx(found["contact_ratio"] + overlap, rel=1e-12)
    assert found["slices"] == 5
    # without friction and on the mean the tangential load at the reference circles, times tan β
    tangential = 300.0 / (47 * 1.5e-3 / np.cos(np.radians(20.0)))
    assert found["axial_force_mean"] == pytest.approx(-tangential * np.tan(np.radians(20.0)), rel=1e-3)
    assert found["line_load_max"] >= np.max(run.data.line_load[-1])


def test_the_mean_friction_coefficient_is_coulombs_whatever_the_slices_do():
    """On both sides of the pitch line of one pair friction acts to either side; the loss is that of both."""
    coulomb = {"friction.law": "coulomb", "friction.coefficient": 0.05}
    found = td.run("helical-23-47", SHORT | coulomb).summary
    assert found["friction_coefficient_mean"] == pytest.approx(0.05, rel=1e-5)


def test_the_map_carries_the_load_of_its_lines_of_contact(record):
    """Along the lines of one position the map has the load of all pairs."""
    found, table = flank_map(record), record.mesh_cycle
    assert found.values.min() >= 0.0
    assert found.roll[[0, -1]] == pytest.approx(path_limits(record))
    pitch, slope = 2 * np.pi / 23, table["pitch_slope"] / table["pinion_pitch_radius"]
    lines = table["roll_start"] + pitch * (0.3 + np.arange(3))
    on = [
        np.interp(lines - z * slope, found.roll, row, left=0.0, right=0.0)
        for z, row in zip(found.face, found.values, strict=True)
    ]
    sample = record.samples - 1 - 200 + 60  # the same position in the last cycle
    # slices that touch in part have less than their width: their load is left out by the map
    expected = np.sum(record["line_load"][sample])
    assert np.sum(on) == pytest.approx(expected, rel=0.1)


def test_key_points_are_of_the_whole_face_and_the_picture_of_its_middle(record):
    names = {name for point in key_points(record) for name in point.names.values()}
    assert names == {"B_g", "P", "B_p"}
    places = key_positions(record)
    path = record.geometry["path_of_contact"]
    assert np.allclose([places["B_g"], places["B_p"]], path[[0, -1]], atol=1e-8)
    assert rolling_teeth(record)["pairs"] == len(record.pairs)


@pytest.mark.parametrize("name", ["line-load", "in-space", "mesh-stiffness"])
def test_figures_are_drawn(record, name: str):
    assert figure(name, [record, record]).axes


def test_a_sweep_has_the_modes_and_states_in_space():
    data = td.sweep("helical-23-47", {"operating.gear_torque": ["200 N*m", "300 N*m"]}, overrides=SHORT)
    assert data.sizes["mode"] == 11
    # 12 coordinates, their rates and 6 works; a motor's angle and speed are missing without a shaft
    assert np.isfinite(np.asarray(data["state"])).sum(axis=-1).tolist() == [30, 30]


def test_a_case_of_a_sweep_starts_from_its_own_equilibrium():
    evaluate = import_module("tribodyn.studies.motion.batch.evaluate")
    held = ({"bearings.gear.stiffness_axial": f"{stiffness} N/m"} for stiffness in (1e9, 2e7))
    cases = [load_scenario("helical-23-47", {**SHORT, **keys}) for keys in held]
    settings = BATCH.settings(cases, None, "native")
    for case in cases:
        ready = prepare(case)
        expected = static_equilibrium(frictionless(ready.model))
        assert evaluate._start(ready, settings)[:12] == pytest.approx(expected[:12], rel=1e-3, abs=1e-9)
