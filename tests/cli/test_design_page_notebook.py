"""The page to design on below a cell of a notebook: a frame of another server's page, with fewer parts."""

import shutil
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest

from tests.support.design_page import PATIENCE, RELIEF, browser, eventually
from tests.support.verbs import ROOT


def test_a_cell_shows_the_page_and_saves_its_file(tmp_path, monkeypatch):
    pytest.importorskip("nicegui", reason="the extra app is not installed")
    import tribodyn as td

    monkeypatch.delenv("PYTEST_CURRENT_TEST")  # the library behaves otherwise within a test
    shutil.copy(ROOT / "scenarios" / "involute-18-36-tip-relief.toml", tmp_path / "mine.toml")
    notebook = ThreadingHTTPServer(("127.0.0.1", 0), partial(SimpleHTTPRequestHandler, directory=tmp_path))
    threading.Thread(target=notebook.serve_forever, daemon=True).start()
    with browser() as started, notebook:
        explorer = td.explore(tmp_path / "mine.toml")
        (tmp_path / "cell.html").write_text(f"<!doctype html><title>cell</title>{explorer._repr_html_()}")
        try:
            page = started.new_page()
            page.set_default_timeout(PATIENCE)
            page.goto(f"http://localhost:{notebook.server_port}/cell.html")
            frame = page.frame_locator("iframe")
            frame.locator(f'[data-field="{RELIEF}"] input[type=text]').fill("13")
            eventually(page, lambda: "(not saved)" in frame.locator("h1").inner_text())
            names = frame.get_by_role("toolbar").get_by_role("button").all_inner_texts()
            assert names == ["Undo", "Redo", "Pin", "Save"]
            frame.get_by_role("button", name="Save").click()
            eventually(page, lambda: "(not saved)" not in frame.locator("h1").inner_text())
        finally:
            explorer.close()
            notebook.shutdown()
    assert 'tip_relief = "13 um"' in (tmp_path / "mine.toml").read_text(encoding="utf-8")
