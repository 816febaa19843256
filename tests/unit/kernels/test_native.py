"""Kernels: what they take and return, and machine code that is kept on disk and loaded again."""

import ctypes
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from tribodyn.kernels.native import compiler, kernel, packed, store
from tribodyn.numerics import elementary
from tribodyn.numerics.elementary import RuntimeIndices
from tribodyn.numerics.files.cache import read_kept
from tribodyn.numerics.processes.lasting import stopped_at_times
from tribodyn.numerics.processes.work import listened


class Inner(NamedTuple):
    factor: Any
    row: Any


class Outer(NamedTuple):
    inner: Inner
    count: Any


@kernel
def weigh(outer, x, table, reverse, out):
    total = 0.0
    for i in range(outer.count):
        j = outer.count - 1 - i if reverse else i
        out[i] = outer.inner.factor * elementary.exp(x[j]) + table[j, 1] ** 1.3 + outer.inner.row[j]
        total += out[i]
    return total, outer.count, reverse


@kernel
def half(x):
    return 0.5 * x


@kernel
def fill(out, value):
    for i in range(out.shape[0]):
        out[i] = value


@kernel
def of_items(items, places, shift, out):
    for i in range(out.shape[0]):
        item = items[places[i]]
        out[i] = item.factor * item.row[shift - i] + item.row[-1]


@pytest.fixture
def arguments(rng):
    outer = Outer(Inner(np.float64(1.7), rng.random(5)), 5)
    return outer, rng.random((5, 3))[:, 2], rng.random((5, 2)), True, np.empty(5)


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))
    return tmp_path


def kept(folder: Path) -> Path:
    (found,) = [path for path in folder.rglob("kernels-*/*") if path.is_file()]
    return found


def never(function, layout):
    raise AssertionError(f"{function.__name__} is compiled though its code is there")


def test_records_numbers_and_arrays_of_any_strides_go_in_and_numbers_come_out(arguments):
    outer, x, table, _, out = arguments
    total, count, reverse = weigh(*arguments)
    expected = (1.7 * np.exp(x) + table[:, 1] ** 1.3 + outer.inner.row)[::-1]
    np.testing.assert_allclose(out, expected, rtol=1e-15)
    assert total == pytest.approx(expected.sum(), rel=1e-15)
    assert (count, reverse) == (5, True)
    assert half(np.array(3.0)) == 1.5  # an array of no axes is a number
    assert fill(out, 2) is None
    assert (out == 2.0).all()


def test_what_is_packed_once_stands_for_the_value(arguments):
    out = arguments[-1]
    weigh(*arguments)
    expected = out.copy()
    out[:] = 0.0
    weigh(*map(packed, arguments))
    np.testing.assert_array_equal(out, expected)


def test_truths_of_numpy_are_those_of_python(arguments):
    outer, x, table, reverse, out = arguments
    plain, of_numpy = (weigh(outer, x, table, truth, out) for truth in (bool(reverse), np.bool_(reverse)))
    assert of_numpy == plain


def test_other_values_are_refused():
    with pytest.raises(TypeError, match="not str"):
        half("1")


def test_code_from_disk_is_not_compiled_again_and_gives_the_same_bits(folder, arguments, monkeypatch):
    compiled = kernel(weigh.function)(*arguments)
    bits = arguments[-1].tobytes()
    arguments[-1][:] = 0.0
    monkeypatch.setattr(compiler, "compiled", never)
    assert kernel(weigh.function)(*arguments) == compiled
    assert arguments[-1].tobytes() == bits


def test_what_is_compiled_is_said_meanwhile_and_what_is_loaded_is_not(folder):
    said: list[str] = []
    for what in ([store.COMPILING, ""], []):
        with listened(said.append):
            kernel(half.function)(1.0)
        assert said == what
        said.clear()


def test_who_is_stopped_while_code_is_made_finds_it_made(folder):
    """As a newer value stops the computation of an older one in a worker."""
    of_half, results = kernel(half.function), []

    class Stopped(BaseException):
        pass

    def first() -> None:
        with suppress(Stopped), stopped_at_times():
            results.append(of_half(1.0))

    caller = threading.Thread(target=first)
    caller.start()
    while not (folder / "locks").exists() and caller.is_alive():  # it makes code
        threading.Event().wait(0.001)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(caller.ident), ctypes.py_object(Stopped))
    caller.join()
    assert results in ([], [0.5])  # it may have been made before
    said: list[str] = []
    with listened(said.append), stopped_at_times():
        assert of_half(3.0) == 1.5
    assert said in ([store.COMPILING, ""], [])
    made = kept(folder).stat().st_mtime_ns
    assert kernel(half.function)(5.0) == 2.5
    assert kept(folder).stat().st_mtime_ns == made


def test_a_damaged_file_is_compiled_anew(folder):
    kernel(half.function)(1.0)
    file = kept(folder)
    whole = file.read_bytes()
    for damaged in (b"", whole[:-40], whole.replace(b'"returns": "d"', b'"returns": "q"')):
        file.write_bytes(damaged)
        assert kernel(half.function)(3.0) == 1.5
        assert read_kept(file.parent.name, file.name) is not None


def test_code_that_calls_what_is_not_there_is_not_loaded():
    """LLVM would end the process."""
    code = compiler.compiled(half.function, kernel_layout(half, 1.0))
    assert store.loaded(code) is not None
    assert store.loaded(code._replace(needs=["no_such_function"])) is None


def kernel_layout(of, *arguments):
    from tribodyn.kernels.native.arguments import together

    return together(of._name, of._names, arguments).layout


def test_another_processor_or_compiler_has_files_of_its_own(folder, monkeypatch):
    names = []
    for name in ("generic", "another"):
        monkeypatch.setattr(store.llvm, "get_host_cpu_name", lambda name=name: name)
        store._digest.cache_clear()
        names.append(store._place_of(half.function, "layout"))
    monkeypatch.setenv("NUMBA_OPT", "0")
    store._digest.cache_clear()
    names.append(store._place_of(half.function, "layout"))
    store._digest.cache_clear()
    assert len(set(names)) == 3
    assert store._place_of(half.function, "layout") != store._place_of(half.function, "other")


def test_a_folder_that_cannot_be_written_keeps_nothing_and_hinders_nothing(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path / "file"))
    assert kernel(half.function)(1.0) == 0.5


def test_threads_wait_for_one_compilation(folder, monkeypatch):
    done = []
    original = compiler.compiled

    def counted(function, layout):
        done.append(function)
        return original(function, layout)

    monkeypatch.setattr(compiler, "compiled", counted)
    shared = kernel(half.function)
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(shared, [1.0, 2.0, 3.0, 4.0])) == [0.5, 1.0, 1.5, 2.0]
    assert len(done) == 1


def test_processes_that_start_at_once_leave_one_good_file(folder, tmp_path_factory):
    script = tmp_path_factory.mktemp("script") / "half.py"
    script.write_text(
        "import tribodyn\n"
        "from tribodyn.kernels.native import kernel\n"
        "tribodyn.OWN_PROCESS = True\n\n"
        "@kernel\n"
        "def half(x):\n"
        "    return 0.5 * x\n\n"
        "assert half(1.0) == 0.5\n"
    )
    running = [subprocess.Popen([sys.executable, str(script)], cwd=Path.cwd()) for _ in range(2)]
    assert [process.wait() for process in running] == [0, 0]
    file = kept(folder)
    assert read_kept(file.parent.name, file.name) is not None


def test_how_many_items_there_are_is_read_at_run_time(rng):
    """And a negative index counts from the end, in functions from outside the package."""
    for count in (1, 2, 3, 5):
        items = tuple(Inner(factor, rng.random(6)) for factor in rng.random(count).tolist())
        places, out = rng.integers(0, count, 4).tolist(), np.empty(4)
        of_items(items, RuntimeIndices(places), 1, out)
        chosen = [items[int(k)] for k in places]
        expected = [one.factor * one.row[1 - i] + one.row[-1] for i, one in enumerate(chosen)]
        np.testing.assert_allclose(out, expected, rtol=1e-14)
    assert len(of_items._codes) == 1
