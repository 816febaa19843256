"""Speed compared with other programs, at equal error, in one run: ratios of medians, never a time alone.

python -m tools.bench_peers                                           # everything that is installed
python -m tools.bench_peers --part single --into docs/measurements.md  # one table, and into the page
python -m tools.bench_peers --only tribodyn LSODA                     # programs whose names contain a word

Single: the CRC drive at 300 rad/s over 20 mesh cycles. Every program gets the loosest tolerance (of a ladder)
with which the maximum error of the transmission error, over its range, is within TARGET of the solution at
1e-12; compilation, tables and files are outside. A program that does not get there is marked and has no
ratio; one with a right-hand side of its own must agree with tribodyn's first. Train: the same for a two-stage
reducer, on tribodyn's right-hand side. Diffrax: the same for diffrax,
whose compilation takes minutes. Batch: the same drive at many speeds. Steady: its periodic steady states over
the speed, and LSODA marching to them.
"""

import argparse
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from tools.marked_block import generate, measured_on, parser_of, spent, table
from tools.peers import steady
from tools.peers.batch import BATCHES, WINDOW, Batch, models_at, threads
from tools.peers.batch import SAMPLES as IN_BATCH
from tools.peers.numpy_model import MOVING, difference
from tools.peers.single import Problem, Program, octave, octave_timed, peers, peers_on_trains, tribodyn_engine
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.structure import rotational_error

Array = Any

TARGET = 2e-5
#: Maximum difference of two right-hand sides, over the range of each rate, that counts as the same equations.
SAME_EQUATIONS = 1e-6
#: Seconds after which a program is not run again: a slow one has fewer repeats.
ENOUGH = 30.0
CYCLES, SAMPLES = 20, 200
LADDER = (1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9)
OURS = "tribodyn dopri5"


class Timed(NamedTuple):
    """Tolerance of a program, error achieved, median seconds of the repeats."""

    name: str
    rtol: float
    error: float
    seconds: float


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("--only", nargs="+", default=[""], help="programs whose names contain one of these")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--part", nargs="+", choices=PARTS, default=[*PARTS])
    generate(__doc__, parser=parser, **PARTS)


def wanted(name: str, given: argparse.Namespace) -> bool:
    return any(word.lower() in name.lower() for word in given.only)


PARTS = {
    "single": lambda given: single(lambda name: wanted(name, given) and "diffrax" not in name, given.repeats),
    "diffrax": lambda given: single(
        lambda name: "diffrax" in name or name in (OURS, "SciPy LSODA, numba"), given.repeats
    ),
    "train": lambda given: of_train(lambda name: wanted(name, given), given.repeats),
    "batch": lambda given: batch(lambda name: wanted(name, given), given.repeats),
    "steady": lambda given: f"{steady.table(given.repeats, TARGET)} {measured_on()}.",
}


def problem(cycles: int = CYCLES) -> Problem:
    """The case of the comparison."""
    case: Any = load_scenario("crc-23-47-300")
    model = prepare(case).model
    return Problem(model, static_equilibrium(model), cycles, SAMPLES)


def single(wanted: Callable[[str], bool], repeats: int) -> str:
    """Table of single runs."""
    return compared(problem(), {name: one for name, one in peers().items() if wanted(name)}, repeats)


def of_train(wanted: Callable[[str], bool], repeats: int) -> str:
    """Table of single runs of a train."""
    case: Any = load_scenario("two-stage-reducer")
    model = prepare(case).model
    posed = Problem(model, static_equilibrium(model), CYCLES, SAMPLES)
    return compared(posed, {name: one for name, one in peers_on_trains().items() if wanted(name)}, repeats)


def compared(posed: Problem, programs: dict[str, Program], repeats: int) -> str:
    """Table of programs that solve the same problem."""
    differs = require_same_equations(posed, programs)
    exact = tribodyn_engine("dopri5")(posed, 1e-12)
    timings = []
    for name, program in programs.items():
        timings.append(_timed(name, program, posed, exact, repeats))
        print(timings[-1], flush=True)
    remarks = f"{measured_on()}; medians of up to {repeats}."
    if differs:
        most = f"{max(differs.values()):.0e} of its range"
        remarks += f" Right-hand sides in {', '.join(differs)} differ from tribodyn's by {most}."
    return f"{single_table(timings)}\n\n{remarks}"


def single_table(timings: list[Timed]) -> str:
    """Rows by time; what misses the error has no ratio, as it does not solve the same problem."""
    ours = next((timed for timed in timings if timed.name == OURS and timed.error <= TARGET), None)
    rows = []
    for name, rtol, error, seconds in sorted(timings, key=lambda x: (x.error > TARGET, x.seconds)):
        ratio = f"{seconds / ours.seconds:.3g}" if ours else ""
        cells = f"{rtol:.0e}", f"{error:.1e}", f"{1e3 * seconds:.3g}", _unless_missed(error, ratio)
        rows.append([name, *cells])
    return table(["program", "rtol", "error", "ms", "times ours"], rows, "lrrrr")


def _unless_missed(error: float, ratio: str) -> str:
    return ratio if error <= TARGET else f"misses {TARGET:.0e}"


def require_same_equations(posed: Problem, programs: dict[str, Program]) -> dict[str, float]:
    """Differences of the right-hand sides that programs bring along; exits where one is above SAME_EQUATIONS.

    Compared at the states of two mesh cycles.
    """
    integrator = make_integrator("dopri5", posed.model, SAMPLES, posed.tolerances(1e-9))
    visited = integrator.integrate(posed.state, 0, 2).samples[:-1, MOVING]
    phases = np.arange(len(visited)) % SAMPLES / SAMPLES
    differs = {
        name: difference(posed.model, phases, visited, program.rates)
        for name, program in programs.items()
        if program.rates
    }
    others = [
        f"{name} (right-hand side differs by {by:.1e} of its range)"
        for name, by in differs.items()
        if not by <= SAME_EQUATIONS
    ]
    if others:
        raise SystemExit(
            f"no comparison, these solve other equations than tribodyn: {', '.join(others)}; "
            f"at most {SAME_EQUATIONS:.0e} is allowed: mend tools/peers"
        )
    return differs


def _timed(name: str, program: Program, posed: Problem, exact: Array, repeats: int) -> Timed:
    """Find the loosest tolerance that serves, then time it."""
    run = program.run
    run(posed._replace(cycles=1), LADDER[0])  # compiles
    rtol, error = loosest(lambda rtol: run(posed, rtol), exact)
    seconds: list[float] = []
    while np.isfinite(error) and len(seconds) < repeats and sum(seconds) < ENOUGH:
        if run is octave:
            seconds.append(octave_timed(posed, rtol)[1])
            continue
        # by the clock, or less where other work took the processor meanwhile
        seconds.append(min(spent(lambda: run(posed, rtol))))
    return Timed(name, rtol, error, float(np.median(seconds or np.nan)))


def loosest(run: Callable[[float], Array], exact: Array) -> tuple[float, float]:
    """Loosest tolerance of the ladder that meets the target, or its tightest, and the error with it.

    The error of a run that gives up is infinite.
    """
    span = np.ptp(exact, axis=-1, keepdims=True)
    rtol, error = LADDER[0], np.inf
    for rtol in LADDER:
        try:
            found = run(rtol)
        except RuntimeError:
            found = np.empty(0)
        whole = found.shape == exact.shape  # some programs give up without a word, and return fewer samples
        error = float(np.max(np.abs(found - exact) / span)) if whole else np.inf
        if error <= TARGET:
            break
    return rtol, error


def _marching(program: Batch, cases: tuple[list[Any], Array]) -> Callable[[float], Array]:
    """From a tolerance to samples of the transmission error of every case."""
    given = {"cycles": program.cycles, "window": WINDOW, "samples": IN_BATCH}
    model = cases[0][0]
    return lambda rtol: rotational_error(program.run(*cases, rtol=rtol, **given).samples, 0, model)


def _cases(posed: Problem, count: int) -> tuple[list[Any], Array]:
    """Models at speeds from 100 to 600 rad/s, and their static equilibria."""
    models = models_at(posed, np.linspace(100.0, 600.0, count))
    return models, np.array([static_equilibrium(model) for model in models])


def batch(wanted: Callable[[str], bool], repeats: int) -> str:
    """Table of batches: mesh cycles × cases per second; programs take turns, as the machine may be shared."""
    posed = problem()
    few = _cases(posed, 8)
    chosen = {name: program for name, program in BATCHES.items() if wanted(name)}
    tight = {p.cycles: Batch(threads("dopri5"), 8, p.cycles) for p in chosen.values()}
    exact = {cycles: _marching(program, few)(1e-11) for cycles, program in tight.items()}
    cases = {n: _cases(posed, n) for n in {program.cases for program in chosen.values()}}
    tolerances = {name: loosest(_marching(p, few), exact[p.cycles]) for name, p in chosen.items()}
    taken: dict[str, list[tuple[float, float]]] = {name: [] for name in chosen}
    for turn in range(repeats + 1):
        for name, program in chosen.items():
            if sum(wall for wall, _ in taken[name]) > ENOUGH:
                continue
            march, (rtol, _) = _marching(program, cases[program.cases]), tolerances[name]
            seconds = spent(lambda march=march, rtol=rtol: march(rtol))
            if turn:  # the first one compiles
                taken[name].append(seconds)
    head = ["program", "rtol", "error", "cycles × cases per second", "per second of one core", "ours over it"]
    rows, ours = [], None
    for name, program in chosen.items():
        wall, cpu = program.cases * program.cycles / np.median(taken[name], axis=0)
        ours = ours or cpu
        rtol, error = tolerances[name]
        cells = f"{rtol:.0e}", f"{error:.1e}", f"{wall:.3g}", f"{cpu:.3g}"
        rows.append([name, *cells, _unless_missed(error, f"{ours / cpu:.3g}")])
    return (
        f"{table(head, rows, 'lrrrrr')}\n\n{measured_on()}; speeds from 100 to 600 rad/s, error at eight of "
        f"them; medians of up to {repeats}; ratios of processor time, since the machine may be shared."
    )


if __name__ == "__main__":
    main()
