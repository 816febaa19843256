"""A page as PDF: on A4, whole or not at all, and refused before any work where nothing can print it."""

import os
import re
import shutil
import signal
import tempfile
from pathlib import Path

import pytest

from tests.support.short_studies import shortened, written_template
from tests.support.verbs import complaint, ended, invoke
from tribodyn.post.page import document
from tribodyn.post.page.document import BROWSERS, browser, run_browser

RECORDS = Path(__file__).parents[3] / "fixtures" / "records-0.2.0"


def test_without_a_browser_nothing_is_begun(tmp_path: Path):
    empty = tmp_path / "programs"
    empty.mkdir()
    scenario, out = written_template("assessment", tmp_path), tmp_path / "out"
    for words in (
        ("assess", scenario, *shortened("assessment"), "-o", out, "--pdf"),
        ("report", RECORDS / "assessment.h5", "-o", tmp_path / "page.html", "--pdf"),
    ):
        assert "install Chromium or Chrome" in complaint(*words, env={"PATH": str(empty)})
    assert not out.exists()
    assert not (tmp_path / "page.html").exists()


@pytest.mark.parametrize("script", ["exit 3", "exit 0", "kill -9 $$"])
def test_a_browser_that_fails_leaves_what_was_there(script: str, tmp_path: Path):
    programs, page = tmp_path / "programs", tmp_path / "page.html"
    programs.mkdir()
    broken = programs / BROWSERS[0]
    broken.write_text(f"#!/bin/sh\n{script}\n", encoding="ascii")
    broken.chmod(0o755)
    before = b"%PDF-1.4\n% as it was\n\n% made by tribodyn\n"
    page.with_suffix(".pdf").write_bytes(before)
    failed = ended("report", RECORDS / "assessment.h5", "-o", page, "--pdf", env={"PATH": str(programs)})
    assert failed.exit_code != 0
    assert "the browser ended with status" in failed.stderr
    assert page.with_suffix(".pdf").read_bytes() == before
    assert {file.name for file in tmp_path.iterdir()} == {"programs", "page.html", "page.pdf"}


@pytest.mark.skipif(os.name != "posix", reason="the browser of this test is a script")
def test_an_interrupted_browser_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Chromium keeps files beside its profile too, and does not remove them when it is killed."""
    programs, temporary = tmp_path / "programs", tmp_path / "temporary"
    programs.mkdir()
    temporary.mkdir()
    waiting = programs / BROWSERS[0]
    begun = tmp_path / "begun"
    script = f'#!/bin/sh\nmkdir "$TMPDIR/scoped"\n: > {begun}\nkill -INT {os.getpid()}\nsleep 60\n'
    waiting.write_text(script, encoding="utf-8")
    waiting.chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("TMPDIR", str(temporary))
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    monkeypatch.setattr(document, "LONGEST_PROFILE", 1000)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background of a shell
    try:
        with pytest.raises(KeyboardInterrupt):
            run_browser()
    finally:
        signal.signal(signal.SIGINT, before)
    assert begun.is_file()
    assert not list(temporary.iterdir())


@pytest.mark.skipif(browser() is None, reason="no browser is installed")
def test_pages_are_printed_on_a4(tmp_path: Path):
    record = shutil.copy(RECORDS / "assessment.h5", tmp_path)
    invoke("report", record, "-o", tmp_path / "page.html", "--pdf", "--json")
    printed = (tmp_path / "page.pdf").read_bytes()
    boxes = re.findall(rb"/MediaBox ?\[([^]]*)\]", printed)
    assert boxes
    for box in boxes:
        left, bottom, right, top = map(float, box.split())
        assert (right - left, top - bottom) == pytest.approx((595.28, 841.89), abs=1.0)
    assert printed.endswith(b"% made by tribodyn\n")
