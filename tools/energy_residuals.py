"""Energy residuals of the CRC drive over bearings, sliding, speed and tolerance, as a Markdown table.

python -m tools.energy_residuals                          # prints the table
python -m tools.energy_residuals --into docs/solvers.md   # and puts it into the page
"""

import math
import sys
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

from tools.marked_block import generate, table
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

STIFFNESSES = (1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12)
SLIDINGS = ("kinematic", "dynamic")
SPEEDS = (1, 10, 100, 1000)
TOLERANCES = (1e-5, 1e-7)
CYCLES, SAMPLES = 4, 40
KEYS = [f"bearings.{gear}.stiffness_{axis}" for gear in ("pinion", "gear") for axis in "xy"]


def residual(stiffness: float, sliding: str, speed: float, rtol: float, folder: Path) -> str:
    """Energy residual of a run over its relative tolerance; a dash where the run stops."""
    overrides = {key: f"{stiffness:g} N/m" for key in KEYS} | {
        "friction.sliding": sliding,
        "operating.pinion_speed": f"{speed:g} rad/s",
        "solver.rtol": rtol,
        "solver.cycles": CYCLES,
        "output.samples_per_cycle": SAMPLES,
    }
    result = run(load_scenario("crc-23-47", overrides), folder / "run.h5", force=True)
    if result.status != "complete" or math.isnan(result.summary["energy_residual"]):
        return "–"
    return plain(f"{abs(result.summary['energy_residual']) / rtol:.1g}")


def plain(number: str) -> str:
    """Powers of ten without a sign of plus and leading zeros."""
    return number.replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def residuals(_: object) -> str:
    columns = list(product(SPEEDS, TOLERANCES))
    head = ["bearings, N/m", "sliding", *(plain(f"{speed} rad/s, {rtol:.0e}") for speed, rtol in columns)]
    rows = []
    with TemporaryDirectory() as scratch:
        for stiffness, sliding in product(STIFFNESSES, SLIDINGS):
            found = (residual(stiffness, sliding, speed, rtol, Path(scratch)) for speed, rtol in columns)
            rows.append([plain(f"{stiffness:.0e}"), sliding, *found])
            print(*rows[-1], file=sys.stderr, flush=True)
    return table(head, rows)


if __name__ == "__main__":
    generate(__doc__, energy_residuals=residuals)
