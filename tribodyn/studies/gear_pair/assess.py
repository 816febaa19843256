"""The part in an assessment: steady states over the speed."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.record.reader import Record
from tribodyn.studies.gear_pair import STUDY
from tribodyn.studies.protocol.part import Contribution, Findings, ReportCurve, Request, Task, TaskResult

_TASK, _SAMPLES, _AT_DUTY = "steady-states", "steady-states-samples", "steady-duty"
#: Mesh cycles until the motion at the duty counts as steady, and samples of each, for vibrations of some ten
#: times the mesh frequency.
_CYCLES, _RESOLVED = 60, 80
#: Cycles that its loads are of where they do not repeat from one to the next; change that counts as none.
_LAST, _REPEATED = 4, 1e-3
#: Slices of the face of the samples, which are inclined to each other: dynamic factors within 0.02 % of 21.
_SLICES = 11
#: Rise of the dynamic factor over both neighbours' minimum from which a maximum counts as a resonance.
_RISE = 0.02
#: Share of the time without contact that counts.
_LOST = 1e-6


def tasks(request: Request) -> tuple[Task, ...]:
    """A steady state at every speed, and of every sample of deviations at the duty.

    The oil is taken as it enters, for friction hardly moves the loads.
    """
    tables = request.tables
    scenario = {
        "title": request.title,
        "kind": STUDY.kind,
        "drive": tables["drive"],
        "lubricant": tables["lubricant"],
        "bearings": tables["bearings"],
        "operating": request.operating(),
        "mesh": {"compliance": "fem", "damping_ratio": tables["damping_ratio"], **tables.get("mesh", {})},
        "friction": {"law": request.laws[0]},
        **{name: tables[name] for name in ("shaft", "film") if name in tables},
    }
    speeds = [f"{speed!r} rad/s" for speed in request.speeds]
    found = [Task(_TASK, "steady states over the speed", scenario, "operating.pinion_speed", speeds)]
    over_time = {"solver": {"cycles": _CYCLES}, "output": {"samples_per_cycle": _RESOLVED}}
    found.append(
        Task(_AT_DUTY, "loads of the teeth over time at the duty", scenario | over_time, needed=False)
    )
    if request.samples:
        sliced = scenario | {"mesh": {"slices": _SLICES, **scenario["mesh"]}}
        numbers = [str(number) for number in range(1, request.samples + 1)]
        about = "steady states, samples of deviations"
        found.append(Task(_SAMPLES, about, sliced, "mesh.deviation_sample", numbers, needed=False))
    return tuple(found)


def answer(request: Request, done: Mapping[str, TaskResult]) -> Findings:
    """Dynamic factor at the duty and over the speed, its maxima, and where contact is lost."""
    rows = done[_TASK].rows
    speeds, factor = np.asarray(request.speeds), rows["dynamic_factor"]
    at_duty = int(np.argmin(np.abs(speeds - request.pinion_speed)))
    lost = np.nan_to_num(rows["contact_loss_fraction"]) > _LOST
    quantities: dict[str, Any] = {
        "dynamic_factor": float(factor[at_duty]),
        "contact_loss_fraction": float(rows["contact_loss_fraction"][at_duty]),
        "transmission_error_peak_to_peak": float(rows["transmission_error_peak_to_peak"][at_duty]),
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
        "Speed of the pinion (rpm)",
        "K_v",
        speeds * rpm,
        {"": factor},
        request.pinion_speed * rpm,
    )
    samples = done[_SAMPLES].rows if _SAMPLES in done else {}
    names = ("dynamic_factor", "transmission_error_peak_to_peak") if samples else ()
    at_duty_loads = _loads(done[_AT_DUTY]) if done[_AT_DUTY].summary else {}
    spread = {name: samples[name] for name in names}
    return Findings(quantities, curves=(curve,), spread=spread, motion=at_duty_loads)


def _loads(run: TaskResult) -> dict[str, np.ndarray]:
    """Roll angles (position, pair) and loads (cycle, position, pair) of the driving flanks, last cycles."""
    with Record(run.path) as record:
        table, front = record.mesh_cycle, [n for n, pair in enumerate(record.pairs) if pair <= 1]
        loads = record["normal_load"][-1 - _LAST * _RESOLVED : -1][:, front]
        ages = np.array([1 - record.pairs[n] for n in front])
    loads = loads.reshape(_LAST, _RESOLVED, len(front))
    if np.max(np.abs(loads[-1] - loads[-2])) < _REPEATED * np.max(loads):
        loads = loads[-1:]
    phase = np.arange(_RESOLVED) / _RESOLVED
    pitch = 2.0 * math.pi / float(table["pinion_teeth"])
    roll = float(table["roll_start"]) + pitch * (phase[:, None] + ages)
    return {"roll_angle": roll, "normal_load": loads}


def maxima(values: np.ndarray) -> list[int]:
    """Places of local maxima that stand out on both sides, the highest first."""
    found = []
    for i in range(1, len(values) - 1):
        here = values[i]
        if not (here >= values[i - 1] and here > values[i + 1]):
            continue
        higher = np.flatnonzero(values > here)
        left = max((j for j in higher if j < i), default=0)
        right = min((j for j in higher if j > i), default=len(values) - 1)
        if here - max(np.nanmin(values[left : i + 1]), np.nanmin(values[i : right + 1])) > _RISE:
            found.append(i)
    return sorted(found, key=lambda i: -values[i])


ROLE = Contribution(2, "Steady states over the speed", tasks, answer)
