"""The losses of every mesh of a train by its table ``[losses]``.

Every gear and every shaft counts once: a gear in its first mesh, all bearings in the first mesh of the train.
The formulas are of gears on fixed axes: those of planetary stages neither churn nor drive air here.
"""

from collections.abc import Iterator
from dataclasses import replace

from tribodyn.errors import InputError
from tribodyn.input.tables.losses import LossesTable, broken_losses
from tribodyn.studies.motion.drivetrain.placed_train import TrainKinematics
from tribodyn.tribology.losses import LossData


def losses_of_meshes(
    table: LossesTable | None, train: TrainKinematics, speed: float
) -> list[LossData | None]:
    """What every mesh counts of the losses; None: nothing. `speed` is that of the reference body, rad/s."""
    motion, parts = train.motion, train.parts
    if table is None or not table.any:
        return [None] * len(motion.meshes)
    speeds = {body: speed * abs(float(motion.ratio[number])) for body, number in train.numbers.items()}
    turning = [(drag, speeds[parts.body(name)]) for name, drag in table.drags().items()]
    losses, counted_gears = [], set[int]()
    for mesh, gears in enumerate(motion.gears):
        one, two = (gear not in counted_gears and motion.carrier[mesh] < 0 for gear in gears)
        counted_gears |= set(gears)
        data = table.data(*(parts.gears[gear].name for gear in gears))
        depths = data.pinion_immersion if one else 0.0, data.gear_immersion if two else 0.0
        losses.append(replace(data, pinion_immersion=depths[0], gear_immersion=depths[1], counted=(one, two)))
    # a shaft that stands loses nothing
    losses[0] = replace(losses[0], further=tuple(one for one in turning if one[1] > 0.0))
    return list(losses)


def broken_train_losses(table: LossesTable | None, train: TrainKinematics) -> Iterator[InputError]:
    """Go through the rules that a train's losses break."""
    parts = train.parts
    gears = [gear.name for gear in parts.gears]
    bodies = [*gears, *(body.name for body in parts.bodies)]
    return broken_losses(table, gears, bodies, {parts.gears[gear].name for gear in _carried(train)})


def _carried(train: TrainKinematics) -> set[int]:
    """Gears of planetary stages."""
    motion = train.motion
    meshes = zip(motion.gears, motion.carrier, strict=True)
    return {gear for gears, carrier in meshes if carrier >= 0 for gear in gears}
