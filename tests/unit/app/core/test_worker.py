"""The process of a window: results in order, the latest request alone, and another process where it dies."""

import asyncio
import threading
from collections.abc import Callable
from pathlib import Path
from time import monotonic, sleep

import pytest

from tribodyn.app.core.document import Document
from tribodyn.app.core.live import LiveRequest
from tribodyn.app.core.worker import Worker
from tribodyn.numerics.processes import child


@pytest.fixture(scope="module")
def worker():
    worker = Worker()
    yield worker
    worker.close()


def of(document: Document) -> LiveRequest:
    return LiveRequest(document.text, str(document.path))


def answers(worker: Worker, document: Document, stages: tuple[str, ...]) -> list[dict]:
    """All results of a request."""
    found, over = [], threading.Event()
    worker.submit(of(document), found.append, stages, over.set)
    assert over.wait(120.0)
    return found


def until(holds: Callable[[], bool]) -> None:
    """Wait for something, at most a minute."""
    begun = monotonic()
    while not holds() and monotonic() - begun < 60.0:
        sleep(0.02)
    assert holds()


def test_stages_come_one_after_the_other(worker):
    found = answers(worker, Document.open("spur-25-51"), ("geometry", "static"))
    assert [result["stage"] for result in found] == ["geometry", "static"]
    assert all(result["ok"] for result in found)
    assert found[1]["load"].shape == (200, 2)


def test_the_latest_request_stops_the_one_before(worker):
    """A run of minutes makes room at once; of it no result comes any more."""
    slow = Document.open("spur-25-51")
    slow.set("solver.cycles", 40_000)
    slow.set("output.window", [0, 1])
    late, over, begun = [], threading.Event(), threading.Event()
    worker.submit(of(slow), lambda result: (late.append(result), begun.set()), ("static", "motion"), over.set)
    assert begun.wait(60.0)
    until(lambda: (worker.at_work.share or 0.0) > 0.0)  # into the run
    assert worker.at_work.stage == "motion"
    asked = monotonic()
    found = answers(worker, Document.open("spur-25-51"), ("geometry",))
    assert monotonic() - asked < 10.0  # of minutes; how fast is in the bench
    assert over.is_set()
    assert [result["stage"] for result in late] == ["static"]
    assert found[0]["ok"]


def test_a_first_compilation_makes_room_for_a_newer_value(tmp_path, monkeypatch):
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))  # nothing has been compiled yet
    worker, begun = Worker(), threading.Event()
    try:
        document = Document.open("spur-25-51")
        worker.submit(of(document), lambda _result: begun.set(), ("geometry", "motion"))
        assert begun.wait(60.0)
        until(lambda: worker.at_work.stage == "motion" and worker.at_work.seconds > 1.5)
        document.set("drive.pinion.profile_shift", 0.3)
        asked = monotonic()
        found = answers(worker, document, ("geometry", "static"))
        assert [result["ok"] for result in found] == [True, True]
        assert monotonic() - asked < 10.0  # of the half minute that compiling takes
    finally:
        worker.close()


def test_dragging_ends_with_the_last_value(worker):
    document, ends = Document.open("spur-25-51"), []
    for shift in (0.05, 0.1, 0.15, 0.2):
        document.set("drive.pinion.profile_shift", shift, drag=True)
        worker.submit(of(document), lambda _result: None, ("geometry", "motion"), lambda: ends.append(1))
        threading.Event().wait(0.05)
    found = answers(worker, document, ("geometry", "static"))
    assert len(ends) == 4
    assert [result["ok"] for result in found] == [True, True]
    assert found[0]["gears"][0]["tip_radius"] == pytest.approx(40.5 + 3.0 * 0.2)


def test_results_are_an_asynchronous_stream(worker):
    async def stages() -> list[str]:
        document = Document.open("spur-25-51")
        return [result["stage"] async for result in worker.results(of(document), ("geometry", "static"))]

    assert asyncio.run(stages()) == ["geometry", "static"]


def test_who_does_not_take_a_result_does_not_stop_the_others(worker, caplog):
    over = threading.Event()

    def broken(_result: dict) -> None:
        raise RuntimeError("of the page")

    worker.submit(of(Document.open("spur-25-51")), broken, ("geometry",), over.set)
    assert over.wait(60.0)
    assert "of the page" in caplog.text
    assert answers(worker, Document.open("spur-25-51"), ("geometry",))[0]["ok"]


def test_another_process_answers_where_one_was_killed():
    worker = Worker()
    try:
        answers(worker, Document.open("spur-25-51"), ("geometry",))
        first = worker._process
        child.end(first)
        assert answers(worker, Document.open("spur-25-51"), ("geometry",))[0]["ok"]
        assert worker._process.pid != first.pid
    finally:
        worker.close()
    assert not Path(worker._scratch.name).exists()
    with pytest.raises(RuntimeError, match="closed"):
        worker.submit(of(Document.open("spur-25-51")), lambda _result: None)
