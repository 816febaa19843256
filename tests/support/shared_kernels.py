"""Kernels that many tests call, compiled before these start.

In one process they take half the time of as many processes, since they consist of the same parts; and no test
waits for the kernel that another one compiles. Nothing is done where kernels of these sources are on disk.

    python -m tests.support.shared_kernels single      # of single runs
    python -m tests.support.shared_kernels lanes       # of sweeps
"""

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tribodyn.kernels.native import store
from tribodyn.numerics.files.cache import cache_folder

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
    from tribodyn.cli.app import app

    for law in ("default", "none"):
        given = [word for key, value in LAWS[law].items() for word in ("--set", f"{key}={value}")]
        words = ("--vary", "operating.pinion_speed=300:310:10rad/s", "-o", str(folder / f"{law}.h5"))
        app(["sweep", "crc-23-47", *given, *words], standalone_mode=False)


#: What makes kernels, and the module of one that only it needs.
MAKERS: dict[str, tuple[Callable[[Path], None], str]] = {
    "single": (single, "tribodyn.solve.methods.switching"),
    "lanes": (lanes, "tribodyn.solve.lanes.march"),
}

if __name__ == "__main__":
    make, module = MAKERS[sys.argv[1]]
    if not (cache_folder() / f"kernels-{store._digest(module)}").exists():
        with tempfile.TemporaryDirectory() as temporary:
            make(Path(temporary))
