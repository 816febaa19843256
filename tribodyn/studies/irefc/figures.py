"""Figures of the gear with rolling elements: loads, slip and losses of its elements, and the gear itself."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle
from matplotlib.ticker import MaxNLocator

from tribodyn.post.figures.drawing import Drawing, drawing, finished
from tribodyn.post.figures.panel import View, abscissa_label, record_title, scale
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, QUIET, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record

CAM_FILL, CROWN_FILL, ELEMENT_FILL = "#dcebf5", "#f6e6da", "#ffffff"
MILLIMETRE = 1e-3
#: Length of the arrow of the maximum load, in element radii.
LONGEST_ARROW = 6.0


def draw_gear(axes: Axes, record: Record) -> None:
    """Draw the gear about the shaft's axis, the pitch point to the right; axes in mm.

    Arrows at the elements show the normal loads on the cam, to scale; their lines meet in the pitch point.
    """
    sizes = {name: value / MILLIMETRE for name, value in record.geometry.items()}
    offset = float(sizes["eccentricity"])
    crown, cam = sizes["crown_outline"], sizes["cam_outline"] + np.array([offset, 0.0])
    rim = 1.12 * float(np.hypot(*crown.T).max())
    axes.add_patch(Circle((0, 0), rim, facecolor=CROWN_FILL, edgecolor=PALETTE[1], linewidth=0.9))
    axes.fill(*crown.T, facecolor="white", edgecolor=PALETTE[1], linewidth=0.9)
    axes.fill(*cam.T, facecolor=CAM_FILL, edgecolor=PALETTE[0], linewidth=0.9)
    # the crown's pitch radius is the pitch point's distance from the axis
    pitch_point = float(sizes["crown_pitch_radius"])
    for centre, name, color in (
        (0.0, "crown_pitch_radius", PALETTE[1]),
        (offset / 2, "pitch_radius", QUIET),
        (offset, "cam_pitch_radius", PALETTE[0]),
    ):
        style = {"fill": False, "edgecolor": color, "linewidth": 0.6, "linestyle": "-."}
        axes.add_patch(Circle((centre, 0.0), sizes[name], **style))
    _draw_elements(axes, record, sizes)
    # beside the points, and the pitch point's name where no load points
    for place, name, shift in (
        (0.0, "O", (-10, 4)),
        (offset, "$O_c$", (4, 4)),
        (pitch_point, "P", (-10, -9)),
    ):
        axes.plot(
            place, 0.0, marker="o", markersize=3.5, markerfacecolor="white", markeredgecolor="black", zorder=4
        )
        axes.annotate(name, (place, 0.0), xytext=shift, textcoords="offset points", fontsize=8)
    label = "From the shaft's axis, through the pitch point (mm)"
    axes.set(
        xlim=(-1.02 * rim, 1.02 * rim), ylim=(-1.02 * rim, 1.02 * rim), xlabel=label, ylabel="Across (mm)"
    )
    axes.set_aspect("equal")
    axes.grid(False)
    axes.annotate("crown", (0.02, 0.97), xycoords="axes fraction", va="top", color=PALETTE[1])
    axes.annotate("cam", (0.02, 0.02), xycoords="axes fraction", color=PALETTE[0])


def _draw_elements(axes: Axes, record: Record, sizes: dict[str, Any]) -> None:
    """Draw all elements of the cage, also those that the paper's position leaves out, and the loads."""
    radius, count = sizes["element_radius"], int(record.scenario["drive"]["elements"])

    def centres(angle: np.ndarray) -> np.ndarray:
        around = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return np.array([sizes["eccentricity"] / 2, 0.0]) + sizes["centre_circle_radius"] * around

    style = {"facecolor": ELEMENT_FILL, "edgecolor": INK, "linewidth": 0.8}
    for centre in centres(2 * np.pi * np.arange(count) / count):
        axes.add_patch(Circle(tuple(centre), radius, **style))
    load, loaded = record["normal_load"][0], centres(record["element_angle"][0])
    normal = loaded - np.array([sizes["crown_pitch_radius"], 0.0])
    normal /= np.hypot(*normal.T)[:, None]
    lengths = LONGEST_ARROW * radius * load / load.max()
    arrow = {"arrowstyle": "-|>", "color": PALETTE[2], "linewidth": 0.9, "mutation_scale": 6}
    for contact, along, length in zip(loaded - radius * normal, normal, lengths, strict=True):
        if length > 0.02 * radius:
            axes.annotate("", tuple(contact - length * along), tuple(contact), arrowprops=arrow)


#: What the four panels of one element's way, or of all elements, show.
CURVES = (
    *("Normal load on the cam", "Slip of the elements over the cam"),
    *("Power lost by one element", "The same, added up"),
)
#: Lines of the losses of an element.
LOSSES: Any = (("cam", "-"), ("crown", "--"), ("both, $N_S$", ":"))
#: Their datasets, and the last angle of the loaded half.
SHOWN, HALF = ("normal_load", "slip_speed", "power_cam", "power_crown"), np.pi * (1 + 1e-12)


class ElementCurves(NamedTuple):
    """Quantities of elements in the order of an abscissa: element number, or angle φ in degrees."""

    x: np.ndarray
    load: np.ndarray
    slip: np.ndarray
    cam: np.ndarray
    crown: np.ndarray
    cumulative: np.ndarray


def by_number(record: Record) -> ElementCurves:
    """Take the elements in the loaded half at the start, by number; losses add up from the first."""
    half = record["element_angle"][0] <= HALF
    load, slip, cam, crown = (record[name][0][half] for name in SHOWN)
    return ElementCurves(np.array(record.elements)[half], load, slip, cam, crown, np.cumsum(cam + crown))


def by_angle(record: Record) -> ElementCurves:
    """Take what one element meets on its way through the loaded half, by angle; in a position, all elements.

    Losses are integrated over the angle and divided by the pitch of the elements, which adds up to the mean
    loss of all elements.
    """
    # an element goes round in the gear's revolution and a little less; every element meets the same
    path = (slice(None), 0) if record.samples > 1 else (0, slice(None))
    angle = record["element_angle"][path]
    order = np.argsort(angle)
    order = order[angle[order] <= HALF]
    phi = angle[order]
    load, slip, cam, crown = (record[name][path][order] for name in SHOWN)
    loss = cam + crown
    pieces = np.diff(phi) * (loss[1:] + loss[:-1]) / 2
    drive = record.scenario["drive"]
    cumulative = np.concatenate([[0.0], np.cumsum(pieces)]) * drive["elements"] / (2 * np.pi)
    return ElementCurves(np.degrees(phi), load, slip, cam, crown, cumulative)


def _four_panels(records: Sequence[Record], by_element: bool) -> Figure:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 0.4)
    panels = figure.subplots(2, 2, sharex=True).ravel()
    for number, record in enumerate(records):
        curve = by_number(record) if by_element else by_angle(record)
        draw_curve(panels, curve, PALETTE[number % len(PALETTE)], by_element)
    _finish_axes(panels, panels[2:], by_element)
    losses = [(name, Line2D([], [], color=QUIET, linestyle=style)) for name, style in LOSSES]
    return _finished(figure, panels, CURVES, records, losses)


def draw_curve(panels: Sequence[Axes], curve: ElementCurves, color: str, marked: bool) -> None:
    """Draw load, slip, losses and cumulative loss into four axes; points of single elements are `marked`."""
    marker = "o" if marked else ""
    style: dict[str, Any] = {"color": color, "marker": marker, "markersize": 3, "clip_on": not marked}
    values = curve.load, curve.slip * 1e3, curve.cam, curve.cumulative
    labels = "Normal load (N)", "Slip over the cam (mm/s)", "Loss of an element (W)", "Cumulative loss (W)"
    for axes, y, label in zip(panels, values, labels, strict=True):
        axes.plot(curve.x, y, **style)
        axes.set_ylabel(label)
    panels[2].plot(curve.x, curve.crown, linestyle="--", **style)
    panels[2].plot(curve.x, curve.cam + curve.crown, linestyle=":", **style)


def _finish_axes(panels: Sequence[Axes], labelled: Sequence[Axes], by_element: bool) -> None:
    """Start loads and losses at zero, which stops axes from growing, and label abscissas."""
    for axes in (panels[0], *panels[2:]):
        axes.set_ylim(bottom=0)
    for axes in labelled:
        if by_element:
            ends = axes.dataLim.x0 - 0.5, axes.dataLim.x1 + 0.5
            axes.set(xlabel="Element, from the cam's depression", xlim=ends)
            axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        else:
            axes.set(xlabel="Angle φ of the element (°)", xticks=range(0, 181, 30))


def _cycles(record: Record, view: View) -> tuple[slice, np.ndarray]:
    """Samples of the last whole cycles, and their phase or time in ms."""
    length = int(record.scenario["output"]["samples_per_cycle"])
    whole = (record.samples - 1) // length
    count = whole if view.cycles is None else min(whole, view.cycles)
    stop = whole * length + 1 if whole else record.samples
    part = slice(stop - 1 - count * length if count else 0, stop)
    if view.against == "time":
        return part, record["time"][part] * 1e3
    return part, np.arange(part.stop - part.start) / length


def _two_rows() -> tuple[Figure, Sequence[Axes]]:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 0.4)
    return figure, figure.subplots(2, 1, sharex=True)


def _loads(records: Sequence[Record], view: View) -> Figure:
    """The load of each element, one of them heavier, and the number of loaded ones."""
    figure, panels = _two_rows()
    for number, record in enumerate(records):
        part, x = _cycles(record, view)
        load, color = record["normal_load"][part], PALETTE[number % len(PALETTE)]
        draw_loads(panels[0], x, load, color)
        panels[1].step(x, np.sum(load > 1e-9 * load.max(), axis=1), color=color, where="mid")
    panels[0].set(ylabel="Normal load of each element (N)", ylim=(0, None))
    panels[1].set(ylabel="Loaded elements", ylim=(0, None), xlabel=abscissa_label(view, records[0]))
    panels[1].yaxis.set_major_locator(MaxNLocator(integer=True))
    titles = "Normal load of each element, one drawn heavier", "Number of elements under load"
    return _finished(figure, panels, titles, records)


def draw_loads(axes: Axes, x: np.ndarray, load: np.ndarray, color: str) -> None:
    """Draw loads of all elements faintly and those of one that unloads in the window in full."""
    axes.plot(x, load, color=color, linewidth=0.7, alpha=0.45)
    leaving = int(np.argmax(load[0] - load[-1]))
    axes.plot(x, load[:, leaving], color=color, linewidth=1.6)
    middle, style = len(x) // 2, {"color": color, "fontsize": 7.5}
    place = x[middle], load[middle, leaving]
    axes.annotate(f"element {leaving + 1}", place, xytext=(6, 6), textcoords="offset points", **style)


def _efficiency(records: Sequence[Record], view: View) -> Figure:
    """Loss and efficiency at each moment."""
    figure, panels = _two_rows()
    shown = ("power_friction", 1.0, "Loss (W)"), ("efficiency", 100.0, "Efficiency (%)")
    for axes, (name, factor, label) in zip(panels, shown, strict=True):
        curves = []
        for number, record in enumerate(records):
            part, x = _cycles(record, view)
            curves.append(record[name][part] * factor)
            axes.plot(x, curves[-1], color=PALETTE[number % len(PALETTE)])
        axes.set_ylabel(label)
        scale(axes, curves)
    panels[1].set_xlabel(abscissa_label(view, records[0]))
    titles = "Power lost in all contacts", "Efficiency at each moment"
    return _finished(figure, panels, titles, records)


def _gears(records: Sequence[Record]) -> Figure:
    columns = min(len(records), 2)
    rows = -(-len(records) // columns)
    side = 0.85 * WIDTH if columns == 1 else 0.65 * WIDTH
    figure = new_figure(side * columns, rows * (side + 0.3))
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in grid[len(records) :]:
        axes.remove()
    shown = grid[: len(records)]
    for axes, record in zip(shown, records, strict=True):
        draw_gear(axes, record)
        axes.set_title(_title(record), loc="left", fontsize=9)
    reach = max(abs(end) for axes in shown for end in (*axes.get_xlim(), *axes.get_ylim()))
    for axes in shown:
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
    return figure


def _overview(records: Sequence[Record], view: View) -> Figure:
    record = records[0]
    figure = new_figure(11.0, 6.2)
    rows = figure.subplots(2, 3)
    draw_gear(rows[0, 0], record)
    panels = [rows[0, 1], rows[0, 2], rows[1, 0], rows[1, 1]]
    moving = record.samples > 1
    draw_curve(panels, by_angle(record), PALETTE[0], marked=not moving)
    _finish_axes(panels, panels, by_element=False)
    panels[2].legend([name for name, _ in LOSSES])
    if moving:
        part, x = _cycles(record, view)
        draw_loads(rows[1, 2], x, record["normal_load"][part], PALETTE[0])
        rows[1, 2].set(xlabel=abscissa_label(view, record), ylabel="Normal load of each element (N)")
        rows[1, 2].set_ylim(bottom=0)
    else:
        rows[1, 2].remove()
    titles = ("Cam, elements and crown", *CURVES, "Normal load of each element over time")
    for letter, axes, title in zip("abcdef" if moving else "abcde", rows.flat, titles, strict=False):
        mark_panel(axes, letter, title)
    figure.suptitle(_title(record), x=0.01, ha="left", fontsize=11)
    return figure


def _title(record: Record) -> str:
    """Return what the record is about and in which mode it was made."""
    title = record_title(record)
    mode = literal(str(record.scenario.get("mode", "corrected")).replace("_", " "))
    return title if mode in title else f"{title} ({mode})"


def _finished(
    figure: Figure, panels: Sequence[Axes], titles: Sequence[str], records: Sequence[Record], key: Any = ()
) -> Figure:
    return finished(figure, panels, titles, records, key, title=_title(records[0]), handlelength=2.6)


OF_A_POSITION: dict[str, Drawing] = {
    "overview": drawing("loads, slip and losses of the elements, and the gear", _overview),
    "elements": drawing("loads, slip and losses by element", lambda records, _: _four_panels(records, True)),
    "element-angle": drawing(
        "the same over an element's way", lambda records, _: _four_panels(records, False)
    ),
    "gear": drawing("cam, elements and crown", lambda records, _: _gears(records)),
}


def _of_a_motion(name: str, about: str, draw: Any) -> Drawing:
    """A figure over time."""
    remedy = f"draw {', '.join(other for other in OF_A_POSITION if other != 'overview')}"
    missing = name, "{path} holds a single position", remedy
    return drawing(about, draw, lambda record: record.samples > 1, missing, samples=0)


DRAWINGS: dict[str, Drawing] = {
    **OF_A_POSITION,
    "normal-load": _of_a_motion("normal-load", "normal load of the elements over time", _loads),
    "efficiency": _of_a_motion("efficiency", "efficiency and torque over time", _efficiency),
}
