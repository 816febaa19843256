"""Load contact studies of helical pairs: what a record holds, and that its picture follows the helix."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.record.reader import Record
from tribodyn.studies.pages import figure

HELICAL = {
    "drive.helix_angle": "20 deg",
    "output.positions_per_cycle": 12,
    "lubricant": "liu-ni-2022",
    "operating.pinion_speed": "1500 rpm",
    "film.law": "dowson-higginson",
    "drive.roughness": "1e-6 um",  # a film of smooth flanks
}
PAIR = "load-contact-18-36"


@pytest.fixture(scope="module")
def run() -> td.Run:
    return td.run(PAIR, HELICAL)


def test_a_helical_face_is_in_slices_and_carries_the_torque(run):
    assert run.summary["slices"] == 21
    assert run.summary["torque_residual"] < 1e-9
    assert run.summary["contact_ratio_effective"] > run.summary["contact_ratio"] + 0.5
    data = run.data
    # load along the normal per length of the line of contact, b/cos β_b
    base = np.arcsin(np.sin(np.radians(20.0)) * np.cos(np.radians(20.0)))
    length = 26.7e-3 / 21 / np.cos(base)
    found = data["line_load"].values.sum(axis=-1) * length
    np.testing.assert_allclose(found, data["normal_load"].values, rtol=1e-6)


def test_lines_of_contact_run_across_the_face(run):
    """A place of the face is loaded later by z tan β/r of pinion rotation, on the whole."""
    data = run.data
    roll, load = data["roll_angle"].values, data["line_load"].values
    middle = np.sum(roll[..., None] * load, axis=(0, 1)) / np.sum(load, axis=(0, 1))
    radius = 3e-3 * 18 / 2 / np.cos(np.radians(20.0))
    slope = np.polyfit(data["slice"].values, middle, 1)[0]
    assert slope == pytest.approx(np.tan(np.radians(20.0)) / radius, rel=0.1)


def test_the_pitch_line_of_the_map_leans_with_the_helix(run):
    with Record(run.path) as record:
        drawn = figure("line-load", [record])
        (line,) = [line for axes in drawn.axes for line in axes.lines if line.get_linestyle() == ":"]
        roll, face = line.get_data()
    radius = 3e-3 * 18 / 2 / np.cos(np.radians(20.0))
    expected = np.degrees(np.tan(np.radians(20.0)) / radius) * 1e-3
    assert np.polyfit(face, roll, 1)[0] == pytest.approx(expected, rel=1e-6)


def test_the_film_sees_the_line_of_contact(run):
    """Dowson and Higginson's with R_t/cos β_b and the load per length of the line, at the pitch point."""
    data = run.data
    roll, middle = data["roll_angle"].values, 10
    at = np.unravel_index(np.argmin(np.abs(roll)), roll.shape)
    load = data["line_load"].values[at][middle]
    transverse = np.arctan(np.tan(np.radians(20.0)) / np.cos(np.radians(20.0)))
    base = np.arcsin(np.sin(np.radians(20.0)) * np.cos(np.radians(20.0)))
    pitch = np.array([18.0, 36.0]) * 3e-3 / 2 / np.cos(np.radians(20.0))
    along = pitch[0] * np.cos(transverse) * roll[at] * np.array([1.0, -1.0])
    radii = pitch * np.sin(transverse) + along
    radius = np.prod(radii) / np.sum(radii) / np.cos(base)
    entrainment = np.pi * 1500 / 30 * (radii[0] + radii[1] / 2) / 2
    modulus = 207e9 / (1 - 0.3**2)
    speed, material, pressed = 0.35 * entrainment, 25e-9 * modulus, load / (modulus * radius)
    expected = 2.65 * radius * (speed / (modulus * radius)) ** 0.7 * material**0.54 * pressed**-0.13
    found = data["central_film_thickness"].values[at][middle]
    assert found == pytest.approx(expected, rel=1e-9)


def test_one_slice_of_a_helical_face_is_refused():
    with pytest.raises(td.InputError, match=r"mesh\.slices"):
        td.run(PAIR, HELICAL | {"mesh.slices": 1})
