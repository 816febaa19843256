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
COLUMNS = "irefc-columns"
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
    **{
        f"{PUBLISHED}-rb-{radius}": ("irefc-as-published", {"drive.element_radius": f"{radius} mm"})
        for radius in ("1.6", "2.4")
    },
    # the gear that the table's columns of cam and crown belong to
    COLUMNS: ("irefc-as-published", {"drive.element_radius": "2.8 mm", "friction.rolling_arm": "1e-6 m"}),
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
    alternatives = {
        "corrected speeds": {key: value for key, value in otherwise.items() if key not in locked},
        "corrected speeds, the gear locks": dict.fromkeys(locked),
        "r_b 2.8 mm, rolling arm 1e-6 m": _columns(results[COLUMNS]),
    }
    values |= _columns(results[PUBLISHED])
    claims, other = (_claims(results, begin) for begin in (PUBLISHED, CORRECTED))
    values |= {key: value for key, (value, _) in claims.items()}
    notes |= {key: note for key, (_, note) in claims.items()}
    alternatives["corrected speeds"] |= {key: value for key, (value, _) in other.items()}
    return compare_paper(
        PAPER, {key: (value, notes.get(key, "")) for key, value in values.items()}, alternatives
    )


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
    values: dict[str, Any] = {
        f"efremenkov/ns-max{end or '-r2-20'}": None if result is None else float(result.loss.max())
        for end, result in results.items()
    }
    base, larger, smallest, largest = (results[end] for end in ("", "-r2-30", "-rb-1.2", "-rb-2.8"))
    assert base is not None
    assert larger is not None
    assert largest is not None
    falls = smallest and float(smallest.loss.max() - largest.loss.max())
    return values | {
        "efremenkov/ns-max-change-rb": falls,
        "efremenkov/ns-max-change-r2": float(base.loss.max() - larger.loss.max()),
        "efremenkov/efficiency": base.summary["efficiency"],
        "efremenkov/vs-range": base.slip_range,
    }


def _columns(result: FinishedRun) -> dict[str, Any]:
    """Columns N_SA and N_SB of Table 1, W, as amounts, and their values in element 8 that the text has."""
    cam, crown = (np.abs(result.data[f"power_{side}"][0]) for side in ("cam", "crown"))
    return {
        "efremenkov/column-cam": cam.tolist(),
        "efremenkov/column-crown": crown.tolist(),
        "efremenkov/power-cam": float(cam[7]),
        "efremenkov/power-crown": float(crown[7]),
    }


def _claims(results: dict[str, FinishedRun], begin: str) -> dict[str, tuple[bool, str]]:
    """Claims about slip and loss, from the radii that there are runs of."""
    ends = 1e3 * results[f"{begin}-r2-30"].data["slip_speed"][0][[0, -1]]
    names = (begin + end for end in ("-rb-1.2", "-rb-1.6", "", "-rb-2.4", "-rb-2.8"))
    radii = [results[name] for name in names if name in results]
    slips = [1e3 * float(np.max(result.data["slip_speed"][0])) for result in radii]
    losses = [float(result.loss.max()) for result in radii]
    prefix = "efremenkov/claim-"
    return {
        f"{prefix}slip-changes-its-sign": (
            bool(ends[0] < 0.0 < ends[1]),
            f"{ends[0]:.2f} to {ends[1]:+.3f} mm/s",
        ),
        f"{prefix}slip-shifts-to-the-negative": (
            bool(np.all(np.diff(slips) < 0.0)),
            f"largest v_s {', '.join(f'{slip:+.2f}' for slip in slips)} mm/s",
        ),
        f"{prefix}loss-falls-with-the-radius": (
            bool(np.all(np.diff(losses) < 0.0)),
            f"{', '.join(f'{loss:.2f}' for loss in losses)} W",
        ),
    }
