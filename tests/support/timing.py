"""Times of calls on a machine on which other programs run."""

from collections.abc import Callable, Sequence
from time import perf_counter, process_time
from typing import Any

#: Seconds to meet a calm machine.
SECONDS = 8.0


def least(calls: Sequence[Callable[[], Any]], turns: int, enough: float = 0.0) -> list[float]:
    """Processor time of calls, taken in turn: the least of each, which met the calmest machine; s.

    Where the first one's over the sum of the others' is not below `enough`, they go on for seconds: whatever
    else runs holds a processor's caches for as long.
    """
    best = [float("inf")] * len(calls)
    turn, end = 0, perf_counter() + SECONDS
    while turn <= turns or (best[0] >= enough * sum(best[1:]) and enough and perf_counter() < end):
        for place, call in enumerate(calls):
            begun = process_time()
            call()
            best[place] = min(best[place], process_time() - begun)
        turn += 1
    return best
