"""Derivatives of internal pairs and planetary sets against central differences of other computations."""

import numpy as np
import pytest

import tribodyn as td
from tests.support.slopes import compare, in_toml, shipped
from tests.support.soak_parameters import all_in_soak

RING, SET = "ring-36-93", "planetary-24-84"
#: Constant stiffness and friction: a set whose program is quickly made.
PLAIN = {
    "mesh": {"compliance": "constant", "stiffness": "4e8 N/m", "damping_ratio": 0.06},
    "friction": {"law": "coulomb", "coefficient": 0.05},
}


def planetary(**tables):
    """The shipped set; without a centre distance the ring's is that of sun and planets."""
    table = shipped(SET)
    del table["stage"][0]["centre_distance"]
    return table | tables


def differences(function, at, step=1e-5):
    """Central differences by every key of `at`, over the same relative step: columns."""
    columns = []
    for key, (value, unit) in at.items():
        ends = []
        for sign in (1.0, -1.0):
            ends.append(np.array(function({key: in_toml(value + sign * step * abs(value), unit)})))
        columns.append((ends[0] - ends[1]) / (2.0 * step * abs(value)))
    return np.array(columns).T


def test_internal_teeth_by_the_keys_of_their_drawing():
    """Keys are written without signs, as diameters where the scenario has these."""
    keys = ["drive.module", "drive.centre_distance", "drive.gear.profile_shift", "drive.gear.tip_diameter"]
    keys += ["drive.gear.cutter_rounding", "drive.pinion.tip_diameter", "drive.gear.thickness_allowance"]
    of = ["contact_ratio", "clearance_gear", "rack_tip_gear", "trochoidal_clearance"]
    of += ["tip_thickness_gear"]
    gap = {"drive.gear.profile_shift_of": "gap", "drive.gear.profile_shift": -0.1171}

    def sheet(changed):
        overrides = gap | changed
        distances, pair = td.constraints(RING, overrides), td.drive(RING, overrides)
        return [pair.contact_ratio, *(distances[name] for name in of[1:])]

    function = td.differentiable(RING, of, keys, gap)
    values, slopes = function.jacobian(function.at)
    assert function.at[1:4] == pytest.approx([0.584, -0.1171, 1.906081])
    assert values == pytest.approx(sheet({}), rel=1e-12)
    at = dict(zip(keys, zip(function.at, function.key_units, strict=True), strict=True))
    expected = differences(sheet, at)
    np.testing.assert_allclose(slopes, expected, rtol=1e-5, atol=1e-7 * np.abs(expected).max())


def test_closed_forms():
    """a = m (z2 − z1)/2; of a set without a given distance all meshes have m (z1 + z2)/2."""
    found = td.gradient("cycloidal-ring-24-72", "centre_distance", ["drive.module"])
    assert found.value == pytest.approx(24.0 * found.at["drive.module"], rel=1e-12)
    assert found["drive.module"] == pytest.approx(24.0, rel=1e-12)
    itself = td.gradient(RING, "centre_distance", "drive.centre_distance")["drive.centre_distance"]
    assert itself == pytest.approx(1.0, rel=1e-12)
    for mesh in ("set-sun-2", "set-ring-3"):
        found = td.gradient(planetary(), f"{mesh}.centre_distance", "stage.0.module")
        assert found["stage.0.module"] == pytest.approx(27.0, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    "names", all_in_soak([["contact_ratio"], ["contact_ratio", "hertz_pressure"]], [["contact_ratio"]])
)
def test_a_planetary_set(names):
    """A planet is in both meshes; its shift moves the ring's pressure angle by the sun's centre distance."""
    of = [f"set-{mesh}.{name}" for mesh in ("sun-1", "ring-2") for name in names]
    keys = ["gear.planet.profile_shift", "stage.0.module", "operating.output_torque", "gear.ring.addendum"]
    shifts = {"gear.planet.profile_shift": -0.05, "gear.sun.profile_shift": 0.05}
    compare(planetary(), of, keys, shifts, alone=False)


@pytest.mark.slow
def test_losses_of_a_set_are_those_of_efficiency_studies(tmp_path):
    """Central differences of a study of its own of the sun's and of the ring's mesh, three planets each."""
    file = tmp_path / "set.toml"

    def losses(changed):
        case = td.scenario(planetary(**PLAIN), changed)
        file.write_text(case.toml, encoding="utf-8")
        lost = 0.0
        for mesh in ("set-sun-1", "set-ring-1"):
            study = {"kind": "efficiency", "title": mesh, "gearbox": {"scenario": str(file), "mesh": mesh}}
            lost += 3.0 * td.run(study).summary["power_friction_mean"]
        return [lost]

    keys = ["gear.planet.addendum", "operating.input_speed"]
    function = td.differentiable(planetary(**PLAIN), "friction_power", keys)
    values, slopes = function.jacobian(function.at)
    assert values == pytest.approx(losses({}), rel=1e-5)
    at = dict(zip(keys, zip(function.at, function.key_units, strict=True), strict=True))
    np.testing.assert_allclose(slopes, differences(losses, at, 1e-3), rtol=1e-3)


@pytest.mark.soak
def test_bores_that_follow_from_the_module():
    """Without a bore and an outer diameter in the scenario these grow with the module, as in a run."""
    bare = planetary()
    for gear in bare["gear"].values():
        gear.pop("bore_diameter", None)
        gear.pop("outer_diameter", None)
    compare(bare, ["set-ring-1.mean_stiffness"], ["stage.0.module"], rel=1e-4)
    compare(bare, ["set-ring-1.mean_stiffness"], ["gear.ring.outer_diameter"], rel=1e-4)


@pytest.mark.parametrize(
    ("wrt", "said"),
    [
        ("gear.ring.teeth", "whole number, by which nothing can be differentiated; vary it: td.sweep("),
        ("stage.0.planets", "whole number"),
        ("stage.0.centre_distanc", "no key to differentiate by"),
        ("gear.ring.bore_diameter", "no key to differentiate by"),
    ],
)
def test_what_cannot_be_differentiated(wrt, said):
    with pytest.raises(td.InputError) as error:
        td.gradient(SET, "efficiency", wrt)
    assert said in str(error.value)
