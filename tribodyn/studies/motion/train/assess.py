"""The part in an assessment of a train: steady states over the speed of its input."""

from collections.abc import Mapping

from tribodyn.cases.assessment_part import GEARBOX, Contribution, Findings, Request, Task, TaskResult
from tribodyn.studies.motion.over_speed import speed_findings, speed_tasks

#: Of every mesh, and further ones of a train, at the duty.
OF_MESHES = tuple(
    f"{name}_of_mesh"
    for name in (
        *("dynamic_factor", "mesh_load_factor", "power_friction_mean", "friction_coefficient_mean"),
        "bulk_temperature",
    )
)
_FURTHER = ("mesh_load_factor", "hertz_pressure_max", "power_friction_mean", "efficiency")
_SPEED = "operating.input_speed"


def tasks(request: Request) -> list[Task]:
    """Those of `speed_tasks`: the request's tables are a scenario of the train."""
    return speed_tasks(request, request.tables, _SPEED, OF_MESHES, needed=False)


def answer(request: Request, done: Mapping[str, TaskResult]) -> Findings:
    """What `speed_findings` finds."""
    return speed_findings(request, done, _SPEED, "input", (*_FURTHER, *OF_MESHES))


ROLE = Contribution(2, "Steady states over the speed", tasks, answer, of=GEARBOX)
