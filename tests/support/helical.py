"""Helical pairs for several tests: involutes by the numbers of their rack's normal section."""

import numpy as np

from tests.support.faces_in_slices import STEEL
from tribodyn.compliance.sharing.load_sharing import flexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.helix import from_written

#: A pair whose finite elements several tests share, of module 3 mm; its overlap ratio is 1 at 20°.
PAIR, WIDTH = (18, 36), float(np.pi * 3e-3 / np.sin(np.radians(20.0)))


def assembly(teeth, helix, width, module=3e-3, shift=(0.0, 0.0), dedendum=1.25, bore=0.3):
    """A pair of helix angle `helix` (degrees), and bores of that share of the reference diameter."""
    angle = np.radians(helix)
    bodies = [
        GearBody(z, x, 1.0, dedendum, 0.38, width, bore * module * z / 2.0 / np.cos(angle))
        for z, x in zip(teeth, shift, strict=True)
    ]
    written = Drive(module, np.radians(20.0), *bodies, helix_angle=float(angle))
    return assemble(FAMILY, from_written(FAMILY, written))


def elastic(*args, held=False, **changes):
    """The same with its finite elements."""
    return flexibility(assembly(*args, **changes), (STEEL, STEEL), lead=True, held=held)
