"""Every reported quantity is defined once, is shown in its unit, and stands on the page of the summary."""

from pathlib import Path

import numpy as np
import pytest
from pint import UnitRegistry

from tools.summary_table import tables
from tribodyn.quantities.catalogue import EVERY, GROUPS, QUANTITIES
from tribodyn.quantities.quantity import SHOWN, Quantity
from tribodyn.studies import STUDIES

PAGE = Path(__file__).parents[3] / "docs" / "summary.md"
STANDARDS = {quantity.name for group in ("capacity", "standards") for quantity in GROUPS[group]}


def test_no_name_means_two_things():
    names = [quantity.name for quantity in EVERY]
    assert len(names) == len(set(names)) == len(QUANTITIES)


@pytest.mark.parametrize("name", [name for name in QUANTITIES if name not in STANDARDS])
def test_every_quantity_has_a_definition(name: str):
    assert QUANTITIES[name].definition.endswith(".")


@pytest.mark.parametrize("kind", [kind for kind in STUDIES if STUDIES[kind].package.startswith("tribodyn.")])
def test_studies_report_what_the_catalogue_defines(kind: str):
    study = STUDIES[kind]
    reported = [quantity for group in study.reported().values() for quantity in group]
    for quantity in (*study.swept().values(), *reported):
        assert quantity == QUANTITIES.get(quantity.name) or quantity.name.endswith("_spread")
    assert {quantity.name for quantity in study.sweep_table()} <= set(study.swept())


@pytest.mark.parametrize("unit", [unit for unit in SHOWN if unit not in ("", "%")])
def test_numbers_are_shown_in_their_unit(unit: str):
    quantity, units = Quantity("length", "Length", unit), UnitRegistry(autoconvert_offset_to_baseunit=True)
    value = units.Quantity(300.0, quantity.si.replace("m2", "m**2").replace("m3", "m**3")).to(
        unit.replace("mm µm", "mm*µm")
    )
    assert quantity.in_unit(np.array([300.0])) == pytest.approx(value.magnitude, rel=1e-12)


def test_values_are_written_with_their_digits():
    film = Quantity("film", "Film", "µm", ".3g", symbol="h")
    assert (film.written(1.23456e-6), film.with_unit(1e-6), film.written(float("nan"))) == (
        "1.23",
        "1 µm",
        "–",
    )
    assert film.written(np.array([1e-6, 2e-6])) == "2 / 1"
    assert film._replace(listed=True).written(np.array([1e-6, 2e-6])) == "1 / 2"
    assert Quantity("steps", "Steps", digits=",d").written(12345.0) == "12,345"
    load, share = Quantity("load", "Load", "N", ",.0f"), Quantity("share", "Share", "%", ".3f")
    assert [load.written(value) for value in (12345.6, -42.3, 0.0, 0.13862)] == [
        "12,346",
        "-42",
        "0",
        "0.139",
    ]
    assert [share.written(value) for value in (0.99467, 6.5312e-6, 0.0)] == ["99.467", "0.000653", "0.000"]
    safety = Quantity("safety", "Safety", digits=".2f")
    assert [safety.written(value) for value in (1.234, 1234.5, 248206.62)] == ["1.23", "1234.50", "248,207"]
    assert film.variable()[:3] == ((), "m", "film")
    assert (film.title, film.titled, film.in_table) == ("Film h", "Film h (µm)", "Film h")


def test_the_page_has_the_quantities_as_they_are():
    text = PAGE.read_text(encoding="utf-8")
    inside = text.partition("<!-- begin summary lines -->")[2].partition("<!-- end summary lines -->")[0]
    assert inside.strip() == tables().strip(), "write the page anew: python -m tools.summary_table"
