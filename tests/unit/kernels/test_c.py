"""C code of Python functions against the functions themselves, and what has no counterpart in C."""

import ctypes
import inspect
from typing import Any

import numpy as np
import pytest

from tests.support import python_subset as subset
from tests.support.c_code import address, called, compiled
from tribodyn.kernels.c import CEntry, OutsideSubsetError, translated
from tribodyn.numerics.elementary import StaticInt, last_at_or_below

Y = np.array([0.5, 1.0, 1.25, 2.0, 3.0, 4.0, 5.0, 6.0])
WORK = np.arange(12.0).reshape(4, 3)
#: Function -> arguments.
CALLS: dict[Any, list[tuple[Any, ...]]] = {
    subset.whole_numbers: [(7, 3, 2), (-7, 3, 5), (7, -3, 1), (-8, -4, 0)],
    subset.floats: [(5.5, 2.0), (-5.5, 2.0), (5.5, -2.0), (0.1, 0.3)],
    subset.elementary_functions: [(0.7,), (-3.2,), (12.0,)],
    subset.truths: [(0.5, 1.5), (-0.5, 1.5), (1.5, 0.5), (1.5, 3.0), (-2.0, -1.0)],
    subset.branches: [(3.0, 1), (1.0, 3), (1.0, 2), (1.0, 0)],
    subset.loops: [(8, Y), (4, Y), (1, Y)],
    subset.endless: [(1.5,)],
    subset.one_name_for_several: [(5, Y)],
    subset.exchanged: [(1.0, 2.0, Y)],
    subset.records: [(1.5, -2.0)],
    subset.tuples: [(1.5,)],
    subset.parts: [(2, Y, WORK)],
    subset.effects: [(Y,)],
}


@pytest.fixture(scope="module")
def library(tmp_path_factory) -> ctypes.CDLL:
    entries = {function.__name__: CEntry(function, calls[0]) for function, calls in CALLS.items()}
    return compiled(translated(entries, {}).source, tmp_path_factory.mktemp("c"))


def _copied(arguments: tuple[Any, ...]) -> list[Any]:
    return [one.copy() if isinstance(one, np.ndarray) else one for one in arguments]


def _structure(values: tuple[Any, ...]) -> type[ctypes.Structure]:
    kinds = [ctypes.c_int64 if isinstance(value, int) else ctypes.c_double for value in values]
    return type(
        "Result", (ctypes.Structure,), {"_fields_": [(f"v{i}", kind) for i, kind in enumerate(kinds)]}
    )


@pytest.mark.parametrize(
    ("function", "arguments"),
    [(function, arguments) for function, calls in CALLS.items() for arguments in calls],
    ids=[f"{function.__name__}-{i}" for function, calls in CALLS.items() for i in range(len(calls))],
)
def test_c_does_what_python_does(library, function, arguments):
    in_python, in_c = _copied(arguments), _copied(arguments)
    expected = function(*in_python)
    expected = expected if isinstance(expected, tuple) else (expected,)
    several = len(expected) > 1
    alone = ctypes.c_double if isinstance(expected[0], float) else ctypes.c_int64
    result = _structure(expected) if several else alone
    found = called(getattr(library, function.__name__), *in_c, result=result)
    np.testing.assert_allclose(found, expected, rtol=1e-15)
    for one, other in zip(in_python, in_c, strict=True):
        if isinstance(one, np.ndarray):
            np.testing.assert_array_equal(other, one)


def _first_of(model, i):
    return model.rows[i] + model.pair[i].x + model.more[0]


def test_data_stand_once_and_exactly(tmp_path):
    """Awkward numbers come through to the last bit; equal arrays are one; what nothing reads is left out."""
    numbers = np.array([0.1, 1e-300, np.nextafter(1.0, 2.0), np.inf, -0.0])
    pair = (subset.Point(1e-7, StaticInt(3)), subset.Point(2.5, StaticInt(3)))
    kind = subset.NamedTuple("Model", [(name, Any) for name in ("rows", "pair", "more", "unread")])
    model = kind(numbers, pair, numbers.copy(), np.arange(99.0))
    made = translated({"entry": CEntry(_first_of, (model, 0))}, {"model": model})
    library = compiled(made.source, tmp_path)
    for i in range(2):
        (found,) = called(library.entry, address(library, "model"), i, result=ctypes.c_double)
        assert found == _first_of(model, i)
    assert made.source.count("5e-324") + made.source.count("1e-300") == 1
    assert "unread" not in made.source
    assert "98.0" not in made.source
    assert "extern const Model model;" in made.header


def _of_rows(model, i, j):
    part = model.parts[i]
    last = part.inner.rows[part.inner.rows.shape[0] - 1, j]
    return last + part.other.rows[0, 0] + 100.0 * part.inner.rows.shape[0] + part.size


def test_records_of_several_lengths_stand_in_one_array(tmp_path):
    """Lengths and whole numbers that differ are read when the code runs; the rest is compiled in."""
    rows = subset.NamedTuple("Rows", [("rows", Any)])
    part = subset.NamedTuple("Part", [("inner", Any), ("other", Any), ("size", Any)])
    model = subset.NamedTuple("Several", [("parts", Any)])
    short, long = (rows(np.arange(2.0 * n).reshape(n, 2)) for n in (2, 5))
    several = model((part(short, short, 1), part(long, short, 7)))
    made = translated({"entry": CEntry(_of_rows, (several, 0, 0))}, {"model": several})
    library = compiled(made.source, tmp_path)
    for i in range(2):
        (found,) = called(library.entry, address(library, "model"), i, 1, result=ctypes.c_double)
        assert found == _of_rows(several, i, 1)
    assert "const double (*rows)[2];" in made.header


def _reads_file(x):
    return float(open("a").read()) + x


def _comprehends(x):
    return sum([x for _ in range(3)])


def _lambda(x):
    scaled = lambda y: 2.0 * y  # noqa: E731
    return scaled(x)


def _several_types(x):
    value = x
    if x > 0.0:
        value = subset.Point(x, x)
    return value


def _grows(x, model):
    model.rows[0] = x


def _calls_itself(x):
    return x if x < 1.0 else _calls_itself(x - 1.0)


def _divides_by_nothing(x):
    return x + 1 // 0


def _of_no_array(x):
    return last_at_or_below(subset.WEIGHTS, x)


def _any_number(x, *others):
    return x


def _hands_over_two(x):
    return _any_number(x, x)


def _no_field(x):
    return subset.Point(x, x).z


def _a_type(x):
    return subset.Point


@pytest.mark.parametrize(
    ("function", "says"),
    [
        (_divides_by_nothing, "by zero"),
        (_of_no_array, "not translated"),
        (_any_number, "any number of arguments"),
        (_hands_over_two, "any number of arguments"),
        (_no_field, "no field z"),
        (_a_type, "no number"),
        (_reads_file, "open is not translated"),
        (_comprehends, "ListComp"),
        (_lambda, "Lambda"),
        (_several_types, "several types"),
        (_calls_itself, "calls itself"),
    ],
)
def test_what_has_no_counterpart_is_named(function, says):
    """Function, file and line, and what it is."""
    with pytest.raises(OutsideSubsetError, match=says) as caught:
        translated({"entry": CEntry(function, (1.0,))}, {})
    first = inspect.getsourcelines(function)[1]
    assert function.__name__ in str(caught.value)
    assert "test_c.py" in str(caught.value)
    line = int(str(caught.value).partition("line ")[2].partition(")")[0])
    assert first <= line <= first + 4


def test_arrays_in_records_are_not_changed():
    kind = subset.NamedTuple("Model", [("rows", Any)])
    with pytest.raises(OutsideSubsetError, match="an array inside a record is changed"):
        translated({"entry": CEntry(_grows, (1.0, kind(np.zeros(3))))}, {})
