"""The command line: python -m tools.fuzz; see the package."""

import argparse
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from tools.fuzz.inputs import SHARES, drawn
from tools.fuzz.runs import Result, run_corpus, run_numbers
from tools.marked_block import made_by, put
from tools.marked_block import table as table_of

#: Inputs of `make fuzz`.
COUNT = 30_000
#: Inputs between two reports.
BLOCK = 1000


def main() -> None:
    """Run inputs; print what is wrong, and the table."""
    parser = argparse.ArgumentParser(prog="python -m tools.fuzz", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--input", type=int, help="print this input alone, and what becomes of it")
    parser.add_argument("--into", type=Path, help="page with the marked block for the table")
    given = parser.parse_args()
    if given.input is not None:
        print(drawn(given.seed, given.input))
        print(run_numbers(given.seed, [given.input]))
        return
    begun = time.perf_counter()
    results = [run_corpus()]
    print(*results[0].faults, sep="\n", flush=True)
    numbers = range(given.first, given.first + given.count)
    blocks = [numbers[i : i + BLOCK] for i in range(0, len(numbers), BLOCK)]
    with ProcessPoolExecutor(given.jobs, mp_context=get_context("spawn")) as pool:
        futures = [pool.submit(run_numbers, given.seed, block) for block in blocks]
        for block, future in zip(blocks, futures, strict=True):
            results.append(future.result())
            seconds = time.perf_counter() - begun
            print(*results[-1].faults, f"{block.stop} done, {seconds:.0f} s", sep="\n", flush=True)
    text = f"{made_by()} Seed {given.seed}:\n\n{table(results)}"
    print(text)
    if given.into:
        put(given.into, "fuzz", text)
    sys.exit(any(result.faults for result in results))


def table(results: list[Result]) -> str:
    """What became of all inputs, by target."""
    counts = sum((result.counts for result in results), Counter[tuple[str, str]]())
    rows = []
    for target in (*SHARES, "all"):
        numbers = [
            sum(count for (own, how), count in counts.items() if target in (own, "all") and how == way)
            for way in ("taken", "refused", "fault")
        ]
        rows.append([target, sum(numbers), *numbers])
    seconds, which = max(result.slowest for result in results)
    lines = table_of(["target", "inputs", "taken", "refused", "faults"], rows, "lrrrr")
    return f"{lines}\n\nLongest by processor time: {seconds:.2g} s ({which})."


if __name__ == "__main__":
    main()
