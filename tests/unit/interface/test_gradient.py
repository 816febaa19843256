"""Derivatives of quantities by a scenario's numbers: closed forms, and central differences of other runs."""

import math
from contextlib import suppress

import jax
import numpy as np
import pytest
from jax.extend.core import jaxprs_in_params

import tribodyn as td
from tests.support.soak_parameters import all_in_soak
from tribodyn.derivatives import numbers
from tribodyn.derivatives.differentiable import FORWARDS, fixed_of
from tribodyn.derivatives.quantities import QUANTITIES, PairEvaluation, quantity_of
from tribodyn.errors import InputError
from tribodyn.geometry.limits.limits import LIMITS
from tribodyn.studies import study_of

INVOLUTE = "efficiency-involute-18-36"
#: Families of which the slopes are asked for in every run, and the number that shapes their teeth.
QUICK = {
    INVOLUTE: "drive.pressure_angle",
    "cycloidal-23-47": "drive.shape.approach_circle",
    "points-23-47": "drive.pressure_angle",
    "spline-23-47": "drive.shape.angles.2",
}
#: One scenario of every family.
FAMILIES = *QUICK, "crc-23-47", "circular-arc-23-47", "parabolic-23-47", "s-gear-23-47"


def value_of(case, quantity, fixed):
    return float(quantity.function(PairEvaluation(case, fixed)))


def numbers_of(case):
    return numbers.numbers_of(case.pair, study_of({"kind": case.kind}).table())


def quantity(case, of):
    """Without a compiled program."""
    pair = case.pair
    return value_of(pair, quantity_of(pair, of), fixed_of(pair))


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_contact_ratio_of_gears_that_are_made_anew(name):
    lower, shape = {"drive.gear.addendum": 0.97}, QUICK[name]
    found = td.gradient(name, "contact_ratio", ["drive.gear.addendum", shape], lower)
    assert found.unit == "1"
    for key, slope in found.gradient.items():
        at, unit, step = found.at[key], found.units[key], 1e-5 * found.at[key]
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


@pytest.mark.parametrize("name", [INVOLUTE, "efficiency-crc-23-47", "efficiency-cycloidal-23-47"])
def test_efficiency_is_that_of_the_efficiency_study(name):
    case = td.scenario(name).pair
    summary = td.run(name).summary
    assert quantity(case, "efficiency") == pytest.approx(summary["efficiency_elastic"], abs=2e-7)
    # extremes at nodes of the table, and in samples
    if name == "efficiency-crc-23-47":
        for of in ("hertz_pressure_max", "film_min", "film_parameter_min", "flash_temperature_max"):
            assert quantity(case, of) == pytest.approx(summary[of], rel=2e-3), of
        lost = summary["power_friction_mean"]
        assert quantity(case, "power_friction_mean") == pytest.approx(lost, rel=1e-5)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((INVOLUTE, "eficiency", ["drive.module"]), 'did you mean "efficiency"'),
        ((INVOLUTE, "noise", ["drive.module"]), "there is: contact_ratio, "),
        ((INVOLUTE, "efficiency", ["drive.pinion.teeth"]), "is a whole number"),
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
        step = 1e-5 * abs(known[key].value) or 1e-6  # an allowance of nothing is a length
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
    case = td.scenario("spline-23-47").pair
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
    assert (function.of, function.units) == (("film_min", "contact_ratio"), ("m", "1"))
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


#: A mate whose tip reaches the rounding of a low rack.
FILLET = {"drive.pinion.fillet_radius": 0.45, "drive.gear.addendum": 1.2}
#: Overrides that `check` refuses, and the distances that say so.
BEYOND = {
    "undercut": ("involute-18-36", {"drive.pinion.profile_shift": -0.6}, "undercut_pinion"),
    "in the fillet": ("involute-18-36", FILLET, "interference_pinion"),
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


def quantities_of(case):
    """Those that a case has, by name."""
    found = {}
    for name in QUANTITIES:
        with suppress(td.InputError):
            found[name] = quantity_of(case.pair, name)
    return found


#: Differentiated backwards as well, each alone; but for the S-gear, whose programs XLA compiles for minutes.
BACKWARDS = ("efficiency", "film_min", "stiffness_swing", "interference_gear", "tip_corner_pinion")


@pytest.mark.soak
@pytest.mark.parametrize("name", FAMILIES)
def test_every_quantity_and_key_of_every_family(name):
    """Against central differences; what hardly depends on a key is compared with the quantity itself."""
    case = td.scenario(name).pair
    known, of = numbers_of(case), list(quantities_of(case))
    at = [number.value for number in known.values()]
    backwards = () if name == "s-gear-23-47" else BACKWARDS
    found = [td.differentiable(name, asked, list(known)).jacobian(at) for asked in (of, *backwards)]
    slopes = np.vstack([slope for _, slope in found])
    of += backwards
    expected = differences(case, of, list(known))
    scale = np.array([abs(x) or 1.0 for x in at])
    allowed = 2e-5 * np.abs(expected) + 1e-6 * np.abs(np.hstack([v for v, _ in found]))[:, None] / scale
    wrong = np.argwhere(~(np.abs(slopes - expected) <= allowed))
    assert [(of[i], list(known)[j], slopes[i, j], expected[i, j]) for i, j in wrong] == []


def primitives(jaxpr):
    """Names of all primitives of floating point numbers, those of inner programs included."""
    for equation in jaxpr.eqns:
        if any(np.issubdtype(value.aval.dtype, np.floating) for value in equation.invars):
            yield equation.primitive.name
        for inner in jaxprs_in_params(equation.params):
            yield from primitives(inner)


@pytest.mark.parametrize(
    "name", all_in_soak([*FAMILIES, "helical-23-47"], (INVOLUTE, "spline-23-47", "helical-23-47"))
)
def test_no_slope_depends_on_the_equality_of_numbers(name):
    """JAX's slope of a minimum is lost where a program computes its arguments once more and rounds apart."""
    case = td.scenario(name).pair
    known, fixed = numbers_of(case), fixed_of(case)
    functions = [quantity.function for quantity in quantities_of(case).values()]

    def traced(values):
        changed = case
        for number, value in zip(known.values(), values, strict=True):
            changed = number.put(changed, value)
        at = PairEvaluation(changed, fixed)
        return [function(at) for function in functions]

    with jax.enable_x64(True):
        program = jax.make_jaxpr(traced)([float(number.value) for number in known.values()])
    used = set(primitives(program.jaxpr))
    assert "select_n" in used
    assert used.isdisjoint({"max", "min", "clamp", "reduce_max", "reduce_min"})


def test_a_temperature_that_moves_with_the_losses_is_not_differentiated():
    with pytest.raises(InputError, match="temperature that does not move"):
        td.gradient("efficiency-oil-18-36", "efficiency", "operating.oil_temperature")


@pytest.mark.slow
def test_laws_that_follow_from_the_duty():
    """Compiled programs are of the laws that "auto" took, which differ where numbers alone do."""
    constant = {"friction.law": "auto", "mesh.compliance": "constant", "mesh.stiffness": "4e8 N/m"}
    taken = set()
    for torque in ("300 N*m", "100 N*m"):
        case = td.scenario("spur-25-51", constant | {"operating.gear_torque": torque})
        taken.add(case.friction.law)
        function = td.differentiable(case, "friction_power", "operating.gear_torque")
        assert function.values(function.at) == pytest.approx([quantity(case, "friction_power")], rel=1e-9)
    assert len(taken) == 2
