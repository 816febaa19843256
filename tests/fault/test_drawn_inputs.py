"""What scenarios drawn from the schema ended in: an error inside, or a warning; now each is refused."""

import shutil
import warnings
from pathlib import Path
from typing import Any

import h5py
import pytest

from tests.support.planet_sets import planet_set
from tests.support.short_studies import ShortRuns
from tests.support.train_scenarios import case_of_table
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.pages import figure, names
from tribodyn.studies.protocol.load import load_scenario

#: Of a path that stands still.
POINTS = {name: {"unit": "mm", "values": [0.0, 0.0, 0.0, 1.0]} for name in "xy"}


@pytest.mark.parametrize("more", [{"pinion.thickness_allowance": "-50 um"}, {"gear.tip_rounding": "0.1 mm"}])
def test_a_path_is_checked_before_backlash_and_rounded_tips_are_computed(more: dict[str, Any]):
    changed = {"drive.shape.points": POINTS} | {f"drive.{key}": value for key, value in more.items()}
    with pytest.raises(InputError, match="the path doubles back") as refused:
        load_scenario("points-23-47", changed)
    assert refused.value.key == "drive.shape.points"


def test_planets_on_a_shift_that_leaves_no_distance():
    table = planet_set()
    table["gear"]["sun"]["profile_shift"] = -9.0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(InputError, match="closer than their base circles allow"):
            case_of_table(table)


def test_a_planets_bearing_without_the_length_of_its_rollers():
    table = planet_set()
    rolling = {"type": "cylindrical-roller", "elements": 12, "radial_load": "1 kN", "contact_angle": "0 deg"}
    table["bearings"] = {"default": {"rolling": rolling, "damping_ratio": 0.05}}
    with pytest.raises(InputError, match="missing") as refused:
        case_of_table(table)
    assert refused.value.key == "bearings.default.rolling.length"


@pytest.mark.slow
def test_a_search_whose_evaluations_are_all_alike_is_drawn(short_runs: ShortRuns, tmp_path: Path):
    path = tmp_path / "alike.h5"
    shutil.copyfile(short_runs("design").path, path)
    with Record(path) as record:
        start = record.summary["objective_start"]
    with h5py.File(path, "r+") as file:
        objective: Any = file["objective"]
        objective[...] = start
    with warnings.catch_warnings(), Record(path) as record:
        warnings.simplefilter("error")
        for name in names([record]):
            figure(name, [record])
