"""Housings by matrices: units to SI, names and places of seats, feet; and what is refused with one line."""

import numpy as np
import pytest

from tests.support.beam_element import bar
from tribodyn.errors import InputError
from tribodyn.input.tables.housing_matrices import element_of, scales
from tribodyn.input.tables.sensors import Housing, broken_sensor_rules
from tribodyn.train.elastic.superelement import frequencies


def _written(length=1.0, kilogram=1.0, **change):
    """The bar in units of so many m and kg, seconds beside."""
    element = bar()
    unit = np.array([*2 * [length, length, length, 1.0, 1.0, 1.0], *element.modes * [1.0]])
    both = np.outer(unit, unit) / (kilogram * length**2)
    table = {
        "mass": element.mass * both,
        "stiffness": element.stiffness * both,
        "places": element.places / length,
        "recovery": element.recovery[0] * unit / length,
    }
    rows = {name: np.asarray(matrix).tolist() for name, matrix in table.items()}
    return {"seats": ("A", "B"), "points": ("middle",), **rows, **change}


def _sounding(length=1.0, kilogram=1.0, sign=1.0, **change):
    """The bar with a radiation that acts where its damping does."""
    written = _written(length, kilogram, units="m, kg, s")
    rows = np.asarray(written["stiffness"]) * sign
    return (
        written
        | {"radiation": [*rows.tolist(), *rows.tolist()], "radiation_frequency": (50.0, 90.0)}
        | change
    )


def _housing(table, **keys):
    return Housing.model_validate({"held": ("B",), "damping_ratio": 0.01, "matrices": table, **keys})


@pytest.mark.parametrize(
    ("text", "length", "mass"),
    [("m, kg, s", 1.0, 1.0), ("mm, t, s", 1e-3, 1e3), ("N, mm, s, t", 1e-3, 1e3), ("mm, kg, s", 1e-3, 1.0)],
)
def test_any_consistent_units_give_the_same_structure(text, length, mass):
    one = element_of(_housing(_written(length, mass), units=text))
    other = element_of(_housing(_written(units="m, kg, s")))
    assert one.seats == ("A",)
    np.testing.assert_allclose(frequencies(one), frequencies(other), rtol=1e-9)
    np.testing.assert_allclose(one.mass[:6, :6], other.mass[:6, :6], rtol=1e-9, atol=1e-15)
    # displacement of the point under a force at the seat, and damping there
    for element in (one, other):
        np.testing.assert_allclose(np.diag(element.mass[6:, 6:]) > 0.0, True)
    moved = [
        each.recovery[0] @ np.linalg.solve(each.stiffness, np.eye(each.coordinates)[0])
        for each in (one, other)
    ]
    np.testing.assert_allclose(*moved, rtol=1e-6, atol=1e-15)
    damped = [each.damping[:6, :6] for each in (one, other)]
    np.testing.assert_allclose(*damped, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("mm, kg, s, N", "units disagree: the unit of force is 1 N"),
        ("mm, s", "no unit of mass"),
        ("mm, m, kg, s", "two units of length"),
        ("mm, kg, banana", "no unit of length, mass, time or force"),
    ],
)
def test_units_that_disagree_or_lack_one_are_refused(text, words):
    with pytest.raises(InputError, match=words):
        scales(text, "housing.units")


@pytest.mark.parametrize(
    ("housing", "key", "words"),
    [
        (lambda: _housing(_written()), "housing.units", "missing"),
        (lambda: _housing(_written(units="m, kg, s"), units="mm, t, s"), "housing.units", "the file says"),
        (lambda: _housing(_written(), units="mm, t, s"), "housing.matrices", "heavier than lead"),
        (lambda: _housing(_written(units="m, kg, s"), held=()), "housing.held", "free"),
        (lambda: _housing(_written(units="m, kg, s"), held=("C",)), "housing.held.0", "no such seat"),
        (lambda: _housing(_written(units="m, kg, s", seats=())), "housing.seats", "missing"),
        (lambda: _housing(_written(units="m, kg, s", places=())), "housing.places.A", "missing"),
        (lambda: _housing(_written(units="m, kg, s"), seats=("A", "A")), "housing.seats", "once"),
        (lambda: _housing(_written(units="m, kg, s", points=())), "housing.matrices", "three of each"),
        (lambda: _housing(_written(units="m, kg, s", mass=((1.0,),))), "housing.matrices", "1 by 1"),
        (lambda: _housing(_written(units="m, kg, s", damping=((1.0,), (1.0, 2.0)))), "damping", "differ"),
        (lambda: _housing(_sounding(radiation_frequency=(50.0,))), "radiation", "1 frequencies and"),
        (lambda: _housing(_sounding(radiation_frequency=(0.0, 50.0))), "radiation_frequency", "increase"),
        (lambda: _housing(_sounding(sign=-1.0)), "housing.matrices", "radiation at 50 Hz is not positive"),
    ],
)
def test_what_contradicts_itself_is_one_line(housing, key, words):
    with pytest.raises(InputError, match=words) as refused:
        element_of(housing())
    assert refused.value.key.endswith(key)
    assert "\n" not in str(refused.value)


def test_radiation_is_the_same_in_any_units():
    """Power of a rate: m²/s² times m² of an area, W of a resistance; modes keep their scale."""
    metres, millimetres = (
        element_of(_housing(_sounding(*of, units=text, area=_area(of[0]))))
        for of, text in (((1.0, 1.0), "m, kg, s"), ((1e-3, 1e3), "mm, t, s"))
    )
    scale = np.sqrt(np.diag(millimetres.mass) / np.diag(metres.mass))
    for name in ("area", "resistance"):
        one, other = (getattr(each.radiation, name) for each in (metres, millimetres))
        np.testing.assert_allclose(other / np.outer(scale, scale), one, rtol=1e-9, atol=1e-9 * np.max(one))
    assert metres.radiation.resistance.shape == (2, metres.coordinates, metres.coordinates)
    np.testing.assert_allclose(np.diag(metres.radiation.area)[:3], 0.3)


def _area(length):
    """0.3 m² for displacements of both seats, in units of so many m."""
    each = [0.3 / length**2] * 3 + [0.0] * 3
    return np.diag([*each, *each, *[0.0] * bar().modes]).tolist()


def test_a_scenario_names_the_seats_and_their_places():
    places = {"left": ["0 mm", "0 mm", "0 mm"], "foot": ["0 mm", "0 mm", "500 mm"]}
    table = _written(units="m, kg, s", places=(), seats=())
    element = element_of(_housing(table, seats=("left", "foot"), places=places, held=("foot",)))
    assert element.seats == ("left",)


def test_keys_of_matrices_without_matrices_are_refused():
    keys = {"modes_up_to": "1 kHz", "radiation_efficiency": 0.5}
    found = broken_sensor_rules((), Housing.model_validate(keys))
    assert [error.key for error in found] == [f"housing.{key}" for key in keys]
