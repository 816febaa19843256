"""A helical pair's way: the section in the middle of the face, along the inclined line of contact."""

import math

import numpy as np
import pytest

from tests.support.helical_pair import HELICAL
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.ehl import along_path
from tribodyn.studies.ehl.run import run
from tribodyn.studies.protocol.load import load_scenario

HELIX, RACK = math.radians(20.0), math.radians(20.0)
WIDTH = math.pi * 3e-3 / math.sin(HELIX)  # ε_β = 1
SCENARIO = f"""
kind = "ehl"
{HELICAL}
[output]
positions = 9
"""


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("helical") / "helical.toml"
    path.write_text(SCENARIO)
    return load_scenario(path)


@pytest.fixture(scope="module")
def study(case):
    return along_path.prepare(case)


def test_radius_speeds_and_ends_are_those_of_the_standard(study):
    """ρ_n = ρ_t/cos β_b and v = ω ρ_t: ISO/TR 15144-1, (14), (15), (43), (45), by hand in m."""
    found = along_path._way(study, 9, None)
    transverse = math.atan(math.tan(RACK) / math.cos(HELIX))
    radii = [3e-3 * z / math.cos(HELIX) / 2.0 for z in (23, 47)]
    base = [r * math.cos(transverse) for r in radii]
    tangents = [math.sqrt((r + 3e-3) ** 2 - b**2) for r, b in zip(radii, base, strict=True)]
    whole = sum(base) * math.tan(transverse)
    length = sum(tangents) - whole
    first = tangents[0] - length + (np.arange(9) + 0.5) / 9.0 * length
    second = whole - first
    lean = math.asin(math.sin(HELIX) * math.cos(RACK))
    np.testing.assert_allclose(found.radius, first * second / whole / math.cos(lean), rtol=1e-9)
    speed = 1500.0 * math.pi / 30.0
    np.testing.assert_allclose(found.speeds[0], speed * first, rtol=1e-9)
    np.testing.assert_allclose(found.speeds[1], speed * 23.0 / 47.0 * second, rtol=1e-9)
    # of whole ε_β the lines of contact have the length ε_α b/cos β_b at all times
    mean = (
        300.0
        / base[1]
        / math.cos(lean)
        / (length / (math.pi * 2.0 * base[0] / 23.0) * WIDTH / math.cos(lean))
    )
    turned = np.linspace(found.table[0][0], found.table[0][-1], 500)
    assert np.mean(np.interp(turned, *found.table)) == pytest.approx(mean, rel=0.05)


def test_a_record_has_the_solved_contact_of_the_middle(case, tmp_path):
    result = run(case, tmp_path / "found.h5")
    assert result.status == "complete"
    with Record(result.path) as record:
        film, line, radius = (
            np.asarray(record[name][:]) for name in ("central_film_smooth", "line_load", "equivalent_radius")
        )
        entrainment = np.asarray(record["entrainment_speed"][:])
    assert np.all(film > 0.0)
    # film of Hamrock & Dowson's line contact, central: proportional to U^0.69 W^−0.10 R
    middle = slice(2, 7)
    scaled = film / (radius**0.41 * entrainment**0.69 * line**-0.1)
    assert np.ptp(scaled[middle]) < 0.05 * np.mean(scaled[middle])


def test_sections_bear_together_what_the_lines_of_contact_do(study):
    """The loads of all sections over the width and the path are the work of the torque on the gear."""
    cycle, limits = study.cycle, along_path.roll_limits(study)
    turned = np.linspace(*limits, 400)
    stretch = 1.0 / math.cos(math.asin(math.sin(HELIX) * math.cos(RACK)))
    means = []
    for at in range(cycle.slices):
        nodes, loads = along_path.section_line_loads(cycle, at, 300.0, None, limits)
        means.append(float(np.mean(np.interp(turned, nodes, loads))) * stretch)
    # neighbours on both sides carry for a section in the middle; free bodies hand on less than held ones
    assert np.ptp(means) > 3e-3 * np.mean(means)
    path = (limits[1] - limits[0]) / float(cycle.pitch_angle)
    base = 47 * 3e-3 / math.cos(HELIX) / 2.0 * math.cos(math.atan(math.tan(RACK) / math.cos(HELIX)))
    normal = 300.0 / base * stretch
    assert np.mean(means) * path * WIDTH == pytest.approx(normal, rel=0.02)


def test_a_place_off_the_face_or_of_a_spur_pair_is_refused(tmp_path):
    path = tmp_path / "helical.toml"
    path.write_text(SCENARIO)
    with pytest.raises(InputError, match=r"contact\.face_position = 40 mm: off the face"):
        load_scenario(path, {"contact.face_position": "40 mm"})
    with pytest.raises(InputError, match=r"contact\.face_position.*is of helical pairs"):
        load_scenario("ehl-crc-23-47", {"contact.face_position": "4 mm"})
