"""`td.line_contact`: names, units, signs and errors."""

from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

import tribodyn as td
from tribodyn.errors import InputError

mpl.use("agg")

GIVEN: dict[str, Any] = {
    "line_load": 200e3,
    "radius": 10e-3,
    "entrainment_speed": 1.0,
    "viscosity": 0.04,
    "pressure_viscosity": 22e-9,
    "viscosity_pressure_index": 0.6,
    "effective_modulus": 226.37e9,
}


def test_attributes_and_plot():
    contact = td.line_contact(**GIVEN)
    assert contact.central_film_thickness == pytest.approx(0.2983e-6, rel=5e-3)
    assert contact.minimum_film_thickness == pytest.approx(0.2589e-6, rel=5e-3)
    assert (
        contact.x.shape == contact.pressure.shape == contact.film_thickness.shape == contact.temperature.shape
    )
    assert np.trapezoid(contact.pressure, contact.x) == pytest.approx(200e3, rel=1e-9)
    assert contact.hertz_pressure == pytest.approx(0.8489e9, rel=1e-3)
    assert abs(contact.friction_coefficient) < 1e-12
    assert len(contact.plot().axes) == 2
    assert "µm" in repr(contact)


def test_friction_has_the_sign_of_the_sliding_speed():
    coefficient, other = (
        td.line_contact(**GIVEN, sliding_speed=v).friction_coefficient for v in (1e-4, -1e-4)
    )
    assert coefficient > 0.0
    assert other == pytest.approx(-coefficient)


def test_index_of_roelands_isotherm_where_none_is_given():
    """α = z (ln η0 + 9.67)/p_r."""
    given = {**GIVEN, "viscosity_pressure_index": None}
    index = 22e-9 * 1.962e8 / (np.log(0.04) + 9.67)
    same = td.line_contact(**{**GIVEN, "viscosity_pressure_index": index})
    assert td.line_contact(**given).central_film_thickness == pytest.approx(same.central_film_thickness)


#: Arguments that must be positive, and which law of shear reads them.
POSITIVE = {
    **dict.fromkeys(
        [
            *("line_load", "radius", "entrainment_speed", "viscosity", "effective_modulus", "roughness"),
            *("asperity_density", "asperity_slope", "limiting_coefficient", "limiting_floor"),
            *("oil_conductivity", "oil_heat_capacity", "step"),
        ],
        "limiting",
    ),
    "eyring_stress": "eyring",
    "carreau_modulus": "carreau",
    "carreau_index": "carreau",
}


def all_given(rheology):
    return {**GIVEN, "roughness": 3e-7, "temperature_viscosity": 0.035, "rheology": rheology}


@pytest.mark.parametrize("name", [*POSITIVE, "pressure_viscosity", "sliding_speed", "asperity_friction"])
@pytest.mark.parametrize(
    "value", [-1e300, float("nan"), float("inf"), 1e300, "1", True, [1.0], 1j, np.array([1.0, 2.0])]
)
def test_no_numbers(name, value):
    with pytest.raises(td.InputError) as caught:
        td.line_contact(**{**all_given(POSITIVE.get(name, "limiting")), name: value})
    assert caught.value.key == name


@pytest.mark.parametrize("name", POSITIVE)
@pytest.mark.parametrize("value", [0, -1.0, 1e-300])
def test_no_positive_numbers(name, value):
    with pytest.raises(td.InputError) as caught:
        td.line_contact(**{**all_given(POSITIVE[name]), name: value})
    assert caught.value.key == name


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("viscosity_pressure_index", 1.5),
        ("viscosity_pressure_index", 0.0),
        ("rheology", "plastic"),
        ("rheology", ["eyring"]),
        ("compressible", "no"),
        ("solid_conductivity", 46.0),
        ("solid_heat_capacity", (3.6e6, -1.0)),
        ("temperature_viscosity", -0.1),
        ("start", "here"),
        ("line_load", 1e12),  # wider than the cylinders
        ("line_load", 1e-9),
        ("pressure_viscosity", 22.0),
    ],
)
def test_bad_values(name, value):
    with pytest.raises(td.InputError) as caught:
        td.line_contact(**{**all_given("limiting"), name: value})
    assert caught.value.key == name


def test_a_smooth_contact_does_not_start_a_rough_one():
    smooth = td.line_contact(**GIVEN)
    assert td.line_contact(**GIVEN, start=smooth).minimum_film_thickness == pytest.approx(
        smooth.minimum_film_thickness
    )
    with pytest.raises(td.InputError, match="smooth"):
        td.line_contact(**GIVEN, roughness=3e-7, start=smooth)


@pytest.mark.parametrize("exponent", [30.0, 65.0, 600.0])
@pytest.mark.parametrize("index", [0.6, 1.0])
@pytest.mark.parametrize("heat", [None, 0.035])
def test_cold_oil(exponent, index, heat):
    """Stiff as it may be, it slips at τ_00 + Λ p; above α p_H = 60 the contact says that it is a solid."""
    given = {**GIVEN, "viscosity_pressure_index": index, "pressure_viscosity": exponent / 0.8489e9}
    contact = td.line_contact(
        **given, sliding_speed=0.1, rheology="limiting", temperature_viscosity=heat, step=0.2
    )
    assert 0.045 < contact.friction_coefficient
    assert contact.friction_coefficient * 200e3 <= np.trapezoid(2e6 + 0.05 * contact.pressure, contact.x)
    assert any("60" in limit for limit in contact.limits) == (exponent > 60.0)


def test_what_no_oil_bears_is_said():
    contact = td.line_contact(**GIVEN, sliding_speed=0.1)
    assert contact.friction_coefficient > 1.0
    assert "limiting" in contact.limits[0]
    assert "limiting" in repr(contact)
    assert td.line_contact(**GIVEN).limits == ()


def test_a_lubricant_that_is_no_name():
    with pytest.raises(InputError, match=r"lubricant = .*: not the name of a lubricant; name a shipped one"):
        td.line_contact(
            line_load=2e5,
            radius=0.01,
            entrainment_speed=2.0,
            effective_modulus=2.2e11,
            oil_temperature=353.0,
            lubricant={"like": "iso-vg-220-mineral"},  # pyright: ignore[reportArgumentType]
        )
