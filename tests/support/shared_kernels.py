"""Kernels that many tests call, compiled before these start.

In one process they take half the time of as many processes, since they consist of the same parts; and no test
waits for the kernel that another one compiles. Nothing is done where it was done with these sources.

    python -m tests.support.shared_kernels single      # of single runs
    python -m tests.support.shared_kernels lanes       # of sweeps
    python -m tests.support.shared_kernels trains      # of both of trains, which all but plain pairs have
"""

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tribodyn.kernels.native import store
from tribodyn.numerics.files.cache import keep, read_kept

SHORT: dict[str, Any] = {"solver.cycles": 1, "output.samples_per_cycle": 16}
LAWS: dict[str, dict[str, Any]] = {
    "default": {},
    "none": {"friction.law": "none"},  # the code of any constant coefficient and film by a formula
}


def single(folder: Path) -> None:
    """Run with the explicit and the switching method under two laws, and with the stiff one."""
    from tribodyn.studies.protocol.load import load_scenario
    from tribodyn.studies.protocol.run import run

    pairs = [("dopri5", "default"), ("rodas4", "default"), ("switching", "default")]
    pairs += [("dopri5", "none"), ("switching", "none")]
    for method, law in pairs:
        case = load_scenario("crc-23-47", {**SHORT, "solver.method": method, **LAWS[law]})
        run(case, folder / f"{method}-{law}.h5")


def lanes(folder: Path) -> None:
    """Sweep to steady states under two laws."""
    for law in ("default", "none"):
        _sweep("crc-23-47", "operating.pinion_speed", law, folder)


def trains(folder: Path) -> None:
    """Run and sweep a train under a law of a constant coefficient, by the explicit and the stiff method."""
    from tribodyn.studies.protocol.load import load_scenario
    from tribodyn.studies.protocol.run import run

    for method in ("dopri5", "rodas4"):
        case = load_scenario("two-stage-reducer", {**SHORT, "solver.method": method, **LAWS["none"]})
        run(case, folder / f"train-{method}.h5")
    _sweep("two-stage-reducer", "operating.input_speed", "none", folder)


def _sweep(scenario: str, key: str, law: str, folder: Path) -> None:
    from tribodyn.cli.app import app

    given = [word for name, value in LAWS[law].items() for word in ("--set", f"{name}={value}")]
    words = ("--vary", f"{key}=300:310:10rad/s", "-o", str(folder / f"{scenario}-{law}.h5"))
    app(["sweep", scenario, *given, *words], standalone_mode=False)


#: What makes kernels.
MAKERS: dict[str, Callable[[Path], None]] = {"single": single, "lanes": lanes, "trains": trains}
#: Folder of the cache that says what was made.
FOLDER = "passed"
#: Modules whose sources say whether kernels are those that were made.
MODULES = ("tribodyn.solve.methods.switching", "tribodyn.solve.lanes.march")

if __name__ == "__main__":
    what, now = sys.argv[1], "".join(map(store._digest, MODULES)).encode()
    if read_kept(FOLDER, f"kernels-{what}") != now:
        with tempfile.TemporaryDirectory() as temporary:
            MAKERS[what](Path(temporary))
        keep(FOLDER, f"kernels-{what}", now)
