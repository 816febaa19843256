"""The process that computes for a window: takes requests, and lets a newer one end what it is at."""

import ctypes
import json
import os
import pickle
import struct
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from typing import IO, Any, BinaryIO, NamedTuple

from tribodyn.app.core.live import Live, LiveRequest
from tribodyn.numerics.processes.lasting import stopped_at_times
from tribodyn.numerics.processes.work import listened

#: Before every answer, which is pickled: its length.
HEAD = struct.Struct(">Q")
#: What an answer is: a stage was begun, its share, what it is at, its result, a request's end; the process
#: is ready.
BEGUN, SHARE, DOING, RESULT, DONE, READY = "begun", "share", "doing", "result", "done", "ready"
#: Seconds between two shares.
_PAUSE = 0.1


class _Superseded(BaseException):
    """A newer request has come."""


class _Requested(NamedTuple):
    """A request with its number, which grows."""

    number: int
    stages: tuple[str, ...]
    request: LiveRequest


def line_of(number: int, stages: tuple[str, ...], request: LiveRequest) -> bytes:
    """A request as this process reads it."""
    return json.dumps([number, stages, vars(request)]).encode() + b"\n"


def serve(scratch: str) -> None:
    """Answer the requests that come in until the input ends; runs are recorded in a folder of its caller."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    sys.stdout = sys.stderr
    _Serving(answers).run(Live(Path(scratch)))


class _Serving:
    """Computes the latest request; the thread that reads stops the one before it."""

    def __init__(self, answers: BinaryIO) -> None:
        self._answers = answers
        self._changed = threading.Condition()
        self._latest: _Requested | None = None
        self._done = -1
        self._at_work = False
        self._main = threading.get_ident()

    def run(self, live: Live) -> None:
        """Compute for ever; the process ends with its input."""
        self._answer(READY, -1, None)
        threading.Thread(target=self._read, daemon=True).start()
        while True:
            try:
                self._one(live)
            except _Superseded:
                self._at_work = False

    def _one(self, live: Live) -> None:
        """Compute the latest request. It counts as done at its end alone: one that is stopped is not lost."""
        with self._changed:
            self._changed.wait_for(lambda: self._latest is not None and self._latest.number > self._done)
            asked = self._latest
            assert asked is not None
            self._at_work = True
        said = monotonic()

        def progress(share: float) -> None:
            nonlocal said
            if monotonic() - said > _PAUSE:
                said = monotonic()
                self._answer(SHARE, asked.number, share)

        for stage in asked.stages:
            self._answer(BEGUN, asked.number, stage)
            with listened(lambda what: self._answer(DOING, asked.number, what)), stopped_at_times():
                result = live.compute(stage, asked.request, progress)
            if self._is_old(asked):
                raise _Superseded
            self._answer(RESULT, asked.number, result)
        with self._changed:
            self._at_work, self._done = False, asked.number
        self._answer(DONE, asked.number, None)

    def _is_old(self, asked: _Requested) -> bool:
        return self._latest is not None and self._latest.number > asked.number

    def _read(self) -> None:
        """Take in requests; the computation of an older one ends where Python's next step would begin."""
        for line in sys.stdin.buffer:
            number, stages, request = json.loads(line)
            request["torques"] = tuple(request["torques"])
            with self._changed:
                self._latest = _Requested(number, tuple(stages), LiveRequest(**request))
                if self._at_work:
                    thread = ctypes.c_ulong(self._main)
                    ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, ctypes.py_object(_Superseded))
                self._changed.notify_all()

    def _answer(self, what: str, number: int, content: Any) -> None:
        """Write whole answers, whatever stops the computation meanwhile."""
        answer = pickle.dumps((what, number, content), protocol=pickle.HIGHEST_PROTOCOL)
        self._answers.write(HEAD.pack(len(answer)) + answer)
        self._answers.flush()


def answers_in(stream: IO[bytes]) -> Iterator[tuple[str, int, Any]]:
    """Answers of such a process until it ends: what they are, number of the request, content."""
    while len(head := stream.read(HEAD.size)) == HEAD.size:
        content = stream.read(HEAD.unpack(head)[0])
        if len(content) < HEAD.unpack(head)[0]:
            return
        yield pickle.loads(content)
