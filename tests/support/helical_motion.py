"""Helical pairs for tests of their motion, and their mirror images."""

import numpy as np

EVEN = {
    "mesh.compliance": "constant",
    "mesh.stiffness": "4e8 N/m",
    "friction.law": "none",
    "film.law": "masjedi-khonsari",
}
HELICAL = {"drive.helix_angle": "20 deg", "mesh.slices": 5, **EVEN}


def mirrored(model):
    """Factors on the states where +z becomes −z."""
    layout, factors = model.layout, np.ones(model.layout.states)
    for body in range(layout.spatial):
        z = layout.tilts + 3 * body
        factors[z : z + 3] = factors[layout.half + z : layout.half + z + 3] = -1.0
    return factors
