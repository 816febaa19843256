"""The part in an assessment of a pair: steady states over the speed, and loads of the teeth at the duty."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.cases.assessment_part import Contribution, Findings, Request, Task, TaskResult
from tribodyn.gears.motion.tooth_loads import tooth_loads
from tribodyn.record.reader import Record
from tribodyn.studies.motion import PAIR as STUDY
from tribodyn.studies.motion.over_speed import speed_findings, speed_tasks
from tribodyn.studies.motion.train.assessable import faces
from tribodyn.studies.protocol.load import load_data

_AT_DUTY = "steady-duty"
#: Mesh cycles until the motion at the duty counts as steady, and samples of each, for vibrations of some ten
#: times the mesh frequency.
_CYCLES, _RESOLVED = 60, 80
#: Slices of the face of the samples, which are inclined to each other: dynamic factors within 0.02 % of 21.
_SLICES = {"slices": 11}
_SPEED = "operating.pinion_speed"


def tasks(request: Request) -> tuple[Task, ...]:
    """Those of `speed_tasks`, and the motion over time at the duty.

    The oil is taken as it enters, for friction changes the loads little.
    """
    scenario = _scenario(request)
    over_time = {"solver": {"cycles": _CYCLES}, "output": {"samples_per_cycle": _RESOLVED}}
    about = "loads of the teeth over time at the duty"
    first, *others = speed_tasks(request, scenario, _SPEED, slices=_SLICES)
    return first, Task(_AT_DUTY, about, scenario | over_time, needed=False), *others


def _scenario(request: Request) -> dict[str, Any]:
    tables = request.tables
    return {
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


def face(request: Request) -> dict[str, float]:
    """The load along the face on drawn shafts or matrices, by the energy method; nothing without these."""
    if not request.supports():
        return {}
    case = load_data(_scenario(request), "face").case
    if case.pair.drive.helix_angle:  # spur gears are cut anyhow
        case = case.with_pair(mesh=replace(case.pair.mesh, compliance="energy"))
    return next(iter(faces(case).values()), {})


def answer(request: Request, done: Mapping[str, TaskResult]) -> Findings:
    """What `speed_findings` finds, and the loads of the teeth."""
    loads = _loads(done[_AT_DUTY]) if done[_AT_DUTY].summary else {}
    return speed_findings(request, done, _SPEED, "pinion")._replace(motion=loads)


def _loads(run: TaskResult) -> dict[str, np.ndarray]:
    """Roll angles (position, pair) and loads (cycle, position, pair) of the driving flanks, last cycles."""
    with Record(run.path) as record:
        loads = record["normal_load"]
        phase = np.arange(len(loads)) / _RESOLVED
        of_teeth = tooth_loads(phase, loads, record.pairs, record.mesh_cycle, _RESOLVED)
    assert of_teeth is not None  # a run of many cycles
    return of_teeth._asdict()


ROLE = Contribution(2, "Steady states over the speed", tasks, answer, face=face)
