"""In which order a window has values computed that come faster than results."""

import asyncio
from collections.abc import AsyncIterator

import pytest

from tribodyn.errors import InputError

pytest.importorskip("tomlkit")
from tribodyn.app.core.document import Document
from tribodyn.app.core.live import STAGES
from tribodyn.app.folder import WorkFolder
from tribodyn.app.window import DesignWindow

SHIFT = "drive.pinion.profile_shift"


class SlowWorker:
    """Takes so many seconds for each stage, and notes what it was asked for and when it was let finish."""

    def __init__(self, **seconds: float) -> None:
        self.seconds, self.asked, self.finished = seconds, [], []
        self.at_work = ("", 0.0, None)

    def results(self, request, stages=STAGES) -> AsyncIterator[dict]:
        self.asked.append(request.text)
        return self._results(request, stages)

    async def _results(self, request, stages):
        for stage in stages:
            await asyncio.sleep(self.seconds.get(stage, 0.0))
            if request.text != self.asked[-1]:  # a newer request has ended this one
                return
            self.finished.append((request.text, stage))
            yield {"stage": stage, "ok": True, "text": request.text, "seconds": self.seconds.get(stage, 0.0)}

    def close(self) -> None:
        """Nothing is to end."""


class RefusingWorker(SlowWorker):
    """Computes no motion, and says so with the text; warns of every value."""

    async def _results(self, request, stages):
        async for result in super()._results(request, stages):
            failed = result["stage"] == "motion"
            error = {"key": SHIFT, "text": f"of {request.text}", "short": "no"}
            wrong = (
                {"ok": False, "errors": [error]} if failed else {"warnings": [f"beware of {request.text}"]}
            )
            yield result | wrong


def dragged(
    tmp_path, worker, values: int, pause: float, *, begin: bool = False
) -> tuple[DesignWindow, list[str]]:
    """A window whose value was dragged in steps, until all is computed; what it had shown."""
    shown: list[str] = []

    async def drag() -> DesignWindow:
        window = DesignWindow(WorkFolder(tmp_path), Document.open("spur-25-51"), worker, shown.extend)
        if begin:
            window.changed([])
            await asyncio.sleep(1.0)  # all has been computed once
            worker.finished.clear()
        for step in range(values):
            error = window.change(SHIFT, 0.1 + 0.001 * step, drag=True)
            assert not isinstance(error, InputError)
            await asyncio.sleep(pause)
        while window.late:
            await asyncio.sleep(0.01)
        await asyncio.sleep(0.3)
        return window

    return asyncio.run(drag()), shown


def test_the_worker_has_a_value_before_the_page_is_told(tmp_path):
    worker = SlowWorker(motion=0.01)
    window, shown = dragged(tmp_path, worker, 1, 0.0)
    assert worker.asked == [window.document.text]
    assert shown.index("geometry") < shown.index("form")
    assert shown[-1] in ("late", "check")


def test_teeth_of_values_are_shown_while_they_are_dragged_and_the_last_is_computed_whole(tmp_path):
    worker = SlowWorker(geometry=0.03, static=0.01, motion=0.2)
    window, _ = dragged(tmp_path, worker, 12, 0.02)
    last = window.document.text
    teeth = [text for text, stage in worker.finished if stage == "geometry"]
    assert teeth == worker.asked  # no value is begun that another takes the place of before its teeth
    assert len(teeth) >= 3
    assert [stage for text, stage in worker.finished if text == last] == list(STAGES)
    assert {result["text"] for result in window.results.values()} == {last}
    assert window.late == ()


def test_a_quasi_static_error_that_takes_long_comes_now_and_then(tmp_path):
    worker = SlowWorker(geometry=0.01, static=0.1, motion=0.3)
    dragged(tmp_path, worker, 30, 0.02, begin=True)
    assert [stage for _, stage in worker.finished].count("static") >= 2  # the last one is not alone


def test_another_scenario_does_not_wait_for_the_one_before_it(tmp_path):
    worker = SlowWorker(geometry=0.2)

    async def opened() -> DesignWindow:
        window = DesignWindow(WorkFolder(tmp_path), Document.open("spur-25-51"), worker, lambda _parts: None)
        window.changed([])
        await asyncio.sleep(0.01)
        window.open(Document.open("helical-23-47"))
        assert len(worker.asked) == 2
        while window.late:
            await asyncio.sleep(0.01)
        return window

    window = asyncio.run(opened())
    assert {result["text"] for result in window.results.values()} == {window.document.text}


def test_a_message_of_a_computation_goes_with_the_value_that_it_names(tmp_path):
    worker = RefusingWorker(geometry=0.01, motion=0.01)

    async def changed() -> None:
        window = DesignWindow(WorkFolder(tmp_path), Document.open("spur-25-51"), worker, lambda _parts: None)
        for shift in (0.1, 0.2):
            before = window.document.text
            assert not window.change(SHIFT, shift)
            assert window.errors() == []
            assert window.doubtful == (shift > 0.1)
            assert all(window.sentences("warnings").values())  # they are of the value before
            while "geometry" in window.late:
                await asyncio.sleep(0.001)
            text = window.document.text
            assert window.sentences("warnings").get(f"beware of {text}") is False
            assert window.sentences("warnings").get(f"beware of {before}", True)
            while window.late:
                await asyncio.sleep(0.001)
            assert window.errors() == [(SHIFT, f"of {text}", "no")]
            assert list(window.sentences("warnings")) == [f"beware of {text}"]
            assert not window.doubtful

    asyncio.run(changed())
