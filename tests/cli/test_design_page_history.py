"""The page to design on, gone back to and loaded again: what was not saved stays, and replaces no file."""

import shutil

import pytest

from tests.support.design_page import RELIEF, browser, entry, eventually, opened, served
from tests.support.verbs import ROOT


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("designs")
    shutil.copy(ROOT / "scenarios" / "involute-18-36-tip-relief.toml", folder / "mine.toml")
    return folder


@pytest.fixture(scope="module")
def page(folder):
    with served(folder, "mine.toml") as (address, _), browser() as started:
        shown = opened(started, address, wait=False)
        yield shown
        assert shown.faults == []


def test_another_scenario_is_opened_and_the_one_before_comes_back_with_its_changes(page):
    entry(page, RELIEF).fill("13")
    page.wait_for_selector("text=mine.toml (not saved)")
    page.get_by_role("button", name="Open", exact=True).click()
    page.wait_for_selector("text=The browser's Back brings them back.")
    page.get_by_role("button", name="Hot film").click()
    page.wait_for_selector("h1 >> text=spur-25-51.toml")
    page.go_back()
    page.wait_for_selector("text=mine.toml (not saved)")
    eventually(page, lambda: entry(page, RELIEF).input_value() == "13")
    page.go_forward()
    page.wait_for_selector("h1 >> text=spur-25-51.toml")
    page.go_back()
    page.wait_for_selector("text=mine.toml (not saved)")
    page.get_by_role("button", name="Undo").click()
    eventually(page, lambda: entry(page, RELIEF).input_value() == "12.4")
    page.get_by_role("button", name="Redo").click()
    eventually(page, lambda: entry(page, RELIEF).input_value() == "13")


def test_a_page_loaded_again_does_not_replace_a_file_that_another_program_has_changed(page, folder):
    file = folder / "mine.toml"
    file.write_text(file.read_text(encoding="utf-8") + "# of another editor\n", encoding="utf-8")
    page.reload()
    eventually(page, lambda: entry(page, RELIEF).input_value() == "13")
    page.keyboard.press("Control+s")
    page.wait_for_selector("text=was changed elsewhere since it was opened")
    assert file.read_text(encoding="utf-8").endswith("# of another editor\n")


def test_a_state_that_no_address_holds_is_there_when_the_page_is_loaded_again(page):
    page.get_by_role("button", name="Edit as text").click()
    text = page.get_by_label("Scenario as text")
    eventually(page, lambda: text.input_value() != "")
    digits = f"{7**150_000:x}"  # which no packer makes short
    text.fill(f"{text.input_value()}# {digits}\n")
    eventually(page, lambda: "state=" not in page.evaluate("location.search"))
    page.reload()  # it is shown as text again
    eventually(page, lambda: digits in text.input_value())
    assert page.get_by_role("button", name="Edit as text").get_attribute("aria-pressed") == "true"
    page.get_by_role("button", name="Link", exact=True).click()
    page.wait_for_selector("text=too long for an address")
