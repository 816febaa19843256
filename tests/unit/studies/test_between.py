"""Cases between two cases."""

import pytest

from tribodyn.studies.between import NothingBetween, case_between
from tribodyn.studies.load import load_scenario


def case(speed, **others):
    return load_scenario("crc-23-47", {"operating.pinion_speed": f"{speed} rad/s", **others})


def test_numbers_are_in_proportion():
    slow, fast = case(100), case(300)
    for share, speed in ((0.25, 150.0), (0.5, 200.0), (1.5, 400.0)):
        assert case_between(slow, fast, share).operating.pinion_speed == pytest.approx(speed)


def test_the_ends_are_the_cases_themselves():
    slow, fast = case(100), case(300)
    assert case_between(slow, fast, 0.0) is slow
    assert case_between(slow, fast, 1.0) is fast


def test_there_is_nothing_between_two_laws():
    with pytest.raises(NothingBetween):
        case_between(case(100), case(100, **{"friction.law": "none"}), 0.5)
