"""Derivatives of quantities by a scenario's numbers: closed forms, and central differences of other runs."""

import math

import jax
import numpy as np
import pytest

import tribodyn as td
from tribodyn.derivatives import numbers
from tribodyn.derivatives.differentiable import FORWARDS, _program, fixed_of
from tribodyn.derivatives.quantities import QUANTITIES, PairEvaluation, quantity_of
from tribodyn.errors import InputError
from tribodyn.geometry.limits.limits import LIMITS
from tribodyn.studies import study_of

#: One scenario of every family, and the number that shapes its teeth.
FAMILIES = {
    "efficiency-involute-18-36": "drive.pressure_angle",
    "crc-23-47": "drive.pressure_angle",
    "circular-arc-23-47": "drive.shape.approach_diameter",
    "cycloidal-23-47": "drive.shape.approach_circle",
    "parabolic-23-47": "drive.shape.k1",
    "points-23-47": "drive.pressure_angle",
    "s-gear-23-47": "drive.shape.form_factor",
    "spline-23-47": "drive.shape.angles.2",
}
INVOLUTE = "efficiency-involute-18-36"


def value_of(case, quantity, fixed):
    return float(quantity.function(PairEvaluation(case, fixed)))


def numbers_of(case):
    return numbers.numbers_of(case, study_of({"kind": case.kind}).table())


def quantity(case, of):
    """Without a compiled program."""
    return value_of(case, quantity_of(case, of), fixed_of(case))


#: Families of which the slopes are asked for in every run.
QUICK = (INVOLUTE, "cycloidal-23-47", "points-23-47", "spline-23-47")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "shape"),
    [
        pytest.param(*family, marks=() if family[0] in QUICK else pytest.mark.soak)
        for family in FAMILIES.items()
    ],
)
def test_contact_ratio_of_every_family(name, shape):
    """Against the ratio of gears that are made anew, with the number written into their scenario."""
    lower = {"drive.gear.addendum": 0.97}
    found = td.gradient(name, "contact_ratio", ["drive.gear.addendum", shape], lower)
    assert found.unit == "1"
    for key, slope in found.gradient.items():
        at, unit = found.at[key], found.units[key]
        step = 1e-5 * at
        ends = [
            td.drive(name, {**lower, key: value if unit == "1" else f"{value!r} {unit}"}).contact_ratio
            for value in (at + step, at - step)
        ]
        assert slope == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=1e-5, abs=1e-6)
    assert found.value == pytest.approx(td.drive(name, lower).contact_ratio, rel=1e-12)


def test_closed_forms():
    """a = m (z1 + z2)/2 without shift; Hertz's pressure goes with √T and 1/√b; b of the narrower gear."""
    distance = td.gradient(INVOLUTE, "centre_distance", ["drive.module", "drive.pinion.addendum"])
    assert distance["drive.module"] == pytest.approx(27.0, rel=1e-12)
    assert distance["drive.pinion.addendum"] == 0.0
    assert (distance.unit, distance.units["drive.module"]) == ("m", "m")
    keys = ["operating.gear_torque", "drive.pinion.face_width", "drive.gear.face_width"]
    narrow = {"drive.gear.face_width": "20 mm"}
    pressure = td.gradient(INVOLUTE, "hertz_pressure", keys, narrow)
    assert pressure.sensitivity[keys[0]] == pytest.approx(0.5, rel=1e-10)
    assert pressure[keys[1]] == 0.0
    assert pressure.sensitivity[keys[2]] == pytest.approx(-0.5, rel=1e-10)
    sine = math.sin(math.radians(20.0))
    radius = td.gradient(INVOLUTE, "equivalent_radius", "drive.module")
    assert radius.value == pytest.approx(sine / (1 / 0.027 + 1 / 0.054), rel=1e-12)
    assert radius.sensitivity["drive.module"] == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize(
    "name", ["efficiency-involute-18-36", "efficiency-crc-23-47", "efficiency-cycloidal-23-47"]
)
def test_efficiency_is_that_of_the_efficiency_study(name):
    case = td.scenario(name)
    summary = td.run(name).summary
    assert quantity(case, "efficiency") == pytest.approx(summary["efficiency_elastic"], abs=2e-7)
    # extremes at nodes of the table, and in samples
    if name == "efficiency-crc-23-47":
        for of in ("hertz_pressure_max", "film_min", "film_parameter_min", "flash_temperature_max"):
            assert quantity(case, of) == pytest.approx(summary[of], rel=2e-3), of
        lost = summary["power_friction_mean"]
        assert quantity(case, "power_friction_mean") == pytest.approx(lost, rel=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["efficiency-involute-18-36", "efficiency-crc-23-47", "cycloidal-23-47"])
def test_losses_can_be_traced(name):
    """With all numbers traced, mean and local laws: what the compiled programs are made of."""
    case = td.scenario(name)
    quantity, fixed = quantity_of(case, "efficiency"), fixed_of(case)
    known = numbers_of(case)

    def traced(values):
        changed = case
        for number, value in zip(known.values(), values, strict=True):
            changed = number.put(changed, value)
        return quantity.function(PairEvaluation(changed, fixed))

    with jax.enable_x64(True):
        found = jax.eval_shape(traced, [float(number.value) for number in known.values()])
    assert (found.shape, found.dtype) == ((), np.float64)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((INVOLUTE, "eficiency", ["drive.module"]), 'did you mean "efficiency"'),
        ((INVOLUTE, "noise", ["drive.module"]), "there is: contact_ratio, "),
        ((INVOLUTE, "efficiency", ["drive.pinion.teeth"]), "no key to differentiate by"),
        ((INVOLUTE, "efficiency", ["drive.modul"]), 'did you mean "drive.module"'),
        ((INVOLUTE, "efficiency", []), "nothing to differentiate by"),
        (("crc-23-47", "contact_ratio", ["drive.pinion.profile_shift"]), "drive.pinion.addendum"),
        (("involute-18-36-fem", "mean_stiffness", ["drive.module"]), 'mesh.compliance = "fem"'),
        (("cycloidal-23-47", "hertz_pressure", ["drive.module"]), "infinite at the pitch point"),
        (("backlash-oscillator", "contact_ratio", ["damping"]), "no gear pair"),
        (("load-contact-18-36", "efficiency", ["drive.module"]), "[friction]"),
    ],
)
def test_what_cannot_be_differentiated(arguments, said):
    with pytest.raises(td.InputError) as error:
        td.gradient(*arguments)
    assert said in str(error.value)


def differences(case, of, keys):
    """Central differences of quantities that are evaluated without a compiled program."""
    known = numbers_of(case)
    found = np.empty((len(of), len(keys)))
    for column, key in enumerate(keys):
        step = 1e-5 * (abs(known[key].value) or 1.0)
        ends = [known[key].put(case, known[key].value + sign * step) for sign in (1, -1)]
        for row, name in enumerate(of):
            found[row, column] = (quantity(ends[0], name) - quantity(ends[1], name)) / (2 * step)
    return found


@pytest.mark.parametrize("keys", [3, pytest.param(FORWARDS + 1, marks=pytest.mark.soak)])
def test_distances_and_their_slopes_of_a_free_form_path(keys):
    """Forwards and backwards, of one program for all keys."""
    of = ["interference_gear"] if keys > FORWARDS else ["undercut_pinion", "tip_thickness_gear"]
    function = td.differentiable("spline-23-47", of, [f"drive.shape.angles.{i}" for i in range(keys)])
    values, slopes = function.jacobian(function.at)
    case = td.scenario("spline-23-47")
    assert values == pytest.approx([td.constraints("spline-23-47")[name] for name in of], rel=1e-12)
    expected = differences(case, of, function.wrt)
    np.testing.assert_allclose(slopes, expected, rtol=1e-5, atol=1e-7 * np.abs(expected).max())
    # values of no tooth: distances all the same
    beyond = function.at + np.radians([60.0, -50.0] + [0.0] * (keys - 2))
    values, slopes = function.jacobian(beyond)
    assert np.all(np.isfinite(values))
    assert np.all(np.isfinite(slopes))


def test_a_differentiable_function_says_what_it_is_of():
    function = td.differentiable("spline-23-47", ["film_min", "contact_ratio"], ["drive.shape.path_length"])
    assert function.of == ("film_min", "contact_ratio")
    assert function.units == ("m", "1")
    assert function.key_units == ("m",)
    assert function.at == pytest.approx([0.018])
    with pytest.raises(td.InputError, match="no key to differentiate by"):
        td.differentiable("spline-23-47", "film_min", "drive.shape.angles.7")
    with pytest.raises(td.InputError, match=r"drive.shape.angles.6"):
        td.differentiable("spline-23-47", "film_min", "drive.shape.angles")


@pytest.mark.parametrize("name", FAMILIES)
def test_distances_of_every_family_that_can_be_made_are_positive(name):
    found = td.constraints(name)
    assert list(found) == list(LIMITS)
    assert min(found.values()) > 0.0
    assert found == td.constraints(td.drive(name))


#: Overrides that `check` refuses, and the distances that say so.
BEYOND = {
    "undercut": ("involute-18-36", {"drive.pinion.profile_shift": -0.6}, "undercut_pinion"),
    "in the fillet": ("involute-18-36", {"drive.pinion.profile_shift": -0.2}, "interference_pinion"),
    "pointed": ("involute-18-36", {"drive.pinion.profile_shift": 1.2}, "tip_thickness_pinion"),
    "tip in root": ("crc-23-47", {"drive.gear.addendum": 1.3}, "clearance_gear"),
    "parts": (
        "crc-23-47",
        {"drive.gear.addendum": 0.4, "drive.pinion.addendum": 0.4},
        "contact_ratio_above_1",
    ),
    "singular": ("parabolic-23-47", {"drive.shape.k1": 0.49}, "undercut_gear"),
    "ends": ("cycloidal-23-47", {"drive.shape.recess_circle": "2 mm"}, "contact_ratio_above_1"),
    "corners": ("crc-23-47", {"drive.pinion.fillet_radius": 0.5}, "rack_tip_pinion"),
    "free form": (
        "spline-23-47",
        {"drive.shape.angles.0": "8 deg", "drive.shape.angles.1": "12 deg"},
        "undercut_pinion",
    ),
}


@pytest.mark.parametrize("name", BEYOND)
def test_what_check_refuses_has_a_negative_distance(name):
    scenario, overrides, distance = BEYOND[name]
    with pytest.raises(td.InputError):
        td.drive(scenario, overrides)
    assert td.constraints(scenario, overrides)[distance] < 0.0


@pytest.mark.soak
@pytest.mark.parametrize("of", QUANTITIES)
@pytest.mark.parametrize("name", FAMILIES)
def test_every_quantity_and_key_of_every_family(name, of):
    """Against central differences; what hardly depends on a key is compared with the quantity itself."""
    _program.cache_clear()
    jax.clear_caches()  # compiled programs of all of them fill the memory
    case = td.scenario(name)
    known = numbers_of(case)
    try:
        found = td.gradient(case, of, list(known))
    except td.InputError as error:
        pytest.skip(str(error))
    quantity, fixed = quantity_of(case, of), fixed_of(case)
    for key, number in known.items():
        scale = abs(number.value) or 1.0
        step = 1e-5 * scale
        ends = [value_of(number.put(case, number.value + s * step), quantity, fixed) for s in (1, -1)]
        difference = (ends[0] - ends[1]) / (2 * step)
        assert found[key] == pytest.approx(difference, rel=2e-5, abs=1e-6 * abs(found.value) / scale), key


def test_a_temperature_that_moves_with_the_losses_is_not_differentiated():
    with pytest.raises(InputError, match="temperature that does not move"):
        td.gradient("efficiency-oil-18-36", "efficiency", "operating.oil_temperature")
