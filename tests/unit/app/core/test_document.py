"""Editing a scenario: comments stay, values reach through models, messages are those of the command line."""

import tomllib
from pathlib import Path

import pytest

from tribodyn.app.core.document import BY_DEFAULT, Document
from tribodyn.errors import InputError
from tribodyn.input.sources import names, shipped
from tribodyn.studies.protocol.load import load

SCENARIOS = [name for name in names(shipped("scenarios")) if name not in ("wear-18-36",)]

#: Edits of the spur pair: in a table of its own, a model, a model of the model, a default, nothing yet.
EDITS = {
    "operating.oil_temperature": "90 degC",
    "drive.pinion.profile_shift": 0.3,
    "drive.material.density": "7800 kg/m**3",
    "bearings.pinion.stiffness_x": "2e9 N/m",
    "solver.max_steps": 2_000_000,
    "temperature.model": "iso",
    "operating.gear_torque": "600 N*m",
}


def comments(text: str) -> list[str]:
    """What stands behind every # of a text that has none in quotes."""
    return [line.partition("#")[2].strip() for line in text.splitlines() if "#" in line]


@pytest.mark.parametrize("name", SCENARIOS)
def test_any_scenario_is_opened_without_a_message(name):
    document = Document.open(name)
    assert document.messages() == ()
    assert document.written() == tomllib.loads((shipped("scenarios") / f"{name}.toml").read_text())
    assert not document.unsaved


def test_edits_are_those_that_the_command_line_sets(tmp_path):
    """The saved file gives the case that the overrides of the command line give."""
    document = Document.open("spur-25-51")
    for key, value in EDITS.items():
        document.set(key, value)
    saved = document.save(tmp_path / "mine.toml")
    ours, theirs = (tomllib.loads(case.toml) for case in (load(saved).case, load("spur-25-51", EDITS).case))
    assert {**ours, "name": ""} == {**theirs, "name": ""}


def test_comments_stay_where_values_change():
    document = Document.open("spur-25-51")
    before = comments(document.text)
    for key, value in EDITS.items():
        document.set(key, value)
    assert sorted(comments(document.text)) == sorted(before)
    assert "damping_ratio = 0.05                      # assumption" in document.text


def test_values_say_where_they_are_from():
    document = Document.open("spur-25-51")
    assert (document.value("operating.pinion_speed"), document.source("operating.pinion_speed")) == (
        "1500 rpm",
        "",
    )
    assert document.value("drive.pinion.teeth") == 25
    assert Path(document.source("drive.pinion.teeth")).name == "spur-25-51.toml"
    assert Path(document.source("drive.pinion.teeth")).parent.name == "drives"
    assert (document.value("solver.max_steps"), document.source("solver.max_steps")) == (10**6, BY_DEFAULT)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("drive.pinion.teeth", "-5"),
        ("drive.pinion.teeth", "many"),
        ("drive.module", ""),
        ("drive.module", "3"),
        ("drive.module", "3 furlongs per week"),
        ("mesh.damping_ratio", "nan"),
        ("mesh.damping_ratio", "-1"),
        ("drive.family", "no such"),
        ("drive", "no-such-drive"),
        ("kind", "no-such-kind"),
        ("operating.pinion_speed", "1e400 rpm"),
        ("operating.pinion_sped", "1 rpm"),
        ("solver.cycles", "9223372036854775808"),
        ("title", "a\u202eb"),
        ("drive.pinion", "7"),
        ("operating", "[1, 2]"),
    ],
)
def test_wrong_values_are_said_as_of_a_file(tmp_path, key, value):
    document = Document.open("spur-25-51")
    document.set(key, value)
    document.save(tmp_path / "wrong.toml")
    with pytest.raises(InputError) as refused:
        load(tmp_path / "wrong.toml")
    assert "\n".join(message.text for message in document.messages()) == str(refused.value)
    assert document.undo()
    assert document.messages() == ()


@pytest.mark.parametrize("key", ["drive", "operating.pinion_speed", "mesh", "title"])
def test_a_required_key_that_is_taken_out_is_missed(tmp_path, key):
    document = Document.open("spur-25-51")
    document.unset(key)
    document.save(tmp_path / "wrong.toml")
    with pytest.raises(InputError) as refused:
        load(tmp_path / "wrong.toml")
    (message,) = document.messages()
    assert (message.text, message.key) == (str(refused.value), key)
    assert message.short.startswith("missing")


def test_a_text_that_is_no_toml_names_its_line_and_refuses_edits():
    document = Document.open("spur-25-51")
    document.set_text(document.text.replace("[mesh]", "[mesh"))
    (message,) = document.messages()
    assert message.key.startswith("line ")
    assert "not TOML" in message.rule
    with pytest.raises(InputError, match="not TOML"):
        document.set("solver.cycles", 30)
    assert document.undo()
    assert document.messages() == ()


def test_undo_and_redo_go_through_all_states_and_dragging_is_one():
    document = Document.open("spur-25-51")
    texts = [document.text]
    for shift in (0.1, 0.2, 0.3):
        document.set("drive.pinion.profile_shift", shift, drag=True)
    texts.append(document.text)
    document.set("operating.gear_torque", "600 N*m")
    texts.append(document.text)
    assert document.value("drive.pinion.profile_shift") == 0.3
    for text in reversed(texts[:-1]):
        assert document.undo()
        assert document.text == text
    assert not document.can_undo
    assert not document.undo()
    assert document.redo()
    assert document.redo()
    assert not document.redo()
    assert document.text == texts[-1]
    document.undo()
    document.set("solver.cycles", 30)
    assert not document.can_redo


def test_variants_are_kept_and_compared():
    document = Document.open("two-stage-reducer")
    document.pin("as it was")
    document.set("gear.pinion-1.profile_shift", 0.3)
    document.set("stage.1.module", "4.5 mm")
    document.restore("as it was")
    assert not document.unsaved
    assert document.can_undo
    with pytest.raises(InputError, match="no such variant"):
        document.restore("another")
    document.unpin("as it was")
    assert document.variants == ()


def test_a_link_holds_text_and_variants(tmp_path):
    document = Document.open("helical-23-47")
    document.pin("first")
    document.set("operating.gear_torque", "350 N*m")
    link = document.link()
    assert len(link) < 1500
    assert link.isascii()
    assert "/" not in link
    assert "+" not in link
    again = Document.of_link(link, tmp_path)
    assert (again.text, again.variants) == (document.text, document.variants)
    assert again.messages() == ()
    for broken in ("", "1.", link[:-9], link[1:], "1." + "A" * 40, link + "!!"):
        with pytest.raises(InputError, match="not a link"):
            Document.of_link(broken, tmp_path)


def test_tables_are_added_and_taken_out():
    document = Document.open("two-stage-reducer")
    key = document.append("stage", {"name": "third", "gears": ["wheel-2", "out"], "module": "5 mm"})
    assert key == "stage.2"
    document.set(f"{key}.pressure_angle", "20 deg")
    document.set("gear.out.teeth", 40)
    document.set("gear.out.face_width", "60 mm")
    assert document.written()["stage"][2]["pressure_angle"] == "20 deg"
    assert document.written()["gear"]["out"] == {"teeth": 40, "face_width": "60 mm"}
    document.unset("stage.2")
    document.unset("gear.out")
    assert document.written() == Document.open("two-stage-reducer").written()
    with pytest.raises(InputError, match=r"there is no stage\.7"):
        document.set("stage.7.module", "4 mm")


def test_saving_elsewhere_names_the_files_beside_it_from_there(tmp_path):
    here = tmp_path / "here"
    here.mkdir()
    drive = (shipped("models") / "drives" / "spur-25-51.toml").read_text()
    (here / "my-drive.toml").write_text(drive)
    document = Document.open("spur-25-51")
    document.set("drive", "my-drive.toml")
    document.save(here / "mine.toml")
    assert document.messages() == ()
    document.set("drive.pinion.profile_shift", 0.2)
    moved = document.save(tmp_path / "there.toml")
    assert document.messages() == ()
    assert not document.unsaved
    assert load(moved).case.pair.drive.pinion.profile_shift == 0.2
    assert tomllib.loads(moved.read_text())["drive"]["like"] == "here/my-drive.toml"


def test_no_file_is_replaced_unasked_and_none_of_the_package(tmp_path):
    document = Document.open("spur-25-51")
    with pytest.raises(InputError, match="of the package"):
        document.save()
    (tmp_path / "mine.toml").write_text("title = 'of somebody else'\n")
    with pytest.raises(InputError):
        document.save(tmp_path / "mine.toml")
    document.save(tmp_path / "other.toml")
    document.set("solver.cycles", 30)
    assert document.unsaved
    document.save()
    assert Document.open(tmp_path / "other.toml").value("solver.cycles") == 30


@pytest.mark.parametrize(("mark", "end"), [(b"", b"\n"), (b"\xef\xbb\xbf", b"\r\n")])
def test_a_file_keeps_its_ends_of_lines_and_its_mark(tmp_path, mark, end):
    lines = [b"# by an editor", b'title = "one"', b'kind = "gear-pair"', b'drive = "spur-25-51"']
    path = tmp_path / "mine.toml"
    path.write_bytes(mark + end.join(lines) + end)
    document = Document.open(path)
    document.set("title", "two")
    document.save()
    lines[1] = b'title = "two"'
    assert path.read_bytes() == mark + end.join(lines) + end
    document.set("title", "three")
    document.save()  # nobody else has changed it


def test_a_new_scenario_has_the_comments_of_its_template(tmp_path):
    document = Document.new("", tmp_path / "mine.toml")
    assert document.messages() == ()
    assert document.unsaved
    assert "# or one of:" in document.text


def test_a_csv_file_is_not_edited_through_the_scenario():
    document = Document.open("load-step")
    assert document.messages() == ()
    with pytest.raises(InputError, match="edit that file"):
        document.set("operating.output_torque_table.torque.unit", "N*m")
