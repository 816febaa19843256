"""Rules that tie several keys of a gear pair's scenario together: what contradicts, what needs what."""

from collections.abc import Iterator

from tribodyn.errors import InputError, unknown_name
from tribodyn.scenario.tables.bearings import broken_bearing_rules
from tribodyn.scenario.tables.drive_data import gives_backlash
from tribodyn.scenario.tables.duty import broken_duty_rules, duty_of
from tribodyn.solve.methods import SOLVERS
from tribodyn.studies.gear_pair.scenario import Scenario
from tribodyn.studies.gears.motion import Mesh, broken_mesh_rules, broken_source_rules
from tribodyn.studies.gears.scenario import broken_gear_rules


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks; none: it is consistent."""
    yield from broken_gear_rules(scenario)
    yield from broken_bearing_rules(scenario.bearings)
    yield from broken_source_rules(scenario.operating, "pinion_torque")
    yield from broken_mesh_rules(scenario.mesh)
    yield from _load(scenario)
    if scenario.solver.method not in SOLVERS:
        yield unknown_name("solver.method", scenario.solver.method, SOLVERS, "solver")


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
