"""The table ``[losses]`` of a train, by the names of gears and shafts, and the losses of every mesh.

Every gear and every shaft counts once: a gear in its first mesh, all bearings in the first mesh of the train.
The formulas are of gears on fixed axes: those of planetary stages neither churn nor drive air here.
"""

from collections.abc import Iterator
from dataclasses import replace

from pydantic import Field

from tribodyn.errors import InputError, unknown_name
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import written
from tribodyn.input.tables.losses import (
    BearingDrag,
    Depth,
    LossFormulas,
    LossKeys,
    broken_formulas,
    drag_of,
)
from tribodyn.studies.motion.drivetrain.placed_train import TrainKinematics
from tribodyn.tribology.losses import LossData


class TrainLossesTable(LossFormulas):
    """Which load-independent losses are added, and what their formulas need."""

    immersion: dict[PartName, Depth] = written({})
    shaft_bearings: dict[PartName, BearingDrag] = Field({})


def losses_of_meshes(
    table: TrainLossesTable | None, train: TrainKinematics, speed: float
) -> list[LossData | None]:
    """What every mesh counts of the losses; None: nothing. `speed` is that of the reference body, rad/s."""
    motion, parts = train.motion, train.parts
    if table is None or not table.any:
        return [None] * len(motion.meshes)
    formulas = {name: getattr(table, name) for name in LossFormulas.model_fields}
    drags = [(drag_of(bearing), parts.body(name)) for name, bearing in table.shaft_bearings.items()]
    speeds = {body: speed * abs(float(motion.ratio[number])) for body, number in train.numbers.items()}
    turning = [(drag, speeds[body]) for drag, body in drags if drag is not None]
    losses, counted_gears = [], set[int]()
    for mesh, gears in enumerate(motion.gears):
        counted = [gear not in counted_gears and motion.carrier[mesh] < 0 for gear in gears]
        counted_gears |= set(gears)
        depths = [
            table.immersion.get(parts.gears[gear].name, 0.0) if bearing else 0.0
            for gear, bearing in zip(gears, counted, strict=True)
        ]
        losses.append(LossData(**formulas, pinion_immersion=depths[0], gear_immersion=depths[1]))
        losses[-1] = replace(losses[-1], counted=(counted[0], counted[1]))
    # a shaft that stands loses nothing
    losses[0] = replace(losses[0], further=tuple(one for one in turning if one[1] > 0.0))
    return list(losses)


def broken_losses(table: TrainLossesTable | None, train: TrainKinematics) -> Iterator[InputError]:
    """Go through the rules that a train's losses break."""
    if table is None:
        return
    parts = train.parts
    gears = [gear.name for gear in parts.gears]
    bodies = [*gears, *(body.name for body in parts.bodies)]
    in_sets = {parts.gears[gear].name for gear in _carried(train)}
    for name in table.immersion:
        key = f"losses.immersion.{name}"
        if name not in gears:
            yield unknown_name(key, name, gears, "gear")
        elif name in in_sets:
            rule = "is in a planetary stage, and the formulas are of gears on fixed axes"
            yield InputError(key, None, rule, "leave it out")
    for name in table.shaft_bearings:
        if name not in bodies:
            yield unknown_name(f"losses.shaft_bearings.{name}", name, bodies, "gear, shaft or body")
    immersion = f'add [losses.immersion] with {gears[-1]} = "20 mm"'
    bearings = f'add [losses.shaft_bearings.{bodies[0]}] with type = "deep-groove-ball" and mean_diameter'
    keys = LossKeys(
        [f"immersion.{name}" for name, depth in table.immersion.items() if depth],
        [f"shaft_bearings.{name}" for name in table.shaft_bearings],
        ("immersion", immersion),
        ("shaft_bearings", bearings),
    )
    yield from broken_formulas(table, keys)


def _carried(train: TrainKinematics) -> set[int]:
    """Gears of planetary stages."""
    motion = train.motion
    meshes = zip(motion.gears, motion.carrier, strict=True)
    return {gear for gears, carrier in meshes if carrier >= 0 for gear in gears}
