"""The page to design on in a real browser: open, drag, compare, save, sweep, an error at its field."""

import http.client
import re
import shutil
import signal
import time
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from tests.support.design_page import (
    RELIEF,
    breaches,
    browser,
    drag,
    entry,
    eventually,
    number,
    opened,
    served,
)
from tests.support.verbs import complaint, invoke
from tribodyn.app.core.document import Document
from tribodyn.record.reader import Record

SWING = "transmission_error_peak_to_peak"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    return tmp_path_factory.mktemp("designs")


@pytest.fixture(scope="module")
def address(folder):
    with served(folder, "involute-18-36-tip-relief", "--folder", str(folder)) as (address, _):
        yield address


@pytest.fixture(scope="module")
def chromium():
    with browser() as started:
        yield started


@pytest.fixture(scope="module")
def page(chromium, address):
    shown = opened(chromium, address)
    yield shown
    assert shown.faults == []


def test_a_dragged_value_moves_teeth_curves_and_numbers_beside_the_pinned_state(page):
    assert page.locator(".tb-teeth path.tb-body").count() == 2
    swing, curve = number(page, SWING), page.locator('[data-chart="te-static"] figcaption').inner_text()
    page.get_by_role("button", name="Pin", exact=True).click()
    page.wait_for_selector("text=Numbers beside variant 1")
    drag(page, RELIEF, 0.6)
    eventually(page, lambda: number(page, SWING) > 1.5 * swing)
    assert 25.0 < float(entry(page, RELIEF).input_value()) < 35.0  # of a slider from 0 to 50 um
    assert number(page, SWING, 2) == swing
    assert page.locator('[data-chart="te-static"] figcaption').inner_text().partition(";")[0] != curve
    assert "pinned" in page.locator('[data-chart="te-motion"] figcaption').inner_text()
    assert page.locator(".tb-teeth path.tb-pinned").count() == 2
    page.get_by_role("button", name="Undo").click()  # the whole drag
    eventually(page, lambda: entry(page, RELIEF).input_value() == "12.4")
    eventually(page, lambda: number(page, SWING) == swing)
    eventually(page, lambda: page.locator("html.tb-late").count() == 0)


def test_keys_roll_the_teeth_and_step_a_value(page):
    body = page.locator(".tb-teeth g[transform*=rotate]").first
    before = body.get_attribute("transform")
    page.locator(".tb-teeth svg").focus()
    page.keyboard.press("ArrowRight")
    eventually(page, lambda: body.get_attribute("transform") != before)
    entry(page, RELIEF).fill("10")
    eventually(page, lambda: "(not saved)" in page.locator("h1").inner_text())
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Tab")
    eventually(page, lambda: entry(page, RELIEF).input_value() == "10.25")


def test_a_wrong_value_is_said_at_its_field_as_the_command_line_says_it(page):
    key = "drive.pinion.modification.tip_relief_length"
    entry(page, key).fill("-2")
    page.wait_for_selector(f'[data-field="{key}"].wrong')
    said = complaint("check", "involute-18-36-tip-relief", "--set", f"{key}=-2 mm")
    rule = said.partition(": ")[2].partition(": ")[2]
    assert page.locator(f'[data-field="{key}"] .tb-error').inner_text() == rule
    assert entry(page, key).get_attribute("aria-invalid") == "true"
    assert page.locator(".tb-teeth path.tb-body").count() == 2  # the last picture stays
    entry(page, key).fill("5.41")
    page.wait_for_selector(f'[data-field="{key}"]:not(.wrong)')


def test_what_is_saved_runs_to_the_same_numbers(page, folder):
    entry(page, RELIEF).fill("12.65")
    page.keyboard.press("Tab")
    page.wait_for_selector("text=(not saved)")
    page.get_by_role("button", name="Save as").click()
    page.get_by_label("Name in this folder").fill("../elsewhere")
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("button", name="Save").click()
    page.wait_for_selector("text=no file of this folder")
    page.get_by_label("Name in this folder").fill("quiet")
    dialog.get_by_role("button", name="Save").click()
    page.wait_for_selector("text=Saved quiet.toml")
    text = (folder / "quiet.toml").read_text(encoding="utf-8")
    assert 'tip_relief = "12.65 um"' in text
    assert "# minimum error at this torque" in text  # comments are kept
    invoke("run", folder / "quiet.toml", "-o", folder / "quiet.h5", "--no-plot")
    with Record(folder / "quiet.h5") as record:
        swing = record.summary[SWING] * 1e6
    eventually(page, lambda: number(page, SWING) == pytest.approx(swing, rel=1e-3))


def test_a_page_loaded_again_shows_what_it_showed(page):
    entry(page, RELIEF).fill("14")
    page.wait_for_selector("text=(not saved)")
    page.reload()
    page.wait_for_selector("text=Numbers beside variant 1")
    eventually(page, lambda: entry(page, RELIEF).input_value() == "14")


def test_a_sweep_runs_beside_the_page_and_links_to_its_report(page, address):
    page.get_by_role("button", name="Run …").click()
    page.get_by_label("What", exact=True).click()
    page.get_by_role("option", name="Sweep").click()
    page.get_by_label("Key", exact=True).fill("operating.pinion_speed")
    page.get_by_label("Values", exact=True).fill("1000:1200:200rpm")
    page.get_by_role("button", name="Start").click()
    page.wait_for_selector("[data-job=done]")
    link = page.locator(".tb-jobs a[href$='.html']").first.get_attribute("href")
    answer = page.request.get(link)
    assert answer.ok
    assert "sandbox" in answer.headers["content-security-policy"]
    assert "quiet" in answer.text()
    page.keyboard.press("Escape")


@pytest.mark.parametrize(("width", "scheme"), [(400, "light"), (1280, "dark"), (2560, "light")])
def test_it_is_accessible_from_phone_to_wall_in_light_and_dark(page, width, scheme):
    page.set_viewport_size({"width": width, "height": 900})
    page.emulate_media(color_scheme=scheme)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert breaches(page) == []
    page.set_viewport_size({"width": 1280, "height": 900})


def test_dialogs_are_accessible(page):
    page.get_by_role("button", name="Link", exact=True).click()
    page.wait_for_selector(".q-dialog .tb-dialog")
    page.wait_for_timeout(400)  # it fades in
    assert breaches(page) == []
    page.keyboard.press("Escape")
    page.wait_for_selector(".q-dialog .tb-dialog", state="detached")


def test_another_window_is_another_drive_and_a_mesh_is_chosen_by_key(chromium, address, page):
    other = opened(chromium, address, wait=False)
    other.get_by_role("button", name="Open", exact=True).click()
    other.get_by_role("button", name="Planetary load sharing").click()
    ring = other.locator('[data-mesh="set-ring-1"]')
    ring.focus()
    other.keyboard.press("Enter")
    other.wait_for_selector('[data-mesh="set-ring-1"][aria-pressed=true]')
    assert other.locator(".tb-teeth path.tb-ring").count() == 1
    assert "planetary" in other.locator("h1").inner_text()
    assert "planetary" not in page.locator("h1").inner_text()
    assert other.faults == []
    other.close()


@pytest.mark.parametrize(
    ("headers", "token"),
    [
        ({}, "wrong"),
        ({"Host": "evil.example"}, ""),
        ({"Origin": "http://evil.example"}, ""),
        ({"Origin": "null"}, ""),
    ],
)
@pytest.mark.parametrize("socket", [False, True])
def test_strangers_are_refused(address, headers, token, socket):
    place = urlsplit(address)
    path = f"/{token or place.path.strip('/')}/"
    upgrade = {
        "Connection": "Upgrade",
        "Upgrade": "websocket",
        "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
    }
    if socket:
        path += "_nicegui_ws/socket.io/?EIO=4&transport=websocket"
    assert status(place.netloc, path, headers | (upgrade if socket else {})) == 403


def test_the_page_itself_is_served_and_nothing_outside_the_folder(address, folder):
    place = urlsplit(address)
    assert place.hostname == "127.0.0.1"
    assert status(place.netloc, place.path, {}) == 200
    (folder.parent / "secret.html").write_text("secret")
    (folder / "link.html").symlink_to(folder.parent / "secret.html")
    for name in ("../secret.html", "%2e%2e/secret.html", "link.html", "quiet.toml", "/etc/passwd"):
        assert status(place.netloc, f"{place.path}files/{name}", {}) in (403, 404)


def test_the_command_of_a_browser_leads_to_the_page_once_and_holds_no_token(tmp_path):
    """Other users of the machine can read the words of a command."""
    words, program = tmp_path / "words", tmp_path / "browser"
    program.write_text(f'#!/bin/sh\necho "$@" > {words}.new; mv {words}.new {words}\n')
    program.chmod(0o700)
    with served(tmp_path, program=program) as (address, _):
        for _ in range(200):
            if words.is_file():
                break
            time.sleep(0.05)
        invitation, place = urlsplit(words.read_text().strip()), urlsplit(address)
        assert place.path.strip("/") not in invitation.path
        assert status(place.netloc, invitation.path, {"Host": "evil.example"}) == 403
        assert status(place.netloc, invitation.path, {}) == 303
        assert status(place.netloc, invitation.path, {}) == 403


def status(host: str, path: str, headers: dict[str, str]) -> int:
    connection = http.client.HTTPConnection(host, timeout=60)
    connection.putrequest("GET", path, skip_host="Host" in headers)
    for name, value in headers.items():
        connection.putheader(name, value)
    connection.endheaders()
    found = connection.getresponse().status
    connection.close()
    return found


def test_a_run_of_minutes_leaves_undo_typing_and_scrolling_free(chromium, address, folder):
    document = Document.open("spur-25-51")
    document.set("solver.cycles", 40_000)
    document.set("output.window", [0, 1])
    page = opened(chromium, f"{address}?state={document.link()}", wait=False)
    running = '.tb-busy.on[data-late^="motion"]'  # teeth and quasi-static error are there
    page.wait_for_selector(running)
    shift = "drive.pinion.profile_shift"
    page.get_by_label("Find a field").fill("profile shift")
    before, drawn = entry(page, shift).input_value(), page.locator(".tb-teeth path.tb-body").first
    outline = drawn.get_attribute("d")
    entry(page, shift).fill("0.31")
    eventually(page, lambda: drawn.get_attribute("d") != outline)
    page.wait_for_selector(running)
    page.get_by_role("button", name="Undo").click()
    eventually(page, lambda: entry(page, shift).input_value() == before)
    eventually(page, lambda: drawn.get_attribute("d") == outline)
    page.wait_for_selector(running)
    page.mouse.move(640, 600)
    page.mouse.wheel(0, 500)
    eventually(page, lambda: page.evaluate("window.scrollY") > 0)
    assert page.locator(running).count() == 1
    assert page.locator("html.tb-late .tb-numbers").count() == 1  # they are of no value yet
    assert breaches(page) == []
    assert page.faults == []
    page.close()


def test_a_killed_server_leaves_what_was_saved_and_no_process(chromium, tmp_path):
    shutil.copy(Path("scenarios/involute-18-36-tip-relief.toml"), tmp_path / "mine.toml")
    with served(tmp_path, "mine.toml") as (address, process):
        page = opened(chromium, address, wait=False)
        entry(page, RELIEF).fill("11")
        page.wait_for_selector("text=(not saved)")
        page.keyboard.press("Control+s")
        page.wait_for_selector("text=Saved mine.toml")
        entry(page, RELIEF).fill("99")
        page.wait_for_selector("text=(not saved)")
        workers = children(process.pid)
        assert workers
        process.send_signal(signal.SIGKILL)
        process.wait()
        page.close()
    assert 'tip_relief = "11 um"' in (tmp_path / "mine.toml").read_text(encoding="utf-8")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.toml"]
    for _ in range(300):
        if not any(Path(f"/proc/{worker}").exists() for worker in workers):
            return
        time.sleep(0.1)
    raise AssertionError("a worker goes on without its server")


def children(parent: int) -> list[int]:
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == parent:
            found.append(int(stat.parent.name))
    return found


def test_bad_words_are_one_line(tmp_path):
    assert re.search("no such file|did you mean", complaint("app", "none.toml", folder=tmp_path))
    assert "no such folder" in complaint("app", "--folder", tmp_path / "none")
