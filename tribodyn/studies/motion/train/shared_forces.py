"""Bearings of a train that are to bear the forces of its meshes."""

from collections import defaultdict
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.gears.rating.mesh_forces import mesh_force, on_driven, shared_by_bearings
from tribodyn.studies.motion.case import Gearbox
from tribodyn.train.planetary import CARRIER


def with_shared_forces(case: Gearbox) -> Gearbox:
    """The case with the meshes' forces on bearings that ask for them, of planets on the carrier, too."""
    data = case.pair.losses
    if data is None or not any(held.of_meshes for shaft in data.shafts for held in shaft.bearings):
        return case
    forces: dict[int, Any] = defaultdict(lambda: np.zeros(3))
    for mesh in case.meshes:
        pair, sense = mesh.pair, case.bodies[mesh.driver].sense
        force = mesh_force(pair.family, pair.drive, pair.operating.gear_torque)
        driven = on_driven(force, mesh.azimuth, sense)
        forces[mesh.driven] += driven
        forces[mesh.driver] -= driven
    for gearset in case.sets:
        for planet in gearset.planets:
            forces[gearset.members[CARRIER]] += forces[planet]
    first = replace(case.meshes[0].pair, losses=shared_by_bearings(data, forces))
    return replace(case, meshes=(replace(case.meshes[0], pair=first), *case.meshes[1:]))
