"""Papers: a module of rows and one of figures each, and the study behind both."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from tribodyn.errors import SimulationError
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run


def run_all(
    runs: Mapping[str, tuple[str, Mapping[str, Any]]], folder: Path, progress: Callable[[float], None]
) -> Iterator[tuple[str, Path]]:
    """Run scenarios with changes, by the names of their records in a folder; yields name and record.

    Raises SimulationError if one of them does not end.
    """
    for count, (name, (scenario, changes)) in enumerate(runs.items(), start=1):
        result = run(load_scenario(scenario, changes), folder / f"{name}.h5", force=True)
        if result.status != "complete":
            raise SimulationError(f"{name}: {result.message}")
        yield name, result.path
        progress(count / len(runs))
