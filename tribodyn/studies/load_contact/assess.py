"""The part in an assessment: loaded error, loads, pressures and root stresses on finite elements."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.cases.assessment_part import (
    TEETH,
    Contribution,
    Findings,
    ReportCurve,
    Request,
    Task,
    TaskResult,
    of_teeth,
)
from tribodyn.record.reader import Record
from tribodyn.standards.load_factors import transverse_load_factor
from tribodyn.studies.load_contact import STUDY
from tribodyn.studies.load_contact.run import ALONG, highest_over_face

_TASK, _DEVIATING, _SAMPLES = "loaded-contact", "pitch-deviation", "loaded-contact-samples"
_SPECTRUM = "loaded-contact-spectrum"
#: Mesh cycles in which a deviating tooth is seen from its entry to its exit, up to ε_α = 3.
_CYCLES = 3
_QUANTITIES = (
    *("contact_ratio", "overlap_ratio", "total_contact_ratio", "contact_ratio_effective"),
    *("stiffness_single_pair_at_pitch_point", "mesh_stiffness_mean"),
    *("loaded_transmission_error_mean", "loaded_transmission_error_peak_to_peak"),
    *("least_peak_to_peak", "least_peak_to_peak_torque"),
    *("face_load_factor", "line_load_max", "hertz_pressure_max"),
    *("shaft_misalignment", "given_misalignment"),
    *("pinion_root_tension_max", "gear_root_tension_max"),
)
_SCATTERED = (
    *("face_load_factor", "loaded_transmission_error_peak_to_peak", "mesh_stiffness_mean"),
    *("hertz_pressure_max", "pinion_root_tension_max", "gear_root_tension_max"),
)


def tasks(request: Request) -> tuple[Task, ...]:
    """Slow rotation at the duty's torque, the error over all torques; with a deviating tooth, and samples.

    One tooth of the pinion stands f_pb − y_α ahead of all others: it carries more at its entry and its exit.
    """
    operating = {
        "gear_torque": f"{request.gear_torque!r} N*m",
        "gear_torques": [f"{torque!r} N*m" for torque in request.torques],
    }
    scenario = {
        "title": request.title,
        "kind": STUDY.kind,
        "drive": request.tables["drive"],
        "operating": operating,
        "mesh": dict(request.tables.get("mesh", {})),
        **request.supports(),
    }
    requested = [Task(_TASK, "loaded error, pressures, root stresses", scenario)]
    at_duty = scenario | {"operating": {"gear_torque": operating["gear_torque"]}}
    if request.pitch_deviation:
        deviating = at_duty | {
            "drive": _with_deviating_tooth(at_duty["drive"], request.pitch_deviation),
            "output": {"cycles": _CYCLES},
        }
        requested.append(Task(_DEVIATING, "load sharing with a pitch deviation", deviating, needed=False))
    if request.spectrum_torques:
        others = [{"operating.gear_torque": f"{torque!r} N*m"} for torque in request.spectrum_torques]
        requested.append(Task(_SPECTRUM, "loads along the face of the spectrum's duties", at_duty, others))
    if request.samples:
        cases = [of_teeth(sample) for sample in request.samples]
        about = "load sharing, samples"
        requested.append(Task(_SAMPLES, about, at_duty, cases, arrays=tuple(ALONG), needed=False))
    return tuple(requested)


def _with_deviating_tooth(drive: Mapping[str, Any], deviation: float) -> dict[str, Any]:
    """Drive whose pinion has one tooth that stands `deviation` (m) ahead."""
    pinion = drive["pinion"]
    errors = [f"{-deviation!r} m"] + ["0 m"] * (int(pinion["teeth"]) - 1)
    modification = pinion.get("modification", {}) | {"pitch_errors": errors}
    return {**drive, "pinion": {**pinion, "modification": modification}}


def answer(request: Request, done: Mapping[str, TaskResult]) -> Findings:
    """Quantities, loads and pressures of one pair over its roll angle, and the error over the torque."""
    from tribodyn.studies.load_contact.maps import late, over_roll

    summary = done[_TASK].summary
    with Record(done[_TASK].path) as record:
        roll, load = over_roll(record, record["normal_load"])
        _, over_face = over_roll(record, record["hertz_pressure"])
        pressure = highest_over_face(roll, over_face, np.asarray(record["slice"]) * late(record))
        _, line_load = over_roll(record, record["line_load"])
        torques, spread = record["torque"], record["map_peak_to_peak"]
    quantities: dict[str, Any] = {name: summary[name] for name in _QUANTITIES if name in summary}
    if _SPECTRUM in done:
        ratios = done[_SPECTRUM].rows["face_load_factor"] / summary["face_load_factor"]
        quantities["face_load_ratios"] = [float(ratio) if np.isfinite(ratio) else 1.0 for ratio in ratios]
    accurate = summary.get("shared_load_max")
    deviating = done[_DEVIATING].summary.get("shared_load_max") if _DEVIATING in done else None
    if deviating is not None and accurate is not None:
        quantities["transverse_load_factor"] = transverse_load_factor(deviating, accurate)
    rows = done[_SAMPLES].rows if _SAMPLES in done else {}
    scattered = {name: rows[name] for name in _SCATTERED} if rows else {}
    if rows and accurate is not None:
        shared = rows["shared_load_max"]
        factors = [transverse_load_factor(load, accurate) if np.isfinite(load) else load for load in shared]
        scattered["transverse_load_factor"] = np.array(factors)
    scattered |= {ALONG[name]: rows[name] for name in ALONG} if rows else {}
    along = {"roll_angle": roll, "normal_load": load, "hertz_pressure": pressure, "line_load": line_load}
    curve = ReportCurve(
        "Loaded transmission error, peak to peak",
        "Torque on the gear (N m)",
        "Peak to peak (µm)",
        torques,
        {"": 1e6 * np.asarray(spread)},
        request.gear_torque,
    )
    return Findings(quantities, along, (curve,), scattered)


ROLE = Contribution(1, "Loaded contact", tasks, answer, of=TEETH)
