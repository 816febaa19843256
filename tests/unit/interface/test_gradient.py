"""Derivatives of figures by a scenario's numbers: closed forms, and central differences of other runs."""

import math

import jax
import numpy as np
import pytest

import tribodyn as td
from tribodyn.errors import InputError
from tribodyn.interface.gradient import _checked
from tribodyn.interface.numbers import numbers_of
from tribodyn.interface.quantities import QUANTITIES

#: One scenario of every family, and the number that shapes its teeth.
FAMILIES = {
    "efficiency-involute-18-36": "drive.pressure_angle",
    "crc-23-47": "drive.pressure_angle",
    "circular-arc-23-47": "drive.shape.approach_diameter",
    "cycloidal-23-47": "drive.shape.approach_circle",
    "parabolic-23-47": "drive.shape.k1",
    "points-23-47": "drive.pressure_angle",
    "s-gear-23-47": "drive.shape.form_factor",
}
INVOLUTE = "efficiency-involute-18-36"


@pytest.mark.slow
@pytest.mark.parametrize(("name", "shape"), FAMILIES.items())
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
    quantity, fixed = _checked(case, "efficiency")
    assert quantity.function(case, fixed) == pytest.approx(
        td.run(name).summary["efficiency_elastic"], abs=2e-7
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", ["efficiency-involute-18-36", "efficiency-crc-23-47", "cycloidal-23-47"])
def test_losses_can_be_traced(name):
    """With all numbers traced, mean and local laws: what the compiled programs are made of."""
    case = td.scenario(name)
    quantity, fixed = _checked(case, "efficiency")
    numbers = numbers_of(case)

    def traced(values):
        changed = case
        for number, value in zip(numbers.values(), values, strict=True):
            changed = number.put(changed, value)
        return quantity.function(changed, fixed)

    with jax.enable_x64(True):
        found = jax.eval_shape(traced, [float(number.value) for number in numbers.values()])
    assert (found.shape, found.dtype) == ((), np.float64)


def test_a_gradient_shows_itself():
    found = td.gradient(INVOLUTE, "hertz_pressure", "operating.gear_torque")
    text = found._repr_html_()
    assert "operating.gear_torque" in text
    assert "Pa per N m" in text
    assert "+0.5 %" in text
    assert "hertz_pressure" in repr(found)


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
        (("load-contact-18-36", "efficiency", ["drive.module"]), "[mesh]"),
    ],
)
def test_what_cannot_be_differentiated(arguments, said):
    with pytest.raises(td.InputError) as error:
        td.gradient(*arguments)
    assert said in str(error.value)


@pytest.mark.soak
@pytest.mark.parametrize("of", QUANTITIES)
@pytest.mark.parametrize("name", FAMILIES)
def test_every_figure_and_key_of_every_family(name, of):
    """Against central differences; what hardly depends on a key is compared with the figure itself."""
    case = td.scenario(name)
    try:
        quantity, fixed = _checked(case, of)
    except td.InputError as error:
        pytest.skip(str(error))
    numbers = numbers_of(case)
    found = td.gradient(case, of, list(numbers))
    for key, number in numbers.items():
        scale = abs(number.value) or 1.0
        step = 1e-5 * scale
        ends = [quantity.function(number.put(case, number.value + s * step), fixed) for s in (1, -1)]
        difference = (ends[0] - ends[1]) / (2 * step)
        assert found[key] == pytest.approx(difference, rel=2e-5, abs=1e-6 * abs(found.value) / scale), key


def test_a_temperature_that_moves_with_the_losses_is_not_differentiated():
    with pytest.raises(InputError, match="temperature that does not move"):
        td.gradient("efficiency-oil-18-36", "efficiency", "operating.oil_temperature")
