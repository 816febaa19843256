"""Efremenkov et al., Mathematics 12 (2024) 873: the gear with rolling elements and a free cage."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.record.reader import open_record
from tribodyn.studies.load import load_scenario
from tribodyn.studies.run import run
from tribodyn.validation.rows import Row, compare, published

PAPER = "efremenkov-2024"
PUBLISHED, CORRECTED = "irefc-as-published", "irefc"

#: Runs by the names of their records: scenario and what is changed in it.
RUNS: dict[str, tuple[str, dict[str, str]]] = {
    "irefc-as-published": (PUBLISHED, {}),
    "irefc-r2-30": (PUBLISHED, {"drive.pitch_radius": "30 mm"}),
    "irefc-rb-1.2": (PUBLISHED, {"drive.element_radius": "1.2 mm"}),
    "irefc-rb-2.8": (PUBLISHED, {"drive.element_radius": "2.8 mm"}),
    "irefc-corrected": (CORRECTED, {}),
    "irefc-corrected-1-mm": (CORRECTED, {"friction.rolling_arm": "1 mm"}),
}


class Result(NamedTuple):
    """What the rows need of a record: figures, and datasets (time, element)."""

    summary: dict[str, Any]
    data: dict[str, np.ndarray]

    @property
    def loss(self) -> np.ndarray:
        """N_S of the elements at the start, W."""
        return (self.data["power_cam"] + self.data["power_crown"])[0]

    @property
    def slip_range(self) -> float:
        """Range of the slip speed over the elements, m/s."""
        return float(np.ptp(self.data["slip_speed"][0]))


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows of the paper, from runs whose records are left in `folder`."""
    results = {}
    for count, (name, (scenario, changes)) in enumerate(RUNS.items()):
        results[name] = _run(folder / f"{name}.h5", scenario, changes)
        if progress:
            progress((count + 1) / len(RUNS))
    values = _table(results["irefc-as-published"]) | _figures(results)
    table = published(PAPER)
    return [compare(table[key], *values[key]) for key in table]


def _run(path: Path, scenario: str, changes: dict[str, str]) -> Result:
    result = run(load_scenario(scenario, changes), path, force=True)
    if result.status != "complete":
        raise SimulationError(f"{path.stem}: {result.message}")
    with open_record(result.path) as record:
        return Result(record.summary, {name: record[name] for name in record})


def _table(result: Result) -> dict[str, tuple[Any, str]]:
    """Rows of Table 1: L_A, L_B, v_s in mm/s, N_S, R."""
    data = result.data
    columns = (
        data["cam_distance"][0],
        data["crown_distance"][0],
        data["slip_speed"][0] * 1e3,
        result.loss,
        data["normal_load"][0],
    )
    table = np.stack(columns, axis=-1)
    return {f"efremenkov/row-{number:02d}": (row.tolist(), "") for number, row in enumerate(table, start=1)}


def _figures(results: dict[str, Result]) -> dict[str, tuple[Any, str]]:
    base = results["irefc-as-published"]
    corrected, coarse = (results[name].summary for name in ("irefc-corrected", "irefc-corrected-1-mm"))
    ranges = [results[name].slip_range for name in ("irefc-rb-1.2", "irefc-rb-2.8")]
    prefix = "efremenkov/"
    return {
        f"{prefix}efficiency": (
            base.summary["efficiency"],
            f"the product (23); by energy {base.summary['efficiency_by_energy']:.4f}. With corrected speeds "
            f"{coarse['efficiency']:.3f} ({coarse['power_friction_mean']:.0f} W of "
            f"{coarse['power_in_mean']:.0f} W lost), and {corrected['efficiency']:.4f} with a rolling arm of "
            "0.01 mm",
        ),
        f"{prefix}ns-max-r2-20": (float(base.loss.max()), ""),
        f"{prefix}ns-max-r2-30": (float(results["irefc-r2-30"].loss.max()), ""),
        f"{prefix}ns-max-rb-1.2": (float(results["irefc-rb-1.2"].loss.max()), ""),
        f"{prefix}ns-max-rb-2.8": (float(results["irefc-rb-2.8"].loss.max()), ""),
        f"{prefix}vs-range": (
            base.slip_range,
            f"r_b 2 mm; {ranges[0] * 1e3:.4f} and {ranges[1] * 1e3:.4f} mm/s with 1.2 and 2.8 mm",
        ),
    }
