"""How long tests take: measured into tests/durations.json, which orders the files and chooses the quick tests.

`make durations` measures. Seconds are relative to each other: on another machine all are longer or shorter, and
the order is much the same. Files and tests that were never measured count as new: they run first, and in
`make quick`.
"""

import json
from collections import Counter
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
MEASURED = TESTS / "durations.json"
#: `--quick` leaves out what takes longer than this, s. Sum of the rest: about 45 s on two cores.
QUICK = 0.3
#: Tests below this are not listed, s; together they make the list short and its changes few.
LISTED = 0.1


def add_options(parser: pytest.Parser) -> None:
    """Add the options `--measure-durations` and `--quick`."""
    group = parser.getgroup("durations")
    group.addoption("--measure-durations", action="store_true", help=f"write {MEASURED.name}")
    group.addoption("--quick", action="store_true", help=f"only tests that take at most {QUICK} s")


class Durations:
    """A plugin: sorts and selects what was collected, and measures what runs.

    Parameters
    ----------
    config : pytest.Config
        With the options of `add_options`.
    """

    def __init__(self, config: pytest.Config) -> None:
        self.config = config
        self.seconds: Counter[str] = Counter()
        known = json.loads(MEASURED.read_text(encoding="utf-8")) if MEASURED.is_file() else {}
        self.files: dict[str, float] = known.get("files", {})
        self.tests: dict[str, float] = known.get("tests", {})

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Put the longest files first, the order within a file stays; leave out what is not quick."""
        items.sort(key=lambda item: -self.files.get(_name(item.nodeid).partition("::")[0], float("inf")))
        if self.config.getoption("--quick"):
            long = [item for item in items if self.tests.get(_name(item.nodeid), 0.0) > QUICK]
            self.config.hook.pytest_deselected(items=long)
            left_out = set(map(id, long))
            items[:] = [item for item in items if id(item) not in left_out]

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Add up setup, call and teardown; what a fixture prepares for many counts for the first of them."""
        self.seconds[_name(report.nodeid)] += report.duration

    def pytest_sessionfinish(self, exitstatus: int) -> None:
        """Write the durations down, in the process that heard of all tests.

        After a selection (`--quick`), the longer of both measurements of a test holds: where the first user of
        something expensive is left out, the next one prepares it.
        """
        wanted = self.config.getoption("--measure-durations") and not hasattr(self.config, "workerinput")
        if not wanted or exitstatus not in (0, pytest.ExitCode.TESTS_FAILED):
            return
        tests = dict(self.seconds)
        files: Counter[str] = Counter()
        for name, seconds in tests.items():
            files[name.partition("::")[0]] += seconds
        if self.config.getoption("--quick"):
            files = Counter(self.files)
            tests = {
                name: max(tests.get(name, 0.0), self.tests.get(name, 0.0)) for name in self.tests | tests
            }
        listed = {name: seconds for name, seconds in tests.items() if seconds >= LISTED}
        written = {"files": _longest_first(files), "tests": _longest_first(listed)}
        MEASURED.write_text(json.dumps(written, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _name(nodeid: str) -> str:
    """Name of a test below tests/: ``unit/solve/test_ensemble.py::test_x``."""
    return nodeid.removeprefix(f"{TESTS.name}/")


def _longest_first(seconds: dict[str, float]) -> dict[str, float]:
    ordered = sorted(seconds.items(), key=lambda item: (-round(item[1], 1), item[0]))
    return {name: round(value, 1) for name, value in ordered}
