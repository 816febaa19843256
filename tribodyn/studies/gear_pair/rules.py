"""Rules that tie several keys of a scenario together: what contradicts, what needs what."""

import math
from collections.abc import Iterator

from tribodyn.dynamics.rolling_bearing import ROLLERS
from tribodyn.errors import InputError, unknown_name
from tribodyn.scenario.tables.drive_data import gives_backlash
from tribodyn.scenario.tables.drive_rules import broken_drive_rules, broken_part_rules
from tribodyn.scenario.tables.duty import broken_duty_rules, duty_of
from tribodyn.scenario.tables.losses import broken_loss_rules
from tribodyn.scenario.tables.lubricant_rules import broken_lubricant_rules
from tribodyn.scenario.tables.model_files import Bearing, Rolling
from tribodyn.scenario.tables.modification_rules import Face, broken_face_rules
from tribodyn.scenario.tables.quality import broken_sample_rules
from tribodyn.scenario.tables.spectrum import unnamed_duty
from tribodyn.scenario.tables.temperature import broken_temperature_rules
from tribodyn.solve.methods import SOLVERS
from tribodyn.studies.gear_pair.scenario import Mesh, Operating, Scenario

#: Contact angle from which a bearing carries no radial load to speak of.
MAXIMUM_CONTACT_ANGLE = math.radians(60.0)


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks; none: it is consistent."""
    yield from broken_drive_rules(scenario.drive)
    yield from unnamed_duty(scenario)
    yield from broken_lubricant_rules(scenario.lubricant, scenario.operating.oil_temperature)
    yield from broken_temperature_rules(scenario.temperature, scenario.lubricant)
    yield from broken_loss_rules(scenario.losses)
    yield from _bearing("bearings.pinion", scenario.bearings.pinion)
    yield from _bearing("bearings.gear", scenario.bearings.gear)
    yield from _operating(scenario.operating)
    yield from _mesh(scenario.mesh)
    yield from broken_face_rules(_face(scenario), scenario.mesh.compliance)
    yield from broken_sample_rules(scenario.drive, scenario.mesh.deviation_sample, scenario.mesh.misalignment)
    yield from _load(scenario)
    if scenario.solver.method not in SOLVERS:
        yield unknown_name("solver.method", scenario.solver.method, SOLVERS, "solver")


def _face(scenario: Scenario) -> Face:
    mesh = scenario.mesh
    return Face(scenario.drive, mesh.misalignment, mesh.slices, mesh.slice_coupling)


def _bearing(key: str, bearing: Bearing) -> Iterator[InputError]:
    for name in ("stiffness_x", "stiffness_y"):
        given = getattr(bearing, name)
        if bearing.rolling is None and given is None:
            yield InputError(
                f"{key}.{name}",
                rule="missing",
                remedy=f'add {name} = "1e9 N/m", or the table [{key}.rolling]',
            )
        elif bearing.rolling is not None and given is not None:
            yield InputError(
                f"{key}.{name}",
                f"{given:g} N/m",
                f"contradicts [{key}.rolling], from which it follows",
                "give the one or the other",
            )
    if bearing.rolling is not None:
        yield from _rolling(f"{key}.rolling", bearing.rolling)
    each = (bearing.damping_ratio_x, bearing.damping_ratio_y)
    if bearing.damping_ratio is not None and any(ratio is not None for ratio in each):
        yield InputError(
            f"{key}.damping_ratio",
            bearing.damping_ratio,
            "contradicts damping_ratio_x and damping_ratio_y",
            "write the one for both axes, or both of the others",
        )
    elif bearing.damping_ratio is None and any(ratio is None for ratio in each):
        yield InputError(
            f"{key}.damping_ratio", rule="missing", remedy="add damping_ratio = 0.05, for both axes"
        )


def _rolling(key: str, rolling: Rolling) -> Iterator[InputError]:
    needed, other = ("length", "diameter") if rolling.type in ROLLERS else ("diameter", "length")
    if getattr(rolling, needed) is None:
        rule = f'missing: type = "{rolling.type}" needs it'
        yield InputError(f"{key}.{needed}", rule=rule, remedy=f'add {needed} = "12 mm"')
    if getattr(rolling, other) is not None:
        yield InputError(
            f"{key}.{other}",
            rule=f'has no effect with type = "{rolling.type}"',
            remedy=f"leave {other} out",
        )
    if rolling.contact_angle >= MAXIMUM_CONTACT_ANGLE:
        yield InputError(
            f"{key}.contact_angle",
            rule="60 deg or more: a thrust bearing",
            remedy="write a smaller angle, or give stiffness_x and stiffness_y",
        )


def _operating(operating: Operating) -> Iterator[InputError]:
    key = "operating."
    if operating.source == "speed":
        for name in (
            "pinion_torque",
            "drive_inertia",
            "shaft_stiffness",
            "shaft_damping",
            "speed_regulation",
        ):
            value = operating.motor_torque if name == "pinion_torque" else getattr(operating, name)
            if value:
                yield InputError(
                    key + name,
                    f"{value:g} (SI)",
                    'contradicts source = "speed": a prescribed rotation needs no motor',
                    f'leave {name} out, or write source = "torque"',
                )
    elif operating.shaft_stiffness is None and operating.shaft_damping:
        yield InputError(
            key + "shaft_damping",
            f"{operating.shaft_damping:g} N*m*s/rad",
            "a rigid shaft has no damping",
            "add shaft_stiffness, or leave shaft_damping out",
        )
    elif operating.shaft_stiffness is not None and operating.drive_inertia == 0:
        yield InputError(
            key + "drive_inertia",
            "0 kg*m**2",
            "a compliant shaft needs a motor with inertia at its end",
            'add drive_inertia = "0.01 kg*m**2", or leave shaft_stiffness out',
        )


def _load(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules of speed and load; without one of each there is nothing else to say."""
    operating, drive, mesh = scenario.operating, scenario.drive, scenario.mesh
    if broken := broken_duty_rules(operating.load):
        yield from broken
        return
    torque = duty_of(operating.load, drive.pinion.teeth, drive.gear.teeth).gear_torque
    back_flanks = mesh.backlash is not None or gives_backlash(drive)
    if torque <= 0 and not back_flanks:
        yield InputError(
            "operating.gear_torque",
            f"{torque:g} N*m",
            "must be greater than zero: without backlash only the driving flanks can carry load",
            'write a torque such as "500 N*m", or add mesh.backlash',
        )
    yield from _working_flanks(torque, back_flanks, mesh)


def _working_flanks(torque: float, back_flanks: bool, mesh: Mesh) -> Iterator[InputError]:
    """Refuse what a load on the back flanks leaves without effect, and no load where the mesh needs one."""
    for name in ("harmonics", "table"):
        if torque < 0 and getattr(mesh.transmission_error, name):
            yield InputError(
                f"mesh.transmission_error.{name}",
                rule="is that of the driving flanks, but under a negative gear_torque the back flanks carry",
                remedy="leave it out, or reverse the load",
            )
    if torque < 0 and mesh.deviation_sample is not None:
        yield InputError(
            "mesh.deviation_sample",
            mesh.deviation_sample,
            "is of the driving flanks, but under a load that drives the gear the back flanks carry",
            "leave it out, or reverse the load",
        )
    if torque == 0 and back_flanks and mesh.compliance == "fem":
        yield InputError(
            "operating.gear_torque",
            "0 N*m",
            'contradicts compliance = "fem", which is taken at this load',
            'write a torque such as "500 N*m", or use compliance = "energy"',
        )


def _mesh(mesh: Mesh) -> Iterator[InputError]:
    for choice, name in (("constant", "stiffness"), ("table", "table")):
        given = getattr(mesh, name) is not None
        if mesh.compliance == choice and not given:
            yield InputError(
                f"mesh.{name}",
                rule=f'missing: compliance = "{choice}" needs it',
                remedy=f"add {name} = "
                + (
                    '"2.8e8 N/m"'
                    if choice == "constant"
                    else '"stiffness.csv", columns roll_angle and stiffness'
                ),
            )
        if mesh.compliance != choice and given:
            yield InputError(
                f"mesh.{name}",
                rule=f'contradicts compliance = "{mesh.compliance}"',
                remedy=f'leave {name} out, or write compliance = "{choice}"',
            )
    yield from broken_part_rules(mesh.hertz, mesh.foundation, mesh.compliance)
    error = mesh.transmission_error
    if error.harmonics and error.table is not None:
        yield InputError(
            "mesh.transmission_error.table",
            rule="contradicts mesh.transmission_error.harmonics",
            remedy="give the one or the other",
        )
