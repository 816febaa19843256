"""Lines and sentences of the summary of a gear pair's dynamics."""

from collections.abc import Mapping
from typing import Any

from tribodyn.post.report import Line, Lines, on_closures, on_energy, on_methods, shown
from tribodyn.record.reader import Record
from tribodyn.studies.gear_pair.sweep_layout import FIGURES
from tribodyn.studies.gears import (
    CONTACT_RATIO,
    ENERGY,
    MESH_FREQUENCY,
    NORMAL_LOAD,
    SINGLE_PAIR,
    TRIBOLOGY,
    WALL_TIME,
)

LINES: Lines = {
    "Geometry": (CONTACT_RATIO, SINGLE_PAIR),
    "Dynamics": (
        MESH_FREQUENCY,
        Line("transmission_error_mean", "Transmission error, mean", 1e6, "µm"),
        Line("transmission_error_peak_to_peak", "Transmission error, peak to peak", 1e6, "µm"),
        NORMAL_LOAD,
        Line("dynamic_factor", "Dynamic factor", form=".3f"),
        Line("contact_loss_fraction", "Time without contact", 100.0, "%", ".3g"),
    ),
    "Tribology": TRIBOLOGY,
    "Energy": ENERGY,
    "Solver": (
        Line("solver", "Method"),
        Line("steps", "Steps", form=",d"),
        Line("rhs_evaluations", "Right-hand sides", form=",d"),
        WALL_TIME,
    ),
}


SWEPT = FIGURES

#: What a sweep prints, minimum and maximum of each.
SWEEP_LINES = (
    Line("transmission_error_rms", "Transmission error, RMS", 1e6, "µm"),
    Line("transmission_error_peak_to_peak", "Transmission error, peak to peak", 1e6, "µm"),
    Line("dynamic_factor", "Dynamic factor", form=".3f"),
    Line("normal_load_max", "Maximum normal load", form=",.0f", unit="N"),
    Line("hertz_pressure_max", "Maximum Hertz pressure", 1e-9, "GPa", ".3g"),
    Line("film_min", "Minimum film thickness", 1e6, "µm", ".3g"),
    Line("efficiency", "Efficiency", 100.0, "%", ".3f"),
    Line("friction_work_on_vibration", "Friction's work on the vibration", 100.0, "%", ".2g"),
    Line("contact_loss_fraction", "Time without contact", 100.0, "%", ".3g"),
)


#: Difference between the extremes of the run and those of its last cycles that is said.
DIFFERENT = 0.005

PANELS = (
    "transmission_error_rotational",
    "normal_load",
    "central_film_thickness",
    "friction_coefficient",
    "power_friction",
)


def on_extremes(summary: Mapping[str, Any]) -> list[str]:
    """Say which extremes of the whole run are not those of its last mesh cycles, and what the latter are."""
    described = summary.get("extremes")
    if not described:  # a record of 0.1.0, or of a run that stopped at once
        return []
    run, last = described.get("run", {}), described.get("last_cycles", {})
    parts = []
    for line in (NORMAL_LOAD, *TRIBOLOGY):
        if line.name not in run or line.name not in last:
            continue
        value = last[line.name]["value"]
        if abs(run[line.name]["value"] - value) > DIFFERENT * abs(value):
            name = line.label[0].lower() + line.label[1:]
            parts.append(f"{name} {shown(line, value)} {line.unit}".rstrip())
    if not parts:
        return []
    return [f"Extremes are over the whole run. Over the cycles of the means: {', '.join(parts)}."]


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_extremes(summary), *on_closures(summary), *on_energy(summary)]
