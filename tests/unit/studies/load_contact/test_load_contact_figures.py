"""Figures of load contact studies, from a short run: units of axes, pairs followed from cycle to cycle."""

from collections.abc import Iterator
from typing import Any, cast

import numpy as np
import pytest

from tests.support.short_studies import ShortRuns
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.load_contact.maps import (
    at_pitch_point,
    face_edges,
    face_map,
    over_phase,
    over_roll,
    pair_over_phase,
)
from tribodyn.studies.pages import figure

pytestmark = pytest.mark.slow

LABELS = {
    "loaded-error": ["Transmission error (µm)"],
    "load-sharing": ["Normal load of each pair (N)", "Share of the load (%)"],
    "line-load": ["Place on the face (mm)", "Line load (N/mm)", "Line load (N/mm)"],
    "pressure-map": ["Place on the face (mm)", "Hertz pressure (GPa)"],
    "root-stress": ["Root tension (MPa)", "", "Root compression (MPa)", ""],
    "stress": [
        *(2 * ["From the gear's axis (mm)", "Along the profile (mm)"]),
        "von Mises stress (MPa)",
    ],
    "mesh-stiffness": ["Mesh stiffness (N/µm)"],
}


class OfTeeth(dict[str, np.ndarray]):
    """A record of teeth that differ."""

    pairs = (0, 1, 2)


@pytest.fixture(scope="module")
def record(short_runs: ShortRuns) -> Iterator[Record]:
    with Record(short_runs("load-contact").path) as opened:
        yield opened


@pytest.mark.parametrize("name", LABELS)
def test_axes_carry_engineers_units(record: Record, name: str):
    assert [axes.get_ylabel() for axes in figure(name, [record]).axes] == LABELS[name]


def test_a_map_of_torques_needs_torques(record: Record):
    with pytest.raises(InputError, match="gear_torques"):
        figure("harris", [record])


def test_one_cycle_is_shown_twice_because_it_repeats(record: Record):
    phase, error = over_phase(record, "loaded_transmission_error")
    count = record.samples
    np.testing.assert_allclose(phase, np.arange(2 * count + 1) / count, atol=1e-12)
    np.testing.assert_array_equal(error[: count + 1], error[count:])


def test_a_pair_goes_on_in_the_number_before(record: Record):
    """At the end of a cycle the curve of pair 1 ends where that of pair 0 begins."""
    ends, begins = (pair_over_phase(record, "normal_load", pair) for pair in (1, 0))
    last = np.flatnonzero(np.isnan(ends[0]))[0] - 1
    assert ends[0][last] == pytest.approx(1.0)
    assert ends[1][last] == pytest.approx(begins[1][0])


def test_a_pair_is_followed_over_its_roll_angle(record: Record):
    """It carries most about the pitch point, where the next pair may touch under load; none at the ends."""
    roll, load = over_roll(record, record["normal_load"])
    assert np.all(np.diff(roll) > 0)
    assert load[0] == load[-1] == 0.0
    assert 0.9 * load.max() < np.interp(0.0, roll, load) <= load.max()


@pytest.mark.parametrize("cycles", [3, 5])
def test_one_pair_of_teeth_is_followed_through_its_life(cycles):
    """The first that begins: of three numbers, the third of the first cycle; each has a value of its own."""
    phase = np.arange(4 * cycles) / 4
    tooth = np.floor(phase)[:, None] + np.arange(3)
    record = OfTeeth(phase=phase, roll_angle=phase[:, None] - tooth)
    roll, values = over_roll(cast(Any, record), tooth)
    np.testing.assert_array_equal(values, 2.0)
    np.testing.assert_allclose(roll, np.arange(12) / 4 - 2.0)


def test_a_map_covers_the_contact_and_the_face(record: Record):
    """From the last position before contact to the first one behind it."""
    found = face_map(record, "line_load")
    assert found.values.shape == (len(found.roll), len(found.face))
    loaded = np.any(found.values > 0.0, axis=1)
    assert not loaded[0]
    assert np.all(loaded[1:-1])
    assert not loaded[-1]
    np.testing.assert_allclose(found.face, record["slice"])
    width, edges = record.mesh_cycle["face_width"], face_edges(record)
    np.testing.assert_allclose((edges[1:] + edges[:-1]) / 2.0, found.face, atol=1e-12)
    assert edges[-1] - edges[0] == pytest.approx(width)
    nearest = np.unravel_index(np.argmin(np.abs(record["roll_angle"])), record["roll_angle"].shape)
    load = np.mean(at_pitch_point(record, "line_load")) * width
    assert load == pytest.approx(record["normal_load"][nearest], rel=1e-6)
