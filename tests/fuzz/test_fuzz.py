"""Half a thousand of the inputs of `make fuzz`: taken, or refused by a readable message; nothing else."""

import os
import signal

import pytest

from tests.support.soak_parameters import all_in_soak
from tools.fuzz import targets
from tools.fuzz.inputs import SHARES, Input, drawn, of_corpus
from tools.fuzz.records import QUICK
from tools.fuzz.runs import Result, run_all, run_corpus
from tools.fuzz.targets import REFUSED, TAKEN

#: With the corpus a thousand, of which `make soak` runs all.
DRAWN = 726


def quick(numbers: range, seed: int = 0) -> list[tuple[str, Input]]:
    """Inputs by their names, without records whose runs take long."""
    named = [(f"seed {seed} input {number}", drawn(seed, number)) for number in numbers]
    return [(name, given) for name, given in named if given.target != "run" or given.base in QUICK]


def assert_sound(result: Result, count: int) -> None:
    assert result.faults == []
    assert sum(result.counts.values()) == count
    assert {how for _, how in result.counts} <= {TAKEN, REFUSED}


def test_what_once_went_wrong():
    inputs = of_corpus()
    assert len(inputs) + DRAWN >= 1000
    assert_sound(run_corpus(), len(inputs))


@pytest.mark.parametrize("part", all_in_soak(range(3), [0]))
def test_drawn_inputs(part: int):
    count = DRAWN // 3
    inputs = quick(range(part * count, (part + 1) * count))
    result = run_all(inputs)
    assert_sound(result, len(inputs))
    assert {target for target, _ in result.counts} == set(SHARES)


def test_an_input_is_its_seed_and_number():
    assert [drawn(3, i) for i in range(50)] == [drawn(3, i) for i in range(50)]
    assert drawn(3, 1) != drawn(4, 1)


def test_a_crash_and_a_fault_are_told_and_end_nothing(monkeypatch: pytest.MonkeyPatch):
    """The process of the second input dies, the third raises what no input may."""

    def die(*_: object) -> None:
        os.kill(os.getpid(), signal.SIGKILL)

    def fail(*_: object) -> None:
        raise ZeroDivisionError("no\nreason")

    monkeypatch.setitem(targets._TARGETS, "cache", die)
    monkeypatch.setitem(targets._TARGETS, "signals", fail)
    good = of_corpus()[-1]
    assert good.target == "toml"
    bad = [("b", Input("cache", "kernel", b"")), ("c", Input("signals", "sensors-18-36", b""))]
    result = run_all([("a", good), *bad, ("d", good)])
    assert len(result.faults) == 2
    assert result.faults[0] == "b (cache, kernel): the process ended with -9"
    assert "ZeroDivisionError" in result.faults[1]
    assert result.counts["toml", REFUSED] + result.counts["toml", TAKEN] == 2
