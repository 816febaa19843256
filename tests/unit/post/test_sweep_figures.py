"""Figures of sweeps: no curve is left out, two keys are a map, a branch can be chosen."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.post.figures.sweep_branch import MARKS, branches, chosen_branch, colors_of
from tribodyn.post.figures.sweep_response import maps_of


def sweep(*sizes: int, directions: tuple[str, ...] = ()) -> Any:
    names = ("pinion_speed", "gear_torque", "law")
    values = [np.linspace(1.0, 2.0, size) for size in sizes[:2]] + [np.array(["a", "b"])] * (len(sizes) > 2)
    parameters = [
        SimpleNamespace(name=name, key=f"operating.{name}", values=numbers, units="N*m")
        for name, numbers in zip(names, values, strict=False)
    ]
    return cast(
        Any, SimpleNamespace(parameters=parameters, directions=directions, label="sweep", path="s.h5")
    )


@pytest.mark.parametrize("count", [1, 6, 7, 40])
def test_every_branch_is_drawn_in_a_colour_of_its_own(count: int):
    drawn = branches([sweep(5, count)])
    assert len(drawn) == count
    assert len({branch.color for branch in drawn}) == len(set(colors_of(count))) == count


def test_up_and_down_of_a_single_branch_differ_in_colour_line_and_mark():
    up, down = branches([sweep(5, directions=("up", "down"))])
    assert up.color != down.color
    assert up.style != down.style
    assert MARKS[up.direction] != MARKS[down.direction]


def test_two_numbers_with_many_curves_are_a_map():
    assert maps_of([sweep(20, 9)])
    assert not maps_of([sweep(20, 5)])
    assert not maps_of([sweep(20, 9, directions=("up", "down"))])
    assert not maps_of([sweep(20, 9, 2)])
    assert not maps_of([sweep(20, 9), sweep(20, 9)])


def test_the_branch_nearest_to_the_wish_is_chosen():
    record = sweep(5, 11)
    (branch,), named = chosen_branch([record], {"gear_torque": 1.62})
    assert record.parameters[1].values[branch.place[1]] == pytest.approx(1.6)
    assert "one of 11" in named
    (first,), _ = chosen_branch([record], {})
    assert first.place[1] == 0
    with pytest.raises(InputError, match="no such value"):
        chosen_branch([sweep(5, 3, 2)], {"law": "c"})
