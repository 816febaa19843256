"""What is not known: drawn over its range, the same for the same seed, and not at all where it is known."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.short_studies import short_case
from tribodyn.errors import InputError
from tribodyn.geometry.families.involute import tight_centre_distance
from tribodyn.input.tables.bearings import Bearing, bearing_of
from tribodyn.studies.assessment.parts import ranges_of_case
from tribodyn.studies.assessment.unknowns import OF_PAIR, Ranges, UnknownsTable, distances, drawn, stiffened
from tribodyn.studies.protocol.load import load_data, load_scenario

KIND, SAMPLES = "assessment", 16
KNOWN: dict[str, Any] = {"deviations": False, "bearings": 1.0, "damping_ratio": [0.05, 0.05]}


def table(**keys: Any) -> UnknownsTable:
    return UnknownsTable.model_validate(keys)


def ranges_of(case: Any, unknowns: UnknownsTable) -> Ranges:
    settings = case.settings.model_copy(update={"unknowns": unknowns})
    found = ranges_of_case(replace(case, settings=settings))
    assert found is not None
    return found


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return short_case(KIND, tmp_path_factory.mktemp("drive"), drive__centre_distance="81.1 mm")


def test_the_same_seed_draws_the_same(case: Any):
    first, again, other = (drawn(ranges_of(case, table()), SAMPLES, seed) for seed in (3, 3, 4))
    assert first == again
    assert [draw.bearings for draw in first] != [draw.bearings for draw in other]
    assert [draw.deviation for draw in first] == list(range(3, 3 + SAMPLES))


def test_every_part_of_every_range_is_met_once(case: Any):
    varied = table(bearings=4.0, damping_ratio=[0.02, 0.08])
    draws = drawn(ranges_of(case, varied), SAMPLES, 1)
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
    for draw in drawn(ranges_of(case, table(**KNOWN, centre_distance="0 um")), SAMPLES, 1):
        assert draw.keys({}) == {"mesh.damping_ratio": 0.05}
        assert draw.of(case.pair) is case.pair


def test_the_centre_distance_stays_where_the_teeth_do_not_jam(case: Any):
    draws = drawn(ranges_of(case, table(centre_distance="1 mm")), 64, 1)
    distances = [draw.distances[OF_PAIR] for draw in draws]
    tight = float(tight_centre_distance(case.pair.drive))
    assert tight < min(distances) < tight + 0.1e-3
    assert 82.0e-3 < max(distances) < 82.1e-3


def test_a_drive_without_a_centre_distance_has_no_other(tmp_path: Path):
    # rack shifts of the short drive are zero: 81 mm is the mesh without backlash
    bare = short_case(KIND, tmp_path)
    alone = replace(bare.pair, drive=bare.pair.drive._replace(centre_distance=None))
    assert distances(alone, table()) is None


@pytest.mark.parametrize(
    ("grade", "tolerance"), [({}, 17.5e-6), ({"drive__centre_distance_grade": 9}, 43.5e-6)]
)
def test_the_centre_distance_has_the_tolerance_of_its_js_class(tmp_path: Path, grade: Any, tolerance: float):
    """Half of IT7 (35 µm) and of IT9 (87 µm) from 80 to 120 mm: ISO 286-1; js7 where no class is given."""
    case = short_case(KIND, tmp_path, drive__centre_distance="81.1 mm", **grade)
    assert distances(case.pair, table()) == pytest.approx(
        (81.1e-3 - tolerance, 81.1e-3 + tolerance), abs=1e-12
    )


def test_bearings_and_centre_distances_of_a_train_are_drawn_by_name():
    """Half of IT7 from 120 to 180 mm, 40 µm: ISO 286-1; all bearings of one table are as stiff."""
    key = "stage.0.centre_distance"
    data = {"title": "x", "kind": "assessment", "scenario": "two-stage-reducer"}
    case = load_data(data, "x", {f"scenario.{key}": "138.5 mm"}).case
    train, scenario = case.gearbox.case, tomllib.loads(case.gearbox.case.toml)
    ranges = ranges_of(case, table())
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
    assert set(draw.of_mesh(key).keys({})) == {OF_PAIR, "mesh.damping_ratio"}
    assert set(draw.of_mesh("").keys({})) == {"mesh.damping_ratio"}


def test_pins_of_planets_are_drawn_about_what_is_given():
    """Half of IT7 from 80 to 120 mm, 35 µm, of the circle on which the planets of 24/30/-84 teeth stand."""
    key = "scenario.stage.0.tangential_pin_errors"
    data = {"title": "x", "kind": "assessment", "scenario": "planetary-24-84"}
    case = load_data(data, "x", {key: ["40 um", "0 um", "0 um"]}).case
    draws = drawn(ranges_of(case, table()), SAMPLES, 1)
    pins = np.array([draw.pins["stage.0.tangential_pin_errors"] for draw in draws]) - [40e-6, 0.0, 0.0]
    for of_planet in pins.T:
        assert sorted(np.floor((of_planet + 17.5e-6) / 35e-6 * SAMPLES)) == list(range(SAMPLES))
    overrides = draws[0].keys(tomllib.loads(case.gearbox.case.toml)["bearings"])
    sample = load_scenario("planetary-24-84", overrides)
    given = tomllib.loads(sample.toml)["stage"][0]["tangential_pin_errors"]
    assert [float(text.removesuffix(" m")) for text in given] == draws[0].pins[
        "stage.0.tangential_pin_errors"
    ]


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
