"""Figures of gears in motion: of a pair over its mesh cycles; of a train in its true positions, by mesh."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post import style
from tribodyn.post.cycles import last_cycles
from tribodyn.post.figures import over_face, over_mesh, sensor_averages, spectrum
from tribodyn.post.figures.drawing import Drawing, drawing
from tribodyn.post.figures.panel import (
    ORDER,
    Trace,
    View,
    record_label,
    record_title,
)
from tribodyn.post.figures.path_of_contact import path_figure
from tribodyn.record.reader import MeshView, Record
from tribodyn.studies.motion.batch.sweep_figures import SWEEP_DRAWINGS as SWEEP_DRAWINGS
from tribodyn.studies.motion.drivetrain.carried_sets import (
    body_labels,
    mesh_labels,
    sets_of,
)
from tribodyn.studies.motion.pictures.curves import draw_curves
from tribodyn.studies.motion.pictures.modes_figure import modes_figure
from tribodyn.studies.motion.pictures.planet_figures import (
    bearing_load_figure,
    has_orbits,
    orbit_figure,
    planet_load_figure,
)
from tribodyn.studies.motion.pictures.ring_figure import has_waves, ring_figure
from tribodyn.studies.motion.pictures.shafts_figure import has_shafts, shafts_figure
from tribodyn.studies.motion.pictures.train_picture import draw_train, train_figure

MESH_FORCE = Trace("driven_torque", "Force of each mesh along its pitch tangent", "$F_t$", "N")
FILM = over_mesh.FILM_THICKNESS._replace(title="Minimum film thickness of each mesh", from_zero=True)
LOSS = Trace("mesh_power_friction", "Loss to friction in each mesh", "$P_f$", "W", from_zero=True)
ERROR = over_mesh.TRANSMISSION_ERROR._replace(
    title="Transmission error of each mesh", symbol="$r_1θ_1 - r_2θ_2$"
)
DISPLACEMENT = Trace("x", "Displacement of each body in its bearing", r"$\sqrt{x^2 + y^2}$", "µm")
EFFICIENCY = over_mesh.EFFICIENCY._replace(title="Efficiency of the train at each moment")

#: Height of one of so many panels, inch.
_LOW, _FEW = 1.8, 3


def mesh_forces(record: Record) -> np.ndarray:
    """Force of every mesh on its driven gear along the pitch tangent, N (samples, meshes)."""
    radii = [abs(record.of_mesh(mesh, "geometry")["gear_pitch_radius"]) for mesh in record.meshes]
    return record.over_meshes("driven_torque") / np.array(radii)


def losses(record: Record) -> np.ndarray:
    """Power of friction in every mesh, W (samples, meshes)."""
    return record.over_meshes("mesh_power_friction" if record.names_meshes else "power_friction")


def thinnest_films(record: Record) -> np.ndarray:
    """Smallest film of the pairs under load in every mesh, m (samples, meshes); NaN without any."""
    films = np.where(record["normal_load"] > 0.0, record["central_film_thickness"], np.nan)
    return np.fmin.reduce(films, axis=2)


def displacements(record: Record) -> np.ndarray:
    """Displacement of every body in its bearing, of planets from their carriers' pins, m (samples, bodies).

    NaN of those that only turn.
    """
    at = record.over_bodies("x"), record.over_bodies("y")
    x, y = at[0].copy(), at[1].copy()
    places = record.geometry
    for gearset in sets_of(record):
        ahead = places["sense"][gearset.carrier] * record["angle"][:, gearset.carrier]
        ahead = ahead - places["carried"][gearset.carrier] * record["reference_angle"]
        for planet in gearset.planets:
            right, up = places["centre"][planet] - places["centre"][gearset.carrier]
            x[:, planet] += ahead * up - at[0][:, gearset.carrier]
            y[:, planet] -= ahead * right + at[1][:, gearset.carrier]
    return np.hypot(x, y)


def overview_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw what the first record holds: the pairs of its only mesh, or the train and each of its meshes."""
    record = records[0]
    if len(record.meshes) == 1:
        return over_mesh.overview_figure(records, view)
    meshes, bodies = mesh_labels(record), body_labels(record)
    figure = style.new_figure(11.0, 6.6)
    rows = figure.subplots(2, 3)
    draw_train(rows[0, 0], record, last_cycles(record, view.cycles).part.start)
    style.mark_panel(rows[0, 0], "a", "Train, drawn to scale")
    moved = displacements(record)
    held = bool(np.any(np.isfinite(moved)))
    curves = (
        (MESH_FORCE, mesh_forces(record), meshes),
        (ERROR, record["transmission_error_rotational"], meshes),
        (FILM, thinnest_films(record), meshes),
        (LOSS, losses(record), meshes),
        (DISPLACEMENT, moved, bodies) if held else (EFFICIENCY, record["efficiency"][:, None], ["train"]),
    )
    for letter, axes, (trace, values, names) in zip("bcdef", rows.flat[1:], curves, strict=True):
        draw_curves(axes, record, values, names, trace, view)
        style.mark_panel(axes, letter, trace.title)
    for axes in rows[1, 1:]:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=6.5)
    rows[1, 1].get_legend().set_title("Meshes, in b to e", {"size": 6.5})
    rows[1, 2].get_legend().set_title("Bodies" if held else "", {"size": 6.5})
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=11)
    return figure


def _all_meshes(trace: Trace, of: Any, over: str, records: Sequence[Record], view: View) -> Figure:
    """Draw a curve of every mesh or body, or of the train, each record in a panel of its own."""
    figure, rows = _rows(len(records), records)
    for letter, axes, record in zip(_letters(records), rows, records, strict=True):
        names = [over] if over == "train" else list(record[over] if over == "body" else record.meshes)
        if len(names) > len(style.PALETTE):
            names = mesh_labels(record) if over == "mesh" else body_labels(record)
        draw_curves(axes, record, of(record), names, trace, view)
        head = f"{record_label(record)}: " if len(records) > 1 else ""
        style.mark_panel(axes, letter, f"{head}{_lower(trace.title) if head else trace.title}")
    _finish(figure, rows, records)
    return figure


def paths_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the gears in every mesh of records, of those that differ by their planet alone the first."""
    meshes = []
    for record in records:
        labels = mesh_labels(record)
        firsts = [m for m, label in enumerate(labels) if labels.index(label) == m]
        meshes += [MeshView(record, m, labels[m]) for m in firsts] if record.names_meshes else [record]
    return path_figure(meshes, view)


#: rad to µrad.
MICRO = 1e6
AXIAL_FORCE = Trace("axial_force", "Axial force of each mesh on its driver", "$F_a$", "N")
AXIAL = Trace("z", "Displacement of each body along its axis", "$z$", "µm")
TILT_X = Trace("tilt_x", "Tilt of each body about x", "tilt", "µrad")
TILT_Y = TILT_X._replace(dataset="tilt_y", title="Tilt of each body about y")


def in_space_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw axial forces of the meshes of every record, and motions of bodies along and about their axes."""
    traces = AXIAL_FORCE, AXIAL, TILT_X, TILT_Y
    shown = [(record, trace) for record in records for trace in traces]
    figure, rows = _rows(len(shown), records)
    for letter, axes, (record, trace) in zip(_letters(shown), rows, shown, strict=True):
        of_meshes = trace is AXIAL_FORCE
        names = mesh_labels(record) if of_meshes else body_labels(record)
        values = record.over_meshes(trace.dataset) if of_meshes else record.over_bodies(trace.dataset)
        draw_curves(axes, record, values * (MICRO if trace.unit == "µrad" else 1.0), names, trace, view)
        head = f"{record_label(record)}: " if len(records) > 1 else ""
        style.mark_panel(axes, letter, f"{head}{_lower(trace.title) if head else trace.title}")
        if trace in (AXIAL_FORCE, AXIAL):
            axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7)
        axes.set_xlabel("" if axes is not rows[-1] else axes.get_xlabel())
    figure.align_ylabels()
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure


def _rows(count: int, records: Sequence[Record]) -> tuple[Any, list[Axes]]:
    height = style.PANEL_HEIGHT if count <= _FEW else _LOW
    figure = style.new_figure(style.WIDTH, (height + 0.15) * count + 0.6)
    return figure, list(figure.subplots(count, 1, squeeze=False, sharex=len(records) == 1)[:, 0])


def _letters(of: Sequence[Any]) -> list[str]:
    return [chr(ord("a") + number) if 1 < len(of) <= 26 else "" for number in range(len(of))]


def _finish(figure: Any, rows: list[Axes], records: Sequence[Record]) -> None:
    figure.align_ylabels()
    for axes in rows[:-1]:
        axes.set_xlabel("")
    _legend(figure, rows)
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)


def _legend(figure: Any, rows: Sequence[Axes]) -> None:
    entries: dict[str, Any] = {}
    for axes in rows:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(f"{label}{ORDER.get(label, '')}", handle)
    if entries:
        figure.legend(list(entries.values()), list(entries), loc="outside lower center", ncols=4)


def _lower(text: str) -> str:
    return text[0].lower() + text[1:]


def _held(name: str, about: str, draw: Any, fits: Callable[[Record], bool]) -> Drawing:
    """A figure of records that hold what it shows."""
    return drawing(about, draw, fits, (name, "{path} does not hold what it shows", "draw another figure"))


DRAWINGS: dict[str, Drawing] = {
    **over_mesh.DRAWINGS,
    "overview": over_mesh.DRAWINGS["overview"]._replace(draw=overview_figure),
    "path-of-contact": over_mesh.DRAWINGS["path-of-contact"]._replace(draw=paths_figure),
    "line-load": over_face.LINE_LOAD,
    "in-space": drawing(
        "axial forces of helical meshes, axial displacements and tilts of their bodies",
        in_space_figure,
        over_face.helical,
        ("in-space", *over_face.MISSING),
        samples=2,
    ),
    "film-parameter": over_mesh.stacked("film thickness over roughness", over_mesh.FILM_PARAMETER),
    "orders": Drawing(
        "orders of the mesh while the speed changes, such as run-up",
        spectrum.orders_figure,
        spectrum.worth_tracking,
    ),
    "train": drawing(
        "the gears in their true positions, and the teeth in every mesh",
        train_figure,
        lambda record: "centre" in record.geometry,
        ("train", "{path} does not say where its gears stand", "run it again"),
    ),
    "shafts": _held(
        "shafts", "drawn shafts from the side, bent by the mean loads", shafts_figure, has_shafts
    ),
    "planet-load": _held(
        "planet-load",
        "load of every planet of planetary sets, at sun and ring",
        planet_load_figure,
        lambda record: bool(sets_of(record)),
    ),
    "ring-shape": _held("ring-shape", "rims of rings as their waves bend them", ring_figure, has_waves),
    "orbit": _held("orbit", "orbits of the central gears of planetary sets", orbit_figure, has_orbits),
    "mesh-force": drawing(
        "force of every mesh along its pitch tangent",
        partial(_all_meshes, MESH_FORCE, mesh_forces, "mesh"),
        lambda record: "driven_torque" in record,
        ("mesh-force", "{path} has no torques of the mesh", "run it again"),
    ),
    "displacement": _held(
        "displacement",
        "displacement of every body in its bearing",
        partial(_all_meshes, DISPLACEMENT, displacements, "body"),
        lambda record: "body" in record and bool(np.any(np.isfinite(displacements(record)))),
    ),
    "loss": Drawing("loss to friction in every mesh", partial(_all_meshes, LOSS, losses, "mesh")),
    "revolutions": over_mesh.REVOLUTIONS,
    "bearing-load": drawing(
        "force on every bearing and pin",
        bearing_load_figure,
        lambda record: "bearing_force_x" in record,
        ("bearing-load", "{path} has no forces on bearings", "give the bodies bearings, or run it again"),
    ),
    "modes": drawing(
        "natural frequencies, mesh frequencies over the speed, shares of the bodies",
        modes_figure,
        lambda record: "body" in record and "mode_shares" in record.summary,
        ("modes", "{path} does not say which bodies move in its modes", "run it again"),
    ),
    **sensor_averages.DRAWINGS,
}
