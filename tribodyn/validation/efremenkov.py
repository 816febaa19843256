"""Efremenkov et al., Mathematics 12 (2024) 873: the gear with rolling elements and a free cage."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation.rows import Row, compare_paper

PAPER = "efremenkov-2024"

#: What is changed by the ends of the names of the records.
CHANGES = {
    "": {},
    "-r2-30": {"drive.pitch_radius": "30 mm"},
    "-rb-1.2": {"drive.element_radius": "1.2 mm"},
    "-rb-2.8": {"drive.element_radius": "2.8 mm"},
}
#: The choices under which all rows are computed, by the beginnings of these names.
PUBLISHED, CORRECTED = "irefc-as-published", "irefc-corrected-1-mm"
#: With corrected speeds and the published rolling arm this gear locks.
LOCKS = "-rb-1.2"
#: Runs by the names of their records: scenario and what is changed in it.
RUNS: dict[str, tuple[str, dict[str, str]]] = {
    **{PUBLISHED + end: ("irefc-as-published", changes) for end, changes in CHANGES.items()},
    **{
        CORRECTED + end: ("irefc", {"friction.rolling_arm": "1 mm", **changes})
        for end, changes in CHANGES.items()
        if end != LOCKS
    },
    "irefc-corrected": ("irefc", {}),
}


class FinishedRun(NamedTuple):
    """What the rows need of a record: its summary, and datasets (time, element)."""

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
    values, otherwise = (
        _table(results[begin]) | _of_the_text({end: results.get(begin + end) for end in CHANGES})
        for begin in (PUBLISHED, CORRECTED)
    )
    published_as = results[PUBLISHED].summary["efficiency_by_energy"]
    corrected, coarse = (results[name].summary for name in ("irefc-corrected", CORRECTED))
    ranges = [results[PUBLISHED + end].slip_range * 1e3 for end in ("-rb-1.2", "-rb-2.8")]
    notes = {
        "efremenkov/efficiency": f"the product (23); by energy {published_as:.4f}. With corrected speeds "
        f"{coarse['efficiency']:.3f} ({coarse['power_friction_mean']:.0f} W of "
        f"{coarse['power_in_mean']:.0f} W lost), and {corrected['efficiency']:.4f} with a rolling arm "
        "of 0.01 mm",
        "efremenkov/vs-range": f"r_b 2 mm; {ranges[0]:.4f} and {ranges[1]:.4f} mm/s with 1.2 and 2.8 mm",
    }
    locked = {key for key, value in otherwise.items() if value is None}
    beside = {
        "corrected speeds": {key: value for key, value in otherwise.items() if key not in locked},
        "corrected speeds, the gear locks": dict.fromkeys(locked),
    }
    return compare_paper(PAPER, {key: (value, notes.get(key, "")) for key, value in values.items()}, beside)


def _run(path: Path, scenario: str, changes: dict[str, str]) -> FinishedRun:
    result = run(load_scenario(scenario, changes), path, force=True)
    if result.status != "complete":
        raise SimulationError(f"{path.stem}: {result.message}")
    with Record(result.path) as record:
        return FinishedRun(record.summary, {name: record[name] for name in record})


def _table(result: FinishedRun) -> dict[str, Any]:
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
    return {f"efremenkov/row-{number:02d}": row.tolist() for number, row in enumerate(table, start=1)}


def _of_the_text(results: dict[str, FinishedRun | None]) -> dict[str, Any]:
    """Numbers of the text, from runs by `CHANGES`; None for a gear that locks."""
    found: dict[str, Any] = {
        f"efremenkov/ns-max{end or '-r2-20'}": None if result is None else float(result.loss.max())
        for end, result in results.items()
    }
    base = results[""]
    assert base is not None
    return found | {
        "efremenkov/efficiency": base.summary["efficiency"],
        "efremenkov/vs-range": base.slip_range,
    }
