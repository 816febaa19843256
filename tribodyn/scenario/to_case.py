"""From the validated tables of a scenario to the plain data that the physics takes."""

from typing import cast

from tribodyn import case
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.scenario import model_files, schema


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
        drive=Drive(drive.module, drive.pressure_angle, _body(drive.pinion), _body(drive.gear)),
        materials=(_material(drive, drive.pinion), _material(drive, drive.gear)),
        masses=(_mass(drive.pinion), _mass(drive.gear)),
        roughness=drive.roughness,
        lubricant=case.LubricantData(
            **scenario.lubricant.model_dump(exclude={"title", "source", "assumptions"})
        ),
        bearings=(_bearing(scenario.bearings.pinion), _bearing(scenario.bearings.gear)),
        operating=_operating(scenario.operating),
        mesh=_mesh(scenario.mesh),
        friction=case.FrictionData(**scenario.friction.model_dump()),
        solver=case.SolverData(**scenario.solver.model_dump()),
        output=case.OutputData(**scenario.output.model_dump()),
    )


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


def _mesh(mesh: schema.Mesh) -> case.MeshData:
    error = mesh.transmission_error
    return case.MeshData(
        table=mesh.table.in_si() if mesh.table else None,
        error_harmonics=tuple((one.order, one.amplitude, one.phase) for one in error.harmonics),
        error_table=error.table.in_si() if error.table else None,
        **mesh.model_dump(exclude={"table", "transmission_error"}),
    )


def _mass(gear: model_files.Gear) -> case.BodyMass:
    return case.BodyMass(gear.mass, gear.inertia)
