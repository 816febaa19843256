"""Losses of a gearbox by term and element at the duty of its scenario, and in a run of its motion."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.errors import InputError, SimulationError
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.losses.breakdown import ElementLoss, balance, breakdown
from tribodyn.studies.motion.losses.gearbox import GearboxLoss, formula_of


def losses_at_duty(prepared: PreparedGearbox) -> tuple[dict[str, Any], list[str]]:
    """Losses in slow rotation at the scenario's load, speed and oil, and what is to be said of them.

    Nothing without power, and where friction locks a mesh.
    """
    gearbox, case = GearboxLoss(prepared.case, prepared.tables), prepared.case
    if not gearbox.output_power:
        return {}, []
    speed, oil = case.source.speed, case.pair.lubricant.temperature
    at = OperatingPoints(np.ones(1), np.array([speed]), np.array([np.nan if oil is None else float(oil)]))
    if case.heat is not None and case.heat.settled is not None:
        bulk = [0.5 * (one + two) for one, two in case.heat.settled.gears]
        at = at._replace(bulk_temperature=np.array([bulk]))
    try:
        found = gearbox.at(at)
    except (SimulationError, InputError) as error:
        return {}, [f"No losses by term: {error}."]
    power = found.power(at.speed)[0]
    losses = [ElementLoss(*each) for each in zip(found.sources, power.tolist(), found.exceeded, strict=True)]
    return breakdown(losses, balance(losses, gearbox.load_powers)), []


def losses_of_run(
    prepared: PreparedGearbox, friction: Sequence[float], whole: Mapping[str, Any]
) -> dict[str, Any]:
    """Losses by the motion of the meshes, W, and beside them those that it does not have, at nominal speed.

    `whole` has the mean power that is put in, of the motion alone. Nothing of runs by time, whose speed is
    what it becomes, and of gears that stand.
    """
    gearbox, case = GearboxLoss(prepared.case, prepared.tables), prepared.case
    if case.in_time or not np.all(np.isfinite([*friction, whole["power_in_mean"]])):
        return {}
    speed, oil = np.array([case.source.speed]), np.array([_oil_temperature(prepared)])
    losses = _of_meshes(gearbox, friction, OperatingPoints(np.ones(1), speed, oil))
    drags = gearbox.drags_at(speed, oil, np.ones(1))
    for source, drag, ratio in zip(gearbox.sources[len(losses) :], drags, gearbox.of_bodies, strict=True):
        losses.append(ElementLoss(source, float(drag.torque[0] * ratio * speed[0]), drag.exceeded))
    put_in, lost = float(whole["power_in_mean"]), sum(loss.power for loss in losses)
    rubbed = sum(float(power) for power in friction)
    powers = {"power_in": put_in + lost - rubbed, "power_out": put_in - rubbed, "power_lost": lost}
    return breakdown(losses, powers)


def _of_meshes(gearbox: GearboxLoss, friction: Sequence[float], duty: OperatingPoints) -> list[ElementLoss]:
    """Losses of the meshes by their motion, or at the duty where [losses] names a formula."""
    count = len(gearbox.tables)
    sources, exceeded, powers = gearbox.sources[:count], [()] * count, list(friction)
    if formula_of(gearbox.case.pair) is not None:
        found = gearbox.at(duty)
        exceeded, powers = found.exceeded, found.power(duty.speed)[0].tolist()
    each = zip(sources, powers, exceeded, strict=False)
    return [ElementLoss(source, float(power), limits) for source, power, limits in each]


def _oil_temperature(prepared: PreparedGearbox) -> float:
    """Temperature of the oil around the gears, K; NaN where none is given."""
    for thermal in prepared.thermal:
        if thermal is not None and thermal.temperatures is not None:
            return float(thermal.temperatures.oil)
    known = prepared.case.pair.lubricant.temperature
    return float("nan") if known is None else float(known)
