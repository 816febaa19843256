"""What a window computes with: a process of its own, in which the latest request stops the one before it."""

import asyncio
import logging
import threading
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from tempfile import TemporaryDirectory
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple

from tribodyn.app.core.live import STAGES, LiveRequest
from tribodyn.app.core.serving import BEGUN, DOING, DONE, READY, RESULT, SHARE, answers_in, line_of
from tribodyn.numerics.processes import child

if TYPE_CHECKING:
    import subprocess

#: How long the process may go on with an older request before another one takes its place, s: what runs in
#: compiled code of a library is not stopped sooner.
PATIENCE = 2.0
#: Ends of a process for one request after which it is given up.
MOST_ENDS = 2

Tell = Callable[[dict[str, Any]], None]
"""Takes a result of a stage; called by another thread."""


class AtWork(NamedTuple):
    """What a worker is at."""

    stage: str  # "": nothing, or it is still being started
    seconds: float  # since when
    share: float | None  # done; None: that is not known
    doing: str  # in a few words; "": there is nothing to say


class Worker:
    """A process that computes for one window; it is started at once, and imports what it needs."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._number, self._begun, self._ends = 0, 0, 0
        self._asked: bytes = b""
        self._asked_at = 0.0
        self._tell: Tell | None = None
        self._finished: Callable[[], None] | None = None
        self._share: float | None = None
        self._doing = ""
        self._closed = False
        self._scratch = TemporaryDirectory(prefix="tribodyn-")
        self._start()
        threading.Thread(target=self._watch, daemon=True).start()

    def submit(
        self,
        request: LiveRequest,
        tell: Tell,
        stages: tuple[str, ...] = STAGES,
        finished: Callable[[], None] | None = None,
    ) -> int:
        """Compute stages of a scenario, in place of what was asked for before; return the request's number.

        `tell` gets every result of a stage as it comes, of the latest request alone; `finished` is called
        behind the last one, and where a newer request takes its place. Both are called by other threads.
        """
        with self._lock:
            if self._closed:
                raise RuntimeError("the worker is closed")
            self._end_asked()
            self._number += 1
            self._tell, self._finished, self._ends = tell, finished, 0
            self._asked, self._asked_at = line_of(self._number, stages, request), monotonic()
            self._send()
            return self._number

    @property
    def at_work(self) -> AtWork:
        """What it is at; before a first motion machine code may have to be made, which takes a minute."""
        with self._lock:
            return AtWork(self._stage, monotonic() - self._since, self._share, self._doing)

    def results(
        self, request: LiveRequest, stages: tuple[str, ...] = STAGES
    ) -> AsyncIterator[dict[str, Any]]:
        """The results of `submit`, which is called at once; they end early where a newer request is made."""
        loop = asyncio.get_running_loop()
        queue: asyncio.Queue[dict[str, Any] | None] = asyncio.Queue()

        def put(result: dict[str, Any] | None) -> None:
            with suppress(RuntimeError):  # the loop is closed
                loop.call_soon_threadsafe(queue.put_nowait, result)

        self.submit(request, put, stages, lambda: put(None))
        return _until_none(queue)

    def close(self) -> None:
        """End the process."""
        with self._lock:
            self._closed = True
            self._end_asked()
            child.end(self._process)
        self._scratch.cleanup()

    def _start(self) -> None:
        self._ready = False
        self._stage, self._since, self._share, self._doing = "", monotonic(), None, ""
        # the module beside this one
        self._process = child.start(f"{__package__}.serving:serve", self._scratch.name)
        threading.Thread(target=self._listen, args=(self._process,), daemon=True).start()

    def _send(self) -> None:
        with suppress(OSError, ValueError):  # it has ended: who listens to it starts another one
            child.tell(self._process, self._asked)

    def _end_asked(self) -> None:
        """What was asked for before is over."""
        finished, self._tell, self._finished = self._finished, None, None
        if finished is not None:
            finished()

    def _listen(self, process: "subprocess.Popen[bytes]") -> None:
        """Pass on what a process answers until it ends."""
        assert process.stdout is not None
        with suppress(OSError, ValueError):  # it was ended
            for what, number, content in answers_in(process.stdout):
                self._take(what, number, content)
        with self._lock:
            if process is self._process and not self._closed:
                child.end(process)
                self._begin_anew()

    def _take(self, what: str, number: int, content: Any) -> None:
        with self._lock:
            if what == READY:
                self._ready, self._asked_at = True, monotonic()
            if what == BEGUN:
                self._begun = max(self._begun, number)
                self._stage, self._since, self._share, self._doing = content, monotonic(), None, ""
            if what == SHARE:
                self._share = content
            if what == DOING:
                self._doing = content
            if what == DONE:
                self._stage, self._since, self._share, self._doing = "", monotonic(), None, ""
            tell = self._tell if number == self._number else None
        if tell is None:
            return
        if what == RESULT:
            try:
                tell(content)
            except Exception:  # of who asked: other requests go on
                logging.getLogger(__name__).exception("a result was not taken")
        elif what == DONE:
            with self._lock:
                if number == self._number:
                    self._end_asked()

    def _begin_anew(self) -> None:
        """Start another process, and ask it what the last one has not answered; not again and again."""
        self._ends += 1
        self._start()
        if self._tell is None:
            return
        if self._ends < MOST_ENDS:
            self._asked_at = monotonic()
            self._send()
            return
        rule = "the computation ended: out of memory, or killed"
        error = {"key": "", "text": rule, "value": "", "rule": rule, "remedy": "", "file": "", "short": rule}
        head = {"stage": "", "ok": False, "complete": True, "warnings": [], "seconds": 0.0}
        self._tell({**head, "errors": [error]})
        self._end_asked()

    def _watch(self) -> None:
        """End a process that goes on with an older request for too long."""
        while True:
            threading.Event().wait(0.2)
            with self._lock:
                if self._closed:
                    return
                late = self._tell is not None and self._begun < self._number
                if late and self._ready and monotonic() - self._asked_at > PATIENCE:
                    stuck = self._process
                    self._ready = False
                    child.end(stuck)  # who listens to it begins anew


async def _until_none(queue: "asyncio.Queue[dict[str, Any] | None]") -> AsyncIterator[dict[str, Any]]:
    while (result := await queue.get()) is not None:
        yield result
