"""The command line: python -m tools.soak; see the package."""

import argparse
import logging
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

from tools.marked_block import made_by, put
from tools.soak import outcomes
from tools.soak.cases import CASES
from tools.soak.outcome import FAULTY, Outcome, outcome, run_one


def main() -> None:
    """Run cases that have no outcome yet; print what is wrong, and the table."""
    parser = argparse.ArgumentParser(prog="python -m tools.soak", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--case", type=int, help="this case alone, again")
    parser.add_argument("--keep", type=Path, help="with --case: folder for its scenario and record")
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--count", type=int, default=CASES)
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--short", action="store_true", help="dynamics alone, few laws: quick to compile")
    parser.add_argument("--so-far", action="store_true", help="run nothing; the table of what is done")
    parser.add_argument("--into", type=Path, help="page with the marked block for the table")
    given = parser.parse_args()
    if given.case is not None:
        sys.exit(_again(given.seed, given.case, given.keep, given.short))
    store = outcomes.store(given.seed, given.short)
    wanted = range(given.first, given.first + given.count)
    known = {known.case: known for known in outcomes.read(store)}
    waiting = [] if given.so_far else [number for number in wanted if number not in known]
    done = sum(number in known for number in wanted)
    print(f"seed {given.seed}: {done} outcomes in {store}, {len(waiting)} to do", flush=True)
    with ProcessPoolExecutor(given.jobs, mp_context=get_context("spawn")) as pool:
        futures = [pool.submit(run_one, given.seed, number, given.short) for number in waiting]
        for done, future in enumerate(as_completed(futures), 1):
            found = future.result()
            outcomes.add(store, found)
            known[found.case] = found
            if found.status == FAULTY:
                print(_written(found), flush=True)
            if done % 50 == 0:
                print(f"{done} of {len(waiting)}", flush=True)
    there = [known[number] for number in wanted if number in known]
    minutes = f"{sum(case.seconds for case in there) / 60:.0f} minutes of one core"
    head = f"{len(there)} of the {len(wanted)} cases of seed {given.seed}, {minutes}:"
    text = f"{made_by()} {head}\n\n{outcomes.table(there)}"
    print(text)
    if given.into:
        put(given.into, "soak", text)
    sys.exit(any(case.status == FAULTY for case in there))


def _again(seed: int, number: int, keep: Path | None, short: bool) -> int:
    logging.basicConfig()
    logging.getLogger("tools.soak").setLevel(logging.DEBUG)
    with TemporaryDirectory() as scratch:
        folder = keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        found = outcome(seed, number, folder, short)
        print((folder / "case.toml").read_text(encoding="utf-8"))
    print(_written(found))
    return int(found.status == FAULTY)


def _written(found: Outcome) -> str:
    which = f"seed {found.seed} case {found.case}"
    head = f"{which}: {found.sort} {found.family} {found.status} {found.reason}".rstrip()
    return "\n".join([f"{head} ({found.seconds:.2g} s)", *(f"    {fault}" for fault in found.faults)])


if __name__ == "__main__":
    main()
