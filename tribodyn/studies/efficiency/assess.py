"""The part in an assessment: film, friction and losses at the duty, and the losses by every friction law."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.cases.assessment_part import Contribution, Findings, Request, Task, TaskResult, of_teeth
from tribodyn.studies.efficiency import STUDY

_TASK, _SAMPLES = "efficiency-", "efficiency-samples"
#: Slices of the face of samples, fewer of spur teeth that nothing but deviations inclines, and positions of
#: the mesh cycle: loss and bulk temperature rise within 0.1 % of 11 slices, of helical teeth 1 % of 21.
_SLICES, _MORE_SLICES, _POSITIONS = 3, 11, 60
_SCATTERED = ("efficiency", "power_friction_mean", "friction_coefficient_mean", "bulk_temperature")
_QUANTITIES = (
    *("efficiency", "power_in_mean", "power_friction_mean", "friction_coefficient_mean"),
    *("film_min", "film_parameter_min", "flash_temperature_max"),
    *("bulk_temperature", "power_load_independent", "efficiency_with_losses"),
)
#: What the verdict says of the laws.
_LAWS = tuple(
    f"{law}_{what}" for law in ("film", "friction") for what in ("law", "judged", "outside", "chosen")
)


def tasks(request: Request) -> tuple[Task, ...]:
    """One mesh cycle by every friction law, and of every sample by the first."""
    tables = request.tables
    shared = {
        "title": request.title,
        "kind": STUDY.kind,
        "drive": tables["drive"],
        "lubricant": tables["lubricant"],
        "operating": request.operating(),
        "mesh": {"compliance": "fem", **tables.get("mesh", {})},
        **request.supports(),
        **{name: tables[name] for name in ("temperature", "losses") if name in tables},
    }
    film = {name: tables[name] for name in ("film",) if name in tables}
    requested = [
        Task(
            f"{_TASK}{law}",
            f"film and losses, {law}",
            {**shared, "friction": {"law": law}, **(film if law == request.laws[0] else {})},
            needed=law == request.laws[0],
        )
        for law in request.laws
    ]
    if request.samples:
        inclined = "helix_angle" in tables["drive"] or "shaft" in tables or _tilted(shared["mesh"])
        slices = _MORE_SLICES if inclined else _SLICES
        sliced = {
            **requested[0].scenario,
            "mesh": {"slices": slices, **shared["mesh"]},
            "output": {"samples_per_cycle": _POSITIONS},
        }
        cases = [of_teeth(sample) for sample in request.samples]
        requested.append(Task(_SAMPLES, "film and losses, samples", sliced, cases, needed=False))
    return tuple(requested)


def _tilted(mesh: Mapping[str, Any]) -> bool:
    """Whether the scenario misaligns the axes: any angle but 0."""
    angles = [mesh.get("misalignment", {}).get(name, "0") for name in ("in_plane", "out_of_plane")]
    return any(float(str(angle).split()[0]) != 0.0 for angle in angles)


def answer(request: Request, done: Mapping[str, TaskResult]) -> Findings:
    """Quantities by the first law, and the losses by all of them."""
    first = done[f"{_TASK}{request.laws[0]}"].summary
    summaries = {law: done[f"{_TASK}{law}"].summary for law in request.laws}
    losses = {law: float(summary["power_friction_mean"]) for law, summary in summaries.items() if summary}
    values = np.array(list(losses.values()))
    power = float(first["power_in_mean"])
    quantities = {name: first[name] for name in (*_QUANTITIES, *_LAWS) if first.get(name) is not None}
    quantities |= {
        "loss_by_law": losses,
        "loss_lowest": float(values.min()),
        "loss_highest": float(values.max()),
        "efficiency_lowest": 1.0 - float(values.max()) / power,
        "efficiency_highest": 1.0 - float(values.min()) / power,
    }
    rows = done[_SAMPLES].rows if _SAMPLES in done else {}
    return Findings(quantities, spread={name: rows[name] for name in _SCATTERED if name in rows})


ROLE = Contribution(3, "Film, friction and losses", tasks, answer)
