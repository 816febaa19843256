"""Sensors on a gearbox: its places, and what listens to its run."""

import numpy as np

from tribodyn.dynamics.recorded.outputs import holding_links
from tribodyn.gears.sensing.listening import Listener
from tribodyn.gears.sensing.sensor_places import Radiator, RingPlaces, Sensible, placed
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.frequencies import lines_of
from tribodyn.studies.motion.planetary.results import meshes_of_member
from tribodyn.train.planetary import CARRIER, RING
from tribodyn.train.structure import TURN


def sensible(prepared: PreparedGearbox) -> Sensible:
    """What of the gearbox can be sensed."""
    case, model, names = prepared.case, prepared.model, prepared.names
    layout = model.layout
    stiffness = np.asarray(model.links.stiffness)
    numbers = {body: place for place, body in enumerate(prepared.order)}
    of_motor = "motor" if case.named else "shaft"
    shafts = {
        case.links[k].name if k < len(case.links) else of_motor: k
        for k in range(layout.links)
        if layout.second[k] >= 0 and stiffness[k, TURN] > 0.0
    }
    rings = {
        gearset.name: RingPlaces(
            numbers[gearset.members[CARRIER]],
            case.bodies[gearset.members[CARRIER]].sense,
            gearset.angles[-gearset.arms :],
            tuple(meshes_of_member(case, gearset, RING)),
        )
        for gearset in case.sets
    }
    system = case.system
    housing = None if system is None else system.housing
    structure, radiator = {}, None
    if system is not None and housing is not None:
        moved = system.motion_of_housing(layout, numbers)
        structure = {at: housing.motion_of(at) @ moved for at in (*housing.points, *housing.seats)}
        if housing.radiation is not None:
            radiator = Radiator(moved, housing.radiation, system.radiation_efficiency)
    return Sensible(
        bodies={name: number for number, name in enumerate(names)},
        bearings={names[layout.first[k]]: k for k in holding_links(model) if layout.second[k] < 0},
        meshes={mesh.name: number for number, mesh in enumerate(case.meshes)},
        shafts=shafts,
        lines=lines_of(prepared),
        reference=names[0],
        rings=rings,
        structure=structure,
        radiator=radiator,
        reactions={name: k for k, name in enumerate(case.system.bearing_names if case.system else ())},
    )


def listener_of(prepared: PreparedGearbox) -> Listener:
    """What listens to a run of the gearbox; raises InputError where a sensor cannot."""
    case, places = prepared.case, sensible(prepared)
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    at = placed(case.sensors, case.housing, places, prepared.model, samples, cycles)
    return Listener(at, case.housing, places)
