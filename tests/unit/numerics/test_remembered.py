"""Remembered results: of the same content, whatever holds it; with nothing to compare, none."""

from typing import NamedTuple

import jax
import numpy as np
import pytest

from tribodyn.numerics.remembered import remembered


class Held(NamedTuple):
    values: object


class Other(NamedTuple):
    values: object


@pytest.fixture
def counted():
    """A remembered function and the list of what it was called with."""
    calls = []

    @remembered(4)
    def function(*arguments):
        calls.append(arguments)
        return len(calls)

    return function, calls


def test_arrays_of_the_same_content_are_the_same(counted):
    function, calls = counted
    assert function("a", Held(np.arange(3.0))) == function("a", Held(np.arange(3.0))) == 1
    assert len(calls) == 1


@pytest.mark.parametrize(
    ("argument", "other"),
    [
        (np.arange(4.0), np.arange(4.0)[::-1]),
        (np.arange(4.0), np.arange(4.0).reshape(2, 2)),
        (np.zeros(2, dtype=np.int64), np.zeros(2)),
        (np.zeros(1), (0.0,)),
        (Held(np.zeros(1)), Other(np.zeros(1))),
        (Held(np.zeros(1)), (np.zeros(1),)),
    ],
)
def test_what_differs_is_not_mistaken(counted, argument, other):
    function, _ = counted
    assert function(argument) != function(other)


def test_an_array_that_is_changed_afterwards_is_another(counted):
    function, calls = counted
    values = np.zeros(3)
    function(values)
    values[0] = 1.0
    function(values)
    function(np.zeros(3))
    assert len(calls) == 2


def test_what_cannot_be_compared_is_calculated_every_time(counted):
    function, calls = counted
    for _ in range(2):
        function(np.array([object()]))
        function([1.0])
        jax.jit(lambda x: function(x) + x)(1.0)
    assert len(calls) == 6


def test_an_error_of_the_function_itself_passes():
    @remembered(1)
    def unhashable(_):
        return hash([])

    with pytest.raises(TypeError, match="unhashable"):
        unhashable(np.zeros(1))
