"""The soak itself: cases come back, outcomes are kept, and what is wrong is noticed."""

from collections import Counter

import h5py
import numpy as np
import pytest

from tools.by_schema.changes import opened
from tools.soak.cases import CASES, GROUP, KEYS, SHARES, SORTS, Refused, bare, case, sort_of, written
from tools.soak.drives import FAMILIES
from tools.soak.gear_records import faults
from tools.soak.keyed import BASES
from tools.soak.other_records import (
    assessment_faults,
    load_contact_faults,
    search_faults,
    solved_contact_faults,
    wear_faults,
)
from tools.soak.refusals import untrue
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

RTOL = 1e-6


def drive(shift: float) -> dict:
    """Return a pinion of few teeth, whose undercut leaves no contact ratio of 1 below a shift of 0.14."""
    gear = {"face_width": "20 mm", "bore_radius": "6 mm"}
    return {
        "title": "Few teeth",
        "source": "an example",
        "family": "involute",
        "module": "3 mm",
        "pressure_angle": "20 deg",
        "roughness": "0.3 um",
        "material": "steel-liu-ni-2022",
        "pinion": {"teeth": 8, "profile_shift": shift, **gear},
        "gear": {"teeth": 47, **gear},
    }


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """The record of a short run."""
    overrides = {"solver.cycles": 4, "output.samples_per_cycle": 20, "friction.law": "none"}
    short = load_scenario("crc-23-47", {**overrides, "operating.pinion_speed": "300 rad/s"})
    return run(short, tmp_path_factory.mktemp("soak") / "sound.h5").path


def test_a_case_follows_from_seed_and_number(tmp_path):
    first, again, other = (case(3, number, tmp_path) for number in (5, 5, 6))
    assert first.scenario == again.scenario
    assert first.scenario != other.scenario
    for made in (first, other):
        load_scenario(written(made.scenario, tmp_path / "case.toml"))


def test_every_sort_has_its_share_and_every_family():
    sorts = [sort_of(number) for number in range(CASES)]
    assert Counter(sorts) == {sort: share * GROUP for sort, share in SORTS.items()}
    assert all(len(set(sorts[first : first + GROUP])) == 1 for first in range(0, CASES, GROUP))
    assert sort_of(CASES) == sort_of(0)
    assert set(sorts[: CASES // 3]) == set(SORTS)
    assert sum(SORTS.values()) == SHARES


@pytest.mark.soak
def test_every_kind_is_drawn_with_every_family(tmp_path):
    """Kinds are those of the registry; of each sort of gears a group has every family."""
    kinds = {opened(name)["kind"] for name in BASES}
    first = {sort_of(number): number for number in reversed(range(0, CASES, GROUP))}
    for sort, number in first.items():
        made = [case(3, number + i, tmp_path).scenario for i in range(GROUP)]
        kinds |= {scenario["kind"] for scenario in made}
        if sort == KEYS:
            continue
        drives = [scenario.get("scenario", scenario).get("drive", {}) for scenario in made]
        if "family" in drives[0]:
            assert {drive["family"] for drive in drives} == set(FAMILIES), sort
    assert kinds == set(STUDIES)


@pytest.mark.parametrize(
    ("remedy", "expected"),
    [
        ("use at least 0.5", "is accepted"),
        ("use at least 0.01", "is refused too"),
        ("use more teeth", None),
    ],
)
def test_advice_is_tried(tmp_path, remedy, expected):
    left = "which leaves a contact ratio of 0.888 of 1.525"
    rule = f"the rack undercuts the flank up to the radius 11.46 mm, {left}"
    error = InputError("drive.pinion.profile_shift", 0.0, rule, remedy)
    said = untrue(Refused(bare(drive(0.0)), error), tmp_path)
    assert len(said) == (expected is not None)
    assert not said or expected in said[0]


def test_a_sound_record_has_no_faults(record):
    with Record(record) as sound:
        assert list(faults(sound, RTOL)) == []


@pytest.mark.parametrize(
    ("name", "factor", "expected"),
    [
        ("normal_load", -1.0, "normal_load falls to"),
        ("hertz_pressure", float("nan"), "hertz_pressure is not finite under load"),
        ("central_film_thickness", 0.5, "summary film_min"),
        ("transmission_error_rotational", 2.0, "summary peak to peak"),
        ("work_in", 1.1, "summary power_in_mean"),
    ],
)
def test_what_is_wrong_is_noticed(record, tmp_path, name, factor, expected):
    damaged = tmp_path / "damaged.h5"
    damaged.write_bytes(record.read_bytes())
    with h5py.File(damaged, "r+") as file:
        file[name][...] = factor * file[name][...]
    with Record(damaged) as wrong:
        assert any(fault.startswith(expected) for fault in faults(wrong, RTOL))


@pytest.mark.parametrize(
    ("kind", "check", "name", "factor", "expected"),
    [
        ("ehl", solved_contact_faults, "minimum_film_thickness", 2.0, "a film is not above zero"),
        ("ehl", solved_contact_faults, "asperity_load_ratio", -1.0, "asperities carry"),
        ("ehl", solved_contact_faults, "central_film_thickness", np.nan, "0 positions have a film"),
        ("wear", wear_faults, "worn_depth", -1.0, "worn_depth falls to"),
        ("load-contact", load_contact_faults, "root_tension", 1.01, "root_tension of a pair that carries"),
        ("assessment", assessment_faults, "contact_temperature", 1.01, "the contact temperature is not"),
        ("assessment", assessment_faults, "film_thickness", -1.0, "film_thickness falls to"),
        ("design", search_faults, "objective", 0.9, "the best is"),
        ("design", search_faults, "feasible", 0.0, "complete, although nothing is feasible"),
    ],
)
def test_what_is_wrong_with_a_study_is_noticed(short_runs, tmp_path, kind, check, name, factor, expected):
    sound = short_runs(kind).path
    damaged = tmp_path / "damaged.h5"
    damaged.write_bytes(sound.read_bytes())
    with Record(damaged) as whole:
        assert list(check(whole)) == []
    with h5py.File(damaged, "r+") as file:
        file[name][...] = factor * file[name][...]
    with Record(damaged) as wrong:
        assert any(fault.startswith(expected) for fault in check(wrong))
