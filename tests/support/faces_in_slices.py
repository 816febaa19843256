"""Modified and misaligned faces in slices: condensed to a table, and the load contact model itself."""

import dataclasses

import numpy as np

from tribodyn.compliance.sharing.flank_gap import flank_gap
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import face_positions
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
)
from tribodyn.mesh.tabulate_loaded import tabulate_loaded

STEEL = MaterialData("steel", 207e9, 0.3, 7850.0, 45.0, 460.0, 6.5e9)
WIDTH = 26.7e-3
#: The pair of Diez-Ibarbia et al. with bores and cutter as assumed for it.
DRIVE = Drive(
    3e-3,
    np.radians(20.0),
    GearBody(18, 0.0, 1.0, 1.25, 0.25, WIDTH, 12e-3),
    GearBody(36, 0.0, 1.0, 1.25, 0.25, WIDTH, 25e-3),
)
TIP = FlankModification(tip=Relief(12e-6, 3e-3))
CASES = {
    "tips": (Modifications(TIP, TIP), 1),
    "tilt": (Modifications(misalignment=Misalignment(5e-4)), 11),
    "lift": (Modifications(misalignment=Misalignment(1.5e-3)), 11),
    "all": (
        Modifications(TIP._replace(lead=LeadRelief(5e-6, 8e-6, 3e-3)), TIP, Misalignment(-4e-4, 2e-4)),
        11,
    ),
}


def table(case, modified, slices, **changes):
    mesh = dataclasses.replace(case.mesh, modifications=modified, slices=slices, points=33, **changes)
    torque = case.operating.gear_torque
    back = mesh.backlash is not None
    return tabulate_loaded(assemble(family(case.family), case.drive), case.materials, mesh, torque, back)


def model(case, cycle, modified, slices, torque, coupled=True):
    """Loads and deflection of the load contact model at the nodes of the table."""
    flexible = flexibility(
        assemble(family(case.family), case.drive), case.materials, lead=slices > 1, held=case.mesh.held
    )
    pairs = cycle.front_pairs
    position = cycle.phase[..., None] + np.arange(pairs - 1.0, -1.0, -1.0)
    roll = np.clip(cycle.roll_start + cycle.pitch_angle * position, cycle.roll_start, cycle.roll_end)
    roll = roll.reshape(-1, pairs)
    face = face_positions(flexible.width, slices)
    gap = flank_gap(flexible.assembly, modified, pair_geometry(flexible.assembly, roll), face)
    return LoadedFlanks(flexible, slices=slices, coupled=coupled).share(roll, torque, 0.0, gap)
