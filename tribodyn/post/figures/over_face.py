"""Figures of helical pairs: the line load over a flank."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure

from tribodyn.numerics.shapes import Array, Float
from tribodyn.post import style
from tribodyn.post.cycles import limits_of, mesh_phases
from tribodyn.post.figures.drawing import drawing
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.record.reader import Record

#: Places of the map along the path of contact, and across the face.
_PLACES = 241


class FlankMap(NamedTuple):
    """A quantity over a flank of the pair that the last mesh cycle shows, from its entry to its exit."""

    #: (place,); roll angle of the pinion at which the transverse section touches there, 0 at P, rad
    roll: Float[Array, " place"]
    face: Float[Array, " slice"]  # (slice,); middles of the slices, m from the middle of the face
    values: Float[Array, "slice place"]  # (slice, place)


def helical(record: Record) -> bool:
    """Whether a record has the loads of helical pairs in slices."""
    return "line_load" in record and "pair" in record and record.axis == "time"


def helical_meshes(record: Record) -> list[int]:
    """Numbers of the meshes whose pairs are in slices."""
    return [m for m in range(len(record.meshes)) if "face_position" in table_of(record, m)]


def flank_map(record: Record, mesh: int = 0) -> FlankMap:
    """Line load (N/m) over a flank; its parts are of the pairs that follow each other in the last cycle.

    Over the roll angle of each section of its own, by which the lines of contact are inclined.
    """
    table = table_of(record, mesh)
    cycles = mesh_phases(record)[:, mesh]
    end = max(np.floor(cycles[-1]), 1.0)
    last = (cycles >= end - 1.0) & (cycles < end)
    phase = cycles[last] % 1.0
    load = record.over_meshes("line_load")[last, mesh][..., : len(table["face_position"])]
    fronts = [
        slot for slot, pair in enumerate(record.pairs) if pair <= 1 and np.any(np.isfinite(load[:, slot]))
    ]
    pitch = 2.0 * np.pi / table["pinion_teeth"]
    turned = np.concatenate([phase + age for age in range(len(fronts))])
    loads = np.concatenate([load[:, slot] for slot in fronts[::-1]])
    face = np.asarray(table["face_position"])
    limits = limits_of(table)
    assert limits is not None, "of slices"
    roll = np.linspace(*limits, _PLACES)
    late = face * table["pitch_slope"] / table["pinion_pitch_radius"]
    at = table["roll_start"] + pitch * turned
    values = [np.interp(roll, at - shift, column) for shift, column in zip(late, loads.T, strict=True)]
    return FlankMap(roll, face, np.stack(values))


def table_of(record: Record, mesh: int) -> dict[str, Any]:
    """The mesh cycle of a mesh."""
    return record.of_mesh(record.meshes[mesh], "mesh_cycle")


def line_load_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw the line load of a pair of every mesh over roll angle and face, with its lines of contact."""
    shown = [(record, mesh) for record in records for mesh in helical_meshes(record)]
    maps = [flank_map(*one) for one in shown]
    top = 1e-3 * max(float(np.max(flank.values)) for flank in maps)
    figure = style.new_figure(style.WIDTH, (style.PANEL_HEIGHT + 0.4) * len(maps) + 0.4)
    rows = figure.subplots(len(maps), 1, squeeze=False)[:, 0]
    for letter, axes, (record, mesh), flank in zip("abcdefghij", rows, shown, maps, strict=False):
        image = _draw_map(axes, table_of(record, mesh), flank, top)
        bar = figure.colorbar(image, ax=axes, label="Line load (N/mm)", pad=0.02)
        bar.outline.set_visible(False)
        parts = [record_label(record)] if len(records) > 1 else []
        parts += [style.literal(record.meshes[mesh])] if record.names_meshes else []
        title = ", ".join(parts) or "Line load of one pair from entry to exit"
        style.mark_panel(axes, letter if len(shown) > 1 else "", title)
    head = record_title(records[0]) if len(records) == 1 else "Line load of one pair from entry to exit."
    figure.suptitle(
        f"{head}\nWhite: lines of contact, a fifth of a mesh cycle apart; dotted: as a pair enters. "
        "Cross: maximum.",
        x=0.01,
        ha="left",
        fontsize=9,
    )
    return figure


def _draw_map(axes: Axes, table: Mapping[str, Any], flank: FlankMap, top: float) -> QuadMesh:
    edge = 1e3 * float(table["face_width"]) / 2.0
    roll, face, values = np.degrees(flank.roll), 1e3 * flank.face, 1e-3 * flank.values
    across = np.linspace(-edge, edge, _PLACES)
    image = axes.pcolormesh(
        roll,
        across,
        np.stack([np.interp(across, face, column) for column in values.T], axis=1),
        vmin=0.0,
        vmax=top,
        cmap="viridis",
        shading="gouraud",
        rasterized=True,
    )
    slope = np.degrees(table["pitch_slope"] / table["pinion_pitch_radius"]) * 1e-3
    pitch = 360.0 / table["pinion_teeth"]
    begin, end = np.degrees(table["roll_start"]), np.degrees(table["roll_end"])
    for number in range(5 * int(np.ceil((end - begin) / pitch)) + 1):
        middle, whole = begin + number * pitch / 5.0, number % 5 == 0
        axes.plot(
            middle - slope * np.array([-edge, edge]),
            [-edge, edge],
            color="white",
            linewidth=1.1 if whole else 0.5,
            linestyle=":" if whole else "-",
            alpha=0.8,
        )
    at = np.unravel_index(np.argmax(values), values.shape)
    for color, width in (("white", 2.4), (style.INK, 1.0)):
        axes.plot(roll[at[1]], face[at[0]], "x", color=color, markersize=6, markeredgewidth=width)
    axes.set_xlim(roll[0], roll[-1])
    axes.set_ylim(-edge, edge)
    axes.grid(visible=False)
    axes.set_xlabel("Roll angle of the section from the pitch point (°)")
    axes.set_ylabel("Place on the face (mm)")
    return image


#: What is said of a record of spur gears.
MISSING = "{path} is of spur gears", "run a scenario with drive.helix_angle"
LINE_LOAD = drawing(
    "line load of a helical pair over roll angle and face, with its lines of contact",
    line_load_figure,
    helical,
    ("line-load", *MISSING),
    samples=2,
    timeless="the line load over the face",
)
