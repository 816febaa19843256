"""The meshes of a train as pairs of gears at their duty: what an assessment rates one by one."""

from collections.abc import Mapping
from typing import Any

from tribodyn.geometry.drive import SIDES
from tribodyn.studies.motion.case import Gearbox, TrainMesh
from tribodyn.studies.motion.described.alike import alike_of
from tribodyn.studies.motion.planetary.results import meshes_of_member
from tribodyn.studies.protocol.part import MeshAtDuty, Meshing, WholeDrive
from tribodyn.train.planetary import RING, SUN


def meshes(case: Gearbox) -> list[MeshAtDuty]:
    """Every mesh with its pair; those of a planetary set with its name."""
    stages = {
        m: own.name
        for own in case.sets
        for member in (SUN, RING)
        for m in meshes_of_member(case, own, member)
    }
    return [
        MeshAtDuty(mesh.name, mesh.pair, alike, stages.get(m, ""), _meshing(case, mesh))
        for m, (mesh, alike) in enumerate(zip(case.meshes, alike_of(case), strict=True))
    ]


def _meshing(case: Gearbox, mesh: TrainMesh) -> tuple[Meshing, Meshing]:
    """How the gears of a mesh are loaded in all of their meshes.

    Teeth that drive are loaded on one flank, those that are driven on the other.
    """
    found = []
    for number, own in zip(mesh.gears, SIDES, strict=True):
        roles = [side for _, side in case.gears[number].meshes]
        found.append(Meshing(roles.count(own), len(set(roles)) > 1))
    return found[0], found[1]


def at_speed(case: Gearbox, scenario: Mapping[str, Any], factor: float) -> dict[str, Any]:
    """The scenario at another speed, given at the input, and with its torque in place of a power."""
    operating = {name: value for name, value in scenario["operating"].items() if name != "output_speed"}
    if operating.pop("power", None) is not None and case.loads:
        operating["output_torque"] = f"{case.loads[0].torque!r} N*m"
    operating["input_speed"] = f"{factor * case.source.speed!r} rad/s"
    return {**scenario, "operating": operating}


WHOLE = WholeDrive(meshes, at_speed, lambda case: case.source.speed)
