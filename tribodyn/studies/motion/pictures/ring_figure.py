"""Rims of rings as their waves bend them, seen from the carrier."""

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.numerics.shapes import Array, Float
from tribodyn.post.figures.gears_in_mesh import MILLIMETRE
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.carried_sets import CarriedSet, sets_of
from tribodyn.studies.motion.drivetrain.gear_positions import GearOutline, gear_outlines
from tribodyn.studies.motion.drivetrain.shaft_lines import rounded_down
from tribodyn.train.elastic.ring import PER_ORDER

#: Largest displacement as drawn, as a share of the radius; angles about the ring; moments beside each other.
_BENT, _ANGLES, _MOMENTS = 0.12, 721, 6
#: A pin as drawn, and half of what is seen, as shares of the radius.
_PIN, _SEEN = 0.05, 1.2


def has_waves(record: Record) -> bool:
    """Whether a record holds what a rim does."""
    return "rim_wave" in record and "wave_ring" in record.geometry


def bent_rim(record: Record, ring: int, angle: Float[Array, " angle"]) -> Float[Array, "time 2 angle"]:
    """How the outside of a ring's rim moves outwards and along the circle, m, at angles of the carrier."""
    own = np.asarray(record.geometry["wave_ring"], int) == ring
    order = np.asarray(record.geometry["wave_order"])[own][::PER_ORDER, None]
    cosine, sine = np.cos(order * angle), np.sin(order * angle)
    out, along, other_out, other_along = np.moveaxis(
        record["rim_wave"][:, own].reshape(-1, len(order), PER_ORDER), 2, 0
    )
    return np.stack([out @ cosine + other_out @ sine, along @ sine - other_along @ cosine], axis=1)


def ring_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw of the first record every rim at the end of the run, and what it moves outwards over its angle.

    The moments of the latter lie in the last pass of a pin under a planet, or in the last turn of the carrier
    against the ring where no pins are.
    """
    record = records[0]
    rings = [
        (gearset, body)
        for gearset in sets_of(record)
        for body in gearset.meshes
        if body in set(np.asarray(record.geometry["wave_ring"], int).tolist())
    ]
    outlines = {gear.body: gear for gear in gear_outlines(record)}
    figure = new_figure(WIDTH, 3.3 * len(rings) + 0.3)
    rows = figure.subplots(len(rings), 2, squeeze=False, width_ratios=(1.0, 1.15))
    for number, (gearset, body) in enumerate(rings):
        angle = np.linspace(0.0, 2.0 * np.pi, _ANGLES)
        moved = bent_rim(record, body, angle)
        name = literal(str(record["body"][body]))
        times = _draw_ring(rows[number, 0], record, gearset, outlines[body], angle, moved[-1], outlines)
        letters = "abcdefgh"[2 * number : 2 * number + 2]
        mark_panel(rows[number, 0], letters[0], f"{name}, bent × {times:g}")
        _draw_over_angle(rows[number, 1], record, gearset, body, angle, moved[:, 0])
        mark_panel(rows[number, 1], letters[1], f"{name}: outwards; dashed: planets")
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


def _turned(record: Record, body: int) -> Float[Array, " time"]:
    """Rotation of a ring against its carrier, rad."""
    own = record.geometry["sense"][body] * record.over_bodies("angle")[:, body]
    return own - record.geometry["carried"][body] * record["reference_angle"]


def _draw_ring(
    axes: Axes,
    record: Record,
    gearset: CarriedSet,
    ring: GearOutline,
    angle: Float[Array, " angle"],
    moved: Float[Array, "2 angle"],
    outlines: dict[int, GearOutline],
) -> float:
    """Draw a rim without and with its waves, planets and pins; by how much displacements are larger."""
    outside, root = ring.outside / MILLIMETRE, float(np.max(np.hypot(*ring.outline.T))) / MILLIMETRE
    largest = float(np.max(np.hypot(*moved))) / MILLIMETRE
    times = rounded_down(_BENT * outside / largest) if largest > 0.0 else 1.0
    cosine, sine = np.cos(angle), np.sin(angle)
    for radius, width in ((outside, 0.9), (root, 0.5)):
        axes.plot(radius * cosine, radius * sine, color=QUIET, linewidth=width, linestyle="--")
        out, along = times * moved / MILLIMETRE
        x, y = (radius + out) * cosine - along * sine, (radius + out) * sine + along * cosine
        axes.plot(x, y, color=PALETTE[0], linewidth=2.0 * width)
    centre = record.geometry["centre"]
    for planet in gearset.planets:
        x, y = (centre[planet] - centre[gearset.carrier]) / MILLIMETRE
        radius = outlines[planet].outside / MILLIMETRE
        axes.plot(x + radius * cosine, y + radius * sine, color=PALETTE[1], linewidth=0.8)
    pins = int(record.geometry["wave_pins"][np.asarray(record.geometry["wave_ring"], int) == ring.body][0])
    for pin in _turned(record, ring.body)[-1] + 2.0 * np.pi * np.arange(pins) / max(pins, 1):
        ends = np.array([outside, (1.0 + _PIN) * outside])
        axes.plot(ends * np.cos(pin), ends * np.sin(pin), color=INK, linewidth=2.0)
    axes.set_xlim(-_SEEN * outside, _SEEN * outside)
    axes.set_ylim(-_SEEN * outside, _SEEN * outside)
    axes.set_aspect("equal")
    axes.set_xlabel("x (mm)")
    axes.set_ylabel("y (mm)")
    return times


def _draw_over_angle(
    axes: Axes,
    record: Record,
    gearset: CarriedSet,
    body: int,
    angle: Float[Array, " angle"],
    out: Float[Array, "time angle"],
) -> None:
    turned = _turned(record, body)
    own = np.asarray(record.geometry["wave_ring"], int) == body
    pass_angle = 2.0 * np.pi / max(int(record.geometry["wave_pins"][own][0]), 1)
    back = np.abs(turned - turned[-1])
    for moment, share in enumerate(np.linspace(1.0, 0.0, _MOMENTS)):
        sample = int(np.argmin(np.abs(back - share * min(pass_angle, float(back[0])))))
        color = colormaps["viridis"](0.92 * moment / (_MOMENTS - 1))
        label = f"{record['time'][sample] * 1e3:.4g} ms"
        axes.plot(np.degrees(angle), out[sample] * 1e6, color=color, linewidth=1.0, label=label)
    centre = record.geometry["centre"]
    for planet in gearset.planets:
        x, y = centre[planet] - centre[gearset.carrier]
        axes.axvline(
            float(np.degrees(np.arctan2(y, x)) % 360.0), color=PALETTE[1], linewidth=0.8, linestyle="--"
        )
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks(range(0, 361, 60))
    axes.set_xlabel("Angle from x of the carrier (°)")
    axes.set_ylabel("outwards (µm)")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=3, fontsize=6)
