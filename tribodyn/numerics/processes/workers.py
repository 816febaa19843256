"""Workers that answer questions: this process, and others that are handed lines of text.

These import nothing of the user's program, which a process of `multiprocessing` would run again.
"""

import json
import sys
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from queue import PriorityQueue
from typing import TYPE_CHECKING, Any, Self

from tribodyn.errors import SimulationError
from tribodyn.numerics.processes import child

if TYPE_CHECKING:
    import subprocess


class Workers:
    """So many workers, each at one question at a time; a context manager, which ends the processes.

    The first is this process, where `own` answers. The others are started for their first question: they call
    `target`, ``module:function``, which is `serve` of what `head` says of the worker of that number.
    """

    def __init__(
        self, count: int, own: Callable[[Any], Any], target: str, head: Callable[[int], Any], about: str
    ) -> None:
        self.count = count
        self._own, self._target, self._head, self._about = own, target, head, about
        self._threads = ThreadPoolExecutor(count)
        self._free: PriorityQueue[int] = PriorityQueue()
        self._processes: dict[int, subprocess.Popen[bytes]] = {}
        for number in range(count):
            self._free.put(number)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._threads.shutdown(wait=False, cancel_futures=True)
        for process in self._processes.values():
            child.end(process)

    @property
    def processes(self) -> "tuple[subprocess.Popen[bytes], ...]":
        """Those that were started."""
        return tuple(self._processes.values())

    def submit(self, question: Any) -> "Future[Any]":
        """Ask what can be written as JSON; so can the answer.

        Its result raises SimulationError, which begins with `about`, where a process has ended.
        """
        return self._threads.submit(self._answer, question)

    def _answer(self, question: Any) -> Any:
        number = self._free.get()
        try:
            if number == 0:
                return self._own(question)
            answer = self._told(number, question)
        except OSError:
            answer = b""
        finally:
            self._free.put(number)
        if not answer:
            raise SimulationError(f"{self._about} ended: out of memory, or killed")
        return json.loads(answer)

    def _told(self, number: int, question: Any) -> bytes:
        if number not in self._processes:
            self._processes[number] = child.start(self._target)
            child.tell(self._processes[number], _line(self._head(number)))
        process = self._processes[number]
        child.tell(process, _line(question))
        return process.stdout.readline() if process.stdout else b""


def serve(begin: Callable[[Any], Callable[[Any], Any]]) -> None:
    """Answer what comes in as lines of JSON: `begin` takes the head and gives what answers the others."""
    answers, sys.stdout = sys.stdout, sys.stderr  # what a library prints is no answer
    answer = begin(json.loads(sys.stdin.readline()))
    for line in sys.stdin:
        answers.write(json.dumps(answer(json.loads(line))) + "\n")
        answers.flush()


def _line(message: Any) -> bytes:
    return json.dumps(message).encode() + b"\n"
