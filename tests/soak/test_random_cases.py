"""Random drives and duties: complete and consistent, or refused with a true reason: docs/soak.md."""

import pytest

from tools.soak.cases import CASES, GROUP
from tools.soak.kept import add, read, store
from tools.soak.outcome import FAULTY, run_one

#: The cases of `make soak` run group by group: what a stopped one has done is not done again.
SEED = 1
#: A few that run with all tests, on laws whose kernels others need too.
SHORT_SEED, SHORT_CASES = 7, (1, 3, 5, 10, 11, 14)


def said(one, options: str = "") -> str:
    again = f"python -m tools.soak --seed {one.seed} --case {one.case}{options}"
    return "\n    ".join([again, *one.faults])


@pytest.mark.parametrize("number", SHORT_CASES)
def test_a_few_cases(number: int):
    one = run_one(SHORT_SEED, number, short=True)
    assert one.status != FAULTY, said(one, " --short")


@pytest.mark.soak
@pytest.mark.parametrize("first", range(0, CASES, GROUP))
def test_random_cases(first: int):
    path = store(SEED)
    known = {one.case: one for one in read(path)}
    for number in range(first, first + GROUP):
        if number not in known:
            known[number] = run_one(SEED, number)
            add(path, known[number])
    faulty = [known[number] for number in range(first, first + GROUP) if known[number].status == FAULTY]
    assert not faulty, "\n".join(said(one) for one in faulty)
