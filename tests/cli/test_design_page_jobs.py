"""Longer work from the page to design on: searches, maps, assessments, files brought in; ended, and kept."""

import shutil
import signal
from urllib.parse import quote

import pytest

from tests.support.design_page import breaches, browser, eventually, opened, served
from tests.support.verbs import ROOT, invoke
from tribodyn.record.reader import Record

ASSESSMENT = """title = "Margins of a spur pair"
kind = "assessment"
drive = { like = "spur-25-51", quality = 6 }
lubricant = "iso-vg-220-mineral"
bearings = "rigid-1e9"
[operating]
pinion_speed = "1500 rpm"
gear_torque = "550 N*m"
oil_temperature = "80 degC"
[assessment]
application_factor = 1.25
speeds = 0
samples = 0
damping_ratio = 0.05
"""


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory):
    folder = tmp_path_factory.mktemp("elsewhere")
    invoke("export", "spur-25-51", "--to", "rexs", "-o", folder / "brought.rexs")
    invoke("export", "run-out-25-51", "--to", "gde", "-o", folder / "pinion.gde")
    (folder / "table.exe").write_text("x")
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("designs")
    shutil.copy(ROOT / "scenarios" / "spur-25-51.toml", folder / "mine.toml")
    (folder / "margins.toml").write_text(ASSESSMENT, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def served_page(folder):
    with served(folder, "mine.toml") as (address, process), browser() as started:
        shown = opened(started, address, wait=False)
        yield shown, address, process
        # a file that is refused is an error of the console, too
        assert [fault for fault in shown.faults if "status of 400" not in fault] == []


@pytest.fixture
def page(served_page):
    return served_page[0]


def close(page) -> None:
    page.keyboard.press("Escape")
    closed(page)


def closed(page) -> None:
    """Wait until a dialog is gone: one that fades is visible still."""
    page.wait_for_selector(".q-dialog", state="detached")


def start(page, what: str, **given: str) -> None:
    """Start a task in the dialog, which is open then."""
    if not page.get_by_role("dialog").is_visible():
        page.get_by_role("button", name="Run …").click()
    page.get_by_label("What", exact=True).click()
    page.get_by_role("option", name=what).click()
    for label, text in given.items():
        page.get_by_label(label.replace("_", " "), exact=True).fill(text)
    begun = page.locator(".tb-jobs article")
    before = begun.count()
    page.get_by_role("button", name="Start", exact=True).click()
    eventually(page, lambda: begun.count() == before + 1)


def ended(page, state: str = "done"):
    """The newest task, when it has ended so."""
    newest = page.locator(".tb-jobs article").first
    eventually(page, lambda: newest.get_attribute("data-job") != "running")
    assert newest.get_attribute("data-job") == state, newest.inner_text()
    return newest


def cancelled(page):
    """End the newest task by an ordinary click, and return it."""
    newest = page.locator(".tb-jobs article").first
    newest.get_by_role("button", name="Cancel", exact=True).click()
    return ended(page, "cancelled")


def test_a_search_and_a_map_run_to_their_end_and_stay_in_the_list(page, folder):
    start(
        page,
        "Search",
        Key="drive.pinion.profile_shift",
        From_and_to="0:0.1",
        Minimise="transmission_error_peak_to_peak",
        Evaluations="2",
    )
    link = ended(page).locator("a[href$='.html']").first.get_attribute("href")
    assert page.request.get(link).ok
    start(page, "Map of losses", Torques="200:400:200N*m", Speeds="1000:2000:1000rpm")
    link = ended(page).locator("a[href$='.html']").first.get_attribute("href")
    assert "loss" in page.request.get(link).text()
    with Record(folder / "mine-map.h5") as record:
        assert record.status == "complete"
    page.reload()
    page.get_by_role("button", name="Run …").click()
    eventually(page, lambda: page.locator(".tb-jobs article").count() == 2)
    assert page.locator(f".tb-jobs a[href='{link}']").count() == 1


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="no process can be stopped for a while here")
def test_a_dialog_that_is_closed_and_asked_for_at_once_comes(served_page):
    page, _, process = served_page
    run = page.get_by_role("button", name="Run …")
    if not page.get_by_role("dialog").is_visible():
        run.click()
    page.get_by_role("dialog").wait_for()
    box = run.bounding_box()
    process.send_signal(signal.SIGSTOP)  # both reach the server together
    page.keyboard.press("Escape")
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)  # while the dialog fades
    closed(page)  # without the server
    process.send_signal(signal.SIGCONT)
    page.get_by_role("dialog").wait_for()
    close(page)


def test_a_map_is_ended_and_what_it_has_is_kept(page, folder):
    start(page, "Map of losses", Torques="100:1000:50N*m", Speeds="500:3000:100rpm")
    page.get_by_role("button", name="Start", exact=True).click()  # as by a double click
    page.wait_for_selector('text="Map of losses of mine": is running')
    newest = page.locator(".tb-jobs article").first
    cancel = newest.get_by_role("button", name="Cancel", exact=True)
    place = cancel.bounding_box()
    newest.locator(".tb-line").evaluate("one => { one.textContent = 'what it is at '.repeat(30); }")
    assert cancel.bounding_box() == place  # what a task says moves no button away from under a click
    eventually(page, lambda: bool(list(folder.glob("mine-map-parts/*"))))
    cancelled(page).get_by_role("button", name="Go on").click()
    page.wait_for_selector(".tb-jobs article[data-job=running] >> text=Map of losses")
    cancelled(page)
    close(page)


def test_files_are_brought_in_and_never_over_another(page, folder, elsewhere):
    def bring(name: str) -> None:
        if not page.get_by_role("dialog").is_visible():
            page.get_by_role("button", name="Open", exact=True).click()
        page.get_by_label("Bring a file into this folder").set_input_files(elsewhere / name)

    bring("brought.rexs")
    page.wait_for_selector("h1 >> text=brought.toml")
    closed(page)
    assert (folder / "brought.rexs").read_bytes() == (elsewhere / "brought.rexs").read_bytes()
    for name, why in (("brought.rexs", "is there already"), ("table.exe", "ends in none of")):
        bring(name)
        page.wait_for_selector(f".q-dialog >> text={why}")
    bring("pinion.gde")
    page.wait_for_selector("text=pinion.gde lies in the folder now")
    closed(page)
    page.go_back()
    page.wait_for_selector("h1 >> text=mine.toml")
    start(page, "Measured gear", File="pinion.gde", Gear="pinion", New_scenario="measured")
    ended(page).get_by_role("button", name="Open measured.toml").click()
    page.wait_for_selector("h1 >> text=measured.toml")
    closed(page)
    assert (folder / "measured.toml").is_file()


@pytest.mark.parametrize(
    "name", ["../over.toml", "sub/../../over.toml", ".hidden.toml", "a.h5", "/over.toml"]
)
def test_nothing_is_brought_to_another_place(served_page, folder, name):
    page, address, _ = served_page
    assert page.request.post(f"{address}bring/{quote(name, safe='')}", data=b"x").status in (400, 404)
    assert not (folder.parent / "over.toml").exists()


def test_a_foreign_page_brings_nothing(served_page, folder):
    page, address, _ = served_page
    headers = {"Origin": "http://evil.example"}
    assert page.request.post(f"{address}bring/evil.toml", data=b"x", headers=headers).status == 403
    assert not (folder / "evil.toml").exists()


def test_an_assessment_is_begun_and_ended_where_the_kind_has_no_run(page, folder):
    page.get_by_role("button", name="Open", exact=True).click()
    page.get_by_role("button", name="margins.toml").click()
    page.wait_for_selector("h1 >> text=margins.toml")
    closed(page)
    page.get_by_role("button", name="Run …").click()
    page.wait_for_selector("text=Run: a scenario of kind assessment is assessed, not run.")
    start(page, "Assessment")
    cancelled(page)
    close(page)


def test_an_assessment_runs_to_its_end(page, folder):
    start(page, "Assessment")
    link = ended(page).locator("a[href$='.html']").first.get_attribute("href")
    assert page.request.get(link).ok
    close(page)


def test_the_dialog_of_tasks_and_that_of_files_are_accessible(page):
    for button in ("Run …", "Open"):
        page.get_by_role("button", name=button, exact=True).click()
        page.wait_for_selector(".q-dialog .tb-dialog")
        page.wait_for_timeout(400)  # it fades in
        assert breaches(page) == []
        close(page)
