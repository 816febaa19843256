"""The form of scenarios of all kinds: every field says what it means, and writes what it shows."""

import tomllib

import pytest

from tribodyn.app.core.document import BY_DEFAULT, Document
from tribodyn.app.core.fields import converted
from tribodyn.app.core.form import FormField, form_of, written_as
from tribodyn.input.quantity import meanings
from tribodyn.input.sources import shipped

#: One of every kind that is shipped.
KINDS = (
    "spur-25-51",
    "two-stage-reducer",
    "planetary-24-84",
    "efficiency-involute-18-36",
    "load-contact-18-36",
    "wear-18-36",
    "ehl-crc-23-47",
    "irefc",
    "backlash-oscillator",
    "design-tip-relief-18-36",
    "assessment-helical-24-95",
    "industrial-reducer-assessment",
    "map-two-stage-reducer",
    "drive-cycle-reducer",
    "spline-23-47",
)


def fields_of(name: str) -> dict[str, FormField]:
    return {field.path: field for group in form_of(Document.open(name)) for field in group.fields}


@pytest.mark.parametrize("name", KINDS)
def test_what_a_form_shows_is_what_it_writes(name):
    """Every value that the scenario gives is written back through its input; nothing changes."""
    document = Document.open(name)
    before = document.written()
    for group in form_of(document):
        for field in group.fields:
            if field.given:
                document.set(field.path, written_as(field, field.shown))
    assert document.written() == before
    assert document.messages() == ()


@pytest.mark.parametrize("name", KINDS)
def test_every_path_is_there_once_and_leads_to_its_value(name):
    document = Document.open(name)
    fields = [field for group in form_of(document) for field in group.fields]
    assert len({field.path for field in fields}) == len(fields)
    known = tomllib.loads((shipped("scenarios") / f"{name}.toml").read_text())
    top = {key for key, value in known.items() if not isinstance(value, (dict, list))}
    assert top <= {field.path for field in fields if field.given}
    for field in fields:
        if field.kind == "quantity" and field.value is not None:
            assert f"{field.shown} {field.unit}".split() == str(field.value).split()
            assert field.unit in field.units


@pytest.mark.parametrize("name", KINDS)
def test_every_field_of_the_schema_says_what_it_means(name):
    named = {key for table in meanings().values() for key in table}
    for path, field in fields_of(name).items():
        assert field.label
        if path.rpartition(".")[2] in named and field.kind != "model":
            assert field.about, path


def test_fields_of_a_pair_know_units_choices_bounds_and_usual_ranges():
    fields = fields_of("spur-25-51")
    module = fields["drive.module"]
    assert (module.kind, module.shown, module.unit, module.required) == ("quantity", "3", "mm", True)
    assert module.usual == (0.5, 70.0)
    assert module.usual_source == "ISO 1328-1"
    teeth = fields["drive.pinion.teeth"]
    assert (teeth.kind, teeth.value, teeth.low, teeth.high) == ("whole", 25, 4.0, 10_000.0)
    assert {"auto", "coulomb", "none"} <= set(fields["friction.law"].choices)
    assert fields["mesh.compliance"].choices == ("energy", "fem", "constant", "table")
    assert "spur-25-51" in fields["drive"].choices
    assert fields["drive"].value == "spur-25-51"
    assert fields["operating.oil_temperature"].units == ("degC", "K", "degF")
    assert fields["solver.rtol"].low == 1e-13
    assert not fields["drive.pinion.modification.tip_relief"].advanced
    assert fields["drive.pinion.over_pins"].advanced
    assert fields["solver.max_steps"].source == BY_DEFAULT


def test_fields_of_trains_are_those_of_their_gears_and_stages():
    fields = fields_of("two-stage-reducer")
    assert fields["gear.wheel-1.teeth"].value == 69
    assert fields["stage.1.module"].shown == "4"
    assert "operating.input_speed" in fields
    assert "operating.pinion_speed" not in fields
    planetary = fields_of("planetary-24-84")
    assert planetary["stage.0.type"].value == "planetary"


def test_a_family_and_a_law_bring_their_own_fields():
    assert {"drive.shape.angles", "drive.shape.knots"} <= fields_of("spline-23-47").keys()
    document = Document.open("spur-25-51")
    document.set("friction.law", "coulomb")
    document.set("friction.coefficient", 0.05)
    fields = {field.path: field for group in form_of(document) for field in group.fields}
    assert fields["friction.coefficient"].value == 0.05
    assert fields["friction.coefficient"].about


def test_a_table_that_is_not_there_is_made_by_its_first_value():
    document = Document.open("spur-25-51")
    (group,) = [group for group in form_of(document) if group.path == "temperature"]
    assert not group.present
    assert group.optional
    (field,) = [field for field in group.fields if field.path == "temperature.model"]
    document.set(field.path, written_as(field, "iso"))
    (group,) = [group for group in form_of(document) if group.path == "temperature"]
    assert group.present
    assert document.messages() == ()


@pytest.mark.parametrize(
    ("number", "unit", "to", "expected"),
    [
        ("3", "mm", "um", 3000.0),
        ("80", "degC", "K", 353.15),
        ("212", "degF", "degC", 100.0),
        ("1500", "rpm", "rad/s", 1500 * 0.10471975511965977),
        ("2", "kN*m", "N*m", 2000.0),
        ("20", "deg", "arcmin", 1200.0),
    ],
)
def test_numbers_go_from_unit_to_unit_and_back(number, unit, to, expected):
    there = converted(number, unit, to)
    assert float(there) == pytest.approx(expected, rel=1e-8)
    assert float(converted(there, to, unit)) == pytest.approx(float(number), rel=1e-8)


@pytest.mark.parametrize(("number", "unit", "to"), [("", "mm", "um"), ("many", "mm", "um"), ("3", "mm", "K")])
def test_what_has_no_other_unit_stays(number, unit, to):
    assert converted(number, unit, to) == number


def test_a_kind_that_there_is_not_has_the_form_of_the_usual_one():
    document = Document.open("spur-25-51")
    document.set("kind", "no such kind")
    assert "drive.module" in {field.path for group in form_of(document) for field in group.fields}


def test_a_broken_text_has_the_form_of_an_empty_scenario():
    document = Document.open("spur-25-51")
    document.set_text("[mesh")
    assert form_of(document)[0].label == "Scenario"


@pytest.mark.parametrize(
    ("before", "number", "after"),
    [("70 banana", "90", "90 degC"), ("70 um", "90", "90 degC"), ("340 K", "350", "350 K")],
)
def test_a_number_does_not_get_the_unit_that_was_wrong_before_it(before, number, after):
    document, key = Document.open("spur-25-51"), "operating.oil_temperature"
    document.set(key, before)
    fields = {field.path: field for group in form_of(document) for field in group.fields}
    assert written_as(fields[key], fields[key].shown, fields[key].unit) == before
    document.set(key, written_as(fields[key], number, fields[key].unit))
    assert document.value(key) == after
    assert document.messages() == ()
