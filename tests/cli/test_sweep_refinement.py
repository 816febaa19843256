"""Sweeps that add values where the response bends: what they find, with how many cases, what is refused."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import find_peaks

from tests.support.verbs import complaint, invoke, sets
from tribodyn.grid.refinement import BEND, PARTS, interval_bends
from tribodyn.input import units
from tribodyn.input.units import Kind, to_si
from tribodyn.input.vary import in_si
from tribodyn.record.sweep_reader import SweepRecord

SPEED = "operating.pinion_speed"
RPM = np.pi / 30
SHORT = sets("output.samples_per_cycle=40")


def swept(path: Path, *words: str) -> Path:
    """Sweep a drive in a range with two resonances, or another."""
    given = words if "--vary" in words else ("--vary", f"{SPEED}=1400:2600:{words[0]}rpm", *words[1:])
    invoke("sweep", "crc-23-47-300", *given, *SHORT, "-o", path)
    return path


def curve(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Speeds in rpm, RMS of the transmission error."""
    with SweepRecord(path) as record:
        return record["pinion_speed"] / RPM, record["transmission_error_rms"].ravel()


@pytest.fixture(scope="module")
def resonances(tmp_path_factory: pytest.TempPathFactory) -> tuple[np.ndarray, np.ndarray]:
    """The curve of values 5 rpm apart."""
    return curve(swept(tmp_path_factory.mktemp("fine") / "fine.h5", "5"))


def test_peaks_are_found_with_a_seventh_of_the_cases(resonances, tmp_path: Path):
    """Both resonances to 1 % of their height and 1 % of their speed, against values 5 rpm apart."""
    fine_speed, fine = resonances
    refined = swept(tmp_path / "refined.h5", "100", "--refine", "20")
    speed, error = curve(refined)
    assert len(speed) == 33 <= len(fine_speed) / 7
    assert np.all(np.diff(speed) > 0)
    tops, _ = find_peaks(fine, prominence=0.05 * np.ptp(fine))
    assert len(tops) == 2
    said = json.loads(invoke("show", refined, "--json"))
    found = sorted(said["peaks"], key=lambda peak: peak["at"]["pinion_speed"])
    assert [peak["value"] for peak in found] == pytest.approx(fine[tops], rel=0.01)
    at = np.array([peak["at"]["pinion_speed"] / RPM for peak in found])
    np.testing.assert_allclose(at, fine_speed[tops], rtol=0.01)
    # as near as is said, to the spacing of the fine ones
    assert np.all(np.abs(at - fine_speed[tops]) <= [peak["within"] / RPM + 5.0 for peak in found])
    assert "13 values and 20 more, of at most 20" in " ".join(invoke("show", refined).split())
    # the first grid alone sees neither: its highest value near the peaks is too low by more
    coarse = error[np.isin(np.round(speed, 6), np.arange(1400.0, 2601.0, 100.0))]
    assert np.max(coarse) < 0.99 * np.max(fine)


def test_a_sweep_that_is_fine_enough_stops_by_itself(tmp_path: Path):
    """Halfway between its values the straight line is off by less than the bend that counts."""
    speed, error = curve(swept(tmp_path / "s.h5", "40", "--refine", "200"))
    assert 31 < len(speed) < 231
    spacing = np.diff(speed)
    assert np.min(spacing) >= 40.0 / PARTS
    fine_speed, fine = curve(swept(tmp_path / "fine.h5", "10"))
    assert np.max(np.abs(np.interp(fine_speed, speed, error) - fine)) < BEND * np.ptp(fine)


def test_a_jump_takes_few_values_and_its_end_is_recorded_once(tmp_path: Path):
    """Upwards the branch that (almost) keeps contact ends in a fold."""
    path = tmp_path / "jump.h5"
    vary = ("--vary", f"{SPEED}=440:500:10rad/s", "--direction", "up")
    invoke("sweep", "jump-involute-23-47", *vary, "--refine", "40", *SHORT, "-o", path)
    with SweepRecord(path) as record:
        speed = record["pinion_speed"]
        jump = np.argmax(np.diff(record["contact_loss_fraction"][:, 0]))
        before, behind = speed[jump], speed[jump + 1]
        assert behind - before == pytest.approx(10.0 / PARTS)
        ends = record["end_value"][np.isfinite(record["end_value"])]
        assert len(ends) == 1
        assert before < ends[0] <= behind


def test_two_keys_share_the_further_values_and_failed_cases_are_left_out(tmp_path: Path):
    """The values are those where any of the curves bends; teeth that are pointed have no place on them."""
    vary = ("--vary", "drive.pinion.profile_shift=0:1.6:0.4", "--vary", "operating.gear_torque=100,300N*m")
    path = tmp_path / "shifts.h5"
    words = ("--refine", "4", "--refine-by", "mesh_frequency", "--refine-by", "dynamic_factor")
    invoke("sweep", "involute-23-47", *vary, *words, "--transient", "4", *SHORT, "-o", path)
    with SweepRecord(path) as record:
        shifts = record["profile_shift"]
        assert record["status"].shape == (len(shifts), 2)
        assert 5 < len(shifts) <= 9
        assert set(np.round(shifts, 12)) >= {0.0, 0.4, 0.8, 1.2, 1.6}
        assert record.count()["failed"] > 0  # pointed
        assert record.settings["refine"] == {"most": 4, "by": ["mesh_frequency", "dynamic_factor"]}


def test_other_kinds_of_study_are_refined_too(tmp_path: Path):
    vary = ("--vary", "operating.gear_torque=20:200:60N*m")
    path = tmp_path / "torques.h5"
    given = (*vary, "--refine", "3", "--refine-by", "efficiency")
    invoke("sweep", "efficiency-involute-18-36", *given, *SHORT, "-o", path)
    with SweepRecord(path) as record:
        assert len(record["gear_torque"]) == 7
        # the loss of the seals and bearings weighs more where there is less power
        assert record["gear_torque"][1] - record["gear_torque"][0] < 60.0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--vary", "friction.law=none,coulomb,constant", "--refine", "5"), "law"),
        (("--vary", f"{SPEED}=100,200rpm", "--refine", "5"), "at least 3 values in order"),
        (("--vary", f"{SPEED}=100,300,200rpm", "--refine", "5"), "at least 3 values in order"),
        (("--vary", "drive.pinion.teeth=20:26:2", "--refine", "5"), "nothing lies between"),
        (("--vary", f"{SPEED}=1:9:1rpm", "--refine", "5", "--refine-by", "dynamic_facter"), "dynamic_factor"),
        (
            ("--vary", f"{SPEED}=1:9:1rpm", "--refine", "5", "--refine-by", "mesh_load_factor"),
            "no case of this",
        ),
        (("--vary", f"{SPEED}=1:9:1rpm", "--refine-by", "efficiency"), "add --refine 40"),
        (("--vary", f"{SPEED}=1:9:1rpm", "--refine", "100000"), "too many values"),
    ],
)
def test_what_cannot_be_refined_is_refused(words: tuple[str, ...], message: str):
    assert message in complaint("sweep", "crc-23-47", *words)


@pytest.mark.parametrize("kind", [k for k in vars(units).values() if isinstance(k, Kind)], ids=str)
@pytest.mark.parametrize("value", [0.1, 157.0796326794897, 3e-9])
def test_a_value_in_between_is_read_to_the_last_bit(kind: Kind, value: float):
    assert to_si(str(in_si(value, kind.si.replace("**", ""))), kind) == value


def test_bends_of_a_broken_line():
    """A corner of height 1: its distance from the line between its neighbours is 1, of those 1/2."""
    values = np.arange(5.0)
    corner = np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    assert interval_bends(values, corner).tolist() == [0.5, 1.0, 1.0, 0.5]
    assert interval_bends(values, np.full(5, 3.0)).tolist() == [0.0] * 4
    # at 2 the case failed: 1 and 3 are neighbours, all four lie on a line
    assert interval_bends(values, np.array([0.0, 1.0, np.nan, 3.0, 4.0])).tolist() == [0.0] * 4
