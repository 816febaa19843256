"""Runs inputs in processes of their own, so that one that crashes or hangs is known and ends no other."""

import os
import shutil
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple, NoReturn

from tools.fuzz.inputs import Input, drawn, of_corpus
from tools.fuzz.records import record_of

#: Seconds of the processor that an input may take, and seconds by the clock of one that only waits.
TIME_LIMIT, WAITING_LIMIT = 10.0, 300
#: Inputs of a process.
TOGETHER = 250


class Result(NamedTuple):
    """What became of inputs."""

    counts: Counter[tuple[str, str]]  # (target, "taken", "refused" or "fault") -> how many
    faults: list[str]
    slowest: tuple[float, str]  # seconds of the processor, and which input


def run_corpus() -> Result:
    """Run everything of the corpus."""
    return run_all([(f"corpus {i}", given) for i, given in enumerate(of_corpus())])


def run_numbers(seed: int, numbers: Iterable[int]) -> Result:
    """Run drawn inputs."""
    return run_all([(f"seed {seed} input {number}", drawn(seed, number)) for number in numbers])


def run_all(inputs: Sequence[tuple[str, Input]]) -> Result:
    """Run inputs, each with a name."""
    result = Result(Counter(), [], (0.0, ""))
    slowest = result.slowest
    waiting = list(inputs)
    while waiting:
        part, waiting = waiting[:TOGETHER], waiting[TOGETHER:]
        lines, ended = _in_a_child(part)
        for (name, given), line in zip(part, lines, strict=False):
            how, seconds, text = line.split("\t", 2)
            result.counts[given.target, how] += 1
            slowest = max(slowest, (float(seconds), f"{name}, {given.target}"))
            if how == "fault":
                result.faults.append(f"{name} ({given.target}, {given.base}): {text}")
        if len(lines) < len(part):
            name, given = part[len(lines)]
            result.counts[given.target, "fault"] += 1
            result.faults.append(f"{name} ({given.target}, {given.base}): the process ended with {ended}")
            waiting = part[len(lines) + 1 :] + waiting
    return result._replace(slowest=slowest)


def _in_a_child(part: Sequence[tuple[str, Input]]) -> tuple[list[str], int]:
    """A line for every input that was done, and how the child ended."""
    from tools.fuzz.targets import warm_up

    warm_up()
    for base in {given.base for _, given in part if given.target == "run"}:
        record_of(base)  # with the kernels that others have compiled
    scratch = Path(tempfile.mkdtemp(prefix="fuzz-"))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that others' threads do not come along is known
            child = os.fork()
        if child == 0:
            _work(part, scratch)
        _, status = os.waitpid(child, 0)
        results = (scratch / "results").read_text(encoding="utf-8", errors="replace")
        return results.splitlines(), os.waitstatus_to_exitcode(status)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _work(part: Sequence[tuple[str, Input]], scratch: Path) -> NoReturn:
    from tools.fuzz.targets import outcome

    try:
        users = os.environ.get("TRIBODYN_CACHE", "")
        os.fsync = lambda fd: None  # nothing here outlives the process, and a disk takes 10 ms each time
        devnull = os.open(os.devnull, os.O_RDWR)
        for number in (0, 1, 2):
            os.dup2(devnull, number)
        warnings.simplefilter("error")
        with (scratch / "results").open("w", encoding="utf-8", buffering=1) as results:
            for i, (_, given) in enumerate(part):
                folder = scratch / str(i)
                folder.mkdir()
                os.chdir(folder)
                # a page of a record solves nothing again that was solved for its run
                os.environ["TRIBODYN_CACHE"] = users if given.target == "run" else str(scratch / "cache")
                signal.setitimer(signal.ITIMER_PROF, TIME_LIMIT)
                signal.alarm(WAITING_LIMIT)
                begun = time.process_time()
                try:
                    how, text = outcome(given, folder), ""
                except Exception as error:
                    how, text = "fault", f"{type(error).__name__}: {error}"
                signal.alarm(0)
                signal.setitimer(signal.ITIMER_PROF, 0.0)
                seconds = time.process_time() - begun
                results.write(f"{how}\t{seconds:.4f}\t{text[:400]!a}\n")
                os.chdir(scratch)
                shutil.rmtree(folder, ignore_errors=True)
    finally:
        sys.stderr.flush()
        os._exit(0)
