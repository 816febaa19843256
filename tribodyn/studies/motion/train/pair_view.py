"""A mesh of a train's scenario as the scenario of a pair of gears, for what those share."""

from typing import Any, NamedTuple

from tribodyn.gears.motion.settings import Friction, Mesh
from tribodyn.gears.supports import GearSupports
from tribodyn.input.tables.gears.model_files import DriveTable
from tribodyn.studies.motion.drivetrain.duty_tables import TrainOperating
from tribodyn.studies.motion.drivetrain.placed_train import TrainKinematics
from tribodyn.studies.motion.drivetrain.structure import mesh_table


class PairView(NamedTuple):
    """A mesh as a scenario of one pair of gears, for what those share; its pinion drives."""

    title: str
    name: str
    kind: str
    drive: DriveTable
    mesh: Mesh
    operating: TrainOperating
    lubricant: Any
    film: Any
    friction: Friction
    temperature: Any
    supports: GearSupports = GearSupports()  # what holds its gears


def pair_view(scenario: Any, train: TrainKinematics, mesh: int) -> PairView:
    """Look at a mesh, by its number in the train's order, as at a pair of gears."""
    part = train.parts.meshes[train.motion.meshes[mesh]]
    table, helical = mesh_table(scenario, part), [bool(drive.helix_angle) for drive in train.drives]
    if any(helical) and not helical[mesh] and table.compliance != "fem":
        # slices are of the helical meshes
        table = table.model_copy(update={"slices": None, "slice_coupling": True})
    return PairView(
        scenario.title,
        scenario.name or "scenario",
        scenario.kind,
        train.drives[mesh],
        table,
        scenario.operating,
        scenario.lubricant,
        scenario.film,
        scenario.friction,
        scenario.temperature,
    )


def reference_teeth(train: TrainKinematics) -> int:
    """Teeth of the gear that drives the first mesh: its cycles in a revolution against the mesh's frame."""
    return abs(train.parts.gears[train.motion.gears[0][0]].teeth)
