"""Work that goes on where who asked for it is stopped: it takes long, and who asks again gets its result.

One thing is made at a time: what nobody waits for any more is given up where another thing is asked for.
"""

import ctypes
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from typing import Any, Generic, TypeVar

from tribodyn.numerics.processes.work import announce, listened

T = TypeVar("T")

#: Between two looks at whether the caller is stopped, s.
_EACH = 0.02
_stopped_at_times: ContextVar[bool] = ContextVar("stopped_at_times", default=False)


@contextmanager
def stopped_at_times() -> Iterator[None]:
    """Say that what is called inside the block may be stopped by an exception from outside."""
    token = _stopped_at_times.set(True)
    try:
        yield
    finally:
        _stopped_at_times.reset(token)


class _GivenUp(BaseException):
    """Another thing is asked for."""


class _Begun(Generic[T]):
    """Work in a thread of its own."""

    def __init__(self, make: Callable[[], T]) -> None:
        self._make, self.doing = make, ""
        self.over = threading.Event()
        self.given_up = False
        self._made: list[T] = []
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._run, daemon=True)

    def begin(self) -> None:
        """Begin it, unless that was done."""
        with suppress(RuntimeError):
            self._thread.start()

    def give_up(self) -> None:
        """End it where Python's next step would begin."""
        self.given_up = True
        if not self.over.is_set():
            number = ctypes.c_ulong(self._thread.ident or 0)
            ctypes.pythonapi.PyThreadState_SetAsyncExc(number, ctypes.py_object(_GivenUp))

    def _run(self) -> None:
        try:
            with listened(self._hear):
                self._made.append(self._make())
        except BaseException as error:
            self._error = error
        self.over.set()

    def _hear(self, what: str) -> None:
        self.doing = what

    def result(self) -> T:
        """What was made, or the error of the work, once it is over."""
        if self._error is not None:
            raise self._error
        return self._made[0]


#: What was begun last, of all kinds.
_latest: list[_Begun[Any]] = []


class LastingWork(Generic[T]):
    """Makes things by key; where the caller may be stopped, in a thread that is not."""

    def __init__(self) -> None:
        self._begun: dict[Any, _Begun[T]] = {}

    def made(self, key: Any, make: Callable[[], T]) -> T:
        """Make the thing of a key, or wait for it where that was begun before; one caller at a time."""
        begun, said = self._begun.get(key), ""
        if begun is None or begun.given_up:
            if not _stopped_at_times.get():
                return make()
            while _latest:
                _latest.pop().give_up()
            begun = self._begun[key] = _Begun(make)
            _latest.append(begun)
        begun.begin()  # it is known by now, should its caller be stopped meanwhile
        while not begun.over.wait(_EACH):
            if begun.doing != said:
                said = begun.doing
                announce(said)
        if said:
            announce("")
        del self._begun[key]
        _latest.clear()
        return begun.result()
