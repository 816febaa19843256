"""A server of the page to design on in a process of its own, and a browser on it."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.support.verbs import ROOT

#: The browser of the machine.
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
#: What a page waits for at most, ms: a machine that does other work takes long.
PATIENCE = 120_000
#: All stages of the newest value have been computed.
UP_TO_DATE = ".tb-busy:not(.on)"
RELIEF = "drive.pinion.modification.tip_relief"


@contextmanager
def served(
    folder: Path, *words: str, program: Path | None = None
) -> Iterator[tuple[str, "subprocess.Popen[str]"]]:
    """The address of a server of a folder, and its process; `program` stands for the user's browser."""
    # the library behaves otherwise where it believes itself within a test
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
    command = [sys.executable, "-m", "tribodyn", "app", *words, "--port", "0"]
    if program is None:
        command.append("--no-browser")
    else:
        environment["BROWSER"] = str(program)
    process = subprocess.Popen(
        command,
        cwd=folder,
        env=environment | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        assert process.stdout is not None
        yield process.stdout.readline().strip(), process
    finally:
        process.terminate()
        process.communicate(timeout=60)


@contextmanager
def browser() -> Iterator[Any]:
    """A browser without a window; the test is skipped where the machine has none."""
    if CHROMIUM is None:
        pytest.skip("no Chromium is installed")
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with playwright.sync_playwright() as driver:
        started = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        try:
            yield started
        finally:
            started.close()


def opened(browser: Any, address: str, *, wait: bool = True) -> Any:
    """A page on the address, first steps skipped, all computed unless told; `faults`: errors of scripts."""
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.set_default_timeout(PATIENCE)
    page.faults = []
    page.on("pageerror", lambda error: page.faults.append(str(error)))
    page.on("console", lambda line: line.type == "error" and page.faults.append(line.text))
    page.on("dialog", lambda dialog: dialog.accept())
    page.goto(address)
    page.get_by_role("button", name="Skip").click()
    if wait:
        page.wait_for_selector(UP_TO_DATE)
    return page


def eventually(page: Any, what: Callable[[], bool]) -> None:
    """Wait until something holds: what a page shows comes from several processes."""
    for _ in range(PATIENCE // 100):
        if what():
            return
        page.wait_for_timeout(100)
    raise AssertionError("it does not come to hold")


def breaches(page: Any) -> list[str]:
    """Rules of WCAG 2.1 A and AA that the page breaks, by their names at axe, which counts no others."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    rules = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]
    found = axe.run(page, options={"runOnly": rules, "resultTypes": ["violations"]})
    return [each["id"] for each in found.response["violations"]]


def entry(page: Any, path: str) -> Any:
    """The input of a field."""
    return page.locator(f'[data-field="{path}"] input[type=text]')


def number(page: Any, name: str, column: int = 1) -> float:
    """A number of the table: of this state (1), of the pinned variant (2)."""
    text = page.locator(f'[data-number="{name}"] > *').nth(column).inner_text()
    return float(text.replace(",", "").replace("−", "-"))


def drag(page: Any, path: str, share: float) -> None:
    """Drag the slider of a field, in steps, to a share of its way."""
    slider = page.locator(f'[data-field="{path}"] input[type=range]')
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    begin = slider.evaluate("one => (one.value - one.min) / (one.max - one.min)")
    y = box["y"] + box["height"] / 2

    def x(place: float) -> float:
        return box["x"] + 8 + (box["width"] - 16) * place  # its thumb is 16 px wide

    page.mouse.move(x(begin), y)
    page.mouse.down()
    for step in range(1, 11):
        page.mouse.move(x(begin + (share - begin) * step / 10), y)
    page.mouse.up()
