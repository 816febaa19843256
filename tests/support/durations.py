"""How long tests take: measured into tests/durations.json, which orders files and chooses the quick tests.

`make durations` measures, in seconds of processor time, so that the machine may be busy; only ratios matter.
`pytest FILE --measure-durations` measures one file anew.
Files and tests that were never measured run first, and belong to the quick ones.
"""

import json
import os
import time
from collections import Counter
from collections.abc import Generator, Mapping
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
MEASURED = TESTS / "durations.json"
#: Tests below this are quick and not listed, s: together less than a tenth of the time of all; with the start
#: of the processes and of the compilers under a minute.
LISTED = 0.2


def add_options(parser: pytest.Parser) -> None:
    """Add the options `--measure-durations` and `--quick`."""
    group = parser.getgroup("durations")
    group.addoption("--measure-durations", action="store_true", help=f"write {MEASURED.name}")
    group.addoption("--quick", action="store_true", help="run only the shortest tests")


class Durations:
    """A plugin with the options of `add_options`: sorts and selects what was collected, and measures."""

    def __init__(self, config: pytest.Config) -> None:
        self.config = config
        self.seconds: Counter[str] = Counter()
        self.before = 0.0
        known = json.loads(MEASURED.read_text(encoding="utf-8")) if MEASURED.is_file() else {}
        self.files: dict[str, float] = known.get("files", {})
        self.tests: dict[str, float] = known.get("tests", {})

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Put the longest files first, the order within a file stays; leave out what is not quick."""
        items.sort(key=lambda item: -self.files.get(_name(item.nodeid).partition("::")[0], float("inf")))
        if self.config.getoption("--quick"):
            quick = [_name(item.nodeid) not in self.tests for item in items]
            left_out = [item for item, stays in zip(items, quick, strict=True) if not stays]
            self.config.hook.pytest_deselected(items=left_out)
            items[:] = [item for item, stays in zip(items, quick, strict=True) if stays]

    def pytest_runtest_logstart(self) -> None:
        """Note where a test begins."""
        self.before = processor_time()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self) -> Generator[None, pytest.TestReport, pytest.TestReport]:
        """Report processor time in place of the clock's, where it is measured."""
        report = yield
        if self.config.getoption("--measure-durations"):
            now = processor_time()
            report.duration, self.before = now - self.before, now
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Add up setup, call and teardown; what a fixture prepares for many counts for the first of them."""
        self.seconds[_name(report.nodeid)] += report.duration

    def pytest_sessionfinish(self, exitstatus: int) -> None:
        """Write the durations down, in the process that hears of all tests; of other files what was known.

        With `--quick` the longer of both measurements of a test holds, and all else stays: where the first
        user of something expensive is left out, the next one prepares it.
        """
        wanted = self.config.getoption("--measure-durations") and not hasattr(self.config, "workerinput")
        if not wanted or exitstatus not in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED):
            return
        measured, known, quick = self.seconds, self.tests, self.config.getoption("--quick")
        if quick:
            measured = {name: max(value, known.get(name, 0.0)) for name, value in measured.items()}
        ran = _by_file(measured)
        files = dict.fromkeys(files_of_tests(), 0.0)
        files = {name: self.files.get(name, seconds) for name, seconds in files.items()}
        files |= {} if quick else ran
        kept = {name: value for name, value in known.items() if name.partition("::")[0] in files}
        kept = {name: value for name, value in kept.items() if quick or name.partition("::")[0] not in ran}
        tests = kept | {name: value for name, value in measured.items() if round(value, 2) >= LISTED}
        written = {"files": _longest_first(files), "tests": _longest_first(tests)}
        MEASURED.write_text(json.dumps(written, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def files_of_tests() -> list[str]:
    """Files of tests, as the list names them; benches and what `make soak` alone runs are listed with 0."""
    return sorted(path.relative_to(TESTS).as_posix() for path in TESTS.rglob("test_*.py"))


def processor_time(process: str = "self") -> float:
    """Processor time that a process and all processes below it have taken, s; the clock's without /proc."""
    stat = _content(Path(f"/proc/{process}/stat"))
    if not stat:
        return time.monotonic() if process == "self" else 0.0
    own = sum(map(int, stat.rpartition(")")[2].split()[11:15])) / os.sysconf(
        "SC_CLK_TCK"
    )  # with ended children
    try:
        threads = os.listdir(f"/proc/{process}/task")
    except OSError:  # it ended in between
        threads = []
    below = [_content(Path(f"/proc/{process}/task/{thread}/children")) for thread in threads]
    return own + sum(processor_time(child) for child in " ".join(below).split())


def _content(file: Path) -> str:
    """Content of a file of /proc, nothing where its process or thread is gone."""
    try:
        return file.read_text(encoding="utf-8")
    except OSError:
        return ""


def _name(nodeid: str) -> str:
    """Name of a test below tests/: ``unit/solve/test_ensemble.py::test_x``."""
    return nodeid.removeprefix(f"{TESTS.name}/")


def _by_file(tests: Mapping[str, float]) -> dict[str, float]:
    files: Counter[str] = Counter()
    for name, seconds in tests.items():
        files[name.partition("::")[0]] += seconds
    return files


def _longest_first(seconds: Mapping[str, float]) -> dict[str, float]:
    ordered = sorted(seconds.items(), key=lambda item: (-round(item[1], 2), item[0]))
    return {name: round(value, 2) for name, value in ordered}
