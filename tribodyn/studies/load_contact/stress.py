"""Von Mises stress of loaded teeth as pictures: a section with its finite elements, the flank, the tooth."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation

from tribodyn.compliance.sharing.loaded_contact import at_pitch_point
from tribodyn.compliance.sharing.tooth_field import ToothField, tooth_field
from tribodyn.geometry.drive import SIDES, Side
from tribodyn.post.figures.panel import record_label, record_title
from tribodyn.post.style import INK, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.load_contact.run import prepare
from tribodyn.studies.load_contact.scenario import LoadContactCase
from tribodyn.studies.protocol.load import load_data

COLOURS = colormaps["turbo"]
LABEL = "von Mises stress (MPa)"
MM, MPA = 1e3, 1e-6
#: Levels of the contours.
_LEVELS = 21


def field_of(record: Record, side: Side) -> ToothField:
    """Stress of the pair that is nearest to the pitch point, on one gear, from a record's loads."""
    case = load_data(record.scenario, record.label).case
    assert isinstance(case, LoadContactCase)
    roll = record["roll_angle"]
    position, pair = at_pitch_point(roll)
    flanks = prepare(case).flanks
    return tooth_field(flanks, side, roll[position], record["line_load"][position], pair)


def known(record: Record) -> bool:
    """Whether the teeth of a record are external spur teeth, of which the stress is known."""
    mesh = record.mesh_cycle
    external = min(mesh["pinion_pitch_radius"], mesh["gear_pitch_radius"]) > 0.0
    return external and float(mesh.get("pitch_slope", 0.0)) == 0.0


def stress_figure(records: Sequence[Record]) -> Figure:
    """Draw pinion and gear of every record: (a) section where the load is highest, (b) the loaded side."""
    rows = [(record, side, field_of(record, side)) for record in records for side in SIDES]
    figure = new_figure(WIDTH, len(rows) * (PANEL_HEIGHT + 0.4) + 0.3)
    panels = figure.subplots(len(rows), 2, squeeze=False)
    scale = scale_of([field for *_, field in rows])
    for number, ((section, flank), (record, side, field)) in enumerate(zip(panels, rows, strict=True)):
        part = int(np.argmax(np.max(field.von_mises[0, field.profile], axis=0)))
        draw_section(section, field, part, scale)
        draw_flank(flank, field, scale)
        at = MM * float(field.slice_position[part])
        named = f"{record_label(record)}, {side}" if len(records) > 1 else side
        for axes, letter, what in (
            (section, "a", f"{named}, at {at:+.1f} mm"),
            (flank, "b", f"{named}, loaded side"),
        ):
            mark_panel(axes, letter if number == 0 else "", what)
    add_bar(figure, scale, panels.ravel().tolist())
    if len(records) == 1:
        figure.suptitle(f"{record_title(records[0])}: pair at the pitch point", x=0.01, ha="left", fontsize=9)
    return figure


def scale_of(fields: Sequence[ToothField]) -> Normalize:
    """One scale of colours for all, MPa: up to the highest stress beyond the depth of the contact's own."""
    highest = 0.0
    for field in fields:
        away = np.linalg.norm(field.place - field.place[:, [field.loaded]], axis=0) > field.depth
        highest = max(highest, float(np.max(field.von_mises[:, away])))
    return Normalize(0.0, MPA * highest)


def add_bar(figure: Figure, scale: Normalize, panels: Sequence[Axes]) -> None:
    """Add the bar of a scale."""
    figure.colorbar(ScalarMappable(scale, COLOURS), ax=list(panels), label=LABEL, shrink=0.8, extend="max")


def draw_section(axes: Axes, field: ToothField, part: int, scale: Normalize) -> None:
    """Draw the finite elements and the contours of a slice of both halves, mm."""
    triangles = np.concatenate([field.cells[[0, 1, 2]], field.cells[[0, 2, 3]]], axis=1).T
    edges = np.concatenate([field.cells, field.cells[:1], np.full((1, field.cells.shape[1]), -1)])
    levels = np.linspace(scale.vmin or 0.0, scale.vmax or 1.0, _LEVELS)
    up, across = MM * field.place
    for half, sense in enumerate((1.0, -1.0)):
        values = MPA * field.von_mises[half, :, part]
        mesh = Triangulation(sense * across, up, triangles)
        axes.tricontourf(mesh, values, levels=levels, cmap=COLOURS, norm=scale, extend="max")
        lines = [np.where(edges < 0, np.nan, part_of[edges]).T.ravel() for part_of in (sense * across, up)]
        axes.plot(*lines, color=INK, linewidth=0.25, alpha=0.6)
    axes.plot(across[field.loaded], up[field.loaded], marker=9, color=INK, markersize=5)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("Across the tooth (mm)")
    axes.set_ylabel("From the gear's axis (mm)")


def draw_flank(axes: Axes, field: ToothField, scale: Normalize) -> None:
    """Draw the loaded side of the profile, unrolled, over the face, mm."""
    place = field.place[:, field.profile]
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(place, axis=1)))])
    values = MPA * field.von_mises[0, field.profile]
    face = field.slice_position
    if face.size == 1:  # the same all along
        half = 0.5e-3
        face, values = np.array([-half, half]), np.repeat(values, 2, axis=1)
    levels = np.linspace(scale.vmin or 0.0, scale.vmax or 1.0, _LEVELS)
    axes.contourf(MM * face, MM * along, values, levels=levels, cmap=COLOURS, norm=scale, extend="max")
    axes.axhline(MM * along[int(np.flatnonzero(field.profile == field.loaded)[0])], color=INK, linewidth=0.6)
    axes.grid(False)
    axes.set_xlabel("From the middle of the face (mm)")
    axes.set_ylabel("Along the profile (mm)")


def draw_tooth(axes: Any, field: ToothField, scale: Normalize) -> None:
    """Draw the surface of the tooth in space, the loaded flank in front, mm."""
    up, across = MM * field.place[:, field.profile]
    loaded, other = (MPA * field.von_mises[half, field.profile] for half in (0, 1))
    # from the loaded side over the tip to the other one
    outline = np.concatenate([across, -across[-2::-1]]), np.concatenate([up, up[-2::-1]])
    values = np.concatenate([loaded, other[-2::-1]])
    values = (values[1:, 1:] + values[:-1, 1:] + values[1:, :-1] + values[:-1, :-1]) / 4.0
    face = np.broadcast_to(MM * field.slice_position, (outline[0].size, field.slice_position.size))
    x, z = (np.broadcast_to(part[:, None], face.shape) for part in outline)
    surface = axes.plot_surface(
        face, x, z, rstride=1, cstride=1, facecolors=COLOURS(scale(values)), linewidth=0.0, shade=False
    )
    surface.set_clip_on(False)  # zoomed beyond its axes
    axes.set_box_aspect((np.ptp(face), np.ptp(x), np.ptp(z)), zoom=1.45)
    axes.view_init(elev=28, azim=68)
    axes.set_xlabel("Along the face (mm)", labelpad=16)
    axes.set_yticks([])
    axes.set_zticks([])
