"""The part in an assessment: steady states of a gearbox over its speed, of accurate teeth and of samples."""

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from tribodyn.cases.assessment_part import CONTACT_LOST, Findings, ReportCurve, Request, Task, TaskResult

_TASK, _SAMPLES = "steady-states", "steady-states-samples"
#: Rise of the dynamic factor over both neighbours' minimum from which a maximum counts as a resonance.
_RISE = 0.02
#: Resonances at which every sample is looked at, and speeds over that of the linearised model: teeth that
#: part vibrate most some percent below it.
_RESONANCES, _AT = 3, (1.0, 0.94)
_AT_DUTY = ("dynamic_factor", "transmission_error_peak_to_peak", "contact_loss_fraction")


def speed_tasks(
    request: Request,
    scenario: Mapping[str, Any],
    key: str,
    arrays: Sequence[str] = (),
    *,
    slices: Mapping[str, int] = MappingProxyType({}),
    needed: bool = True,
) -> list[Task]:
    """A steady state at every speed, and of every sample at the duty and at its own resonances.

    `key` is that of the speed, `arrays` are kept of every case, `slices` of the face are of samples alone.
    Where no steady state repeats, so many cycles are marched as `request` says.
    """
    speeds = [{key: f"{speed!r} rad/s"} for speed in request.speeds]
    about, shared = "steady states over the speed", {"arrays": tuple(arrays), "marched": request.marched}
    requested = [Task(_TASK, about, scenario, speeds, needed=needed, **shared)]
    if request.samples:
        sliced = {**scenario, "mesh": {**slices, **scenario["mesh"]}}
        span = request.speeds[0], request.speeds[-1]

        def at_resonances(case: Any) -> list[dict[str, str]]:
            from tribodyn.studies.motion.resonances import resonance_speeds  # the dynamics

            resonances = resonance_speeds(case, span, _RESONANCES)
            speeds = [max(share * speed, span[0]) for speed in resonances for share in _AT]
            return [{key: f"{speed!r} rad/s"} for speed in speeds]

        about = "steady states, samples"
        task = Task(_SAMPLES, about, sliced, request.samples, at_resonances, needed=False, **shared)
        requested.append(task)
    return requested


def speed_findings(
    request: Request, done: Mapping[str, TaskResult], key: str, turning: str, of_case: Sequence[str] = ()
) -> Findings:
    """Dynamic factor at the duty and over the speed, its maxima, and where contact is lost.

    `turning` is what turns at the speed; `of_case` are further quantities and arrays of a sample at the duty.
    """
    rows = done[_TASK].rows
    speeds, factor = np.asarray(request.speeds), rows["dynamic_factor"]
    at_duty = int(np.argmin(np.abs(speeds - request.pinion_speed)))
    lost = np.nan_to_num(rows["contact_loss_fraction"]) > CONTACT_LOST
    quantities: dict[str, Any] = {name: float(rows[name][at_duty]) for name in _AT_DUTY} | {
        "resonance_speeds": [float(speeds[i]) for i in maxima(factor)],
        "speeds_without_result": int(np.sum(~np.isfinite(factor))),
    }
    if np.any(np.isfinite(factor)):
        worst = int(np.nanargmax(factor))
        quantities |= {
            "dynamic_factor_max": float(factor[worst]),
            "dynamic_factor_max_speed": float(speeds[worst]),
        }
    if np.any(lost):
        quantities |= {
            "contact_loss_speed_from": float(speeds[lost][0]),
            "contact_loss_speed_to": float(speeds[lost][-1]),
            "contact_loss_fraction_max": float(np.nanmax(rows["contact_loss_fraction"])),
        }
    rpm = 30.0 / math.pi
    curve = ReportCurve(
        "Dynamic factor over the speed",
        f"Speed of the {turning} (rpm)",
        "K_v",
        speeds * rpm,
        {"": factor},
        request.pinion_speed * rpm,
    )
    spread = _of_samples(request, done.get(_SAMPLES), key, (*_AT_DUTY, *of_case))
    return Findings(quantities, curves=(curve,), spread=spread, over_speed={"speed": speeds, **rows})


def _of_samples(
    request: Request, done: TaskResult | None, key: str, names: Sequence[str]
) -> dict[str, np.ndarray]:
    """Quantities of every sample at the duty, and the worst of all its speeds; NaN where none is known."""
    if done is None or not done.rows:
        return {}
    places = _places(request.samples, done.cases, key)
    at_duty = {name: np.array([done.rows[name][rows[0]] for rows in places]) for name in names}
    speeds = np.array([_speed(case, key, request.pinion_speed) for case in done.cases])
    ends = ("dynamic_factor_max", "dynamic_factor_max_speed", "contact_loss_fraction_max")
    worst = np.full((len(ends), len(places)), np.nan)
    begins = np.full(len(places), np.nan)
    for sample, rows in enumerate(places):
        factor, lost = done.rows["dynamic_factor"][rows], done.rows["contact_loss_fraction"][rows]
        if np.any(np.isfinite(factor)):
            most = int(np.nanargmax(factor))
            worst[:, sample] = factor[most], speeds[rows][most], np.nanmax(lost)
        parted = np.nan_to_num(lost) > CONTACT_LOST
        begins[sample] = np.min(speeds[rows][parted]) if np.any(parted) else np.nan
    return at_duty | dict(zip(ends, worst, strict=True)) | {"contact_loss_speed_from": begins}


def _places(
    samples: Sequence[Mapping[str, Any]], cases: Sequence[Mapping[str, Any]], key: str
) -> list[list[int]]:
    """Rows of every sample, that at the duty first: its further ones follow it."""
    places: list[list[int]] = []
    for place, case in enumerate(cases):
        if key not in case:
            places.append([])
        places[-1].append(place)
    assert len(places) == len(samples)
    return places


def _speed(case: Mapping[str, Any], key: str, duty: float) -> float:
    return float(str(case[key]).split()[0]) if key in case else duty


def maxima(values: np.ndarray) -> list[int]:
    """Places of local maxima that stand out on both sides, the highest first."""
    places = []
    for i in range(1, len(values) - 1):
        here = values[i]
        if not (here >= values[i - 1] and here > values[i + 1]):
            continue
        higher = np.flatnonzero(values > here)
        left = max((j for j in higher if j < i), default=0)
        right = min((j for j in higher if j > i), default=len(values) - 1)
        if here - max(np.nanmin(values[left : i + 1]), np.nanmin(values[i : right + 1])) > _RISE:
            places.append(i)
    return sorted(places, key=lambda i: -values[i])
