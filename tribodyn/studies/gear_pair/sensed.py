"""Sensors on a pair of gears: its places, and what listens to its run."""

from tribodyn.dynamics.outputs import holding_links
from tribodyn.signals.lines import lines_of_pair
from tribodyn.studies.gear_pair.outputs import MESH
from tribodyn.studies.gear_pair.prepare import GEAR, MOTOR, PINION, PreparedPair
from tribodyn.studies.gears.sensed.listening import Listener
from tribodyn.studies.gears.sensed.places import Sensible, placed

NAMES = ("pinion", "gear", "motor")


def sensible(prepared: PreparedPair) -> Sensible:
    """What of the pair can be sensed."""
    layout, drive = prepared.model.layout, prepared.case.drive
    held = {NAMES[layout.first[link]]: link for link in holding_links(prepared.model)}
    motor = {"shaft": layout.links - 1} if layout.bodies > MOTOR else {}
    return Sensible(
        bodies={NAMES[body]: body for body in range(layout.bodies)},
        bearings=held,
        meshes={"mesh": MESH},
        shafts=motor,
        lines=lines_of_pair(
            NAMES[PINION], NAMES[GEAR], (int(abs(drive.pinion.teeth)), int(abs(drive.gear.teeth)))
        ),
        reference=NAMES[PINION],
    )


def listener_of(prepared: PreparedPair) -> Listener:
    """What listens to a run of the pair; raises InputError where a sensor cannot."""
    case, known = prepared.case, sensible(prepared)
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    at = placed(case.sensors, case.housing, known, prepared.model, samples, cycles)
    return Listener(at, case.housing, known)
