"""Figures of load contact studies: what is drawn, in which units; no picture is compared."""

from pathlib import Path

import numpy as np
import pytest

from tests.support import synthetic_load_contact
from tests.support.synthetic_load_contact import END, LOAD, PITCH, START, WIDTH
from tribodyn.errors import InputError
from tribodyn.record.reader import Record, open_record
from tribodyn.studies.load_contact.figures import DRAWINGS
from tribodyn.studies.load_contact.rolled import (
    at_pitch_point,
    face_map,
    over_phase,
    over_roll,
    pair_over_phase,
)
from tribodyn.studies.pages.pictures import figure, names


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> list[Record]:
    folder = tmp_path_factory.mktemp("studies")
    return [
        open_record(synthetic_load_contact.write(folder / "aligned.h5", tilt=0.0)),
        open_record(synthetic_load_contact.write(folder / "tilted.h5", tilt=0.5)),
    ]


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Record:
    """One slice, one torque."""
    path = tmp_path_factory.mktemp("plain") / "plain.h5"
    return open_record(synthetic_load_contact.write(path, slices=1, tilt=0.0, torques=()))


#: A film is drawn by test_face_film.
NAMES = tuple(name for name in DRAWINGS if name not in ("overview", "film-map"))
LABELS = {
    "loaded-error": ["Transmission error (µm)", "Transmission error (µm)"],
    "load-sharing": ["Normal load of each pair (N)", "Share of the load (%)"],
    "line-load": ["Place on the face (mm)", "Line load (N/mm)", "Line load (N/mm)"],
    "pressure-map": ["Place on the face (mm)", "Hertz pressure (GPa)"],
    "root-stress": ["Root tension (MPa)", "", "Root compression (MPa)", ""],
    "mesh-stiffness": ["Mesh stiffness (N/µm)"],
    "harris": ["Peak to peak (µm)", "Loaded error less its mean (µm)"],
}


@pytest.mark.parametrize("name", NAMES)
def test_axes_carry_engineers_units(records: list[Record], name: str):
    assert [axes.get_ylabel() for axes in figure(name, records[:1]).axes] == LABELS[name]


@pytest.mark.parametrize("name", [*NAMES[:-1], "overview"])
def test_a_study_of_one_slice_and_torque_is_drawn(plain: Record, name: str):
    figure(name, [plain]).draw_without_rendering()


def test_a_map_needs_torques(plain: Record, records: list[Record]):
    assert names(records) == NAMES
    assert names([records[0], plain]) == NAMES[:-1]
    with pytest.raises(InputError, match="gear_torques"):
        figure("harris", [plain])


def test_one_cycle_is_shown_twice_because_it_repeats(plain: Record):
    phase, error = over_phase(plain, "loaded_transmission_error")
    assert phase[0] == 0.0
    assert phase[-1] == 2.0
    assert np.all(np.diff(phase) > 0)
    np.testing.assert_allclose(error, 1.2e-5 + 2e-6 * np.cos(2 * np.pi * phase))


def test_a_pair_goes_on_in_the_number_before(plain: Record):
    """At the end of a cycle the curve of pair 1 ends where that of pair 0 begins."""
    ends, begins = (pair_over_phase(plain, "normal_load", pair) for pair in (1, 0))
    last = np.flatnonzero(np.isnan(ends[0]))[0] - 1
    assert ends[0][last] == pytest.approx(1.0)
    assert ends[1][last] == pytest.approx(begins[1][0])


def test_a_pair_is_followed_over_its_roll_angle(plain: Record):
    roll, load = over_roll(plain, plain["normal_load"])
    assert np.all(np.diff(roll) > 0)
    assert np.all(load[(roll <= START) | (roll >= END)] == 0.0)
    # a single pair carries everything between the places where its neighbours are in contact
    alone = (roll > END - PITCH + 1e-9) & (roll < START + PITCH - 1e-9)
    np.testing.assert_allclose(load[alone], LOAD)


def test_where_teeth_differ_one_pair_is_followed(tmp_path: Path):
    """Through the cycles in which it is the newest, the one before, …"""
    with open_record(synthetic_load_contact.write(tmp_path / "long.h5", cycles=4, torques=())) as record:
        tooth = np.floor(record["phase"])[:, None] + np.array(record.pairs)
        roll, followed = over_roll(record, tooth)
        assert np.all(np.diff(roll) > 0)
        np.testing.assert_array_equal(followed, followed[0])


def test_a_map_covers_the_contact_and_the_face(records: list[Record]):
    found = face_map(records[1], "line_load")
    assert found.values.shape == (len(found.roll), len(found.face))
    assert np.degrees(found.roll[0]) == pytest.approx(np.degrees(START), abs=1.0)
    # from the last position before contact to the first one behind it
    loaded = np.any(found.values > 0.0, axis=1)
    assert not loaded[0]
    assert np.all(loaded[1:-1])
    assert not loaded[-1]
    np.testing.assert_allclose(found.face, records[1]["slice"])
    # the tilted load grows along the face
    middle = np.argmin(np.abs(found.roll))
    assert np.all(np.diff(found.values[middle]) > 0)
    np.testing.assert_allclose(np.mean(at_pitch_point(records[1], "line_load")), LOAD / WIDTH)
