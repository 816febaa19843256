"""A search over a planet and its ring: the ring's interferences as constraints, and where no gears are."""

from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.geometry.limits.limits import LIMITS
from tribodyn.studies.design.candidates.evaluation import distance_from_limits

BASE = {
    "title": "an efficiency",
    "kind": "efficiency",
    "drive": "cycloidal-ring-24-72",
    "lubricant": "iso-vg-100-mineral",
    "operating": {"pinion_speed": "600 rpm", "gear_torque": "600 N*m", "oil_temperature": "60 degC"},
    "mesh": {"load_sharing": "uniform"},
    "friction": {"law": "coulomb", "coefficient": 0.05},
    "output": {"samples_per_cycle": 8},
}
CIRCLE, ADDENDUM = "drive.shape.recess_circle", "drive.gear.addendum"


def test_a_search_keeps_the_tips_of_a_ring_apart(tmp_path: Path):
    found = td.design(
        BASE,
        output=tmp_path / "a.h5",
        free={CIRCLE: ("16 mm", "60 mm"), ADDENDUM: (0.7, 1.2)},
        minimise="loss",
        subject_to=["trochoidal_clearance >= 0.5 mm", "contact_ratio >= 1.6"],
        evaluations=30,
    )
    assert td.constraints("cycloidal-ring-24-72")["trochoidal_clearance"] < 0.5e-3
    assert found.status == "complete"
    best = td.constraints(BASE["drive"], found.best)
    assert best["trochoidal_clearance"] >= 0.5e-3 * (1 - 1e-6)
    assert found.objective < found.objective_start
    assert min(best.values()) > 0.0


@pytest.mark.parametrize(
    ("name", "key", "value", "limit"),
    [
        ("cycloidal-ring-24-72", "drive.gear.teeth", 31, "trochoidal_clearance"),
        ("cycloidal-ring-24-72", "drive.gear.cutter_teeth", 7, "tool_flank"),
        ("ring-36-93", "drive.gear.tip_diameter", "1820 mm", "base_circle"),
    ],
)
def test_what_a_ring_cannot_be_has_a_negative_distance(name: str, key: str, value: object, limit: str):
    with pytest.raises(td.InputError):
        td.drive(name, {key: value})
    found = td.constraints(name, {key: value})
    assert list(found) == list(LIMITS)
    assert found[limit] < 0.0
    assert distance_from_limits(BASE | {"drive": name}, {key: value}) < 0.0
    assert min(td.constraints(name).values()) > 0.0


def test_slopes_of_a_rings_distances_are_those_of_differences():
    names = ["trochoidal_clearance", "tool_flank", "interference_gear", "rack_tip_gear"]
    for key, step, unit in ((CIRCLE, 1e-6, " m"), (ADDENDUM, 1e-5, "")):
        function = td.differentiable("cycloidal-ring-24-72", names, key)
        at = function.at[0]
        ends = [
            td.constraints("cycloidal-ring-24-72", {key: f"{value!r}{unit}" if unit else value})
            for value in (float(at + step), float(at - step))
        ]
        _, slopes = function.jacobian(function.at)
        for name, slope in zip(names, slopes, strict=True):
            expected = (ends[0][name] - ends[1][name]) / (2 * step)
            assert float(slope[0]) == pytest.approx(expected, rel=1e-5, abs=1e-9)
