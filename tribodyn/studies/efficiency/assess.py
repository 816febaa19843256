"""The part in an assessment: film, friction and losses at the duty, and the losses by every friction law."""

from collections.abc import Mapping

import numpy as np

from tribodyn.studies.efficiency import STUDY
from tribodyn.studies.protocol.part import Answer, Asked, Done, Role, Task

_TASK = "efficiency-"
_FIGURES = (
    "efficiency",
    "power_in_mean",
    "power_friction_mean",
    "friction_coefficient_mean",
    "film_min",
    "film_parameter_min",
    "flash_temperature_max",
    "bulk_temperature",
    "power_load_independent",
    "efficiency_with_losses",
)


def tasks(asked: Asked) -> tuple[Task, ...]:
    """One mesh cycle by every friction law."""
    tables = asked.tables
    shared = {
        "title": asked.title,
        "kind": STUDY.kind,
        "drive": tables["drive"],
        "lubricant": tables["lubricant"],
        "operating": asked.operating(),
        "mesh": {"compliance": "fem", **tables.get("mesh", {})},
        **{name: tables[name] for name in ("temperature", "losses") if name in tables},
    }
    return tuple(
        Task(
            f"{_TASK}{law}",
            f"film and losses, {law}",
            {**shared, "friction": {"law": law}},
            needed=law == asked.laws[0],
        )
        for law in asked.laws
    )


def answer(asked: Asked, done: Mapping[str, Done]) -> Answer:
    """Figures by the first law, and the losses by all of them."""
    first = done[f"{_TASK}{asked.laws[0]}"].summary
    summaries = {law: done[f"{_TASK}{law}"].summary for law in asked.laws}
    losses = {law: float(found["power_friction_mean"]) for law, found in summaries.items() if found}
    values = np.array(list(losses.values()))
    power = float(first["power_in_mean"])
    figures = {name: first[name] for name in _FIGURES if first.get(name) is not None}
    figures |= {
        "loss_by_law": losses,
        "loss_lowest": float(values.min()),
        "loss_highest": float(values.max()),
        "efficiency_lowest": 1.0 - float(values.max()) / power,
        "efficiency_highest": 1.0 - float(values.min()) / power,
    }
    return Answer(figures)


ROLE = Role(3, "Film, friction and losses", tasks, answer)
