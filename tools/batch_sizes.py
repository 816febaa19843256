"""Throughput of batches by their size, from 64 to a million cases.

python -m tools.batch_sizes --into docs/measurements.md      # lanes, and the others up to FEW cases
python -m tools.batch_sizes --engine jax --width 16384      # on a GPU: whatever device JAX has

The CRC drive at speeds from 100 to 600 rad/s in no order, at the tolerances of `bench_peers` for an error of
2e-5. Counted is the march of models that are there; large batches are done in parts, as the page on batches
says, and of every case only the peak to peak transmission error is kept.
"""

import argparse
import resource
import sys

import numpy as np

from tools.bench_peers import problem
from tools.marked_block import generate, measured_on, parser_of, spent, table
from tools.peers.batch import models_at, threads, together
from tribodyn.solve.jax import ensemble as jax_ensemble
from tribodyn.train.structure import rotational_error

SIZES = (64, 256, 1024, 10_000, 100_000, 1_000_000)
#: Largest batch of the slower engines where several are measured.
FEW = 1024
#: Cases at a time: their models are Python objects of some kB each.
PART = 2**15
#: Mesh cycles of a case by the size of the batch, and samples in the last of them.
CYCLES = {
    "native": {256: 40, 1024: 20, 10_000: 10, 100_000: 3, 1_000_000: 1},
    "threads": {256: 40, 1_000_000: 10},
    "jax": {1_000_000: 4},
}
REPEATS = 5
SAMPLES = 16
#: How it runs, and the tolerance that brings the error to 2e-5 of the range, see the table of `bench_peers`.
ENGINES = {
    "native": (together("dopri5"), 3e-5),
    "threads": (threads("dopri5"), 3e-5),
    "jax": (together("tsit5"), 3e-6),
}


def by_size(given: argparse.Namespace) -> str:
    """Table of the page."""
    if given.width:
        jax_ensemble.WIDTH = jax_ensemble.WIDTH_ON_CPU = given.width
    engines = [engine for engine in ENGINES if given.engine in (engine, "all")]
    head = ["engine", "cases", "cycles", "cycles × cases per second", "per second of one core"]
    head += ["ns per evaluation", "peak memory"]
    rows = []
    for engine in engines:
        for cases in sorted(given.sizes):
            if engine != "native" and len(engines) > 1 and cases > FEW:
                continue
            cycles = next(n for size, n in CYCLES[engine].items() if cases <= size)
            repeats = REPEATS if cases <= 1024 else 1
            wall, processor, evaluations, failed = measured(engine, cases, cycles, repeats)
            memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10
            rates = (cases * cycles / wall, cases * cycles / processor, 1e9 * processor / evaluations)
            row = [_name(engine), cases, cycles, *(f"{rate:.3g}" for rate in rates), f"{memory:.0f} MiB"]
            print(*row, f"{failed:.0f} failed" if failed else "", file=sys.stderr, flush=True)
            rows.append(row)
    return f"{table(head, rows, 'lrrrrrr')}\n\n{measured_on()}; up to 1024 cases medians of {REPEATS}."


def measured(engine: str, cases: int, cycles: int, repeats: int) -> np.ndarray:
    """Seconds on the clock and of the processor, evaluations and failed cases of the median march."""
    posed = problem()
    run, rtol = ENGINES[engine]
    speeds = np.random.default_rng(1).uniform(100.0, 600.0, cases)
    swing = np.full(cases, np.nan)

    def part(first: int) -> list[float]:
        models = models_at(posed, speeds[first : first + PART])
        states, results = np.tile(posed.state, (len(models), 1)), []
        given = {"cycles": cycles, "window": 1, "samples": SAMPLES, "rtol": rtol}
        seconds = spent(lambda: results.append(run(models, states, **given)))
        (result,) = results
        swing[first : first + PART] = np.ptp(rotational_error(result.samples, 0, posed.model), axis=1)
        return [*seconds, float(np.sum(result.evaluations)), float(np.sum(result.status != 0))]

    part(cases - 64)  # compiles
    runs = [np.sum([part(first) for first in range(0, cases, PART)], axis=0) for _ in range(repeats)]
    return np.median(runs, axis=0)


def _name(engine: str) -> str:
    if engine != "jax":
        return {"native": "lanes", "threads": "one case per thread"}[engine]
    import jax

    return f"diffrax, {jax.devices()[0].device_kind}"


if __name__ == "__main__":
    parser = parser_of(__doc__)
    parser.add_argument("--engine", choices=(*ENGINES, "all"), default="all")
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES)
    parser.add_argument("--width", type=int, help="cases that JAX takes side by side, see `jax_ensemble`")
    generate(__doc__, parser=parser, sizes=by_size)
