"""Lines and sentences of the summary of a gear pair's dynamics."""

from collections.abc import Mapping
from typing import Any

from tribodyn.post.report import Line, Lines, on_closures, on_energy, on_methods, shown
from tribodyn.record.reader import Record
from tribodyn.studies.gear_pair.sweep_layout import FIGURES
from tribodyn.studies.gears.shared import (
    CONTACT_RATIO,
    ENERGY,
    MESH_FREQUENCY,
    NORMAL_LOAD,
    SINGLE_PAIR,
    THERMAL,
    TRIBOLOGY,
    WALL_TIME,
)

LINES: Lines = {
    "Geometry": (
        CONTACT_RATIO,
        Line(
            "normal_backlash",
            "Normal backlash",
            1e3,
            "mm",
            definition="Between the back flanks at the pitch point: of mesh.backlash, or of centre distance "
            "and tooth thickness.",
        ),
        SINGLE_PAIR,
    ),
    "Dynamics": (
        MESH_FREQUENCY,
        Line(
            "transmission_error_mean",
            "Transmission error, mean",
            1e6,
            "µm",
            definition="Mean of the dynamic transmission error of the newest pair along its normal.",
        ),
        Line(
            "transmission_error_peak_to_peak",
            "Transmission error, peak to peak",
            1e6,
            "µm",
            definition="Maximum less minimum of the same, between the samples too.",
        ),
        Line(
            "transmission_error_harmonics",
            "Transmission error, orders 1 to 5 of the mesh",
            1e6,
            "µm",
            ".3g",
            "Amplitudes of the rotational transmission error r_p θ_p − r_g θ_g at 1 to 5 times the mesh "
            "frequency.",
            listed=True,
        ),
        Line(
            "mesh_stiffness_mean",
            "Mesh stiffness of all pairs, mean",
            1e-6,
            "N/µm",
            definition="Mean of Σ k cos² α over the loaded pairs: the stiffness along the pitch tangent, "
            "of pairs with "
            "stiffness k along normals at the angle α.",
        ),
        Line(
            "mesh_stiffness_peak_to_peak",
            "Mesh stiffness of all pairs, peak to peak",
            1e-6,
            "N/µm",
            definition="Maximum less minimum of the same, in the samples.",
        ),
        NORMAL_LOAD,
        Line(
            "dynamic_factor",
            "Dynamic factor K_v",
            form=".3f",
            definition="Maximum of the loads' moment over that of the mean load, from the motion.",
        ),
        Line(
            "dynamic_factor_iso",
            "Dynamic factor K_v by ISO 6336-1, method B",
            form=".3f",
            definition="From formulas for the deviations of the drive's quality, K_A = 1, no tip relief "
            "credited; involutes with a quality only.",
        ),
        Line(
            "resonance_ratio_iso",
            "at the resonance ratio N",
            form=".3f",
            definition="Speed over the resonance speed of the standard, rigid bearings; 0.85 to 1.15 is the "
            "main resonance.",
        ),
        Line(
            "contact_loss_fraction",
            "Time without contact",
            100.0,
            "%",
            ".3g",
            "Share of the samples in which no pair carries load.",
        ),
    ),
    "Tribology": TRIBOLOGY,
    "Energy": ENERGY,
    "Temperature": THERMAL,
    "Solver": (
        Line("solver", "Method", definition="Method of integration, chosen or by solver.method."),
        Line("steps", "Steps", form=",d", definition="Steps of the integration."),
        Line(
            "rhs_evaluations",
            "Right-hand sides",
            form=",d",
            definition="Evaluations of the equations of motion.",
        ),
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


#: Relative difference between the extremes of the whole run and those of its last cycles that is said.
DIFFERENT = 0.005

SHORT = {"peak_to_peak": "transmission_error_peak_to_peak", "loss": "power_friction_mean"}

PANELS = (
    "transmission_error_rotational",
    "normal_load",
    "central_film_thickness",
    "friction_coefficient",
    "power_friction",
)


def on_extremes(summary: Mapping[str, Any]) -> list[str]:
    """Say which extremes of the whole run, or of its last mesh cycles, are not those of the table."""
    described = summary.get("extremes")
    if not described:  # a record of 0.1.0, or of a run that stopped at once
        return []
    said = []
    for part, words in (("run", "Over the whole run"), ("last_cycles", "Over the last mesh cycles")):
        others = []
        for line in (NORMAL_LOAD, *TRIBOLOGY):
            known, value = described.get(part, {}).get(line.name), summary.get(line.name)
            if known is None or value is None or not abs(known["value"] - value) > DIFFERENT * abs(value):
                continue
            name = line.label[0].lower() + line.label[1:]
            at = f" at t = {known['time']:.4g} s" if part == "run" and "time" in known else ""
            others.append(f"{name} {shown(line, known['value'])} {line.unit}".rstrip() + at)
        if others:
            said.append(f"{words}: {', '.join(others)}.")
    return said


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_extremes(summary), *on_closures(summary), *on_energy(summary)]
