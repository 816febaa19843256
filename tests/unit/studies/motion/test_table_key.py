"""Cases with the same key share one table: every field outside the key leaves the table alone."""

import dataclasses

import jax
import numpy as np
import pytest

from tribodyn.gears.tabulated import _tabulated, table_key, tables
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

#: Overrides that leave the table alone, and overrides that do not.
OUTSIDE = {
    "operating.pinion_speed": "1500 rpm",
    "operating.gear_torque": "20 N*m",
    "mesh.damping_ratio": 0.01,
    "mesh.contact_width": "1 um",
    "mesh.formulation": "energy-consistent",
    "lubricant.inlet_viscosity": "0.1 Pa*s",
    "bearings.pinion.stiffness_x": "1e8 N/m",
    "friction.law": "none",
    "drive.roughness": "0.6 um",
    "solver.cycles": 3,
    "output.samples_per_cycle": 40,
}
INSIDE = {
    "drive.module": "3.1 mm",
    "drive.pinion.profile_shift": 0.1,
    "drive.gear.face_width": "19 mm",
    "drive.material.density": "7000 kg/m**3",
    "mesh.points": 33,
    "mesh.backlash": "50 um",
    "mesh.hertz": "load-dependent",
    "mesh.foundation": "ring",
    "mesh.transmission_error.harmonics": [{"order": 1, "amplitude": "2 um"}],
}
NAME = "involute-23-47"


@pytest.mark.parametrize("key", OUTSIDE)
def test_equal_keys_mean_equal_tables(key: str):
    base, other = load_scenario(NAME), load_scenario(NAME, {key: OUTSIDE[key]})
    assert base != other
    assert table_key(base.pair) == table_key(other.pair)
    # the latter as if no table were kept
    same, made = prepare(other, (tables(base.pair),)), prepare(other, (_tabulated(other.pair),))
    assert same.inertias == made.inertias
    for ours, theirs in zip(same.cycle, made.cycle, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    for ours, theirs in zip(same.model.meshes[0].table, made.model.meshes[0].table, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    for part in ("bodies", "links", "schedule", "operation"):
        both = (jax.tree.leaves(getattr(each.model, part)) for each in (same, made))
        for ours, theirs in zip(*both, strict=True):
            np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize("key", INSIDE)
def test_what_makes_another_table_changes_the_key(key: str):
    assert table_key(load_scenario(NAME).pair) != table_key(load_scenario(NAME, {key: INSIDE[key]}).pair)


def test_finite_elements_are_tabulated_at_their_torque():
    name, torque = "involute-18-36-fem", {"operating.gear_torque": "20 N*m"}
    assert table_key(load_scenario(name).pair) != table_key(load_scenario(name, torque).pair)


def test_a_new_field_of_a_case_matters_until_it_is_said_not_to():
    case = load_scenario(NAME).pair
    wider = dataclasses.make_dataclass(
        "Wider", [("new", int)], bases=(type(case),), frozen=True, kw_only=True
    )
    fields = {field.name: getattr(case, field.name) for field in dataclasses.fields(case)}
    assert table_key(wider(**fields, new=1)) != table_key(wider(**fields, new=2))


@pytest.mark.parametrize(("name", "torque"), [("helical-23-47", "20 N*m"), ("involute-18-36-fem", "100 N*m")])
def test_tables_that_are_made_under_load_hang_on_it(name: str, torque: str):
    """Slices of helical teeth hold each other by what touches: equal keys would give another load's table."""
    base, other = load_scenario(name).pair, load_scenario(name, {"operating.gear_torque": torque}).pair
    assert table_key(base) != table_key(other)
    if name.startswith("helical"):
        gap, other_gap = tables(base).cycle.gap, tables(other).cycle.gap
        assert np.max(np.abs(gap - other_gap)) > 0.1 * np.max(np.abs(gap))
