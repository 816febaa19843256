"""Energy residuals of the CRC drive over bearings, sliding, speed and tolerance, as a Markdown table.

python tools/energy_residuals.py                          # prints the table
python tools/energy_residuals.py --into docs/solvers.md   # and puts it into the page
"""

import argparse
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

from marked_block import put

from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

STIFFNESSES = (1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12)
SLIDINGS = ("kinematic", "dynamic")
SPEEDS = (1, 10, 100, 1000)
TOLERANCES = (1e-5, 1e-7)
CYCLES, SAMPLES = 4, 40
KEYS = [f"bearings.{gear}.stiffness_{axis}" for gear in ("pinion", "gear") for axis in "xy"]


def residual(stiffness: float, sliding: str, speed: float, rtol: float, folder: Path) -> float:
    """Energy residual of a run over its relative tolerance; NaN where the run stops."""
    overrides = {key: f"{stiffness:g} N/m" for key in KEYS} | {
        "friction.sliding": sliding,
        "operating.pinion_speed": f"{speed:g} rad/s",
        "solver.rtol": rtol,
        "solver.cycles": CYCLES,
        "output.samples_per_cycle": SAMPLES,
    }
    result = run(load_scenario("crc-23-47", overrides), folder / "one.h5", force=True)
    if result.status != "complete":
        return float("nan")
    return abs(result.summary["energy_residual"]) / rtol


def lines() -> list[str]:
    columns = list(product(SPEEDS, TOLERANCES))
    heads = (f"{speed} rad/s, {rtol:.0e}".replace("e-0", "e-") for speed, rtol in columns)
    table = [f"| bearings, N/m | sliding | {' | '.join(heads)} |", f"|---|---|{'---|' * len(columns)}"]
    with TemporaryDirectory() as scratch:
        for stiffness, sliding in product(STIFFNESSES, SLIDINGS):
            found = (residual(stiffness, sliding, speed, rtol, Path(scratch)) for speed, rtol in columns)
            cells = ("–" if one != one else f"{one:.1g}" for one in found)
            table.append(
                f"| {stiffness:.0e} | {sliding} | {' | '.join(cells)} |".replace("e+0", "e").replace(
                    "e+", "e"
                )
            )
            print(table[-1], flush=True)
    return table


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--into", type=Path, help="Markdown page with the marked block energy-residuals")
    page: Path | None = parser.parse_args().into
    table = "\n".join(lines())
    if page is not None:
        put(page, "energy-residuals", table)


if __name__ == "__main__":
    main()
