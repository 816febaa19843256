"""Work that goes on though its caller is stopped: made once, said, and given up for another thing."""

import ctypes
import threading
from collections.abc import Callable
from contextlib import suppress
from time import sleep

import pytest

from tribodyn.numerics.processes.lasting import LastingWork, stopped_at_times
from tribodyn.numerics.processes.work import announced, listened


class Stopped(BaseException):
    """From outside."""


def stopped(call: Callable[[], object], begun: threading.Event) -> None:
    """Stop a call in another thread once it has begun."""

    def run() -> None:
        with suppress(Stopped), stopped_at_times():
            call()

    caller = threading.Thread(target=run)
    caller.start()
    assert begun.wait(60.0)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(caller.ident), ctypes.py_object(Stopped))
    caller.join()


def test_what_was_begun_for_who_is_stopped_is_made_once_and_said_to_who_asks_again():
    work, begun, free, makers = LastingWork[int](), threading.Event(), threading.Event(), []

    def make() -> int:
        makers.append(threading.get_ident())
        with announced("making it"):
            begun.set()
            assert free.wait(60.0)
        return 7

    stopped(lambda: work.made("a", make), begun)
    said = []

    def hear(what: str) -> None:
        said.append(what)
        free.set()

    with listened(hear), stopped_at_times():
        assert work.made("a", make) == 7
    assert said == ["making it", ""]
    assert len(makers) == 1
    assert makers != [threading.get_ident()]


def test_another_thing_ends_what_nobody_waits_for():
    one, other, begun, ended = LastingWork[int](), LastingWork[int](), threading.Event(), threading.Event()

    def endless() -> int:
        try:
            while True:
                begun.set()
                sleep(0.001)
        finally:
            ended.set()

    stopped(lambda: one.made("a", endless), begun)
    with stopped_at_times():
        assert other.made("a", lambda: 2) == 2
        assert ended.wait(60.0)
        assert one.made("a", lambda: 1) == 1  # and is made anew where it is asked for again


def test_an_error_comes_to_who_asks_and_is_not_kept():
    work = LastingWork[int]()
    with stopped_at_times():
        with pytest.raises(KeyError, match="why"):
            work.made("a", lambda: {}["why"])
        assert work.made("a", lambda: 1) == 1


def test_where_nobody_is_stopped_no_thread_is_begun():
    assert LastingWork[int]().made("a", threading.get_ident) == threading.get_ident()
