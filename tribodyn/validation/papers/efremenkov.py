"""Efremenkov et al., Mathematics 12 (2024) 873: the gear with rolling elements and a free cage.

Figures 4 to 8 are drawn in mode `as_published`.
"""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.validation.papers import run_all
from tribodyn.validation.published import published
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
    """What rows and figures need of a record: its summary, and datasets (time, element)."""

    summary: dict[str, Any]
    data: dict[str, np.ndarray]

    @property
    def loss(self) -> np.ndarray:
        """N_S of the elements at the start, W."""
        return (self.data["power_cam"] + self.data["power_crown"])[0]

    @property
    def slip(self) -> np.ndarray:
        """Slip speed of the elements at the start, mm/s."""
        return self.data["slip_speed"][0] * 1e3

    @property
    def slip_range(self) -> float:
        """Range of the slip speed over the elements, m/s."""
        return float(np.ptp(self.data["slip_speed"][0]))


def rows(folder: Path, progress: Callable[[float], None]) -> list[Row]:
    """All rows of the paper, from runs whose records are left in `folder`."""
    results = {name: _read(path) for name, path in run_all(RUNS, folder, progress)}
    values, otherwise = (
        _table(results[begin]) | _of_the_text({end: results.get(begin + end) for end in CHANGES})
        for begin in (PUBLISHED, CORRECTED)
    )
    corrected, coarse = (results[name].summary for name in ("irefc-corrected", CORRECTED))
    by_energy = results[PUBLISHED].summary["efficiency_by_energy"]
    ranges = [results[PUBLISHED + end].slip_range * 1e3 for end in ("-rb-1.2", "-rb-2.8")]
    notes = {
        "efremenkov/efficiency": f"the product (23); by energy {by_energy:.4f}. With corrected speeds "
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


def _read(path: Path) -> FinishedRun:
    with Record(path) as record:
        return FinishedRun(record.summary, {name: record[name] for name in record})


def _table(result: FinishedRun) -> dict[str, Any]:
    """Rows of Table 1: L_A, L_B, v_s in mm/s, N_S, R."""
    data = result.data
    columns = (
        data["cam_distance"][0],
        data["crown_distance"][0],
        result.slip,
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
    ends = results[f"{begin}-r2-30"].slip[[0, -1]]
    names = (begin + end for end in ("-rb-1.2", "-rb-1.6", "", "-rb-2.4", "-rb-2.8"))
    radii = [results[name] for name in names if name in results]
    slips = [float(np.max(result.slip)) for result in radii]
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


#: Records by the curve that they are: radius of the generating circle, and of the rolling elements, mm.
CIRCLES = {"$r_2$ = 20 mm": PUBLISHED, "$r_2$ = 30 mm": f"{PUBLISHED}-r2-30"}
RADII = {
    1.2: f"{PUBLISHED}-rb-1.2",
    1.6: f"{PUBLISHED}-rb-1.6",
    2.0: PUBLISHED,
    2.4: f"{PUBLISHED}-rb-2.4",
    2.8: f"{PUBLISHED}-rb-2.8",
}
ELEMENT = "Rolling element"


def slip_by_circle(records: Path) -> Figure:
    """Slip speed over the elements, a panel for each generating circle."""
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    panels = figure.subplots(1, 2)
    for letter, axes, (label, name) in zip("ab", panels, CIRCLES.items(), strict=True):
        slip = _read(records / f"{name}.h5").slip
        axes.plot(np.arange(1, slip.size + 1), slip, marker="o", markersize=3)
        axes.axhline(0.0, linewidth=0.6, color="k")
        axes.set(xlabel=ELEMENT, ylabel="$V_s$ (mm/s)")
        mark_panel(axes, letter, label)
    return figure


def over_elements(of: str, label: str, curves: dict[str, str], records: Path) -> Figure:
    """Draw a quantity of the elements over their numbers, a curve for each record."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 0.6)
    axes = figure.subplots()
    for color, (name, record) in zip(PALETTE, curves.items(), strict=False):
        values = getattr(_read(records / f"{record}.h5"), of)
        axes.plot(np.arange(1, values.size + 1), values, marker="o", markersize=3, color=color, label=name)
    axes.set(xlabel=ELEMENT, ylabel=label)
    axes.legend()
    return figure


def largest_loss(records: Path) -> Figure:
    """Maximum N_S over the radius of the rolling elements, with the two printed values."""
    figure = new_figure(0.7 * WIDTH, PANEL_HEIGHT + 0.3)
    axes = figure.subplots()
    axes.plot(
        list(RADII),
        [_read(records / f"{name}.h5").loss.max() for name in RADII.values()],
        marker="o",
        label="computed",
    )
    table, ends = published("efremenkov-2024"), (1.2, 2.8)
    values = [table[f"efremenkov/ns-max-rb-{radius}"]["published"] for radius in ends]
    axes.plot(ends, values, linestyle="none", marker="x", markersize=8, color=PALETTE[1], label="printed")
    axes.set(xlabel="$r_b$ (mm)", ylabel="Maximum $N_S$ (W)")
    axes.legend()
    return figure


_BY_RADIUS = {f"$r_b$ = {radius} mm": name for radius, name in RADII.items()}
_LOSS, _SLIP = "$N_S$ (W)", "$V_s$ (mm/s)"

FIGURES: dict[str, Callable[[Path], Figure]] = {
    "figure-4": slip_by_circle,
    "figure-5": partial(over_elements, "loss", _LOSS, CIRCLES),
    "figure-6": partial(over_elements, "slip", _SLIP, _BY_RADIUS),
    "figure-7": partial(over_elements, "loss", _LOSS, _BY_RADIUS),
    "figure-8": largest_loss,
}
