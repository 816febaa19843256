"""What single teeth of a train's gears have of their own: deviations and damage, in all meshes of a gear."""

from typing import Any

from tribodyn.input.tables.gears.damage import GearPlace, damage_of
from tribodyn.input.tables.gears.single_teeth import own_teeth_of
from tribodyn.mesh.teeth.fields import CARRYING, OwnTeeth
from tribodyn.studies.motion.drivetrain.placed_train import TrainKinematics


def own_teeth(scenario: Any, train: TrainKinematics, mesh: int, view: Any) -> tuple[OwnTeeth, OwnTeeth]:
    """What teeth of driver and driven gear of a mesh have; `view` is its `scenario.PairView`."""
    numbers = train.motion.gears[mesh]
    one, two = (tuple(sorted({CARRYING[side] for _, side in train.meshes_of(gear)})) for gear in numbers)
    deviations = own_teeth_of(view.drive, view.mesh.tooth_sample, numbers, (one, two))
    damaged, both_gears = gears_of_train(train), []
    for deviating, number in zip(deviations, numbers, strict=True):
        name = train.parts.gears[number].name
        tables = [table for table in scenario.damage if table.gear == name]
        both_gears.append((*deviating, *damage_of(tables, damaged[name])))
    return both_gears[0], both_gears[1]


def gears_of_train(train: TrainKinematics) -> dict[str, GearPlace]:
    """The gears that may be damaged, by name."""
    return {
        gear.name: GearPlace(tuple((train.drives[mesh], side) for mesh, side in train.meshes_of(number)))
        for number, gear in enumerate(train.parts.gears)
    }
