"""What must hold for the records of the studies beside a gear pair's dynamics, and for sweeps."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, at_radii, at_wave_numbers
from tribodyn.compliance.sharing.face_root_stress import root_stress
from tribodyn.compliance.sharing.section import oblique_faces
from tribodyn.gears.rating.limits import least
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE
from tribodyn.studies import STUDIES
from tribodyn.studies.design.outcome import REFINEMENT
from tribodyn.studies.load_contact.run import prepare
from tribodyn.studies.protocol.load import load_scenario

#: Largest share by which the torque of the loads may miss the gear's.
TORQUE_RESIDUAL = 1e-6
#: By which a number may differ that is computed again from the record.
SAME = 1e-6
#: Largest imbalance of flow and force in a solved contact.
IMBALANCE = 1e-4
#: By which the volume missing on worn flanks may differ from that of load and sliding, of helical pairs.
BALANCE = 0.02
#: By which an efficiency without losses may miss 1.
ROUNDING = 1e-12


def efficiency_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of an efficiency study."""
    summary = record.summary
    for key, value in summary.items():
        if key.startswith("efficiency") and isinstance(value, float) and (value < 0 or value > 1 + ROUNDING):
            yield f"summary {key} = {value:.6g}"
    if not abs(summary["energy_residual"]) <= 1e-6:
        yield f"energy residual {summary['energy_residual']:.3g}"
    yield from _negative(record, "normal_load")
    names = "central_film_thickness hertz_pressure friction_coefficient flash_temperature_rise"
    # of helical pairs a part of the face may carry where its middle is beyond the path
    carries = (record["normal_load"] > 0) & np.isfinite(record["pressure_angle"])
    for name in names.split():
        values = record[name][carries]
        if not np.all(np.isfinite(values)) or not np.all(values >= 0):
            yield f"{name} is negative or no number under load"
    film = ("film_min", "central_film_thickness", -1)
    for key, name, sign in (*((f"{of}_max", of, 1) for of in ("normal_load", "hertz_pressure")), film):
        sampled = np.nanmax(sign * record[name])
        if not sign * summary[key] >= sampled - 1e-9 * abs(sampled):
            yield f"summary {key} = {summary[key]:.9g}, a sample of {name} is {sign * sampled:.9g}"
    power = record["power_in"] - record["power_out"] - record["power_friction"]
    if not np.all(np.abs(power) <= 1e-6 * np.max(np.abs(record["power_in"]))):
        yield f"power_in - power_out - power_friction up to {np.max(np.abs(power)):.4g} W"


def load_contact_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of a load contact study."""
    yield from _not_finite(record, "face_load_factor")
    factor = record["face_load_factor"][record["normal_load"] > 0]
    if not np.all(factor >= 1 - 1e-9):
        yield f"face_load_factor falls to {np.min(factor):.6g}"
    yield from _negative(record, "normal_load", "line_load", "hertz_pressure", "half_width", "mesh_stiffness")
    if not np.all(np.any(record["normal_load"] > 0, axis=1)):
        yield "there are positions at which no pair carries"
    residual = np.max(np.abs(record["torque_residual"]))
    if not residual <= TORQUE_RESIDUAL:
        yield f"torque residual {residual:.3g}"
    for name in ("normal_load", "hertz_pressure", "line_load"):
        reported = record.summary[f"{name}_max"]
        if not np.isclose(reported, np.max(record[name]), rtol=1e-9):
            yield f"summary {name}_max = {reported:.9g}, the record has {np.max(record[name]):.9g}"
    yield from _root_faults(record)


def _root_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the tension at the roots.

    A neighbour's load presses the root ahead of it, by up to a third of the tension at its own, so that a
    tooth with a small share of the load may be pressed all along its root. Its own load alone pulls the side
    on which it stands.
    """
    with TemporaryDirectory() as folder:
        path = Path(folder) / "again.toml"
        path.write_text(str(record.attrs["scenario"]), encoding="utf-8")
        case, flexible = prepare(load_scenario(path))
    carrying = record["normal_load"] > 0
    # every tooth as the only one of a position of its own
    faces = oblique_faces(flexible.assembly, record["roll_angle"][carrying][:, None, None])
    reaches = faces.geometry.pinion_radius, faces.geometry.gear_radius
    bodies = zip(flexible.gears, flexible.materials, reaches, strict=True)
    for gear, material, reach in bodies:
        even = at_wave_numbers(gear, np.zeros(1), material.poisson_ratio).root_stress[0, NEIGHBOURS, 0]
        even = even @ at_radii(gear.radius, reach[:, 0, 0]).T
        if not np.all(np.max(even, axis=0) > 0):
            yield "a tooth's own load pulls no point of the root on its side"
    own_load = record["line_load"][carrying][:, None]
    own = root_stress(flexible, faces, own_load, case.mesh.slice_coupling)[0][:, :, 0]
    single = carrying & (np.count_nonzero(carrying, axis=1) == 1)[:, None]
    recorded = np.moveaxis(record["root_tension"], 1, 0)
    if not np.allclose(recorded[:, single], own[:, single[carrying]], rtol=SAME):
        yield "root_tension of a pair that carries alone is not that of its load"


def wear_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of a wear study; films are NaN where nothing is carried."""
    yield from _negative(record, "worn_depth", "wear_rate", "worn_volume", "line_load", "hertz_pressure")
    yield from _negative(record, "debris_rate", "power_friction")
    depth, steps = record["worn_depth"], np.diff(record["revolutions"])
    if not np.all(steps > 0) or not np.all(np.diff(depth, axis=0) >= 0):
        yield "revolutions or depths fall"
    if not np.all(depth[0] == 0):
        yield "new flanks are worn"
    if not record.summary["wear_balance"] <= BALANCE:
        yield f"the volume worn off misses that of load and sliding by {record.summary['wear_balance']:.3g}"


def solved_contact_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of a study of the solved contact; NaN where nothing was solved."""
    yield from any_faults(record)
    yield from _negative(record, "normal_load")
    load = record["normal_load"]
    film, least = record["central_film_thickness"], record["minimum_film_thickness"]
    solved = np.isfinite(film)
    if np.count_nonzero(solved) != record.summary["positions_solved"]:
        yield f"{np.count_nonzero(solved)} positions have a film, positions_solved says otherwise"
    if np.any(solved & ~(load > 0)):
        yield "there is a film where nothing carries"
    if not np.all((film > 0) & (least > 0) & (least <= film * (1 + 1e-9)) | ~solved):
        yield "a film is not above zero, or the minimum film exceeds the central one"
    share, friction = record["asperity_load_ratio"][solved], record["friction_coefficient"][solved]
    if not np.all((share >= 0) & (share <= 1 + 1e-6)):
        yield f"asperities carry {share} of the load"
    if not np.all((friction >= 0) & (friction < 1)):
        yield f"friction coefficient {friction}"
    if not np.all(record["residual"][solved] <= IMBALANCE):
        yield f"imbalance of flow or force up to {np.max(record['residual'][solved]):.3g}"
    if not np.all(record["pressure"][solved] >= -1e-9 * record["hertz_pressure"][solved][:, None]):
        yield "the pressure falls below zero"


def assessment_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of an assessment."""
    yield from any_faults(record)
    summary = record.summary
    if not 0 <= summary["efficiency"] <= 1:
        yield f"efficiency {summary['efficiency']:.6g}"
    lost = summary["power_friction_mean"] / summary["power_in_mean"]
    if not np.isclose(1 - summary["efficiency"], lost, rtol=1e-3):
        yield f"efficiency {summary['efficiency']:.6g}, losses over input {lost:.6g}"
    names = "normal_load film_thickness flash_temperature_rise specific_film hertz_pressure"
    yield from _negative(record, *names.split(), missing=True)
    warm = record["contact_temperature"] - record["flash_temperature_rise"] - summary["bulk_temperature"]
    if not np.nanmax(np.abs(warm), initial=0.0) <= 1e-6:
        yield "the contact temperature is not that of the bulk and the flash"
    for name, margin in summary.get("margins", {}).get("simulated", {}).items():
        if name.startswith("S_") and not margin >= 0:
            yield f"margin {name} = {margin}"


def train_assessment_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of an assessment of a train."""
    yield from any_faults(record)
    summary = record.summary
    yield from _negative(record, "dynamic_factor", "power_friction_mean", "S_B", "S_lambda", missing=True)
    for name, mesh in summary["meshes"].items():
        for part, of_part in mesh.get("margins", {}).items():
            margins = {key: least(value) for key, value in of_part.items() if key.startswith("S_")}
            if not all(value is None or value >= 0.0 for value in margins.values()):
                yield f"margins of {name}, {part}: {margins}"


def search_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of a search: its best is none, or alone has other results."""
    yield from any_faults(record)
    summary, feasible = record.summary, record["feasible"] > 0.5
    if not np.any(feasible):
        yield "complete, although nothing is feasible"
        return
    if "objective_2" not in record:
        on = record[REFINEMENT] if REFINEMENT in record else np.ones(len(feasible))
        finest = feasible & (on == np.max(on[feasible]))  # the best is that of the last stage
        best = float(np.min(record["objective"][finest]))
        if not np.isclose(summary["objective"], best, rtol=1e-9):
            yield f"the best is {summary['objective']:.9g}, an evaluation has {best:.9g}"
    if "margin" in record and not np.all(record["margin"][feasible] >= -1e-9):
        yield "a feasible evaluation breaks a constraint"
    again = load_scenario(summary["files"]["toml"])
    study = STUDIES[again.kind]
    if "duties" in summary or study.batch():
        return
    for name, value in study.quantities_of(again).items():
        known = summary["quantities_best"].get(name)
        if name != "wall_time" and known is not None and not np.isclose(value, known, rtol=1e-6):
            yield f"the best scenario has {name} = {value:.9g}, the search {known:.9g}"


def any_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of a study of which no more is known: numbers that are none."""
    for name in record:
        values = record[name]
        if values.dtype.kind == "f" and np.any(np.isinf(values)):
            yield f"{name} is infinite"
    for key, value in record.summary.items():
        if isinstance(value, float) and np.isinf(value):
            yield f"summary {key} is infinite"


def rolling_faults(record: Record) -> Iterator[str]:
    """Say what is wrong with the record of a gear with rolling elements."""
    yield from any_faults(record)
    yield from _not_finite(record, "time")
    yield from _negative(record, "normal_load")
    if not 0 <= record.summary["efficiency"] <= 1:
        yield f"efficiency {record.summary['efficiency']:.6g}"


def _not_finite(record: Record, but: str) -> Iterator[str]:
    """What is no number; where a pair, or a slice of it, carries nothing there need be none."""
    loads = [record[name] for name in ("normal_load", "line_load") if name in record]
    for name in record:
        values = record[name]
        for load in loads:
            values = values[load > 0] if values.shape == load.shape else values
        if name != but and values.dtype.kind == "f" and not np.all(np.isfinite(values)):
            yield f"{name} is not finite"


def _negative(record: Record, *names: str, missing: bool = False) -> Iterator[str]:
    """What is below zero, or no number unless those may be missing."""
    for name in names:
        if np.any(record[name] < 0) or not (missing or np.all(record[name] >= 0)):
            yield f"{name} falls to {np.nanmin(record[name]):.4g}"


#: Sort of case -> what is wrong with a complete record of it.
FAULTS = {
    "efficiency": efficiency_faults,
    "load-contact": load_contact_faults,
    "ehl": solved_contact_faults,
    "wear": wear_faults,
    "assessment": assessment_faults,
    "train-assessment": train_assessment_faults,
    "design": search_faults,
    "irefc": rolling_faults,
}


def sweep_faults(record: SweepRecord) -> Iterator[str]:
    """Say what is wrong with the record of a sweep of a gear pair's dynamics."""
    done = record["status"] == DONE
    for name in record.quantities:
        values = record[name][done] if name in record else np.zeros(0)
        if values.dtype.kind == "f" and np.any(np.isinf(values)):
            yield f"{name} is infinite"
    efficiency = record["efficiency"][done]
    out = efficiency[np.isfinite(efficiency) & ~((efficiency >= 0) & (efficiency <= 1))]
    if out.size:
        yield f"efficiency {out[0]:.6g}"
    for name in ("normal_load_max", "film_min", "hertz_pressure_max", "transmission_error_peak_to_peak"):
        if np.any(record[name][done] < 0):
            yield f"{name} is negative"
    error = record["transmission_error_rotational"][done]
    if error.size:
        with np.errstate(invalid="ignore"):
            spread = np.nanmax(error, axis=-1) - np.nanmin(error, axis=-1)
        said = record["transmission_error_peak_to_peak"][done]
        if not np.all(said >= spread * (1 - 1e-9)):
            yield "transmission_error_peak_to_peak is less than that of the samples"
        known = np.isfinite(record["state"][done])
        if not np.all(known == np.any(known, axis=0)):  # what no case has, as a motor's shaft, is NaN
            yield "state is not finite"


def sweep_against_run(
    record: SweepRecord, summary: dict[str, Any], finer: dict[str, Any], rtol: float
) -> Iterator[str]:
    """Compare the first case of a sweep of transients with the same run by itself.

    `finer` is the summary of that run at a tenth of the tolerance: a motion that amplifies any deviation also
    differs from run to run, and the sweep may be as far away. In a sweep an explicit method may need more
    steps than it may take.
    """
    place = (0,) * len(record.dims)
    if record.case("status", place) != DONE:
        if "limit of steps" not in str(record.case("message", place)):
            yield "the run by itself is complete, the sweep's first case is not"
        return
    size = abs(summary["power_in_mean"])
    scales = {"mesh_frequency": summary["mesh_frequency"], "power_in_mean": size, "power_friction_mean": size}
    for name, scale in scales.items():
        swept, alone = float(record.case(name, place)), float(summary[name])
        away = 3.0 * abs(float(finer.get(name, alone)) - alone)
        if not abs(swept - alone) <= 1e3 * rtol * scale + away:
            yield f"{name}: {swept:.9g} in the sweep, {alone:.9g} in the run by itself"
