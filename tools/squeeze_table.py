"""How far the film with squeeze departs from the steady one over a pair's way, and how long both take.

python -m tools.squeeze_table            # writes the table into docs/ehl.md
"""

from dataclasses import replace
from time import process_time

import numpy as np

from tools.marked_block import DOCS, put, table
from tribodyn.studies.ehl.along_path import prepare, way
from tribodyn.studies.ehl.judgement import case_for
from tribodyn.studies.ehl.run import solve, squeeze_summary
from tribodyn.studies.protocol.load import load_scenario

SCENARIOS = ("crc-23-47", "involute-23-47", "involute-18-36", "cycloidal-23-47")
POSITIONS = 40
HEAD = (
    f"{POSITIONS} positions of",
    "central film: mean, maximum",
    "minimum film: mean, maximum",
    "mean friction",
    "not reached",
    "steady sweep",
    "with squeeze, more",
)


def row(scenario: str) -> list[str]:
    """A scenario's line of the table: departures in %, roll angles not reached, seconds of one core."""
    case = case_for(load_scenario(scenario), POSITIONS)
    seconds, arrays = [], {}
    for transient in (False, True):
        study = prepare(replace(case, transient=transient))
        begun = process_time()
        arrays = solve(study, way(study), lambda _share: None)
        seconds.append(process_time() - begun)
    found = squeeze_summary(arrays)
    central, minimum = (
        f"{100 * found[f'{name}_film_departure_mean']:.1f}, {100 * found[f'{name}_film_departure_max']:.0f} %"
        for name in ("central", "minimum")
    )
    missed = np.count_nonzero(np.isnan(arrays["transient_central_film_thickness"]))
    friction = f"{100 * found['friction_departure_mean']:+.1f} %"
    steady, both = seconds
    times = f"{steady:.1f} s", f"{both - steady:.1f} s"
    return [f"`{scenario}`", central, minimum, friction, str(missed), *times]


if __name__ == "__main__":
    put(DOCS / "ehl.md", "squeeze", table(HEAD, [row(scenario) for scenario in SCENARIOS]))
