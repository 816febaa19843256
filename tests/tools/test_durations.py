"""The order of the test files and the choice of the quick tests."""

import json
from types import SimpleNamespace
from typing import Any, cast

import pytest

from tests.support import durations
from tests.support.durations import Durations

NAMES = (
    "unit/test_a.py::test_1",
    "unit/test_a.py::test_2",
    "unit/test_b.py::test_1",
    "unit/test_new.py::test_1",
)


@pytest.fixture
def measured(tmp_path, monkeypatch):
    """Where the durations are read from and written to."""
    monkeypatch.setattr(durations, "MEASURED", tmp_path / "durations.json")
    return tmp_path / "durations.json"


def plugin(*options: str) -> Durations:
    hook = SimpleNamespace(pytest_deselected=lambda items: None)
    return Durations(cast(Any, SimpleNamespace(getoption=lambda name: name in options, hook=hook)))


def collected(*options: str) -> list[str]:
    items: Any = [SimpleNamespace(nodeid=f"tests/{name}") for name in NAMES]
    plugin(*options).pytest_collection_modifyitems(items)
    return [item.nodeid.removeprefix("tests/") for item in items]


def run(seconds: dict[str, float], *options: str) -> None:
    runner = plugin("--measure-durations", *options)
    for name, took in seconds.items():
        for part in (0.25, 0.75):  # setup and call
            runner.pytest_runtest_logreport(
                cast(Any, SimpleNamespace(nodeid=f"tests/{name}", duration=part * took))
            )
    runner.pytest_sessionfinish(0)


def test_the_longest_files_come_first_and_new_ones_before_them(measured):
    run({NAMES[0]: 1.0, NAMES[1]: 5.0, NAMES[2]: 7.0})
    assert collected() == [NAMES[3], NAMES[2], NAMES[0], NAMES[1]]
    assert json.loads(measured.read_text())["files"] == {"unit/test_b.py": 7.0, "unit/test_a.py": 6.0}


def test_quick_tests_are_the_shortest_and_the_new_ones(measured):
    run({NAMES[0]: 0.2, NAMES[1]: 20.0, NAMES[2]: 0.3, **{f"unit/test_c.py::{n}": 1.0 for n in range(30)}})
    assert collected("--quick") == [NAMES[3], NAMES[0], NAMES[2]]
