"""Tables added and taken out, remedies that a button takes, lines of keys."""

import tomllib

import pytest

from tests.support.verbs import ROOT
from tribodyn.app.core.document import Document
from tribodyn.app.core.form import form_of
from tribodyn.app.core.offers.lines import line_of
from tribodyn.app.core.offers.remedies import remedies_of
from tribodyn.app.core.offers.tables import add_table, copy_table
from tribodyn.errors import InputError

PIT = {
    "damage.0.kind": "pit",
    "damage.0.depth": "1.5 mm",
    "damage.0.diameter": "1 mm",
    "damage.0.height": 0.5,
}


def leaves(data, above=()):
    if isinstance(data, dict):
        for name, value in data.items():
            yield from leaves(value, (*above, name))
    else:
        yield above


@pytest.mark.parametrize("name", ["spur-25-51", "clutch-flywheel", "sensors-18-36", "map-two-stage-reducer"])
def test_a_table_that_is_added_has_fields_and_is_gone_when_it_is_taken_out(name):
    document = Document.open(name)
    text, whole, groups = document.text, document.resolved.data, form_of(document)
    changes = [
        (lambda held=held: add_table(document, held, "another" if held.named else ""))
        for group in groups
        for held in group.holds
    ]
    changes += [
        (lambda path=group.path: copy_table(document, path))
        for group in groups
        if group.one_of and group.path.rpartition(".")[2].isdecimal()
    ]
    assert len(changes) > 5
    for change in changes:
        key = change()
        assert key in {group.path for group in form_of(document)}
        document.messages()
        document.take_out(key)
        assert document.resolved.data == whole
        while document.undo():
            pass
        assert document.text == text


def test_a_copy_has_a_name_of_its_own_and_comments_stay():
    document = Document.open("sensors-18-36")
    assert copy_table(document, "sensor.0").startswith("sensor.")
    copy_table(document, "sensor.0")
    names = [one["name"] for one in document.written()["sensor"]]
    assert len(set(names)) == len(names)
    assert names[-2:] == [f"{names[0]}-2", f"{names[0]}-3"]
    assert not document.messages()
    comments = [line.partition("#")[2] for line in Document.open("sensors-18-36").text.splitlines()]
    assert comments == [line.partition("#")[2] for line in document.text.splitlines()][: len(comments)]


def test_rows_that_only_a_model_has_are_written_out_where_one_is_changed_or_taken_out():
    document = Document.open("industrial-reducer-assessment")
    shafts = document.value("scenario.shaft")
    document.set("scenario.shaft.1.name", "slow")
    assert [one["name"] for one in document.written()["scenario"]["shaft"]] == [
        "slow" if number == 1 else one["name"] for number, one in enumerate(shafts)
    ]
    document.undo()
    document.take_out("scenario.shaft.1")
    assert document.value("scenario.shaft") == [shafts[0], *shafts[2:]]


@pytest.mark.parametrize("name", ["", "a.b", "a b", "pinion-1"])
def test_a_name_that_is_none_or_taken_is_refused(name):
    document = Document.open("two-stage-reducer")
    (gears,) = [one for group in form_of(document) for one in group.holds if one.path == "gear"]
    with pytest.raises(InputError):
        add_table(document, gears, name)
    assert not document.can_undo


@pytest.mark.parametrize(
    ("changes", "offered"),
    [
        (
            {"drive.pinion.modification.tip_relief": "20 um"},
            ['Set mesh.compliance = "fem"', "Leave drive.pinion.modification.tip_relief out"],
        ),
        ({"mesh.stiffness": "1 N/um"}, ['Set mesh.compliance = "constant"', "Leave mesh.stiffness out"]),
        ({"operating.source": "speed", "solver.duration": "1 s"}, ['Set operating.source = "torque"']),
        ({"drive.pinion.teeth": -3}, []),
    ],
)
def test_a_remedy_is_offered_where_it_mends_and_takes_the_message_away(changes, offered):
    document = Document.open("spur-25-51")
    for key, value in changes.items():
        document.set(key, value)
    (message,) = document.messages()
    remedies = remedies_of(document)[message.text]
    assert sorted(one.text for one in remedies) == sorted(offered)
    for remedy in remedies:
        remedy.take(document)
        assert not document.messages()
        document.undo()


@pytest.mark.parametrize(
    ("name", "wrong", "offered"),
    [
        ("spur-25-51", {}, {'Set damage.0.gear = "pinion"', "Set damage.0.tooth = 5"}),
        ("spur-25-51", {"solver.rtol": -1.0}, {'Set damage.0.gear = "pinion"', "Set damage.0.tooth = 5"}),
        ("planetary-24-84", {}, set()),  # it has no pinion
        ("planetary-24-84", {"damage.0.gear": "sun", "solver.rtol": -1.0, **PIT}, {"Set damage.0.tooth = 5"}),
    ],
)
def test_an_example_is_offered_where_the_rules_take_it_that_other_messages_hide(name, wrong, offered):
    document = Document.open(name)
    document.append("damage", {})
    for key, value in wrong.items():
        document.set(key, value)
    remedies = remedies_of(document)
    assert {one.text for each in remedies.values() for one in each} == offered


@pytest.mark.parametrize("name", ["spur-25-51", "wind-turbine-gearbox", "ring-36-93"])
def test_every_key_is_found_in_the_line_that_has_it(name):
    text = (ROOT / "scenarios" / f"{name}.toml").read_text(encoding="utf-8")
    lines = text.splitlines()
    for key in leaves(tomllib.loads(text)):
        line = line_of(text, ".".join(key))
        assert key[-1] in lines[line - 1]
    assert line_of(text, "operating.none") == lines.index("[operating]") + 1
    assert line_of(text, "line 7") == 7
    assert line_of(text, "nowhere.at.all") == line_of("[", "a") == 0
