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
from pathlib import Path
from time import perf_counter, process_time
from typing import NamedTuple

import numpy as np

from tools.bench_peers import problem
from tools.machine import measured_on
from tools.marked_block import put
from tribodyn.dynamics.parameters import XI
from tribodyn.solve import ensemble
from tribodyn.solve.ensemble import march
from tribodyn.solve.jax import ensemble as jax_ensemble

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
#: Method and tolerance that bring the error to 2e-5 of the range, see the table of `bench_peers`.
ENGINES = {"native": ("dopri5", 3e-5), "threads": ("dopri5", 3e-5), "jax": ("tsit5", 3e-6)}


class Measured(NamedTuple):
    """Seconds on the clock and of the processor, evaluations of the right-hand side, cases that failed."""

    wall: float
    processor: float
    evaluations: float
    failed: int


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--into", type=Path, help="page whose marked block `sizes` receives the table")
    parser.add_argument("--engine", choices=(*ENGINES, "all"), default="all")
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES)
    parser.add_argument("--width", type=int, help="cases that JAX takes side by side, see `jax_ensemble`")
    chosen = parser.parse_args()
    if chosen.width:
        jax_ensemble.WIDTH = jax_ensemble.WIDTH_ON_CPU = chosen.width
    text = table([one for one in ENGINES if chosen.engine in (one, "all")], sorted(chosen.sizes))
    print(f"\n{text}\n")
    if chosen.into:
        put(chosen.into, "sizes", text)


def table(engines: list[str], sizes: list[int]) -> str:
    """Table of the page."""
    rows = [
        "| engine | cases | cycles | cycles × cases per second | per second of one core "
        "| ns per evaluation | peak memory |",
        "|---|--:|--:|--:|--:|--:|--:|",
    ]
    for engine in engines:
        for cases in sizes:
            if engine != "native" and len(engines) > 1 and cases > FEW:
                continue
            cycles = next(n for size, n in CYCLES[engine].items() if cases <= size)
            one = measured(engine, cases, cycles, REPEATS if cases <= 1024 else 1)
            each = 1e9 * one.processor / one.evaluations
            memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10
            rows.append(
                f"| {_name(engine)} | {cases} | {cycles} | {cases * cycles / one.wall:.3g} "
                f"| {cases * cycles / one.processor:.3g} | {each:.3g} "
                f"| {memory:.0f} MiB |"
            )
            print(rows[-1], f"{one.failed} failed" if one.failed else "", file=sys.stderr, flush=True)
    return "\n".join([*rows, "", f"{measured_on()}; up to 1024 cases medians of {REPEATS}."])


def measured(engine: str, cases: int, cycles: int, repeats: int) -> Measured:
    """The median march of so many cases."""
    posed = problem()
    method, rtol = ENGINES[engine]
    mechanics = posed.model.mechanics
    speeds = np.random.default_rng(1).uniform(100.0, 600.0, cases)
    swing = np.full(cases, np.nan)

    def part(first: int) -> Measured:
        models = [
            posed.model._replace(mechanics=mechanics._replace(nominal_speed=float(speed)))
            for speed in speeds[first : first + PART]
        ]
        states = np.tile(posed.state, (len(models), 1))
        begun = perf_counter(), process_time()
        if engine == "threads":
            settings = ensemble.March(0, cycles, 1, SAMPLES, False, rtol, 10**6)
            result = ensemble.one_by_one(models, states, method, settings, ensemble.usable_cores())
        else:
            result = march(models, states, cycles=cycles, window=1, samples=SAMPLES, rtol=rtol, method=method)
        spent = perf_counter() - begun[0], process_time() - begun[1]
        swing[first : first + PART] = np.ptp(result.samples[..., XI], axis=1)
        return Measured(*spent, float(np.sum(result.evaluations)), int(np.sum(result.status != 0)))

    part(cases - 64)  # compiles
    runs = [np.sum([part(first) for first in range(0, cases, PART)], axis=0) for _ in range(repeats)]
    return Measured(*np.median(runs, axis=0))


def _name(engine: str) -> str:
    if engine != "jax":
        return {"native": "lanes", "threads": "one case per thread"}[engine]
    import jax

    return f"diffrax, {jax.devices()[0].device_kind}"


if __name__ == "__main__":
    main()
