"""What must hold for the record of any gear pair, whatever the drive and the duty."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from tribodyn.record.reader import Record

#: Numbers at every sample.
ALWAYS = (
    *("time", "pinion_angle", "displacement", "velocity", "transmission_error_rotational"),
    *("normal_load", "friction_force", "mesh_stiffness", "drive_torque", "stored_energy"),
    *("power_in", "power_out", "power_friction", "power_damping", "power_parametric"),
    *("work_in", "work_out", "work_friction", "work_damping", "work_parametric"),
)
#: Numbers wherever a pair carries, and not elsewhere (the first four: on the whole path of contact).
ON_PATH = (
    *("transmission_error_normal", "pressure_angle", "equivalent_radius"),
    *("entrainment_speed", "sliding_speed"),
)
LOADED = (
    *("friction_coefficient", "asperity_load_ratio", "central_film_thickness", "film_parameter"),
    *("hertz_pressure", "flash_temperature_rise"),
)
#: Never below zero.
NOT_NEGATIVE = ("normal_load", "mesh_stiffness", *LOADED)
#: Summary name, dataset, whether it is the maximum.
EXTREMES = (
    ("normal_load_max", "normal_load", True),
    ("film_min", "central_film_thickness", False),
    ("film_parameter_min", "film_parameter", False),
    ("hertz_pressure_max", "hertz_pressure", True),
    ("flash_temperature_max", "flash_temperature_rise", True),
)
#: Energy residual over the relative tolerance, and how a fault of it begins.
RESIDUAL, ENERGY = 10.0, "energy residual"


def faults(record: Record, rtol: float) -> Iterator[str]:
    """Say what is wrong with a complete or failed record of a gear pair's dynamics."""
    if record.samples == 0:
        return
    data = {name: record[name] for name in record}
    yield from _numbers(data)
    yield from _friction(data)
    yield from _damping(data)
    yield from _summary(record.summary, data)
    yield from _energy(record, rtol)
    if record.status == "complete":
        yield from _means(record, data)


def train_faults(record: Record, rtol: float) -> Iterator[str]:
    """Say what is wrong with a complete or failed record of a train whose meshes have equal teeth."""
    if record.samples == 0:
        return
    data = {name: record[name] for name in record}
    absent = np.all(np.isnan(data["normal_load"]), axis=0)  # slots that only other meshes have
    for name in ALWAYS:
        if name in data and data[name].shape[1:] == absent.shape:
            data[name] = np.where(absent, 0.0, data[name])
    yield from _numbers(data)
    yield from _friction(data)
    yield from _damping(data)
    yield from _energy(record, rtol)
    for m, name in enumerate(record["mesh"]):
        own = {key: values[:, m] for key, values in data.items() if "mesh" in record.dims_of(key)}
        yield from _summary(record.summary["meshes"][name], own)
    lost = np.sum(data["mesh_power_friction"], axis=1)
    if not np.allclose(
        lost, data["power_friction"], rtol=1e-9, atol=1e-12 * np.max(np.abs(lost), initial=0.0)
    ):
        yield "the losses of the meshes are not that of the train"


def _numbers(data: dict[str, np.ndarray]) -> Iterator[str]:
    for name in ALWAYS:
        if name in data and not np.all(np.isfinite(data[name])):
            yield f"{name} is not finite at {_first(~np.isfinite(data[name]))}"
    load = data["normal_load"]
    for name in (*ON_PATH, *LOADED):
        if not np.all(np.isfinite(data[name][load > 0])):
            yield f"{name} is not finite under load at {_first((load > 0) & ~np.isfinite(data[name]))}"
    for name in LOADED:
        if not np.all(np.isnan(data[name][load == 0])):
            yield f"{name} is a number where nothing is loaded"
    for name in NOT_NEGATIVE:
        if name in data and np.nanmin(data[name], initial=0.0) < 0:
            yield f"{name} falls to {np.nanmin(data[name]):.4g}"
    ratio = data["asperity_load_ratio"][load > 0]
    if np.any(ratio > 1):
        yield f"asperities carry {np.max(ratio):.6g} of the load"
    if np.any(data["central_film_thickness"][load > 0] <= 0):
        yield "the film is not thicker than zero"
    for name in ("time", "pinion_angle", "reference_angle"):
        if name in data and not np.all(np.diff(data[name]) > 0):
            yield f"{name} does not increase at {_first(np.diff(data[name]) <= 0)}"


def _friction(data: dict[str, np.ndarray]) -> Iterator[str]:
    load, force = data["normal_load"], np.abs(data["friction_force"])
    most = np.where(load > 0, np.nan_to_num(data["friction_coefficient"]) * load, 0.0)
    if np.any(force > most * (1 + 1e-9) + 1e-12):
        yield f"friction exceeds μ F_n at {_first(force > most * (1 + 1e-9) + 1e-12)}"


def _damping(data: dict[str, np.ndarray]) -> Iterator[str]:
    power = data["power_damping"]
    if np.any(power < -1e-12 * np.max(np.abs(power), initial=0.0)):
        yield f"power_damping falls to {np.min(power):.4g}"


def _summary(summary: dict[str, Any], data: dict[str, np.ndarray]) -> Iterator[str]:
    for key, name, greatest in EXTREMES:
        values = data[name][np.isfinite(data[name])]
        known = summary.get("extremes", {}).get("run", {}).get(key)
        if not values.size or known is None:
            continue
        sampled, reported = float(values.max() if greatest else values.min()), float(known["value"])
        beyond = reported - sampled if greatest else sampled - reported
        if not beyond >= -1e-9 * abs(sampled):
            yield f"summary {key} = {reported:.9g}, a sample of {name} is {sampled:.9g}"
    for key, value in _plain(summary):
        if not isinstance(value, str) and np.any(np.isinf(np.asarray(value, dtype=float))):
            yield f"summary {key} is infinite"


def _energy(record: Record, rtol: float) -> Iterator[str]:
    summary = record.summary
    residual = summary.get("energy_residual")
    if residual is None:
        if record.samples > 1 and record.status == "complete":
            yield "the summary has no energy residual"
        return
    # works are integrated to a share of those of a mesh cycle, of which a run that stops may not have one
    done = min(1.0, summary["cycles_done"])
    if not abs(residual) * done <= RESIDUAL * rtol:
        yield f"{ENERGY} {residual:.3g}, {abs(residual) / rtol:.3g} times rtol"


def _means(record: Record, data: dict[str, np.ndarray]) -> Iterator[str]:
    summary = record.summary
    samples = record.scenario["output"]["samples_per_cycle"]
    cycles = record.scenario["solver"]["cycles"]
    whole = "window" not in record.scenario["output"] and "revolutions" not in record.scenario["solver"]
    if whole and record.samples != samples * cycles + 1:
        yield f"{record.samples} samples of {cycles} cycles"
    window = slice(record.samples - 1 - samples * summary["averaging_cycles"], record.samples)
    names = "work_in", "work_out", "work_friction", "time"
    work_in, out, friction, time = (float(data[name][-1] - data[name][window.start]) for name in names)
    efficiency = summary.get("efficiency")
    if efficiency is not None and np.isfinite(efficiency) and not 0 <= efficiency <= 1:
        yield f"efficiency {efficiency:.6g}"
    put_in = (max(work_in, 0.0) + max(-out, 0.0)) / time
    for key, value in (("power_in_mean", put_in), ("power_friction_mean", friction / time)):
        if not np.isclose(summary[key], value, rtol=1e-6, atol=1e-9 * put_in):
            yield f"summary {key} = {summary[key]:.9g}, the record's works give {value:.9g}"
    error = data["transmission_error_rotational"][window.start : -1]
    spread = summary["transmission_error_peak_to_peak"]
    if not spread >= np.ptp(error) * (1 - 1e-9):
        yield f"summary peak to peak {spread:.9g}, the samples' {np.ptp(error):.9g}"
    touching = np.any(data["normal_load"][window.start : -1] > 0, axis=1)
    lost = summary["contact_loss_fraction"]
    if abs(lost - np.mean(~touching)) > 2.0 / samples:
        yield f"summary contact_loss_fraction {lost:.6g}, the samples' {np.mean(~touching):.6g}"


def _plain(summary: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    for key, value in summary.items():
        if isinstance(value, dict):
            yield from _plain(value)
        elif value is not None:
            yield key, value


def _first(where: np.ndarray) -> str:
    place = tuple(int(i) for i in np.argwhere(where)[0])
    return f"sample {place[0]}" + (f", pair slot {place[1]}" if len(place) > 1 else "")
