"""The page of licences names what is tested with, and nothing that a run needs obliges its users to more."""

import re

import pytest

from tools.licences import COPYLEFT, PAGE, Row, constraints, is_known, needed, rows, same_name


def listed() -> list[Row]:
    lines = re.findall(
        r"^\| (\S+) \| (\S+) \| ([^|]+) \| (\w+) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE
    )
    return [Row(*line) for line in lines]


def test_the_page_is_current_with_the_constraints():
    assert {row.name: row.version for row in listed()} == constraints()


def test_the_page_says_what_the_metadata_say():
    pytest.importorskip("distributed")
    page, here = [row for row in listed() if is_known(row.name)], rows()
    assert [row[:3] for row in page] == [row[:3] for row in here]
    # where not all extras are installed, what one of them needs looks like something for development
    needed_for = {(a.needed_for, b.needed_for) for a, b in zip(page, here, strict=True)}
    assert all(a == b or (a, b) == ("extras", "development") for a, b in needed_for)


def test_nothing_that_a_run_needs_is_copyleft():
    default = needed()
    assert set("numpy numba jax matplotlib pint ezdxf h5py scikit-fem llvmlite".split()) <= default
    found = {row.name: row.licence for row in listed() if same_name(row.name) in default}
    assert len(found) == len(default)
    assert not {name: licence for name, licence in found.items() if COPYLEFT.search(licence)}
    assert all(licence != "unknown" for licence in found.values())
