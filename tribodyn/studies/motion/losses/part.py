"""What the study offers of its gearboxes' losses: `cases.loss_part`."""

from collections.abc import Sequence
from typing import Any

from tribodyn.cases.loss_part import GearboxLosses, LossesOver, NominalPoint, OperatingPoints, Statics
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.losses.gearbox import GearboxLoss
from tribodyn.studies.motion.losses.statics import statics_of
from tribodyn.studies.motion.prepare import prepare

#: Gearboxes that are kept ready.
KEPT = 4
_kept: list[tuple[Gearbox, PreparedGearbox, GearboxLoss]] = []


def ready(case: Gearbox) -> tuple[PreparedGearbox, GearboxLoss]:
    """A gearbox made ready for points of operation; the last ones are kept."""
    for of, prepared, loss in _kept:
        if of is case:
            return prepared, loss
    prepared = prepare(case)
    loss = GearboxLoss(prepared.case, prepared.tables)
    _kept.insert(0, (case, prepared, loss))
    del _kept[KEPT:]
    return prepared, loss


def names(case: Gearbox) -> Sequence[str]:
    """Names of the meshes."""
    return [mesh.name for mesh in case.meshes]


def at(case: Gearbox, points: OperatingPoints) -> LossesOver:
    """Losses at points of operation."""
    return ready(case)[1].at(points)


def nominal(case: Gearbox) -> NominalPoint:
    """The scenario's own point of operation."""
    prepared, loss = ready(case)
    speeds, source, oil = loss.speeds, case.source, case.pair.lubricant
    output = prepared.order[prepared.model.layout.output]
    power = loss.output_power
    kinetic = sum(one.inertia * speed**2 for one, speed in zip(prepared.inertias, speeds, strict=True))
    motor = source.inertia if source.shaft_stiffness is not None else 0.0  # else in its body's
    return NominalPoint(
        output_torque=power / abs(speeds[output]),
        input_torque=power / source.speed,
        input_speed=source.speed,
        oil_temperature=float("nan") if oil.temperature is None else float(oil.temperature),
        ratio=speeds[output] / speeds[source.body],
        inertia=kinetic / source.speed**2 + motor,
    )


def statics(case: Gearbox, loads: Any) -> Statics:
    """Statics at multiples of the scenario's loads."""
    return statics_of(*ready(case), loads)


LOSSES = GearboxLosses(names, at, nominal, statics)
