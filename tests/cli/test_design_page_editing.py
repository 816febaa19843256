"""The page to design on, edited otherwise than by fields: as text, by remedies, by tables to add."""

import re
import shutil
import signal
import tomllib

import pytest

from tests.support.design_page import breaches, browser, entry, eventually, opened, served
from tests.support.verbs import ROOT, complaint

PAIR = "involute-18-36-tip-relief.toml"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("designs")
    shutil.copy(ROOT / "scenarios" / PAIR, folder / "broken.toml")
    text = (folder / "broken.toml").read_text(encoding="utf-8")
    (folder / "broken.toml").write_text(text.replace("[mesh]", "[mesh"), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def page(folder):
    with served(folder, "broken.toml") as (address, server), browser() as started:
        shown = opened(started, address, wait=False)
        shown.server = server
        yield shown
        assert shown.faults == []


def wrong(page) -> list[str]:
    return page.locator(".tb-messages .tb-error > .tb-plain").all_inner_texts()


def test_a_broken_file_is_mended_in_the_page(page, folder):
    text = page.get_by_label("Scenario as text")
    eventually(page, lambda: len(wrong(page)) == 1)
    assert wrong(page) == [complaint("check", "broken.toml", folder=folder).strip()]
    number = wrong(page)[0].partition("line ")[2].partition(":")[0]
    assert page.locator(".tb-lines .wrong").inner_text() == number
    page.locator(".tb-messages .tb-plain").click()
    chosen = "one => one.value.slice(one.selectionStart, one.selectionEnd)"
    eventually(page, lambda: text.evaluate(chosen) == "[mesh")
    page.keyboard.press("End")
    page.keyboard.type("]")
    eventually(page, lambda: wrong(page) == [])
    page.keyboard.press("Control+s")
    page.wait_for_selector("text=Saved broken.toml")
    written = (folder / "broken.toml").read_text(encoding="utf-8")
    assert written == (ROOT / "scenarios" / PAIR).read_text(encoding="utf-8")


def test_form_and_text_are_one_scenario(page):
    text = page.get_by_label("Scenario as text")
    text.fill(text.input_value().replace("rtol = 1e-6", 'rtol = "none"'))
    eventually(page, lambda: len(wrong(page)) == 1)
    line = text.input_value().splitlines().index('rtol = "none"') + 1
    assert wrong(page)[0].startswith(f"Line {line}: ")
    page.get_by_role("button", name="Edit as text").click()
    page.get_by_label("Find a field").fill("rtol")
    field = entry(page, "solver.rtol")
    eventually(page, lambda: field.input_value() == "none")
    field.fill("1e-6")
    eventually(page, lambda: wrong(page) == [])
    page.get_by_role("button", name="Edit as text").click()
    eventually(page, lambda: tomllib.loads(text.input_value()).get("solver", {}).get("rtol") == 1e-6)
    page.get_by_role("button", name="Edit as text").click()


def test_a_text_that_would_not_arrive_is_refused_and_can_be_mended(page):
    page.get_by_role("button", name="Edit as text").click()
    text = page.get_by_label("Scenario as text")
    eventually(page, lambda: text.input_value() != "")
    before = text.input_value()
    text.fill(f"{before}# {'x' * 400_000}\n")
    page.wait_for_selector("text=and the page takes 300000")
    page.get_by_role("button", name="Undo").click()  # of what was not taken
    eventually(page, lambda: text.input_value() == before)
    text.fill(f"{before}# {'x' * 400_000}\n")
    page.wait_for_selector("text=and the page takes 300000")
    for _ in range(2):
        page.get_by_role("button", name="Edit as text").click()
    eventually(page, lambda: text.input_value() == before and wrong(page) == [])
    text.fill(f"{before}# {'x' * 400_000}\n")
    page.wait_for_selector("text=and the page takes 300000")
    text.fill(f"{before}# short\n")
    eventually(page, lambda: wrong(page) == [])
    page.get_by_role("button", name="Edit as text").click()


def test_what_is_typed_while_the_server_is_behind_stays(page):
    text = page.get_by_label("Scenario as text")
    eventually(page, lambda: text.input_value() == "")
    page.get_by_role("button", name="Edit as text").click()
    eventually(page, lambda: text.input_value() != "")
    before = text.input_value()
    text.press("Control+End")
    page.server.send_signal(signal.SIGSTOP)
    for word in ("# one", " two"):  # each is sent by itself
        page.keyboard.type(word)
        page.wait_for_timeout(500)
    page.server.send_signal(signal.SIGCONT)
    page.keyboard.type(" three four five six seven", delay=30)
    eventually(page, lambda: page.get_by_role("button", name="Undo").is_enabled())
    page.wait_for_timeout(1000)
    assert text.input_value() == f"{before}# one two three four five six seven"
    text.fill(before)
    page.get_by_role("button", name="Edit as text").click()


def test_a_button_takes_the_remedy_of_a_message(page):
    page.get_by_label("Find a field").fill("compliance")
    choice = page.locator('[data-field="mesh.compliance"] select')
    choice.select_option("energy")
    page.get_by_role("button", name='Set mesh.compliance = "fem"').first.click()
    eventually(page, lambda: wrong(page) == [])
    assert choice.input_value() == "fem"
    page.get_by_label("Find a field").fill("")


def test_tables_come_and_go_in_the_form(page):
    page.get_by_label("Add one of").select_option(label="Damage")
    page.get_by_role("button", name="Add", exact=True).click()
    eventually(page, lambda: any("damage.0" in one for one in wrong(page)))
    page.get_by_role("button", name="Copy Damage 1").click()
    page.wait_for_selector("text=Damage 2")
    for number in (2, 1):
        page.get_by_role("button", name=f"Remove Damage {number}").click()
    eventually(page, lambda: wrong(page) == [])
    page.get_by_role("button", name="Tables that this scenario does not have yet").click()
    page.locator("summary", has_text=re.compile("^Temperature$")).click()
    page.get_by_role("button", name="Add Temperature", exact=True).click()
    page.get_by_role("button", name="Remove Temperature", exact=True).click()
    page.get_by_label("Add one of").select_option(label="Bearings › Bearings")
    page.get_by_label("Its name").fill("a b")
    page.get_by_role("button", name="Add", exact=True).click()
    page.wait_for_selector("text=not a name for a table")
    page.get_by_role("button", name="Undo").click()
    eventually(page, lambda: wrong(page) == [])


@pytest.mark.parametrize(("width", "scheme"), [(400, "dark"), (1280, "light")])
def test_the_text_is_accessible(page, width, scheme):
    page.get_by_role("button", name="Edit as text").click()
    text = page.get_by_label("Scenario as text")
    eventually(page, lambda: text.input_value() != "")
    page.set_viewport_size({"width": width, "height": 900})
    page.emulate_media(color_scheme=scheme)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert breaches(page) == []
    text.focus()
    page.keyboard.press("Tab")  # leads out of it
    assert not text.evaluate("one => one === document.activeElement")
    page.get_by_role("button", name="Edit as text").click()
    page.set_viewport_size({"width": 1280, "height": 900})
