"""From the validated tables of a scenario to the plain data that the physics takes."""

import math
from typing import cast

from tribodyn import case
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.modification import Modifications, vary_along_lead
from tribodyn.scenario import model_files, schema
from tribodyn.scenario.modification import MisalignmentTable, flank_of, misalignment_of
from tribodyn.scenario.shape import shape_of

#: Slices along the face where nothing is said and anything varies along it.
SLICES = 21


def case_of(scenario: schema.Scenario, toml: str, sha256: str) -> case.Case:
    """Return the case of a scenario that has passed schema and rules."""
    drive = scenario.drive
    return case.Case(
        title=scenario.title,
        name=scenario.name or "scenario",
        kind=scenario.kind,
        toml=toml,
        sha256=sha256,
        family=drive.family,
        drive=drive_of(drive),
        materials=materials_of(drive),
        masses=masses_of(drive),
        roughness=drive.roughness,
        mean_roughness=mean_roughness(drive),
        lubricant=lubricant_of(scenario.lubricant),
        bearings=(_bearing(scenario.bearings.pinion), _bearing(scenario.bearings.gear)),
        operating=_operating(scenario.operating),
        mesh=_mesh(scenario),
        friction=case.FrictionData(**scenario.friction.model_dump()),
        solver=case.SolverData(**scenario.solver.model_dump()),
        output=case.OutputData(**scenario.output.model_dump()),
    )


def lubricant_of(lubricant: model_files.Lubricant) -> case.LubricantData:
    """Return the lubricant's numbers."""
    return case.LubricantData(**lubricant.model_dump(exclude={"title", "source", "assumptions"}))


def mean_roughness(drive: model_files.DriveTable) -> float:
    """Ra of the flanks, m; σ/√π where it is not given: two equal flanks with normally distributed heights."""
    return drive.roughness / math.sqrt(math.pi) if drive.mean_roughness is None else drive.mean_roughness


def drive_of(drive: model_files.DriveTable) -> Drive:
    """Return the geometry of a drive file."""
    from tribodyn.scenario.load import family

    shape = shape_of(drive, family(drive.family))
    return Drive(drive.module, drive.pressure_angle or 0.0, _body(drive.pinion), _body(drive.gear), shape)


def materials_of(drive: model_files.DriveTable) -> tuple[case.MaterialData, case.MaterialData]:
    """Return what pinion and gear are made of."""
    return _material(drive, drive.pinion), _material(drive, drive.gear)


def masses_of(drive: model_files.DriveTable) -> tuple[case.BodyMass, case.BodyMass]:
    """Return the masses that a drive file gives."""
    return _mass(drive.pinion), _mass(drive.gear)


def _body(gear: model_files.Gear) -> GearBody:
    return GearBody(
        teeth=float(gear.teeth),
        profile_shift=gear.profile_shift,
        addendum=gear.addendum,
        dedendum=gear.dedendum,
        fillet_radius=gear.fillet_radius,
        face_width=gear.face_width,
        bore_radius=gear.bore_radius,
        tip_radius=gear.tip_radius,
    )


def _material(drive: model_files.DriveTable, gear: model_files.Gear) -> case.MaterialData:
    material = cast(model_files.Material, gear.material or drive.material)
    numbers = material.model_dump(exclude={"title", "source", "assumptions"})
    return case.MaterialData(name=material.title, **numbers)


def _bearing(bearing: model_files.Bearing) -> case.BearingData:
    ratio_x = bearing.damping_ratio if bearing.damping_ratio_x is None else bearing.damping_ratio_x
    ratio_y = bearing.damping_ratio if bearing.damping_ratio_y is None else bearing.damping_ratio_y
    return case.BearingData(
        bearing.stiffness_x, bearing.stiffness_y, cast(float, ratio_x), cast(float, ratio_y)
    )


def _operating(operating: schema.Operating) -> case.OperatingData:
    curve = operating.gear_torque_table
    return case.OperatingData(
        torque_table=curve.in_si() if curve else None,
        torque_harmonics=tuple(
            (one.amplitude, one.frequency, one.phase) for one in operating.gear_torque_harmonics
        ),
        **operating.model_dump(exclude={"gear_torque_table", "gear_torque_harmonics"}),
    )


def _mesh(scenario: schema.Scenario) -> case.MeshData:
    mesh = scenario.mesh
    error = mesh.transmission_error
    modifications = modifications_of(scenario.drive, mesh.misalignment)
    return case.MeshData(
        table=mesh.table.in_si() if mesh.table else None,
        error_harmonics=tuple((one.order, one.amplitude, one.phase) for one in error.harmonics),
        error_table=error.table.in_si() if error.table else None,
        modifications=modifications,
        slices=slices_of(mesh.slices, modifications),
        **mesh.model_dump(exclude={"table", "transmission_error", "misalignment", "slices"}),
    )


def modifications_of(drive: model_files.DriveTable, misalignment: MisalignmentTable) -> Modifications:
    """Return what is taken off the flanks of a drive, and how its axes stand."""
    return Modifications(
        flank_of(drive.pinion.modification), flank_of(drive.gear.modification), misalignment_of(misalignment)
    )


def slices_of(given: int | None, modifications: Modifications) -> int:
    """Return the number of slices along the face."""
    return given or (SLICES if vary_along_lead(modifications) else 1)


def _mass(gear: model_files.Gear) -> case.BodyMass:
    return case.BodyMass(gear.mass, gear.inertia)
