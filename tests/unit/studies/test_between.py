"""Cases between two cases."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pytest

from tribodyn.studies.protocol.batch import NothingBetween, case_between
from tribodyn.studies.protocol.load import load_scenario


def case(speed, **others):
    return load_scenario("crc-23-47", {"operating.pinion_speed": f"{speed} rad/s", **others})


def test_numbers_are_in_proportion():
    slow, fast = case(100), case(300)
    for share, speed in ((0.25, 150.0), (0.5, 200.0), (1.5, 400.0)):
        found = case_between(slow, fast, share)
        assert found.source.speed == pytest.approx(speed)
        assert found.pair.operating.pinion_speed == pytest.approx(speed)


def test_the_ends_are_the_cases_themselves():
    slow, fast = case(100), case(300)
    assert case_between(slow, fast, 0.0) is slow
    assert case_between(slow, fast, 1.0) is fast


def test_there_is_nothing_between_two_laws():
    with pytest.raises(NothingBetween):
        case_between(case(100), case(100, **{"friction.law": "none"}), 0.5)


class Point(NamedTuple):
    """Named numbers within a case."""

    x: float
    y: float


@dataclass(frozen=True)
class Made:
    """A case of every sort of content."""

    title: str
    number: float
    count: int
    curve: np.ndarray
    point: Point
    pair: tuple[float, str]
    values: dict[str, float]


FIRST = Made("one", 1.0, 3, np.array([1.0, 2.0]), Point(1.0, -1.0), (5.0, "a"), {"a": 1.0, "b": 7.0})


def made(**changed: Any) -> Made:
    return Made(**vars(FIRST) | changed)


def test_every_sort_of_content_is_in_proportion():
    last = made(
        title="other",
        number=3.0,
        curve=np.array([2.0, 6.0]),
        point=Point(2.0, -5.0),
        pair=(9.0, "a"),
        values={"a": 5.0, "b": 7.0},
    )
    found = case_between(FIRST, last, 0.25)
    assert (found.title, found.number, found.count) == ("one", 1.5, 3)
    np.testing.assert_allclose(found.curve, [1.25, 3.0])
    assert (found.point, type(found.point)) == (Point(1.25, -2.0), Point)
    assert (found.pair, found.values) == ((6.0, "a"), {"a": 2.0, "b": 7.0})
    # what is equal stays as it is, bit for bit
    third = made(number=0.1)
    assert case_between(third, made(number=0.1, point=Point(3.0, 3.0)), 0.3).number == 0.1
    assert case_between(FIRST, made(number=4.0), 0.5).curve is FIRST.curve


@pytest.mark.parametrize(
    "changed",
    [
        {"count": 4},
        {"pair": (5.0, "b")},
        {"pair": (5.0, "a", 1.0)},
        {"curve": np.array([1.0, 2.0, 3.0])},
        {"values": {"a": 1.0, "c": 7.0}},
        {"number": 2},
    ],
)
def test_there_is_nothing_between_what_is_no_number(changed: dict[str, Any]):
    with pytest.raises(NothingBetween):
        case_between(FIRST, made(**changed), 0.5)
