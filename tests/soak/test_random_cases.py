"""Random drives and duties: complete and consistent, or refused with a true reason: docs/soak.md."""

import pytest

from tests.support.soak_parameters import all_in_soak
from tools.soak.cases import CASES, GROUP
from tools.soak.outcome import FAULTY, Outcome, run_one
from tools.soak.outcomes import add, read, store

#: The cases of `make soak` run group by group: what a stopped one has done is not done again.
SEED = 1
#: A few that run with all tests, on laws whose kernels others need too.
SHORT_SEED, SHORT_CASES = 7, (1, 3, 5, 10, 11, 14)


def written(found: Outcome, options: str = "") -> str:
    again = f"python -m tools.soak --seed {found.seed} --case {found.case}{options}"
    return "\n    ".join([again, *found.faults])


@pytest.mark.parametrize("number", all_in_soak(SHORT_CASES, (3, 10, 11)))
def test_a_few_cases(number: int):
    found = run_one(SHORT_SEED, number, short=True)
    assert found.status != FAULTY, written(found, " --short")


@pytest.mark.soak
@pytest.mark.parametrize("first", range(0, CASES, GROUP))
def test_random_cases(first: int):
    path = store(SEED)
    known = {found.case: found for found in read(path)}
    for number in range(first, first + GROUP):
        if number not in known:
            known[number] = run_one(SEED, number)
            add(path, known[number])
    faulty = [known[number] for number in range(first, first + GROUP) if known[number].status == FAULTY]
    assert not faulty, "\n".join(map(written, faulty))
