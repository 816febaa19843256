"""`td.line_contact`: names, units, signs and errors."""

import matplotlib as mpl
import numpy as np
import pytest

import tribodyn as td

mpl.use("agg")

GIVEN = {
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
    one, other = (td.line_contact(**GIVEN, sliding_speed=v).friction_coefficient for v in (1e-4, -1e-4))
    assert one > 0.0
    assert other == pytest.approx(-one)


def test_index_of_roelands_isotherm_where_none_is_given():
    """α = z (ln η0 + 9.67)/p_r."""
    given = {**GIVEN, "viscosity_pressure_index": None}
    index = 22e-9 * 1.962e8 / (np.log(0.04) + 9.67)
    same = td.line_contact(**{**GIVEN, "viscosity_pressure_index": index})
    assert td.line_contact(**given).central_film_thickness == pytest.approx(same.central_film_thickness)


@pytest.mark.parametrize(
    "name", ["line_load", "radius", "entrainment_speed", "viscosity", "effective_modulus"]
)
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan")])
def test_bad_values(name, value):
    with pytest.raises(td.InputError) as caught:
        td.line_contact(**{**GIVEN, name: value, "viscosity_pressure_index": None})
    assert caught.value.key == name
