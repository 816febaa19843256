"""Reported quantities of a map, how far it holds, and its page."""

from tribodyn.cases.loss_part import TERMS
from tribodyn.post.verdict import numbers, share, watts, with_unit
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.study import TextTable

REPORTED: Reported = {
    "Map": quantities("map_points", "map_points_evaluated", "map_error_max", "map_error_mean"),
    "Losses": quantities(
        *("own_torque", "own_speed", "own_power_loss", "efficiency_own"),
        *("efficiency_max", "power_loss_max", "stall_drag_max", "backlash_output"),
    ),
    "Solver": quantities("wall_time"),
}
SWEPT = quantities(
    *("own_power_loss", "efficiency_own", "efficiency_max", "power_loss_max", "stall_drag_max"),
    *("map_points", "map_error_max"),
)
SHORT = {"loss": "own_power_loss", "efficiency": "efficiency_own"}


def verdict(record: Record) -> list[str]:
    """Say what the gearbox loses at its own point, where it is best, and how well the map holds."""
    summary, lines = numbers(record.summary), []
    if {"own_power_loss", "own_torque", "own_speed"} <= set(summary):
        at = " and ".join(with_unit(name, summary[name]) for name in ("own_torque", "own_speed"))
        lost = watts(summary["own_power_loss"])
        best = summary.get("efficiency_own")
        known = f", an efficiency of {100.0 * best:.2f} %" if best is not None else ""
        lines.append(f"At its own {at} the gearbox loses {lost}{known}.")
    own = numbers(record.summary.get("own_losses"))
    if own and sum(own.values()) > 0.0:
        term = max(own, key=lambda name: own[name])
        part = share(own[term] / sum(own.values()))
        how_much = f"Most of it, {part}," if part != share(1.0) else "All of it"
        lines.append(f"{how_much} is lost by {TERMS.get(term, term)} ({term}).")
    if (best := summary.get("efficiency_max")) is not None:
        lines.append(f"The highest efficiency on the map is {100.0 * best:.2f} %.")
    if (drag := summary.get("stall_drag_max")) is not None:
        lines.append(
            f"At a standstill friction takes up to {with_unit('stall_drag_max', drag)} at the input."
        )
    if "map_error_max" in summary:
        worst, mean = (share(summary[name]) for name in ("map_error_max", "map_error_mean"))
        held, asked = record.summary.get("accuracy_held"), record.summary.get("accuracy")
        more = ": further values are not asked for, map.accuracy" if asked == 0.0 else ""
        more = more or ("" if held else ": allow more points, map.most_points")
        lines.append(
            f"Between its points the map misses the loss by {worst} at most, {mean} on the mean{more}."
        )
    return lines


def sentences(record: Record) -> list[str]:
    """Say what the errors are shares of, and which formulas are used beyond their limits."""
    lines = [
        "Losses are those of steady motion, without vibration.",
        "At a standstill the drag is the limit from a slow motion: friction acts against the motion to come.",
        "The misses are shares of the drag at points in between that the grid does not rest on; a drag below "
        "2 % of the largest over the torque counts as that.",
    ]
    if chosen := record.summary.get("chosen"):
        laws = ", ".join(f'{key} = "{name}"' for key, name in chosen.items())
        lines.append(f'Everywhere with {laws}, chosen at its own point; "auto" may choose others elsewhere.')
    exceeded = record.summary.get("exceeded") or {}
    lines += [
        f"Beyond the limits of its formula somewhere on the map: {name}, {why}."
        for name, why in exceeded.items()
    ]
    return lines


def tables(record: Record) -> list[TextTable]:
    """Losses by term at the gearbox's own point."""
    own = numbers(record.summary.get("own_losses"))
    total = sum(own.values())
    rows = [
        (term, TERMS.get(term, ""), f"{value:.4g}", f"{100.0 * value / total:.3g}")
        for term, value in own.items()
        if value > 0.0
    ]
    return [TextTable("Losses at its own point", ("term", "of", "W", "%"), rows)] if rows else []
