"""Figures of a map: iso-lines of efficiency and loss, losses by term, film, stiffness and its error."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tribodyn.cases.loss_part import TERMS
from tribodyn.post.figures.drawing import Drawing, drawing, finished
from tribodyn.post.figures.panel import View
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, QUIET, WIDTH, literal, new_figure
from tribodyn.record.loss_map import GridValues, efficiency_of
from tribodyn.record.reader import Record
from tribodyn.tribology.oil import ZERO_CELSIUS

RPM = 30.0 / np.pi
TORQUE_LABEL, SPEED_LABEL = "Torque at the output (N m)", "Speed of the input (rpm)"
#: A speed axis without 0 that spans more than this is drawn in logarithms.
_DECADES = 30.0
#: Levels of efficiency, %, denser towards the end.
_EFFICIENCIES = (
    *(0, 20, 40, 50, 60, 70, 80, 85, 90, 92, 94, 95, 96, 97, 97.5, 98, 98.2, 98.4, 98.6),
    *(98.7, 98.8, 98.9, 99, 99.1, 99.2, 99.3, 99.4, 99.5, 99.6, 99.7, 99.8, 99.9),
)
#: Share of a plane that lies between two iso-lines at least, and iso-lines at most.
_LEAST_BAND = 0.05
_MOST_LINES = 9
#: Iso-lines of what is more than so many times below the largest value would lie on each other.
_SPAN = 300.0
COLOURS = "viridis"
#: Values along an axis between which iso-lines are drawn.
_FINE = 161


class Slice(NamedTuple):
    """The map at one temperature of the oil, nearest the gearbox's own."""

    record: Record
    place: int  # on the axis of temperatures

    @property
    def torque(self) -> np.ndarray:
        """N m."""
        return self.record["torque"]

    @property
    def speed(self) -> np.ndarray:
        """In rpm."""
        return RPM * self.record["speed"]

    @property
    def temperature(self) -> str:
        """As a title says it."""
        return f"oil at {self.record['oil_temperature'][self.place] - ZERO_CELSIUS:.4g} °C"

    def own(self, axis: str) -> int:
        """Place on an axis nearest the gearbox's own point."""
        name = {"torque": "own_torque", "speed": "own_speed"}[axis]
        values = self.record[axis]
        return int(np.argmin(np.abs(values - float(self.record.summary.get(name, values[-1])))))

    def plane(self, values: np.ndarray, fine: bool = False) -> "Plane":
        """Values (torque, speed) over the plane; `fine`: also between the nodes."""
        torque, speed = self.torque, self.speed
        if not fine or len(torque) == 1 or len(speed) == 1:
            return Plane(torque, speed, values)
        between = _between(torque, _FINE), _between(speed, _FINE)
        grid = np.meshgrid(*between, indexing="ij")
        return Plane(*between, GridValues((torque, speed), values)(*grid))


class Plane(NamedTuple):
    """Values over torque and speed."""

    torque: np.ndarray
    speed: np.ndarray  # rpm
    values: np.ndarray  # (torque, speed)


def _between(axis: np.ndarray, count: int) -> np.ndarray:
    """The nodes, and values evenly between the first and the last."""
    return np.union1d(axis, np.linspace(axis[0], axis[-1], count))


def slice_of(record: Record) -> Slice:
    """The slice that pictures show."""
    oil = record["oil_temperature"]
    own = float(record.summary.get("own_oil_temperature", oil[0]))
    return Slice(record, int(np.argmin(np.abs(oil - own))))


def iso_lines(axes: Axes, at: Slice, plane: Plane, levels: Sequence[float], label: str, form: str) -> None:
    """Draw iso-lines of values over a plane; a line over the only axis where there is one."""
    torque, speed, values = plane
    if len(torque) == 1 or len(speed) == 1:
        over_speed = len(speed) > 1
        x, y = (speed, values[0]) if over_speed else (torque, values[:, 0])
        axes.plot(x, y, marker="o" if len(x) == 1 else "", markersize=4, color=PALETTE[0])
        axes.set(xlabel=SPEED_LABEL if over_speed else TORQUE_LABEL, ylabel=label)
        return
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    shown = _apart(plane, [level for level in levels if low < level < high])
    masked = np.ma.masked_invalid(values)
    if shown:
        norm = BoundaryNorm([low - 1.0, *shown, high + 1.0], colormaps[COLOURS].N)
        how: Any = {"cmap": COLOURS, "norm": norm, "alpha": 0.35}
        axes.contourf(speed, torque, masked, levels=[low - 1.0, *shown, high + 1.0], **how)
    if shown:
        lines = axes.contour(speed, torque, masked, levels=shown, colors=INK, linewidths=0.7)
        axes.clabel(lines, fmt=form, fontsize=6.5, inline_spacing=2)
    else:
        ends = dict.fromkeys(form % float(f"{end:.3g}") for end in (low, high))
        said = f"{' to '.join(ends)} throughout"
        axes.annotate(said, (0.5, 0.3), xycoords="axes fraction", ha="center", color=QUIET)
    summary = at.record.summary
    own = RPM * float(summary.get("own_speed", np.nan)), float(summary.get("own_torque", np.nan))
    style: Any = {"markerfacecolor": "white", "markeredgecolor": PALETTE[1], "linestyle": "none"}
    axes.plot(*own, marker="o", markersize=4, **style)
    ends = {"xlim": (speed[0], speed[-1]), "ylim": (torque[0], torque[-1])}
    axes.set(xlabel=SPEED_LABEL, ylabel=TORQUE_LABEL, **ends)
    if speed[0] > 0.0 and speed[-1] > _DECADES * speed[0]:
        axes.set_xscale("log")
    if torque[0] < 0.0 < torque[-1]:
        axes.axhline(0.0, color=QUIET, linewidth=0.8)
    axes.grid(False)


def _apart(plane: Plane, levels: Sequence[float]) -> list[float]:
    """Those of the levels between which enough of the plane lies, evenly among them where they are many."""
    area = np.outer(np.gradient(plane.torque), np.gradient(plane.speed))
    area = np.where(np.isfinite(plane.values), area, 0.0)
    kept, below = list[float](), 0.0
    for level in levels:
        share = float(area[plane.values < level].sum() / area.sum())
        if share - below >= _LEAST_BAND and share <= 1.0 - 0.5 * _LEAST_BAND:
            kept.append(level)
            below = share
    places = np.unique(np.linspace(0, len(kept) - 1, min(len(kept), _MOST_LINES)).astype(int))
    return [kept[place] for place in places]


def _log_levels(values: np.ndarray) -> list[float]:
    """1, 2, 5 of each decade of what is positive."""
    positive = values[np.isfinite(values) & (values > 0.0)]
    if not positive.size:
        return []
    lowest = max(positive.min(), positive.max() / _SPAN)
    decades = np.arange(np.floor(np.log10(lowest)), np.ceil(np.log10(positive.max())) + 1)
    steps = [float(f"{step}e{int(decade)}") for decade in decades for step in (1, 2, 5)]
    return [step for step in steps if step >= lowest]


def _overview(records: Sequence[Record], _view: View) -> Figure:
    at = slice_of(records[0])
    figure = new_figure(WIDTH * 1.25, 1.35 * PANEL_HEIGHT)
    left, right = figure.subplots(1, 2)
    drag = at.plane(at.record["drag"][:, at.place].sum(axis=0), fine=True)
    through = abs(float(at.record.attrs["ratio"])) * drag.torque[:, None]
    efficiency = drag._replace(values=100.0 * np.maximum(efficiency_of(through, drag.values), 0.0))
    iso_lines(left, at, efficiency, _EFFICIENCIES, "Efficiency (%)", "%g %%")
    loss = drag._replace(values=drag.values * np.abs(drag.speed) / RPM)
    iso_lines(right, at, loss, _log_levels(loss.values), "Power lost (W)", "%g W")
    titles = f"Efficiency, {at.temperature}", "Power lost"
    return finished(figure, (left, right), titles, records[:1])


def _terms(records: Sequence[Record], _view: View) -> Figure:
    at = slice_of(records[0])
    figure = new_figure(WIDTH * 1.25, 1.2 * PANEL_HEIGHT)
    panels = figure.subplots(1, 2)
    drag, terms = at.record["drag"][:, at.place], at.record["source_term"]
    i, k = at.own("torque"), at.own("speed")
    power = drag * np.abs(at.record["speed"])
    key = []
    for axes, x, along, label in (
        (panels[0], at.torque, power[:, :, k], TORQUE_LABEL),
        (panels[1], at.speed, power[:, i], SPEED_LABEL),
    ):
        present = [term for term in TERMS if np.any(terms == term)]
        parts = [along[terms == term].sum(axis=0) for term in present]
        bands = axes.stackplot(x, parts, colors=PALETTE, alpha=0.75)
        key = [(f"{term} {TERMS[term]}", band) for term, band in zip(present, bands, strict=True)]
        axes.set(xlabel=label, ylabel="Power lost (W)")
        axes.set_ylim(bottom=0.0)
    titles = f"By term, at {at.speed[k]:.4g} rpm, {at.temperature}", f"At {at.torque[i]:.4g} N m"
    return finished(figure, panels, titles, records[:1], key, columns=3)


def _film(records: Sequence[Record], _view: View) -> Figure:
    at = slice_of(records[0])
    figure = new_figure(WIDTH * 1.25, 1.35 * PANEL_HEIGHT)
    left, right = figure.subplots(1, 2)
    film = _worst(at.record["film_parameter_min"][:, at.place], np.fmin)
    iso_lines(left, at, at.plane(film), _log_levels(film), "Film over roughness", "%g")
    bulk = _worst(at.record["bulk_temperature"][:, at.place], np.fmax) - ZERO_CELSIUS
    levels = list(MaxNLocator(_MOST_LINES).tick_values(np.nanmin(bulk), np.nanmax(bulk)))
    iso_lines(right, at, at.plane(bulk), levels, "Bulk temperature (°C)", "%g °C")
    titles = "Minimum film over roughness, all meshes", f"Highest bulk temperature, {at.temperature}"
    return finished(figure, (left, right), titles, records[:1])


def _worst(values: np.ndarray, of: Callable[..., Any]) -> np.ndarray:
    return of.reduce(values, axis=0)  # pyright: ignore[reportFunctionMemberAccess]


def _has_film(record: Record) -> bool:
    named = all(name in record for name in ("film_parameter_min", "bulk_temperature"))
    return named and all(
        np.any(np.isfinite(record[name][:, slice_of(record).place]))
        for name in ("film_parameter_min", "bulk_temperature")
    )


def _temperatures(records: Sequence[Record], _view: View) -> Figure:
    at = slice_of(records[0])
    figure = new_figure(WIDTH, 1.2 * PANEL_HEIGHT)
    axes, oil, i = figure.subplots(), at.record["oil_temperature"], at.own("torque")
    shown = np.unique(np.linspace(0, len(oil) - 1, min(len(oil), len(PALETTE))).astype(int))
    for colour, place in zip(PALETTE, shown, strict=False):
        name = f"{oil[place] - ZERO_CELSIUS:.4g} °C"
        axes.plot(at.speed, at.record["power_loss"][place, i], color=colour, label=name)
    axes.set(xlabel=SPEED_LABEL, ylabel="Power lost (W)")
    axes.legend(title="oil", title_fontsize=7.5)
    return finished(figure, (axes,), (f"Power lost at {at.torque[i]:.4g} N m",), records[:1])


def _statics(records: Sequence[Record], _view: View) -> Figure:
    record = records[0]
    figure = new_figure(WIDTH * 1.25, 1.2 * PANEL_HEIGHT)
    panels, torque = figure.subplots(1, 2), record["torque"]
    mark = "o" if len(torque) == 1 else ""
    key = []
    for colour, mesh, stiffness, error in zip(
        PALETTE,
        record["mesh"],
        record["stiffness_mean"],
        record["transmission_error_harmonic"],
        strict=False,
    ):
        (line,) = panels[0].plot(torque, 1e-6 * stiffness, marker=mark, color=colour)
        key.append((literal(str(mesh)), line))
        for style, harmonic in zip(("-", "--", ":"), error.T, strict=False):
            panels[1].plot(torque, 1e6 * harmonic, marker=mark, color=colour, linestyle=style)
    panels[0].set(xlabel=TORQUE_LABEL, ylabel="Mean mesh stiffness (N/µm)")
    panels[1].set(xlabel=TORQUE_LABEL, ylabel="Amplitude (µm)")
    titles = "Mean mesh stiffness", "Transmission error: 1st (—), 2nd (– –), 3rd (···) harmonic"
    return finished(figure, panels, titles, records[:1], key)


_NO_FILM = "film", "{path} has no film: no mesh under load", "draw another figure"
_ONE_OIL = "temperature", "{path} has one temperature of the oil", "map several: map.oil_temperature"
DRAWINGS: dict[str, Drawing] = {
    "overview": drawing("iso-lines of efficiency and of the power lost over speed and torque", _overview),
    "terms": drawing("power lost by term, over torque and over speed", _terms),
    "film": drawing(
        "film over roughness and bulk temperature over speed and torque", _film, _has_film, _NO_FILM
    ),
    "temperature": drawing(
        "power lost over the speed by temperature of the oil",
        _temperatures,
        lambda record: record.samples > 1,
        _ONE_OIL,
    ),
    "statics": drawing("mean mesh stiffness and harmonics of the error over torque", _statics),
}
