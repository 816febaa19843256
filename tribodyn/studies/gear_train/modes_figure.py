"""Natural frequencies of a train beside its mesh frequencies over the speed, and what moves in each mode."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.cycles import last_cycles, mesh_rates
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.figures.spectrum import mode_frequencies
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, literal, mark_panel, new_figure, write_beside
from tribodyn.record.reader import Record

#: Harmonics of the mesh frequencies, and the speed shown over the mean one.
HARMONICS, REACH = 3, 1.6
#: Room between names of modes, as a share of the axis.
_APART = 0.035


def modes_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw of the first record the Campbell diagram and each body's share in the energy of every mode."""
    record = records[0]
    modes = mode_frequencies(record)
    height = max(3.4, 0.19 * len(modes) + 1.4)
    figure = new_figure(1.35 * WIDTH, height)
    campbell, shares = figure.subplots(1, 2, width_ratios=(3, 2))
    _draw_campbell(campbell, record, modes)
    _draw_shares(shares, record, modes)
    mark_panel(campbell, "a", "Natural frequencies, and mesh frequencies over the speed")
    mark_panel(shares, "b", "Share of each body in the energy of a mode")
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


def _draw_campbell(axes: Axes, record: Record, modes: np.ndarray) -> None:
    mesh = last_cycles(record, None).mesh_frequency
    speed = float(np.mean(record["speed"][:, 0])) * 30.0 / np.pi
    top = 1e-3 * max(1.08 * float(modes.max(initial=0.0)), 1.2 * mesh * float(mesh_rates(record).max()))
    at = np.array([0.0, REACH])
    alike: dict[float, list[str]] = {}
    for name, rate in zip(record["mesh"], mesh_rates(record), strict=True):
        alike.setdefault(round(float(rate), 6), []).append(literal(str(name)))
    for number, (rate, names) in enumerate(alike.items()):
        color = PALETTE[number % len(PALETTE)]
        for order in range(1, HARMONICS + 1):
            frequency = order * rate * mesh * 1e-3
            label = f"mesh frequency of {', '.join(names)}, and its harmonics" if order == 1 else None
            axes.plot(at * speed, at * frequency, color=color, linewidth=1.4 / order + 0.3, label=label)
            end = min(REACH, 0.97 * top / frequency)
            text = "$f_m$" if order == 1 else f"{order}$f_m$"
            write_beside(axes, text, (end * speed, end * frequency), (-9, 1), 6.5, color, ha="right")
    axes.axhline(np.nan, color=QUIET, linestyle=(0, (4, 2)), linewidth=0.8, label="natural frequency")
    for frequency in modes:
        axes.axhline(frequency * 1e-3, color=QUIET, linestyle=(0, (4, 2)), linewidth=0.8)
    for place, text in _apart(modes * 1e-3, _APART * top):
        axes.annotate(
            text,
            (1.0, place),
            xycoords=("axes fraction", "data"),
            xytext=(3, 0),
            textcoords="offset points",
            va="center",
            fontsize=6.5,
            color=QUIET,
            annotation_clip=False,
        )
    axes.axvline(speed, color=INK, linewidth=0.9, label="mean speed of the run")
    axes.set(xlim=(0.0, REACH * speed), ylim=(0.0, top))
    axes.set_xlabel(f"Speed of {literal(str(record['body'][0]))} (rpm)")
    axes.set_ylabel("Frequency (kHz)")
    axes.figure.legend(loc="outside lower center", ncols=2, handles=axes.get_legend_handles_labels()[0])


def _apart(places: np.ndarray, least: float) -> list[tuple[float, str]]:
    """Numbers of the modes, those closer than `least` in one text at their mean."""
    groups: list[list[int]] = []
    for number, place in enumerate(places):
        if groups and place - places[groups[-1][0]] < least:
            groups[-1].append(number)
        else:
            groups.append([number])
    return [
        (float(np.mean(places[group])), "–".join(str(n + 1) for n in dict.fromkeys((group[0], group[-1]))))
        for group in groups
    ]


def _draw_shares(axes: Axes, record: Record, modes: np.ndarray) -> None:
    bodies = list(record["body"])
    shares = np.asarray(record.summary.get("mode_shares", [])).reshape(len(modes), len(bodies))
    places, left = np.arange(len(modes)), np.zeros(len(modes))
    for body, name in enumerate(bodies):
        width = 100.0 * shares[:, body]
        color = PALETTE[body % len(PALETTE)]
        axes.barh(places, width, left=left, height=0.72, color=color, alpha=0.8, label=literal(str(name)))
        left = left + width
    names = [f"{number + 1}: {frequency:,.0f} Hz" for number, frequency in enumerate(modes)]
    axes.set_yticks(places, names)
    axes.set(xlim=(0.0, 100.0), ylim=(-0.6, len(modes) - 0.4))
    axes.set_xlabel("Share of the kinetic energy (%)")
    axes.grid(visible=False, axis="y")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=min(4, len(bodies)))
