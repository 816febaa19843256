"""What a run says of planetary stages: how the planets share the load, powers, efficiency; kinds of modes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.modes import Modes, mode_kinds
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox, SetData
from tribodyn.train.planetary import CARRIER, SUN


def meshes_of_member(case: Gearbox, gearset: SetData, member: str) -> list[int]:
    """Meshes of a sun or the ring of a set, in the order of the planets."""
    body = gearset.members[member]
    mesh_of_planet = {
        other: m
        for m, mesh in enumerate(case.meshes)
        for one, other in ((mesh.driver, mesh.driven), (mesh.driven, mesh.driver))
        if one == body and other in gearset.planets
    }
    return [mesh_of_planet[planet] for planet in gearset.planets if planet in mesh_of_planet]


def meshes_of_set(case: Gearbox, gearset: SetData) -> list[int]:
    """All meshes of a set."""
    return [m for m, mesh in enumerate(case.meshes) if mesh.carrier == gearset.members[CARRIER]]


def stage_quantities(
    prepared: PreparedGearbox, windows: Sequence[Mapping[str, np.ndarray]], each: Sequence[Mapping[str, Any]]
) -> dict[str, dict[str, Any]]:
    """Quantities of every planetary stage over the last whole cycles.

    `windows` and `each` have the datasets and the quantities of every mesh over them.
    """
    return {gearset.name: _of_stage(prepared, gearset, windows, each) for gearset in prepared.case.sets}


def worst_stage(stages: Mapping[str, Mapping[str, Any]]) -> dict[str, float]:
    """Largest load factors of all stages."""
    names = ("mesh_load_factor", "planet_load_factor_max")
    return {name: max(float(stage[name]) for stage in stages.values()) for name in names}


def _of_stage(
    prepared: PreparedGearbox,
    gearset: SetData,
    windows: Sequence[Mapping[str, np.ndarray]],
    each: Sequence[Mapping[str, Any]],
) -> dict[str, Any]:
    case = prepared.case
    at = {member: meshes_of_member(case, gearset, member) for member in gearset.members if member != CARRIER}
    loads = [
        np.array([_on_planet(case, gearset, m, windows[m]) for m in at[member]])
        for member in at
        if member == SUN or gearset.teeth.second_sun  # of two suns one may carry nothing
    ]
    torque = max(loads, key=lambda each: abs(float(np.mean(each))))
    mean = np.mean(torque, axis=1)
    whole = float(np.mean(mean))
    lost = sum(float(each[m]["power_friction_mean"]) for m in meshes_of_set(case, gearset))
    put_in = sum(max(power, 0.0) for power in _powers(prepared, gearset, at, windows))
    quantities = {
        "mesh_load_factor": float(np.max(mean)) / whole if whole else np.nan,
        "planet_load_factor_max": float(np.max(torque)) / whole if whole else np.nan,
        "power_in_mean": put_in,
        "power_friction_mean": lost,
        "efficiency": 1.0 - lost / put_in if put_in > 0.0 else np.nan,
    }
    return quantities | {"planet_shares": mean / whole / len(mean) if whole else np.full(len(mean), np.nan)}


def _on_planet(case: Gearbox, gearset: SetData, m: int, window: Mapping[str, np.ndarray]) -> np.ndarray:
    """Torque between a member and a planet, on the planet, N m."""
    return window["driven_torque" if case.meshes[m].driven in gearset.planets else "driver_torque"]


def _powers(
    prepared: PreparedGearbox,
    gearset: SetData,
    at: Mapping[str, list[int]],
    windows: Sequence[Mapping[str, np.ndarray]],
) -> list[float]:
    """Mean powers that go into a set at its gears and its carrier, W; they add up to its losses."""
    case = prepared.case
    reference = float(prepared.model.operation.nominal_speed)
    powers, on_carrier = [], 0.0
    carrier = case.bodies[gearset.members[CARRIER]]
    for member, meshes in at.items():
        body = gearset.members[member]
        turning = case.bodies[body]
        on_body = 0.0  # in its own sense
        for m in meshes:
            driven = case.meshes[m].driven == body
            on_body += float(np.mean(windows[m]["driven_torque" if driven else "driver_torque"])) * (
                1.0 if driven else -1.0
            )
        powers.append(-on_body * float(turning.ratio) * reference)
        on_carrier -= on_body * turning.sense * carrier.sense
    return [*powers, -on_carrier * float(carrier.ratio) * reference]


def kinds_of(prepared: PreparedGearbox, mode_set: Modes) -> tuple[str, ...]:
    """Kind of every mode of a train by the motion of its suns, rings and carriers; nothing without sets."""
    case = prepared.case
    if not case.sets:
        return ()
    number = {body: place for place, body in enumerate(prepared.order)}
    central = [number[body] for gearset in case.sets for body in gearset.members.values()]
    return mode_kinds(mode_set, prepared.model, central)


def planet_pass(prepared: PreparedGearbox) -> dict[str, float]:
    """Frequency at which the planets of every set pass a place in the housing, Hz."""
    reference = float(prepared.model.operation.nominal_speed)
    return {
        gearset.name: gearset.arms
        * float(prepared.case.bodies[gearset.members[CARRIER]].ratio)
        * reference
        / (2.0 * np.pi)
        for gearset in prepared.case.sets
    }
