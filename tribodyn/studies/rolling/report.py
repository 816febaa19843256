"""Lines and sentences of the summary of a gear with rolling elements, and the figures that a sweep keeps."""

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines, on_energy
from tribodyn.record.reader import Record

LINES: Lines = {
    "Geometry": (
        Line("ratio", "Ratio of input to cam, which turns the other way"),
        Line("eccentricity", "Eccentricity", 1e3, "mm"),
    ),
    "Dynamics": (
        Line("mesh_frequency", "Mesh frequency", 1.0, "Hz"),
        Line("normal_load_max", "Maximum normal load", 1.0, "N", ",.0f"),
        Line("elements_loaded_min", "Loaded elements, at least", form="d"),
        Line("elements_loaded_max", "Loaded elements, at most", form="d"),
        Line("output_torque_mean", "Torque on the load, mean", 1.0, "N m"),
        Line("output_torque_peak_to_peak", "Torque on the load, peak to peak", 1.0, "N m", ".3g"),
    ),
    "Tribology": (
        Line("slip_speed_max", "Maximum slip over the cam", 1e3, "mm/s"),
        Line("spin_speed_max", "Maximum rotation of an element in the cage", 1.0, "rad/s"),
    ),
    "Energy": (
        Line("power_in_mean", "Power in, mean", 1.0, "W", ",.1f"),
        Line("power_friction_mean", "Friction loss, mean", 1.0, "W", ".3g"),
        Line("power_cam_mean", "of it at the cam", 1.0, "W", ".3g"),
        Line("power_crown_mean", "of it at the crown", 1.0, "W", ".3g"),
        Line("efficiency", "Efficiency", 100.0, "%", ".2f"),
    ),
    "Solver": (Line("wall_time", "Wall time", 1.0, "s", ".3g"),),
}

SWEPT: dict[str, Variable] = {
    "efficiency": Variable((), "1", "efficiency"),
    "efficiency_by_energy": Variable((), "1", "efficiency by energy"),
    "normal_load_max": Variable((), "N", "maximum normal load of an element"),
    "slip_speed_max": Variable((), "m/s", "maximum slip over the cam"),
    "spin_speed_max": Variable((), "rad/s", "maximum rotation of an element in the cage"),
    "output_torque_mean": Variable((), "N*m", "mean torque on the load"),
    "output_torque_peak_to_peak": Variable((), "N*m", "torque on the load, peak to peak"),
    "power_friction_mean": Variable((), "W", "mean power lost in all contacts"),
    "power_cam_mean": Variable((), "W", "mean power lost at the cam"),
    "power_crown_mean": Variable((), "W", "mean power lost at the crown"),
}

#: What the modes amount to.
MODES = {
    "corrected": "Mode corrected: motion in time over one revolution, speeds relative to the eccentric, "
    "efficiency by energy.",
    "as_published": "Mode as_published: the paper's position and printed formulas; slip and spin too small "
    "by (Z2 + 1)/2, slip lowers the loss, efficiency is the product (23). A reference, not a prediction.",
}

PANELS = ("normal_load", "slip_speed", "power_friction", "efficiency")


def sentences(record: Record) -> list[str]:
    """Say what the mode amounts to, and how well the energy balance closes."""
    summary = record.summary
    mode = [MODES[summary["mode"]]] if "mode" in summary else []
    return [*mode, *on_energy(summary)]
