"""What a drive file would say of each mesh of a train."""

from typing import Any, cast

import numpy as np

from tribodyn.geometry.families import family
from tribodyn.input.quantity import Printed
from tribodyn.input.tables.gears.drive_data import drive_of
from tribodyn.input.tables.gears.model_files import DriveTable
from tribodyn.studies.motion.drivetrain.structure import MeshPart, Structure
from tribodyn.studies.motion.drivetrain.tables import BareMesh, PlanetaryStage


def drive_table(scenario: Any, parts: Structure, mesh: MeshPart, driver: int, driven: int) -> DriveTable:
    """What a drive file would say of a mesh whose gears drive and are driven."""
    table = mesh.table
    if isinstance(table, DriveTable):
        return table
    pinion, gear = parts.gears[driver].table, parts.gears[driven].table
    common = {
        "module": table.module_at(mesh.member) if isinstance(table, PlanetaryStage) else table.module,
        "pressure_angle": table.pressure_angle,
        "mean_roughness": scenario.mean_roughness,
        "material": scenario.material,
        "quality": scenario.quality,
        "quality_edition": scenario.quality_edition,
        "pinion": pinion,
        "gear": gear,
    }
    if isinstance(table, BareMesh):
        return DriveTable.model_construct(family="involute", **common)
    flanks = "roughness", "finish", "asperity_density", "asperity_slope"
    gear_keys = {name: getattr(table, name) for name in ("family", "rack", "shape", "helix_angle", *flanks)}
    distance: Printed | None = table.centre_distance
    at_ring = isinstance(table, PlanetaryStage) and table.spaces and (pinion.internal or gear.internal)
    if distance is None and at_ring and family(table.family).involute:
        distance = _distance_of_set(scenario, parts, mesh)
    return DriveTable.model_construct(**common, **gear_keys, centre_distance=distance)


def _distance_of_set(scenario: Any, parts: Structure, mesh: MeshPart) -> Printed:
    """Distance of the planets' axes from the sun's where none is written: that of both without backlash."""
    spaces = cast(PlanetaryStage, mesh.table).spaces
    own = [other for other in parts.meshes if other.of_set == mesh.of_set]
    at_sun = next(other for other in own if other.member == spaces)
    drive = drive_of(drive_table(scenario, parts, at_sun, *at_sun.gears))
    with np.errstate(all="ignore"):  # teeth that cannot be made are refused where they are put together
        path = family(cast(PlanetaryStage, at_sun.table).family).working_path(drive)
    return Printed(float(path.pinion_pitch_radius + path.gear_pitch_radius), 0.0)
