"""Lines and sentences of the summary of a gear with rolling elements, and the figures that a sweep keeps."""

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines, on_energy
from tribodyn.record.reader import Record

LINES: Lines = {
    "Geometry": (
        Line(
            "ratio",
            "Ratio of input to cam, which turns the other way",
            definition="Speed of the input over that of the cam.",
        ),
        Line(
            "eccentricity",
            "Eccentricity",
            1e3,
            "mm",
            definition="Distance of the cage's axis from that of the shaft.",
        ),
    ),
    "Dynamics": (
        Line(
            "mesh_frequency",
            "Mesh frequency",
            1.0,
            "Hz",
            definition="Elements that pass a tooth of the cam per second.",
        ),
        Line(
            "normal_load_max",
            "Maximum normal load",
            1.0,
            "N",
            ",.0f",
            definition="Maximum of a single element over the run, on the cam.",
        ),
        Line(
            "elements_loaded_min",
            "Loaded elements, at least",
            form="d",
            definition="Minimum over the run of the number of elements under load.",
        ),
        Line(
            "elements_loaded_max",
            "Loaded elements, at most",
            form="d",
            definition="Maximum over the run of the number of elements under load.",
        ),
        Line(
            "output_torque_mean",
            "Torque on the load, mean",
            1.0,
            "N m",
            definition="Mean torque that the cam gives to the load.",
        ),
        Line(
            "output_torque_peak_to_peak",
            "Torque on the load, peak to peak",
            1.0,
            "N m",
            ".3g",
            definition="Maximum less minimum of the same.",
        ),
    ),
    "Tribology": (
        Line(
            "slip_speed_max",
            "Maximum slip over the cam",
            1e3,
            "mm/s",
            definition="Maximum speed of an element's surface over that of the cam.",
        ),
        Line(
            "spin_speed_max",
            "Maximum rotation of an element in the cage",
            1.0,
            "rad/s",
            definition="Maximum rotation of an element relative to the cage.",
        ),
    ),
    "Energy": (
        Line("power_in_mean", "Power in, mean", 1.0, "W", ",.1f", definition="Mean power of the shaft."),
        Line(
            "power_friction_mean",
            "Friction loss, mean",
            1.0,
            "W",
            ".3g",
            definition="Mean power lost in all contacts.",
        ),
        Line(
            "power_cam_mean",
            "of it at the cam",
            1.0,
            "W",
            ".3g",
            definition="Part of it that slip between elements and cam takes.",
        ),
        Line(
            "power_crown_mean",
            "of it at the crown",
            1.0,
            "W",
            ".3g",
            definition="Part of it that rolling on the crown takes.",
        ),
        Line(
            "efficiency",
            "Efficiency",
            100.0,
            "%",
            ".2f",
            definition="Power out over power in, by energy; in the mode as_published the product (23) of "
            "the paper.",
        ),
    ),
    "Solver": (
        Line(
            "wall_time",
            "Wall time",
            1.0,
            "s",
            ".3g",
            definition="Time that the computation took, without start and drawing.",
        ),
    ),
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
