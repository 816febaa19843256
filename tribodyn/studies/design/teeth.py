"""The found teeth beside those of the start: outlines in mesh, and the reliefs of their flanks."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.compliance.sharing.flank_gap import lead_gap, profile_gap
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import geometry_arrays
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.modification import Modifications
from tribodyn.post.figures.gears_in_mesh import placed
from tribodyn.post.figures.panel import View
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, QUIET, WIDTH, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.design.candidates.evaluation import loaded_source
from tribodyn.studies.design.candidates.sources import BASE

#: Gaps below which flanks count as unmodified, m.
NO_RELIEF = 1e-12


class _Teeth(NamedTuple):
    """Gears of a candidate: outlines as a pair touches at the pitch point, path, material missing; m."""

    pinion: np.ndarray  # (points, 2)
    gear: np.ndarray
    path: np.ndarray
    roll: np.ndarray  # (n,), rad from the pitch point
    relief: np.ndarray  # (n,), of both flanks along the profile
    face: np.ndarray  # (k,), place on the face from its middle
    lead: np.ndarray  # (k,), of both flanks along the face


def has_teeth(record: Record) -> bool:
    """Whether a record has a best candidate that is a pair of gears, which this version can make."""
    if "best" not in record.summary:
        return False
    try:
        return bool(_candidates(record))
    except (InputError, KeyError):
        return False


def _candidates(record: Record) -> list[_Teeth]:
    """Teeth of the start and of the best; none where the study is not of gears."""
    search: Any = record.scenario
    parts = search["design"].get("part") or {}
    scenarios = {BASE: search["scenario"], **parts}
    loads = [loaded_source(scenarios, BASE, values) for values in ({}, record.summary["best"])]
    if not all(loaded.study.has_gears for loaded in loads):
        return []
    pairs = [loaded.case.pair for loaded in loads]
    return [_teeth(check(family(pair.family), pair.drive), pair) for pair in pairs]


def _teeth(assembly: Assembly, case: Any) -> _Teeth:
    shape = geometry_arrays(assembly)
    radii = shape["pinion_pitch_radius"], shape["gear_pitch_radius"]
    pinion, gear = placed(shape["pinion_outline"], shape["gear_outline"], radii, 0.0)
    roll = np.linspace(*assembly.roll_limits, 201)
    width = float(min(assembly.drive.pinion.face_width, assembly.drive.gear.face_width))
    face = np.linspace(-0.5 * width, 0.5 * width, 101)
    modifications = getattr(getattr(case, "mesh", None), "modifications", Modifications())
    relief = np.asarray(profile_gap(assembly, modifications, pair_geometry(assembly, roll)))
    lead = np.asarray(lead_gap(assembly, modifications, face))
    return _Teeth(pinion, gear, shape["path_of_contact"], roll, relief, face, lead)


#: What is taken off the flanks: values, places, factor to the unit of the places, their label, title.
_RELIEFS = (
    ("relief", "roll", 180.0 / np.pi, "Roll angle of the pinion from the pitch point (°)", "the profile"),
    ("lead", "face", 1e3, "Place on the face from its middle (mm)", "the face"),
)


def teeth_figure(records: Sequence[Record], _: View) -> Figure:
    """Draw outlines of start and best in mesh, and where the flanks are modified what is taken off them."""
    start, best = _candidates(records[0])
    reliefs = [
        relief
        for relief in _RELIEFS
        if any(np.ptp(getattr(teeth, relief[0])) > NO_RELIEF for teeth in (start, best))
    ]
    rows = 1 + bool(reliefs)
    figure = new_figure(WIDTH, (1.5 + 0.9 * bool(reliefs)) * PANEL_HEIGHT)
    grid = figure.add_gridspec(rows, max(1, len(reliefs)), height_ratios=[1.5, 0.9][:rows])
    _draw_outlines(figure.add_subplot(grid[0, :]), start, best)
    for column, (values, places, factor, label, along) in enumerate(reliefs):
        axes = figure.add_subplot(grid[1, column])
        for teeth, color, name in ((start, QUIET, "start"), (best, PALETTE[2], "best")):
            axes.plot(factor * getattr(teeth, places), 1e6 * getattr(teeth, values), color=color, label=name)
        axes.set(xlabel=label, ylabel="Relief of both flanks (µm)")
        axes.set_title(f"Relief along {along}", loc="left")
        axes.legend()
    return figure


def _draw_outlines(axes: Axes, start: _Teeth, best: _Teeth) -> None:
    across = 1e3 * max(0.9 * float(np.ptp(teeth.path[:, 0])) for teeth in (start, best))
    for color, name in ((PALETTE[0], "pinion"), (PALETTE[1], "gear")):
        axes.fill(*(1e3 * getattr(best, name)).T, facecolor=color, alpha=0.12, edgecolor="none")
        axes.plot(*(1e3 * getattr(best, name)).T, color=color, linewidth=1.2, label=f"{name}, best")
    for name in ("pinion", "gear"):
        label = "start" if name == "gear" else None
        axes.plot(*(1e3 * getattr(start, name)).T, color=QUIET, linewidth=1.0, linestyle="--", label=label)
    axes.set(xlim=(-across, across), ylim=(-0.55 * across, 0.55 * across))
    axes.set_aspect("equal")
    axes.set(xlabel="From the pitch point along the pitch tangent (mm)", ylabel="Along the centres (mm)")
    axes.set_title("Teeth as a pair touches at the pitch point", loc="left")
    axes.grid(False)
    axes.legend(loc="upper right")
