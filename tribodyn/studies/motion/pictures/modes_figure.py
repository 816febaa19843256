"""Natural frequencies of a train beside its mesh frequencies over the speed, and what moves in each mode."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from tribodyn.post.cycles import last_cycles, mesh_rates
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.figures.spectrum import apart, mode_frequencies
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, literal, mark_panel, new_figure, write_beside
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.carried_sets import body_labels, sets_of
from tribodyn.studies.motion.drivetrain.mesh_groups import together

#: Harmonics of the mesh frequencies, the speeds shown over the mean one, and room below and above.
HARMONICS, SPEEDS, ROOM = 3, (0.25, 1.6), (0.8, 1.3)
#: Room between names of modes, as a share of the axis.
_APART = 0.05


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
    speed = float(np.mean(record.over_bodies("speed")[:, 0])) * 30.0 / np.pi
    rates = mesh_rates(record)
    passes = [one for one in _passes(record) if one[1] > 0.0]
    lowest = min([mesh * rates.min(), *(frequency for _, frequency in passes)])
    ends = np.array([*modes, SPEEDS[0] * lowest, mesh * rates.max()]) * 1e-3
    low, high = ROOM[0] * float(ends.min()), ROOM[1] * float(ends.max())
    at = np.array(SPEEDS)
    alike: dict[float, list[str]] = {}
    sets = {}
    for gearset in sets_of(record):
        own = [m for of in (*gearset.meshes.values(), gearset.between) for m in of]
        several = np.ptp([rates[m] for m in own]) > 1e-6
        for name in (record.meshes[m] for m in own):
            sets[name] = name.rpartition("-")[0] if several else gearset.name
    for name, rate in zip(record.meshes, rates, strict=True):
        alike.setdefault(round(float(rate), 6), []).append(literal(sets.get(name, name)))
    for number, (rate, names) in enumerate(alike.items()):
        color = PALETTE[number % len(PALETTE)]
        for order in range(1, HARMONICS + 1):
            frequency = order * rate * mesh * 1e-3
            label = f"mesh frequency $f_m$ of {together(names)}" if order == 1 else None
            axes.plot(at * speed, at * frequency, color=color, linewidth=1.4 / order + 0.3, label=label)
            # those of different meshes beside each other, as their lines may coincide
            place = SPEEDS[0] * (SPEEDS[1] / SPEEDS[0]) ** (0.05 + 0.09 * (number % 8))
            axes.annotate(
                "$f_m$" if order == 1 else f"{order}$f_m$",
                (place * speed, place * frequency),
                ha="center",
                va="center",
                fontsize=6.5,
                color=color,
                bbox={"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none"},
            )
    for number, (name, frequency) in enumerate(passes):
        color = PALETTE[(len(alike) + number) % len(PALETTE)]
        axes.plot(at * speed, at * frequency * 1e-3, color=color, linestyle=":", label=name)
    for number, frequency in enumerate(modes):
        label = "natural frequency" if number == 0 else None
        axes.axhline(frequency * 1e-3, color=QUIET, linestyle=(0, (4, 2)), linewidth=0.8, label=label)
    for place, text in apart(np.log(modes * 1e-3), _APART * np.log(high / low)):
        where = {"xycoords": ("axes fraction", "data"), "va": "center", "annotation_clip": False}
        write_beside(axes, text, (1.0, float(np.exp(place))), (3, 0), 6.5, QUIET, **where)
    axes.axvline(speed, color=INK, linewidth=0.9, label="mean speed of the run")
    axes.set(xscale="log", yscale="log", xlim=(SPEEDS[0] * speed, SPEEDS[1] * speed), ylim=(low, high))
    for axis, ticks in ((axes.xaxis, (1, 1.5, 2, 3, 4, 6)), (axes.yaxis, (1, 2, 5))):
        axis.set_major_locator(LogLocator(subs=ticks))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.4g}"))
        axis.set_minor_formatter(NullFormatter())
    axes.set_xlabel(f"Speed of {literal(str(record['body'][0]))} (rpm)")
    axes.set_ylabel("Frequency (kHz)")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2)


def _passes(record: Record) -> list[tuple[str, float]]:
    """Frequencies at which planets pass a tooth of the gears on their axis, Hz: N |n_c − n|."""
    if not sets_of(record):
        return []
    turning = record.geometry["sense"] * np.mean(record["speed"], axis=0) / (2.0 * np.pi)
    return [
        (
            literal(f"{gearset.name}: planets pass {record['body'][body]}"),
            len(meshes) * abs(float(turning[gearset.carrier] - turning[body])),
        )
        for gearset in sets_of(record)
        for body, meshes in gearset.meshes.items()
    ]


def _draw_shares(axes: Axes, record: Record, modes: np.ndarray) -> None:
    bodies = list(record["body"])
    shares = np.asarray(record.summary.get("mode_shares", [])).reshape(len(modes), len(bodies))
    places, left, labels = np.arange(len(modes)), np.zeros(len(modes)), np.array(body_labels(record))
    bodies = list(dict.fromkeys(labels.tolist()))
    for number, name in enumerate(bodies):
        width = 100.0 * np.sum(shares[:, labels == name], axis=1)
        color = PALETTE[number % len(PALETTE)]
        axes.barh(places, width, left=left, height=0.72, color=color, alpha=0.8, label=literal(str(name)))
        left = left + width
    names = [f"{number + 1}: {frequency:,.0f} Hz" for number, frequency in enumerate(modes)]
    axes.set_yticks(places, names)
    axes.set(xlim=(0.0, 100.0), ylim=(-0.6, len(modes) - 0.4))
    axes.set_xlabel("Share of the kinetic energy (%)")
    axes.grid(visible=False, axis="y")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=min(3, len(bodies)))
