"""The part in an assessment: steady states over the speed."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.cases.assessment_part import Contribution, Findings, ReportCurve, Request, Task, TaskResult
from tribodyn.gears.motion.tooth_loads import tooth_loads
from tribodyn.record.reader import Record
from tribodyn.studies.motion import PAIR as STUDY

_TASK, _SAMPLES, _AT_DUTY = "steady-states", "steady-states-samples", "steady-duty"
#: Mesh cycles until the motion at the duty counts as steady, and samples of each, for vibrations of some ten
#: times the mesh frequency.
_CYCLES, _RESOLVED = 60, 80
#: Slices of the face of the samples, which are inclined to each other: dynamic factors within 0.02 % of 21.
_SLICES = 11
#: Rise of the dynamic factor over both neighbours' minimum from which a maximum counts as a resonance.
_RISE = 0.02
#: Share of the time without contact that counts.
_LOST = 1e-6
#: Resonances at which every sample is looked at, and speeds over that of the linearised model: teeth that
#: part vibrate most some percent below it.
_RESONANCES, _AT = 3, (1.0, 0.94)
_SPEED = "operating.pinion_speed"


def tasks(request: Request) -> tuple[Task, ...]:
    """A steady state at every speed, and of every sample at the duty and at its own resonances.

    The oil is taken as it enters, for friction changes the loads little.
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
    speeds = [{_SPEED: f"{speed!r} rad/s"} for speed in request.speeds]
    requested = [Task(_TASK, "steady states over the speed", scenario, speeds)]
    over_time = {"solver": {"cycles": _CYCLES}, "output": {"samples_per_cycle": _RESOLVED}}
    about = "loads of the teeth over time at the duty"
    requested.append(Task(_AT_DUTY, about, scenario | over_time, needed=False))
    if request.samples:
        sliced = scenario | {"mesh": {"slices": _SLICES, **scenario["mesh"]}}
        span = request.speeds[0], request.speeds[-1]

        def at_resonances(case: Any) -> list[dict[str, str]]:
            from tribodyn.studies.motion.pair.resonances import resonance_speeds  # the dynamics

            resonances = resonance_speeds(case, span, _RESONANCES)
            speeds = [max(share * speed, span[0]) for speed in resonances for share in _AT]
            return [{_SPEED: f"{speed!r} rad/s"} for speed in speeds]

        about = "steady states, samples"
        requested.append(Task(_SAMPLES, about, sliced, request.samples, at_resonances, needed=False))
    return tuple(requested)


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
    loads = _loads(done[_AT_DUTY]) if done[_AT_DUTY].summary else {}
    spread = _of_samples(request, done.get(_SAMPLES))
    return Findings(quantities, curves=(curve,), spread=spread, motion=loads)


def _of_samples(request: Request, done: TaskResult | None) -> dict[str, np.ndarray]:
    """Quantities of every sample at the duty, and the worst of all its speeds; NaN where none is known."""
    if done is None or not done.rows:
        return {}
    places = _places(request.samples, done.cases)
    names = ("dynamic_factor", "transmission_error_peak_to_peak", "contact_loss_fraction")
    at_duty = {name: np.array([done.rows[name][rows[0]] for rows in places]) for name in names}
    speeds = np.array([_speed(case, request.pinion_speed) for case in done.cases])
    ends = ("dynamic_factor_max", "dynamic_factor_max_speed", "contact_loss_fraction_max")
    worst = np.full((len(ends), len(places)), np.nan)
    begins = np.full(len(places), np.nan)
    for sample, rows in enumerate(places):
        factor, lost = done.rows["dynamic_factor"][rows], done.rows["contact_loss_fraction"][rows]
        if np.any(np.isfinite(factor)):
            most = int(np.nanargmax(factor))
            worst[:, sample] = factor[most], speeds[rows][most], np.nanmax(lost)
        parted = np.nan_to_num(lost) > _LOST
        begins[sample] = np.min(speeds[rows][parted]) if np.any(parted) else np.nan
    return at_duty | dict(zip(ends, worst, strict=True)) | {"contact_loss_speed_from": begins}


def _places(samples: Sequence[Mapping[str, Any]], cases: Sequence[Mapping[str, Any]]) -> list[list[int]]:
    """Rows of every sample, that at the duty first: its further ones follow it."""
    places: list[list[int]] = []
    for place, case in enumerate(cases):
        if _SPEED not in case:
            places.append([])
        places[-1].append(place)
    assert len(places) == len(samples)
    return places


def _speed(case: Mapping[str, Any], duty: float) -> float:
    return float(str(case[_SPEED]).split()[0]) if _SPEED in case else duty


def _loads(run: TaskResult) -> dict[str, np.ndarray]:
    """Roll angles (position, pair) and loads (cycle, position, pair) of the driving flanks, last cycles."""
    with Record(run.path) as record:
        loads = record["normal_load"]
        phase = np.arange(len(loads)) / _RESOLVED
        of_teeth = tooth_loads(phase, loads, record.pairs, record.mesh_cycle, _RESOLVED)
    assert of_teeth is not None  # a run of many cycles
    return of_teeth._asdict()


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


ROLE = Contribution(2, "Steady states over the speed", tasks, answer)
