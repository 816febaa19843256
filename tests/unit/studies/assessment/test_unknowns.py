"""What is not known: drawn over its range, the same for the same seed, and not at all where it is known."""

import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.short_studies import short_case
from tribodyn.errors import InputError
from tribodyn.geometry.families.involute import tight_centre_distance
from tribodyn.input.tables.bearings import Bearing, bearing_of
from tribodyn.studies.assessment.unknowns import (
    OF_PAIR,
    UnknownsTable,
    distances,
    drawn,
    ranges_of,
    ranges_of_gearbox,
    stiffened,
)
from tribodyn.studies.motion.train.assessable import WHOLE
from tribodyn.studies.protocol.load import load_scenario

KIND, SAMPLES = "assessment", 16
KNOWN: dict[str, Any] = {"deviations": False, "bearings": 1.0, "damping_ratio": [0.05, 0.05]}


def table(**keys: Any) -> UnknownsTable:
    return UnknownsTable.model_validate(keys)


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return short_case(KIND, tmp_path_factory.mktemp("drive"), drive__centre_distance="81.1 mm")


def test_the_same_seed_draws_the_same(case: Any):
    first, again, other = (drawn(ranges_of(case, table(), 0.05), SAMPLES, seed) for seed in (3, 3, 4))
    assert first == again
    assert [draw.bearings for draw in first] != [draw.bearings for draw in other]
    assert [draw.deviation for draw in first] == list(range(3, 3 + SAMPLES))


def test_every_part_of_every_range_is_met_once(case: Any):
    varied = table(bearings=4.0, damping_ratio=[0.02, 0.08])
    draws = drawn(ranges_of(case, varied, 0.05), SAMPLES, 1)
    shares = {
        "pinion": [math.log(draw.bearings["pinion"]) / math.log(16.0) + 0.5 for draw in draws],
        "gear": [math.log(draw.bearings["gear"]) / math.log(16.0) + 0.5 for draw in draws],
        "damping": [math.log(draw.damping_ratio / 0.02) / math.log(4.0) for draw in draws],
    }
    for name, values in shares.items():
        assert sorted(np.floor(np.multiply(values, SAMPLES))) == list(range(SAMPLES)), name
    # four ranges, each in an order of its own
    assert np.max(np.abs(np.corrcoef(list(shares.values())) - np.eye(3))) < 0.75


def test_what_is_known_is_not_varied(case: Any):
    for draw in drawn(ranges_of(case, table(**KNOWN, centre_distance="0 um"), 0.05), SAMPLES, 1):
        assert draw.keys({}) == {"mesh.damping_ratio": 0.05}
        assert draw.of(case) is case


def test_the_centre_distance_stays_where_the_teeth_do_not_jam(case: Any):
    draws = drawn(ranges_of(case, table(centre_distance="1 mm"), 0.05), 64, 1)
    distances = [draw.distances[OF_PAIR] for draw in draws]
    tight = float(tight_centre_distance(case.drive))
    assert tight < min(distances) < tight + 0.1e-3
    assert 82.0e-3 < max(distances) < 82.1e-3


def test_a_drive_without_a_centre_distance_has_no_other(tmp_path: Path):
    # rack shifts of the short drive are zero: 81 mm is the mesh without backlash
    bare = short_case(KIND, tmp_path)
    alone = bare.__class__(**{**vars(bare), "drive": bare.drive._replace(centre_distance=None)})
    assert not ranges_of(alone, table(), 0.05).distances


@pytest.mark.parametrize(
    ("grade", "tolerance"), [({}, 17.5e-6), ({"drive__centre_distance_grade": 9}, 43.5e-6)]
)
def test_the_centre_distance_has_the_tolerance_of_its_js_class(tmp_path: Path, grade: Any, tolerance: float):
    """Half of IT7 (35 µm) and of IT9 (87 µm) from 80 to 120 mm: ISO 286-1; js7 where no class is given."""
    case = short_case(KIND, tmp_path, drive__centre_distance="81.1 mm", **grade)
    assert distances(case, table()) == pytest.approx((81.1e-3 - tolerance, 81.1e-3 + tolerance), abs=1e-12)


def test_bearings_and_centre_distances_of_a_train_are_drawn_by_name():
    """Half of IT7 from 120 to 180 mm, 40 µm: ISO 286-1; all bearings of one table are as stiff."""
    key, given = "stage.0.centre_distance", {"stage.0.centre_distance": "138.5 mm"}
    train = load_scenario("two-stage-reducer", given)
    scenario = tomllib.loads(train.toml)
    ranges = ranges_of_gearbox(scenario, WHOLE.meshes(train), table())
    assert not ranges.deviations  # the gears have no tolerance class
    assert ranges.bearings == {"default": 4.5}
    assert list(ranges.distances) == [key]
    assert ranges.distances[key] == pytest.approx((138.48e-3, 138.52e-3), abs=1e-12)
    draw = drawn(ranges, 4, 1)[0]
    sample = load_scenario("two-stage-reducer", draw.keys(scenario["bearings"]))
    assert sample.meshes[0].pair.drive.centre_distance == pytest.approx(draw.distances[key], abs=1e-12)
    for held, other in zip(train.links, sample.links, strict=True):
        assert other.stiffness[:2] == pytest.approx(
            [draw.bearings["default"] * k for k in held.stiffness[:2]]
        )
    assert {mesh.pair.mesh.damping_ratio for mesh in sample.meshes} == {draw.damping_ratio}
    assert set(draw.of_teeth(key)) == {OF_PAIR}
    assert not draw.of_teeth("")


def test_all_stiffnesses_of_bearings_are_multiplied():
    rolling = {"type": "cylindrical-roller", "elements": 12, "length": "12 mm", "radial_load": "5 kN"}
    for given in (
        {
            "stiffness_x": "4e8 N/m",
            "stiffness_y": "2e8 N/m",
            "stiffness_tilt": "1e6 N*m/rad",
            "damping_ratio": 0.05,
        },
        {"rolling": rolling, "span": "100 mm", "damping_ratio_x": 0.05, "damping_ratio_y": 0.04},
    ):
        held, other = (bearing_of(Bearing.model_validate(keys)) for keys in (given, stiffened(given, 3.0)))
        for name in ("stiffness_x", "stiffness_y", "stiffness_tilt"):
            before, after = getattr(held, name), getattr(other, name)
            assert after == (None if before is None else pytest.approx(3.0 * before))
        assert (other.span, other.damping_ratio_x, other.damping_ratio_y) == (
            held.span,
            held.damping_ratio_x,
            held.damping_ratio_y,
        )


@pytest.mark.parametrize(
    ("key", "value", "named"),
    [
        ("damping_ratio", [0.06, 0.1], "between the lowest and the highest"),
        ("damping_ratio", [0.06, 0.01], "between the lowest and the highest"),
        ("bearings", 0.5, "bearings"),
        ("centre_distance", 20.0, "unit"),
    ],
)
def test_ranges_that_are_none_are_refused(key: str, value: Any, named: str, tmp_path: Path):
    with pytest.raises(InputError, match=named):
        short_case(KIND, tmp_path, **{f"assessment__unknowns__{key}": value})
