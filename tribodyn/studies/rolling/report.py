"""Reported quantities of a gear with rolling elements, and how far to trust them."""

from tribodyn.post.report import on_energy
from tribodyn.post.verdict import lost, numbers, share, with_unit
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": quantities("ratio", "eccentricity"),
    "Dynamics": quantities(
        *("mesh_frequency", "normal_load_max", "elements_loaded_min", "elements_loaded_max"),
        *("output_torque_mean", "output_torque_peak_to_peak"),
    ),
    "Tribology": quantities("slip_speed_max", "spin_speed_max"),
    "Energy": quantities(
        "power_in_mean", "power_friction_mean", "power_cam_mean", "power_crown_mean", "efficiency"
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = quantities(
    *("efficiency", "efficiency_by_energy"),
    *("normal_load_max", "slip_speed_max", "spin_speed_max"),
    *("output_torque_mean", "output_torque_peak_to_peak"),
    *("power_friction_mean", "power_cam_mean", "power_crown_mean"),
)

#: What the modes amount to.
MODES = {
    "corrected": "Mode corrected: motion in time over one revolution, speeds relative to the eccentric, "
    "efficiency by energy.",
    "as_published": "Mode as_published: the paper's position and printed formulas; slip and spin too small "
    "by (Z2 + 1)/2, slip lowers the loss, efficiency is the product (23). A reference, not a prediction.",
}

PANELS = ("normal_load", "slip_speed", "power_friction", "efficiency")


def verdict(record: Record) -> list[str]:
    """Say what the elements carry, how even the output is, what is lost, and whether it is a prediction."""
    summary, found = numbers(record.summary), []
    if {"normal_load_max", "elements_loaded_min"} <= set(summary):
        load, fewest = (
            with_unit("normal_load_max", summary["normal_load_max"]),
            summary["elements_loaded_min"],
        )
        found.append(
            f"At least {fewest:.0f} elements carry; the one that carries most is pressed with {load}."
        )
    if {"output_torque_mean", "output_torque_peak_to_peak"} <= set(summary):
        mean, swing = summary["output_torque_mean"], summary["output_torque_peak_to_peak"]
        even = f", {share(swing / abs(mean))} of it" if mean else ""
        torque = with_unit("output_torque_mean", mean)
        swings = with_unit("output_torque_peak_to_peak", swing)
        found.append(f"The output gives {torque} on the mean and swings by {swings}{even}.")
    found += lost(summary)
    if record.summary.get("mode") == "as_published":
        found.append("These are a paper's printed formulas, a reference and no prediction.")
        found.append('To do: mode = "corrected" gives the motion with the right speeds and its efficiency.')
    return found


def sentences(record: Record) -> list[str]:
    """Say what the mode amounts to, and how well the energy balance closes."""
    summary = record.summary
    mode = [MODES[summary["mode"]]] if "mode" in summary else []
    return [*mode, *on_energy(summary)]
