"""Figures of solved contacts: films and friction beside the laws, profiles, maps, Moes' chart."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.figures.drawing import Drawing, drawing
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.style import (
    GRID,
    PALETTE,
    PANEL_HEIGHT,
    QUIET,
    WIDTH,
    house_style,
    literal,
    mark_panel,
    new_figure,
)
from tribodyn.record.reader import Record
from tribodyn.tribology.ehl.steady import survey_film

ROLL = "Roll angle from the pitch point (°)"
_PLACE = "Place over half width of the Hertz contact"
_SHOWN = 5


def _drawing(about: str, draw: Callable[[Record, Figure], None], height: float, *fits: Any) -> Drawing:
    """A figure of one record, so many panels high."""

    def figure(records: Sequence[Record], _view: View) -> Figure:
        if len(records) != 1:
            raise InputError("plot", "records", "this figure shows one record", "give one")
        canvas = new_figure(WIDTH, height * PANEL_HEIGHT)
        draw(records[0], canvas)
        canvas.suptitle(record_title(records[0]))
        return canvas

    return drawing(about, figure, *fits, samples=0, timeless="a study of the solved contact")


def _overview(record: Record, figure: Figure) -> None:
    film, friction, load = figure.subplots(3, 1, sharex=True)
    roll = np.degrees(record["roll_angle"])
    film.plot(roll, 1e6 * record["central_film_thickness"], color="black", lw=2, label="solved, central")
    film.plot(roll, 1e6 * record["minimum_film_thickness"], "k--", label="solved, minimum")
    film.plot(roll, 1e6 * record["central_film_smooth"], "k:", label="solved, central, smooth")
    film.plot(roll, 1e6 * record["minimum_film_smooth"], "k-.", label="solved, minimum, smooth")
    _laws(film, roll, 1e6 * record["film_by_law"], record["film_law"])
    film.set_ylabel("Film thickness (µm)")
    friction.plot(roll, record["friction_coefficient"], color="black", lw=2, label="solved")
    _laws(friction, roll, record["friction_by_law"], record["friction_law"])
    friction.set_ylabel("Friction coefficient")
    load.plot(roll, 1e-9 * record["hertz_pressure"], color=PALETTE[0])
    load.set(ylabel="Hertz pressure (GPa)", xlabel=ROLL)
    mark_panel(film, "a", "Film thickness, solved and by every film law")
    mark_panel(friction, "b", "Friction coefficient, solved and by every friction law")
    mark_panel(load, "c", "Maximum Hertz pressure")
    for axes in (film, friction):
        axes.set_ylim(bottom=0)
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="x-small")


def _laws(axes: Axes, roll: np.ndarray, values: np.ndarray, names: np.ndarray) -> None:
    for number, name in enumerate(names):
        text = name.decode() if isinstance(name, bytes) else str(name)
        style = ("-", ":", "-.")[number // len(PALETTE) % 3]
        axes.plot(roll, values[:, number], style, color=PALETTE[number % len(PALETTE)], lw=1, label=text)


def _chosen(record: Record) -> np.ndarray:
    solved = np.flatnonzero(np.isfinite(record["central_film_thickness"]))
    return solved[np.unique(np.linspace(0, len(solved) - 1, _SHOWN).astype(int))]


#: By the letters of their panels: dataset, factor to the unit, what it is, the unit.
_PROFILES = {
    "a": ("pressure", 1e-9, "Pressure", "GPa"),
    "b": ("film_thickness", 1e6, "Film thickness", "µm"),
    "c": ("temperature_rise", 1.0, "Temperature rise", "K"),
    "d": ("shear_stress", 1e-6, "Shear stress", "MPa"),
}


def _profiles(record: Record, figure: Figure) -> None:
    rows = figure.subplots(2, 2, sharex=True)
    for axes, (letter, (name, scale, label, unit)) in zip(rows.ravel(), _PROFILES.items(), strict=True):
        mark_panel(axes, letter, label)
        for number, at in enumerate(_chosen(record)):
            text = f"{np.degrees(record['roll_angle'][at]):.1f}°"
            axes.plot(record["place"], scale * record[name][at], color=PALETTE[number], label=text)
        axes.set_ylabel(unit)
    rows[0, 1].set_ylim(0, 3e6 * np.nanmax(record["central_film_thickness"]))
    rows[0, 0].legend(title="roll angle", fontsize="x-small")
    for axes in rows[1]:
        axes.set_xlabel(_PLACE)


def _maps(record: Record, figure: Figure) -> None:
    rows = figure.subplots(2, 2, sharex=True, sharey=True)
    roll, top = np.degrees(record["roll_angle"]), 3e6 * np.nanmax(record["central_film_thickness"])
    for axes, (letter, (name, scale, label, unit)) in zip(rows.ravel(), _PROFILES.items(), strict=True):
        mark_panel(axes, letter, label)
        limit = {"vmax": top} if name == "film_thickness" else {}
        values = np.ma.masked_invalid(scale * record[name])
        mesh = axes.pcolormesh(roll, record["place"], values.T, shading="nearest", rasterized=True, **limit)
        figure.colorbar(mesh, ax=axes, label=unit)
    for axes in rows[1]:
        axes.set_xlabel(ROLL)
    for axes in rows[:, 0]:
        axes.set_ylabel("Place over half width")


def _moes(record: Record, figure: Figure) -> None:
    axes = figure.subplots()
    load = np.geomspace(0.5, 2e4, 80)
    for color, material in zip(PALETTE, (1.0, 2.5, 5.0, 10.0, 25.0), strict=False):
        # in b²/R = 8 W R/π, over R √U_Σ
        film = [survey_film(number, material) * 8.0 * number / np.pi for number in load]
        axes.loglog(load, film, color=color, lw=1, label=f"L = {material:g}")
    solved = np.isfinite(record["moes_load"])
    unit = record["half_width"] ** 2 / record["equivalent_radius"]
    film = record["central_film_thickness"] / unit * 8.0 * record["moes_load"] / np.pi
    low, high = np.nanmin(record["moes_material"]), np.nanmax(record["moes_material"])
    label = f"this drive, solved, L = {low:.3g} … {high:.3g}"
    axes.loglog(record["moes_load"][solved], film[solved], "k.-", label=label)
    axes.set(xlabel="Load parameter M", ylabel="Central film, h/(R √U_Σ)")
    axes.legend(fontsize="small")


def _traction(record: Record, figure: Figure) -> None:
    axes = figure.subplots()
    axes.semilogx(record["slide_to_roll"], record["traction"], "o-", color=PALETTE[0])
    axes.set(xlabel="Slide-to-roll ratio", ylabel="Friction coefficient", ylim=(0.0, None))


def _transient(record: Record, figure: Figure) -> None:
    film, departure, friction = figure.subplots(3, 1, sharex=True)
    roll = np.degrees(record["roll_angle"])
    for color, name in zip(PALETTE, ("central", "minimum"), strict=False):
        steady, squeezed = (record[f"{way}{name}_film_thickness"] for way in ("", "transient_"))
        film.plot(roll, 1e6 * steady, "--", color=color, lw=1, label=f"{name}, steady")
        film.plot(roll, 1e6 * squeezed, color=color, label=f"{name}, with squeeze")
        departure.plot(roll, 100.0 * (squeezed / steady - 1.0), color=color, label=name)
    friction.plot(roll, record["friction_coefficient"], "--", color=PALETTE[0], lw=1, label="steady")
    friction.plot(roll, record["transient_friction_coefficient"], color=PALETTE[0], label="with squeeze")
    film.set(ylabel="Film thickness (µm)", ylim=(0.0, None))
    departure.set_ylabel("Departure (%)")
    friction.set(ylabel="Friction coefficient", ylim=(0.0, None), xlabel=ROLL)
    mark_panel(film, "a", "Film thickness")
    mark_panel(departure, "b", "Departure of the film with squeeze from the steady one")
    mark_panel(friction, "c", "Friction coefficient")
    for axes in (film, departure, friction):
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="x-small")


DRAWINGS: dict[str, Drawing] = {
    "overview": _drawing("film and friction beside every law, Hertz pressure", _overview, 3.0),
    "profiles": _drawing("pressure, film, temperature and shear at chosen places", _profiles, 2.2),
    "maps": _drawing("the same over the way of the pair", _maps, 2.2),
    "moes": _drawing("Moes' chart with the drive's duty", _moes, 1.6),
    "transient": _drawing(
        "film and friction with squeeze beside the steady ones",
        _transient,
        3.0,
        lambda record: "transient_central_film_thickness" in record,
        ("transient", "the record has no film with squeeze", "set contact.transient = true"),
    ),
    "traction": _drawing("friction over slide-to-roll ratio, where the load is highest", _traction, 1.4),
}


def laws_figure(title: str, ratios: Sequence[Any], right: Mapping[str, float]) -> Figure:
    """Draw minimum, median and maximum of each `judgement.LawRatio`; points: medians of the map."""
    groups = [[law for law in ratios if law.what == what] for what in right]
    with house_style():
        figure = new_figure(WIDTH, 1.2 + 0.22 * len(ratios))
        panels = figure.subplots(len(groups), 1, height_ratios=[len(laws) for laws in groups], squeeze=False)
        for axes, what, laws in zip(panels[:, 0], right, groups, strict=True):
            _rows(axes, laws)
            axes.axvspan(1.0 - right[what], 1.0 + right[what], color=GRID, zorder=0)
            axes.set_xlabel(f"{what.capitalize()} by the law over the solved one")
        figure.suptitle(literal(title))
    return figure


def _rows(axes: Axes, laws: Sequence[Any]) -> None:
    for row, law in enumerate(laws):
        points = np.ravel(law.map)
        axes.plot(points, np.full(len(points), row), ".", color=QUIET, ms=3, zorder=2)
        axes.plot([law.minimum, law.maximum], [row, row], color=PALETTE[0], lw=2.5, zorder=3)
        axes.plot([law.median], [row], "o", color=PALETTE[1], ms=4, zorder=4)
    axes.set_xscale("log")
    axes.axvline(1.0, color=QUIET, lw=0.8)
    names = [f"{law.law} ({law.against})" if law.what == "film" else law.law for law in laws]
    axes.set_yticks(range(len(laws)), list(map(literal, names)))
    axes.set_ylim(len(laws) - 0.5, -0.5)
    shown = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
    axes.set_xticks(shown, [f"{ratio:g}" for ratio in shown])
    axes.minorticks_off()
    every = [value for law in laws for value in (law.minimum, law.maximum, *np.ravel(law.map))]
    finite = [value for value in every if np.isfinite(value)]
    axes.set_xlim(max(min([*finite, 0.5]) / 1.2, 0.05), min(max([*finite, 2.0]) * 1.2, 20.0))
