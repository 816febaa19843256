"""Figures of planetary sets: loads of the planets over time, orbits of the gears on the axis."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.cycles import last_cycles
from tribodyn.post.figures.panel import MOST_CYCLES_DRAWN, Trace, View, record_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.carried_sets import CarriedSet, sets_of
from tribodyn.studies.motion.pictures.curves import draw_curves

LOAD = Trace("normal_load", "Load of every planet", "$F_n$", "N", from_zero=True)
BEARING = Trace("bearing_force_x", "Force on bearings", "$F$", "N", from_zero=True)
MICROMETRE = 1e-6
#: Half of what is shown of a body that rests but for rounding, µm.
_SMALLEST = 1e-3
#: Share of the largest displacement below which a body rests.
_RESTS = 1e-6
_LETTERS = "abcdefghijklmnopqrstuvwxyz"


def planet_loads(record: Record, meshes: Sequence[int]) -> np.ndarray:
    """Normal load of all teeth of every one of some meshes, N (samples, meshes)."""
    return np.nansum(record["normal_load"][:, list(meshes)], axis=2)


def planet_load_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw of the first record the loads of all planets of every set, at sun and ring in a panel each."""
    record = records[0]
    panels = [
        _Panel(
            f"{_named(record, gearset, body)}: load of the teeth of every planet",
            planet_loads(record, meshes),
            [str(record["body"][planet]) for planet in gearset.met[body]],
            len(meshes),
        )
        for gearset in sets_of(record)
        for body, meshes in gearset.meshes.items()
    ]
    return _below_each_other(record, panels, LOAD, view)


def bearing_load_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw of the first record the forces on bearings and pins, those of a kind in one panel."""
    record = records[0]
    force = np.hypot(record["bearing_force_x"], record["bearing_force_y"])
    names = [str(name) for name in record["bearing"]]
    groups: dict[str, list[int]] = {}
    for place, name in enumerate(names):
        groups.setdefault("pins" if name.startswith("pin-") else "bearings", []).append(place)
    panels = [
        _Panel(f"Force on {kind}", force[:, places], [names[at].partition("-")[2] for at in places], 4)
        for kind, places in groups.items()
    ]
    return _below_each_other(record, panels, BEARING, view)


class _Panel(NamedTuple):
    """Curves of a panel."""

    title: str
    values: np.ndarray  # (samples, names)
    names: Sequence[str]
    columns: int  # of its legend


def _below_each_other(record: Record, panels: Sequence[_Panel], trace: Trace, view: View) -> Figure:
    figure = new_figure(WIDTH, (PANEL_HEIGHT + 0.15) * len(panels) + 0.6)
    rows = figure.subplots(len(panels), 1, squeeze=False, sharex=True)[:, 0]
    for letter, axes, panel in zip(_LETTERS, rows, panels, strict=False):
        draw_curves(axes, record, panel.values, panel.names, trace, view)
        mark_panel(axes, letter, panel.title)
        axes.legend(loc="upper right", ncols=panel.columns, fontsize=6.5)
    for axes in rows[:-1]:
        axes.set_xlabel("")
    figure.align_ylabels()
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


def has_orbits(record: Record) -> bool:
    """Whether a gear on the axis of a planetary set moves in the plane."""
    return bool(_orbits(record))


def _orbits(record: Record) -> list[tuple[CarriedSet, int]]:
    """Sets and bodies on their axes that move in the plane, by more than rounding if any does."""
    central = [
        (gearset, body)
        for gearset in sets_of(record)
        for body in gearset.meshes
        if np.any(np.isfinite(record["x"][:, body]))
    ]
    moved = [float(np.max(np.hypot(record["x"][:, body], record["y"][:, body]))) for _, body in central]
    return [one for one, far in zip(central, moved, strict=True) if far > _RESTS * max(moved)] or central


def orbit_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw of the first record the path of every gear on the axis of a set, from carrier and housing."""
    record = records[0]
    cycles = min(view.cycles or MOST_CYCLES_DRAWN, MOST_CYCLES_DRAWN)
    part, panels = last_cycles(record, cycles).part, _orbits(record)
    figure = new_figure(WIDTH, 2.9 * len(panels) + 0.4)
    rows = figure.subplots(len(panels), 2, squeeze=False)
    for number, (gearset, body) in enumerate(panels):
        place = np.stack([record["x"][part, body], record["y"][part, body]], axis=-1) / MICROMETRE
        turned = record.geometry["carried"][body] * record["reference_angle"][part]
        x, y = place.T
        cosine, sine = np.cos(turned), np.sin(turned)
        from_housing = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
        name = _named(record, gearset, body)
        for axes, path, seen in zip(rows[number], (place, from_housing), ("carrier", "housing"), strict=True):
            _draw_orbit(axes, path, PALETTE[number % len(PALETTE)])
            letter = _LETTERS[(2 * number + (seen == "housing")) % len(_LETTERS)]
            mark_panel(axes, letter, f"{name}, from the {seen}")
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


def _draw_orbit(axes: Axes, path: np.ndarray, color: str) -> None:
    """Draw a path (points, 2), µm, and where it begins; a square, with room for a point that rests."""
    axes.plot(*path.T, color=color, linewidth=1.0)
    axes.plot(*path[0], marker="o", markersize=3, color=color)
    low, high = np.min(path, axis=0), np.max(path, axis=0)
    half = max(0.55 * float(np.max(high - low)), _SMALLEST)
    x, y = (low + high) / 2.0
    axes.set_xlim(x - half, x + half)
    axes.set_ylim(y - half, y + half)
    axes.set_aspect("equal")
    axes.set_xlabel("x (µm)")
    axes.set_ylabel("y (µm)")


def _named(record: Record, gearset: CarriedSet, body: int) -> str:
    return literal(f"{gearset.name}, {record['body'][body]}")
