"""What strangers do to the page: names of files, another writer of the file, units within a field."""

import json
import os
import shutil
import site
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("nicegui", reason="the extra app is not installed")

from tests.support.verbs import ROOT, complaint
from tribodyn.app.core.document import Document
from tribodyn.app.core.form import form_of, written_as
from tribodyn.app.folder import WorkFolder
from tribodyn.app.form_view import Sliders
from tribodyn.app.kept import MOST_KEPT, KeptWork
from tribodyn.app.server import opened
from tribodyn.app.tasks import TASKS, refusals_of
from tribodyn.errors import InputError, OutputError

PAIR = ROOT / "scenarios" / "involute-18-36-tip-relief.toml"
RELIEF = "drive.pinion.modification.tip_relief"


@pytest.mark.parametrize(
    "name", ["my drive (1).toml", "sub/a+b.toml", "-o.toml", "日本 é.toml", "spur-25-51.toml"]
)
def test_a_link_leads_to_its_file_in_the_folder_and_does_not_replace_it(tmp_path, name):
    (tmp_path / "sub").mkdir()
    (tmp_path / name).write_text(PAIR.read_text(encoding="utf-8"), encoding="utf-8")
    document = Document.open(tmp_path / name)
    document.set(RELIEF, "13 um")
    link = document.link(f"./{WorkFolder(tmp_path).named(document.path)}")
    _, again = opened(f"http://127.0.0.1:1/token/?state={link}&at=key", tmp_path)
    assert again.path.resolve() == (tmp_path / name).resolve()
    assert again.text == document.text
    with pytest.raises((InputError, OutputError)):
        again.save()
    assert again.save(force=True) == again.path
    assert 'tip_relief = "13 um"' in (tmp_path / name).read_text(encoding="utf-8")


def test_a_link_in_a_subfolder_names_files_from_there(tmp_path):
    (tmp_path / "sub").mkdir()
    shutil.copy(PAIR, tmp_path / "base.toml")
    (tmp_path / "sub" / "mine.toml").write_text('kind = "design"\nscenario = "../base.toml"\n')
    document = Document.open(tmp_path / "sub" / "mine.toml")
    _, again = opened(f"?state={document.link('./sub/mine.toml')}", tmp_path)
    assert again.value("scenario.drive.pinion.teeth") == document.value("scenario.drive.pinion.teeth") == 18


@pytest.mark.parametrize(
    "name", ["../a.toml", "/etc/a.toml", "./../a.toml", "./a/../b.toml", "./link/a.toml"]
)
def test_a_link_leads_to_no_file_elsewhere(tmp_path, name):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "link").symlink_to(tmp_path)
    with pytest.raises(InputError):
        opened(f"?state={Document.open(PAIR).link(name)}", tmp_path / "folder")


def test_a_page_loaded_again_has_history_and_what_was_saved_last(tmp_path):
    file = tmp_path / "mine.toml"
    shutil.copy(PAIR, file)
    kept, document = KeptWork(), Document.open(file)
    key = kept.keep(document)
    document.set(RELIEF, "13 um")
    document.set("title", "another")
    file.write_text(file.read_text(encoding="utf-8") + "# another editor was here\n", encoding="utf-8")
    again = kept.copy(key)
    assert again is not None
    assert again.text == document.text
    with pytest.raises(InputError, match="changed elsewhere"):
        again.save()
    assert again.undo()
    assert again.undo()
    assert not again.unsaved
    assert document.unsaved  # windows do not disturb one another
    for _ in range(MOST_KEPT):
        kept.keep(document)
    assert kept.copy(key) is None


def test_a_file_that_somebody_else_has_changed_is_not_replaced_unasked(tmp_path):
    file = tmp_path / "mine.toml"
    shutil.copy(PAIR, file)
    first, second = Document.open(file), Document.open(file)
    first.set(RELIEF, "13 um")
    second.set(RELIEF, "14 um")
    first.save()
    with pytest.raises(InputError, match="changed elsewhere"):
        second.save()
    assert 'tip_relief = "13 um"' in file.read_text(encoding="utf-8")
    second.save(file, force=True)
    second.set(RELIEF, "15 um")
    second.save()
    assert 'tip_relief = "15 um"' in file.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["con", "NUL.toml", "a?b", ".hidden", "-o", "x" * 300, "<b>", "a.", " "])
def test_names_that_some_system_refuses_are_refused(tmp_path, name):
    with pytest.raises(InputError):
        WorkFolder(tmp_path).new_file(name, ".toml")


@pytest.mark.parametrize("name", ["a", "my drive (1)", "v1.2", "日本", "console", "a.TOML"])
def test_usual_names_are_taken(tmp_path, name):
    assert WorkFolder(tmp_path).new_file(name, ".toml").parent == tmp_path.resolve()


def test_a_file_whose_name_looks_like_an_option_runs(tmp_path):
    file = tmp_path / "--help.toml"
    shutil.copy(PAIR, file)
    (words,) = TASKS["Run"].steps(file.name, {})
    assert "must be at least 4" in complaint(*words, "--set", "drive.pinion.teeth=0", folder=tmp_path)


def test_a_field_takes_a_number_with_its_own_unit():
    document = Document.open(PAIR)
    field = {one.path: one for group in form_of(document) for one in group.fields}[RELIEF]
    document.set(RELIEF, written_as(field, "0.02 mm", "um"))
    in_mm = document.value(RELIEF)
    document.set(RELIEF, written_as(field, "2e1", "um"))
    assert document.messages() == ()
    assert (in_mm, document.value(RELIEF)) == ("0.02 mm", "2e1 um")


@pytest.mark.parametrize("text", ["1e308", "-1e308", "inf", "nan", "0", "1e29"])
def test_ends_of_sliders_are_numbers_whatever_is_typed(text):
    document = Document.open(PAIR)
    document.set("operating.torque", f"{text} N*m")
    document.set(RELIEF, f"{text} um")
    fields = {one.path: one for group in form_of(document) for one in group.fields}
    json.dumps(Sliders().of(fields), allow_nan=False)


def test_a_folder_is_no_scenario(tmp_path):
    (tmp_path / "dir.toml").mkdir()
    assert "a folder" in complaint("app", "dir.toml", folder=tmp_path)
    (tmp_path / "table.csv").write_text("a,b\n1,2\n")
    assert "table.csv" in complaint("app", "table.csv", folder=tmp_path)


@pytest.mark.parametrize(
    ("name", "here", "elsewhere"),
    [
        ("spur-25-51", "Run", "Assessment"),
        ("assessment-helical-24-95", "Assessment", "Run"),
    ],
)
def test_work_is_offered_that_the_kind_has(name, here, elsewhere):
    refusals = refusals_of(Document.open(name).kind)
    assert refusals[here] == ""
    assert next(iter(refusals)) == here
    assert len(refusals[elsewhere]) > 10


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("binary.toml", b"\xff\x00"),
        ("none.rexs", b"<a/>"),
        ("none.gde", b"nonsense"),
        ("none.csv", b"some,words\nand,more\n"),
        ("none.txt", b"some words\n"),
    ],
)
def test_a_file_that_is_brought_and_cannot_be_opened_is_not_kept(tmp_path, name, content):
    folder = WorkFolder(tmp_path)
    with pytest.raises(InputError, match=name):
        folder.bring(name, content)
    assert list(tmp_path.iterdir()) == []
    folder.bring("mendable.toml", b"[broken")
    assert [path.name for path in tmp_path.iterdir()] == ["mendable.toml"]


@pytest.mark.parametrize(
    "content", [b"time [s],torque [N*m]\n0,1\n1,2\n", b"tooth,flank,F_p [um]\n1,left,0\n2,left,1\n"]
)
def test_a_table_that_a_scenario_names_and_a_measured_gear_are_taken(tmp_path, content):
    assert WorkFolder(tmp_path).bring("table.csv", content).read_bytes() == content


def test_a_scenario_may_read_what_lies_outside_the_folder_and_the_page_writes_nothing_there(tmp_path):
    """As on the command line: who may read the scenario here may read those files, too."""
    (tmp_path / "folder").mkdir()
    shutil.copy(PAIR, tmp_path / "outside.toml")
    (tmp_path / "folder" / "mine.toml").write_text('kind = "design"\nscenario = "../outside.toml"\n')
    folder, document = opened(str(tmp_path / "folder" / "mine.toml"), None)
    before = (tmp_path / "outside.toml").read_bytes()
    assert document.value("scenario.drive.pinion.teeth") == 18
    document.set("scenario.drive.pinion.teeth", 19)
    document.save()
    assert document.value("scenario.drive.pinion.teeth") == 19
    assert (tmp_path / "outside.toml").read_bytes() == before
    for name in ("../outside.toml", "../new.toml"):
        with pytest.raises(InputError):
            folder.new_file(name, ".toml")


def test_without_the_extra_the_verb_says_what_to_install(tmp_path):
    for packages in map(Path, site.getsitepackages()):
        for entry in packages.iterdir():
            if not entry.name.startswith("nicegui") and entry.suffix != ".pth":
                (tmp_path / entry.name).symlink_to(entry)
    program = [sys.executable, "-S", "-m", "tribodyn", "app"]
    environment = os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{tmp_path}"}
    done = subprocess.run(program, capture_output=True, text=True, env=environment, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.splitlines() == [
        'app: the package nicegui is not installed; install it: pip install "tribodyn[app]"'
    ]
