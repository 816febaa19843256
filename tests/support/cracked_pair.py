"""The pair 18/36 whose teeth are cracked and spalled."""

import math

from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import involute

STEEL = MaterialData("steel", 207e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
WIDTH = 0.0267


def body(teeth, bore, shift=0.0):
    return GearBody(float(teeth), shift, 1.0, 1.25, 0.25, WIDTH, bore)


def pair(module=0.003, helix=0.0):
    scale = module / 0.003
    drive = Drive(
        module, math.radians(20.0), body(18, 0.012 * scale), body(36, 0.025 * scale), helix_angle=helix
    )
    return assemble(involute.FAMILY, drive)
