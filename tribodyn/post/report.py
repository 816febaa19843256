"""The summary of a record: a table for people, a dictionary for programs."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from tribodyn.record.reader import Record


class Line(NamedTuple):
    """A line of the table: summary name, what it is called, factor from SI, unit, format of the number."""

    name: str
    label: str
    factor: float = 1.0
    unit: str = ""
    form: str = ".4g"


#: Groups of the table, in order. Names that a summary lacks are left out.
GROUPS: dict[str, tuple[Line, ...]] = {
    "Geometry": (
        Line("ratio", "Ratio of input to cam, which turns the other way"),
        Line("eccentricity", "Eccentricity", 1e3, "mm"),
        Line("contact_ratio", "Contact ratio", form=".4f"),
        Line("contact_ratio_effective", "Contact ratio under load, corner contact included", form=".4f"),
        Line(
            "stiffness_single_pair_at_pitch_point", "Stiffness of one pair at the pitch point", 1e-6, "N/µm"
        ),
    ),
    "Load contact": (
        Line("gear_torque", "Torque on the gear", 1.0, "N m"),
        Line("loaded_transmission_error_mean", "Loaded transmission error, mean", 1e6, "µm"),
        Line("loaded_transmission_error_peak_to_peak", "Loaded transmission error, peak to peak", 1e6, "µm"),
        Line("unloaded_transmission_error_peak_to_peak", "Unloaded, peak to peak", 1e6, "µm", ".3g"),
        Line("least_peak_to_peak", "Least peak to peak of all torques", 1e6, "µm"),
        Line("least_peak_to_peak_torque", "at a torque on the gear of", 1.0, "N m"),
        Line("mesh_stiffness_mean", "Mesh stiffness, mean", 1e-6, "N/µm"),
        Line("mesh_stiffness_peak_to_peak", "Mesh stiffness, peak to peak", 1e-6, "N/µm", ".3g"),
        Line("line_load_max", "Greatest line load", 1e-3, "N/mm"),
        Line("face_load_factor", "Face load factor there", form=".3f"),
        Line("face_load_factor_pitch_point", "Face load factor at the pitch point", form=".3f"),
        Line("pinion_root_tension_max", "Greatest root tension, pinion", 1e-6, "MPa"),
        Line("gear_root_tension_max", "Greatest root tension, gear", 1e-6, "MPa"),
        Line("pinion_root_compression_max", "Greatest root compression, pinion", 1e-6, "MPa"),
        Line("gear_root_compression_max", "Greatest root compression, gear", 1e-6, "MPa"),
    ),
    "Response": (
        Line("points", "Points, up and down", form="d"),
        Line("points_of_longer_period", "with a longer period than the excitation's", form="d"),
        Line("points_not_periodic", "not periodic", form="d"),
        Line("points_failed", "grown without bound", form="d"),
        Line("rms_max", "Greatest RMS about the mean, in half backlashes"),
        Line("rms_max_frequency", "at the frequency"),
        Line("contact_loss_from", "Contact is lost from the frequency"),
        Line("contact_loss_to", "to the frequency"),
        Line("contact_loss_fraction_max", "for at most, of the time", 100.0, "%", ".3g"),
        Line("back_contact_fraction_max", "Contact on the back side, at most", 100.0, "%", ".3g"),
        Line("bistable_from", "Up and down differ from the frequency"),
        Line("bistable_to", "to the frequency"),
    ),
    "Dynamics": (
        Line("mesh_frequency", "Mesh frequency", 1.0, "Hz"),
        Line("transmission_error_mean", "Transmission error, mean", 1e6, "µm"),
        Line("transmission_error_peak_to_peak", "Transmission error, peak to peak", 1e6, "µm"),
        Line("normal_load_max", "Greatest normal load", 1.0, "N", ",.0f"),
        Line("elements_loaded_min", "Loaded elements, at least", form="d"),
        Line("elements_loaded_max", "Loaded elements, at most", form="d"),
        Line("output_torque_mean", "Torque on the load, mean", 1.0, "N m"),
        Line("output_torque_peak_to_peak", "Torque on the load, peak to peak", 1.0, "N m", ".3g"),
        Line("dynamic_factor", "Dynamic factor", form=".3f"),
        Line("contact_loss_fraction", "Time without contact", 100.0, "%", ".3g"),
    ),
    "Tribology": (
        Line("slip_speed_max", "Greatest slip over the cam", 1e3, "mm/s"),
        Line("spin_speed_max", "Greatest rotation of an element in the cage", 1.0, "rad/s"),
        Line("film_min", "Least film thickness", 1e6, "µm", ".3g"),
        Line("film_parameter_min", "Least film parameter", form=".3g"),
        Line("hertz_pressure_max", "Greatest Hertz pressure", 1e-9, "GPa", ".3g"),
        Line("flash_temperature_max", "Greatest flash temperature rise", 1.0, "K", ".3g"),
        Line("friction_coefficient_mean", "Friction coefficient, mean", form=".4f"),
        Line("friction_force_mean", "Friction force, mean over the cycle", 1.0, "N", ".1f"),
    ),
    "Energy": (
        Line("power_in_mean", "Power in, mean", 1.0, "W", ",.1f"),
        Line("power_friction_mean", "Friction loss, mean", 1.0, "W", ".3g"),
        Line("power_cam_mean", "of it at the cam", 1.0, "W", ".3g"),
        Line("power_crown_mean", "of it at the crown", 1.0, "W", ".3g"),
        Line("efficiency", "Efficiency", 100.0, "%", ".2f"),
        Line("load_sharing", "Load sharing of the samples"),
        Line("efficiency_elastic", "Efficiency, elastic load sharing", 100.0, "%", ".3f"),
        Line("efficiency_uniform", "Efficiency, equal loads", 100.0, "%", ".3f"),
        Line("efficiency_single_pair", "Efficiency, one pair at a time", 100.0, "%", ".3f"),
        Line("efficiency_torque_ratio", "Efficiency, torque ratio of one pair", 100.0, "%", ".3f"),
        Line("efficiency_loss_factor", "Efficiency, loss factor integrated", 100.0, "%", ".3f"),
        Line("efficiency_hoehn", "Efficiency, Höhn's loss factor", 100.0, "%", ".3f"),
    ),
    "Solver": (
        Line("solver", "Method"),
        Line("steps", "Steps", form=",d"),
        Line("rhs_evaluations", "Right-hand sides", form=",d"),
        Line("wall_time", "Wall time", 1.0, "s", ".3g"),
    ),
}


#: What the modes of a gear with rolling elements amount to.
MODES = {
    "corrected": "Mode corrected: motion in time over one revolution, speeds relative to the eccentric, "
    "efficiency by energy.",
    "as_published": "Mode as_published: the paper's position and printed formulas; slip and spin too small "
    "by (Z2 + 1)/2, slip lowers the loss, efficiency is the product (23). A reference, not a prediction.",
}


def summary_table(record: Record) -> Group:
    """Lay out the summary of a record for the terminal (a rich renderable), in engineers' units."""
    title = Text(str(record.scenario.get("title", record.path.stem)), style="bold")
    parts: list[Any] = [title]
    if record.status != "complete":
        parts.append(Text(f"{record.status}: {record.message}", style="bold red"))
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(no_wrap=True)
    table.add_column(justify="right")
    table.add_column(no_wrap=True)
    for group, lines in GROUPS.items():
        present = [line for line in lines if record.summary.get(line.name) is not None]
        if not present:
            continue
        table.add_row(Text(group, style="bold cyan"), "", "")
        for line in present:
            label, unit = line.label, line.unit
            if np.ndim(record.summary[line.name]):
                label += f", pairs {', '.join(str(pair) for pair in reversed(record.pairs))}"
            table.add_row(f"  {label}", shown(line, record.summary[line.name]), unit)
    parts.append(table)
    parts.append(Text("How far to trust it", style="bold cyan"))
    parts += [Text(f"  {sentence}") for sentence in trust(record)]
    return Group(*parts)


def shown(line: Line, value: Any) -> str:
    """Write one value in its unit; the values of pairs from pair 1 on."""
    if isinstance(value, str):
        return value
    if np.ndim(value):
        return " / ".join(shown(line, item) for item in reversed(np.asarray(value).tolist()))
    if isinstance(value, float) and not math.isfinite(value):
        return "–"
    number = value * line.factor if line.factor != 1.0 else value
    return format(int(number) if line.form.endswith("d") else number, line.form)


def _other_ranges(summary: Mapping[str, Any]) -> list[str]:
    """Sentences on the ranges of laws, where the record names its laws."""
    sentences = []
    if summary.get("film_thickness") == "minimum":
        sentences.append(f"The film is the minimum film, which {summary['film_law']} gives.")
    if summary.get("film_range") == "none stated":
        sentences.append(f"The film law {summary['film_law']} states no range of validity.")
    friction, name = summary.get("friction_in_range_fraction"), summary.get("friction_law")
    if friction is not None and not (friction >= 1):
        sentences.append(
            f"The friction law {name} is inside its range in {_percent(friction)} of the contact; "
            "the rest is extrapolated, see friction_in_range."
        )
    elif friction is None and name not in (None, "none"):
        sentences.append(f"The friction law {name} states no range of validity.")
    return sentences


def trust(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    sentences = [MODES[summary["mode"]]] if "mode" in summary else []
    if "solver" in summary and "solver_reason" in summary:
        sentences.append(f"Solved by {summary['solver']} ({summary['solver_reason']}).")
    cycles = summary.get("averaging_cycles")
    if cycles is not None:
        sentences.append(f"Means are over the last {cycles} mesh cycle{'s' if cycles != 1 else ''}.")
    fraction = summary.get("closure_in_range_fraction")
    if fraction is not None:
        outside = "" if fraction >= 1 else "; the rest is extrapolated, see closure_in_range"
        sentences.append(
            f"The film law is inside its fitted range in {_percent(fraction)} of the contact{outside}."
        )
    sentences += _other_ranges(summary)
    if summary.get("pitch_point", "regular") != "regular":
        sentences.append(f"At the pitch point {summary['pitch_point']}; pressure there is no merit figure.")
    if summary.get("residual_max") is not None and "points" in summary:
        sentences.append(f"Periodic motions close within {summary['residual_max']:.1e} of half a backlash.")
    sentences += [f"At {summary[name]}." for name in sorted(summary) if name.startswith("remark_")]
    if "remarks_more" in summary:
        sentences.append(f"And {summary['remarks_more']} more points that are not periodic or failed.")
    slices = summary.get("slices")
    if slices is not None:
        what = "in one piece, alike all along" if slices == 1 else f"in {slices} slices"
        sentences.append(f"Slow rotation, no inertia; the face is taken {what}.")
    residual = summary.get("torque_residual")
    if residual is not None:
        sentences.append(f"The loads carry the torque to within {abs(residual):.1e} of it.")
    residual = summary.get("energy_residual")
    if residual is not None and math.isfinite(residual):
        sentences.append(f"The energy balance closes within {abs(residual):.1e} of the work put in.")
    if record.status != "complete":
        sentences.append(f"The run is {record.status}: {record.samples} samples were written.")
    return sentences or ["The record has no summary."]


def _percent(fraction: float) -> str:
    """Write a share in per cent, 100 only when it is whole."""
    percent = 100 * fraction
    return f"{math.floor(percent * 10) / 10:.1f} %" if fraction < 1 else "100 %"


def as_json(record: Record) -> dict[str, Any]:
    """Turn a record's head and summary, SI units, into what `json.dumps` takes; NaN becomes None."""
    head = ("created", "tribodyn_version", "scenario_sha256")
    return {
        "record": str(record.path),
        "title": record.scenario.get("title", ""),
        "status": record.status,
        "message": record.message,
        **{name: record.attrs[name] for name in head},
        "samples": record.samples,
        **({"elements": len(record.elements)} if record.elements else {"pairs": list(record.pairs)}),
        "summary": _plain(record.summary),
    }


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
