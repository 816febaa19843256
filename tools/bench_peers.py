"""Speed compared with other programs, at equal error, in one run: ratios of medians, never a time alone.

python tools/bench_peers.py                              # everything that is installed, to the terminal
python tools/bench_peers.py --into docs/measurements.md   # and into the page
python tools/bench_peers.py --only tribodyn LSODA        # programs whose names contain a word

Single: the CRC drive at 300 rad/s over 20 mesh cycles. Every program gets the loosest tolerance (of a ladder)
with which the maximum error of the transmission error, over its range, is within TARGET of the solution at
1e-12; compilation, tables and files are outside. Batch: the same drive at many speeds. Steady: its periodic
steady states over the speed, and LSODA marching to them.
"""

import argparse
import os
import platform
from collections.abc import Callable
from pathlib import Path
from time import perf_counter, process_time
from typing import Any, NamedTuple

import numpy as np

from tools.marked_block import put
from tools.peers import steady
from tools.peers.batch import BATCHES, Batch, speeds, threads
from tools.peers.numpy_model import check
from tools.peers.single import Problem, Runner, octave, octave_timed, peers, tribodyn_engine
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.load import load_scenario

Array = Any

TARGET = 2e-5
CYCLES, SAMPLES = 20, 200
LADDER = (1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9)
REFERENCE = "SciPy BDF, NumPy"


class Timed(NamedTuple):
    """One program's figures: tolerance, error achieved, median seconds of the repeats."""

    name: str
    rtol: float
    error: float
    seconds: float


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--into", type=Path, help="page whose marked blocks receive the tables")
    parser.add_argument("--only", nargs="+", default=[""], help="programs whose names contain one of these")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--part", nargs="+", choices=("single", "batch", "steady"), help="default: all")
    chosen = parser.parse_args()
    words = [word.lower() for word in chosen.only]

    def wanted(name: str) -> bool:
        return any(word in name.lower() for word in words)

    made = {
        "single": lambda: single(wanted, chosen.repeats),
        "batch": lambda: batch(wanted, chosen.repeats),
        "steady": lambda: steady.table(chosen.repeats),
    }
    for name, make in made.items():
        if chosen.part and name not in chosen.part:
            continue
        text = make()
        print(f"\n{text}\n")
        if chosen.into:
            put(chosen.into, name, text)


def problem(cycles: int = CYCLES) -> Problem:
    """The case of the comparison."""
    case: Any = load_scenario("crc-23-47-300")
    model = prepare(case).model
    return Problem(model, static_equilibrium(model), cycles, SAMPLES)


def single(wanted: Callable[[str], bool], repeats: int) -> str:
    """Table of single runs."""
    posed = problem()
    exact = tribodyn_engine("dopri5")(posed, 1e-12)
    integrator = make_integrator("dopri5", posed.model, SAMPLES, posed.tolerances(1e-9))
    visited = integrator.integrate(posed.state, 0, 2).samples[:-1]
    same = check(posed.model, visited, np.arange(len(visited)) % SAMPLES / SAMPLES)
    timings = []
    for name, run in peers().items():
        if wanted(name):
            one = _timed(name, run, posed, exact, repeats)
            print(
                f"{one.name:24s} rtol {one.rtol:.0e}  error {one.error:.1e}  {1e3 * one.seconds:.2f} ms",
                flush=True,
            )
            timings.append(one)
    ours = next((one for one in timings if one.name == "tribodyn dopri5"), None)
    rows = ["| program | rtol | error | ms | times ours |", "|---|--:|--:|--:|--:|"]
    for one in sorted(timings, key=lambda one: one.seconds):
        ratio = f"{one.seconds / ours.seconds:.3g}" if ours else ""
        rows.append(f"| {one.name} | {one.rtol:.0e} | {one.error:.1e} | {1e3 * one.seconds:.3g} | {ratio} |")
    rows += [
        "",
        f"{machine()}; medians of {repeats}. The NumPy and Octave models differ from tribodyn's "
        f"right-hand side by {same:.0e} of its range (they interpolate the same tables).",
    ]
    return "\n".join(rows)


def _timed(name: str, run: Runner, posed: Problem, exact: Array, repeats: int) -> Timed:
    """Find the loosest tolerance that serves, then time it."""
    run(posed._replace(cycles=1), LADDER[0])  # compiles
    rtol, error = loosest(lambda rtol: run(posed, rtol), exact)
    seconds = []
    for _ in range(repeats):
        begun = perf_counter()
        if run is octave:
            seconds.append(octave_timed(posed, rtol)[1])
            continue
        run(posed, rtol)
        seconds.append(perf_counter() - begun)
    return Timed(name, rtol, error, float(np.median(seconds)))


def loosest(run: Callable[[float], Array], exact: Array) -> tuple[float, float]:
    """Loosest tolerance of the ladder that meets the target, or its tightest, and the error with it."""
    span = np.ptp(exact, axis=-1, keepdims=True)
    rtol, error = LADDER[0], np.inf
    for rtol in LADDER:
        error = float(np.max(np.abs(run(rtol) - exact) / span))
        if error <= TARGET:
            break
    return rtol, error


def _marching(program: Batch, cases: tuple[list[Any], Array]) -> Callable[[float], Array]:
    return lambda rtol: program.march(*cases, program.cycles, rtol)


def batch(wanted: Callable[[str], bool], repeats: int) -> str:
    """Table of batches: mesh cycles × cases per second; programs take turns, as the machine may be shared."""
    posed = problem()
    few = speeds(posed, 8)
    chosen = {name: program for name, program in BATCHES.items() if wanted(name)}
    exact = {n: threads("dopri5")(*few, n, 1e-11) for n in {one.cycles for one in chosen.values()}}
    cases = {n: speeds(posed, n) for n in {one.cases for one in chosen.values()}}
    tolerances = {name: loosest(_marching(one, few), exact[one.cycles]) for name, one in chosen.items()}
    taken: dict[str, list[tuple[float, float]]] = {name: [] for name in chosen}
    for turn in range(repeats + 1):
        for name, program in chosen.items():
            begun = perf_counter(), process_time()
            _marching(program, cases[program.cases])(tolerances[name][0])
            if turn:  # the first one compiles
                taken[name].append((perf_counter() - begun[0], process_time() - begun[1]))
    rows = [
        "| program | rtol | error | cycles × cases per second | per second of one core | ours over it |",
        "|---|--:|--:|--:|--:|--:|",
    ]
    ours = None
    for name, program in chosen.items():
        wall, cpu = program.cases * program.cycles / np.median(taken[name], axis=0)
        ours = ours or cpu
        rtol, error = tolerances[name]
        rows.append(f"| {name} | {rtol:.0e} | {error:.1e} | {wall:.3g} | {cpu:.3g} | {ours / cpu:.3g} |")
    return "\n".join(
        [
            *rows,
            "",
            f"{machine()}; speeds from 100 to 600 rad/s, error at eight of them; medians of {repeats}; "
            "ratios of processor time, since the machine may be shared.",
        ]
    )


def machine() -> str:
    """Processor and cores, for a table."""
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        lines = cpuinfo.read_text(encoding="utf-8").splitlines()
        model = next(
            (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), model
        )
    return f"{model}, {os.cpu_count()} cores"


if __name__ == "__main__":
    main()
