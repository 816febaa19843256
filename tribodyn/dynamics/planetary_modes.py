"""Kinds of modes of planetary sets: rotational, translational, planet modes.

Of equally spaced equal planets every mode is of one kind (Lin & Parker, J. Vib. Acoust. 121 (1999) 316): in
rotational modes sun, ring and carrier only turn, in translational ones they only move in x and y, in planet
modes they rest.
"""

from collections.abc import Sequence

import numpy as np

from tribodyn.dynamics.modes import Modes
from tribodyn.dynamics.parameters import Model
from tribodyn.train.structure import shift_of, turn_of

ROTATIONAL, TRANSLATIONAL, PLANET, MIXED = "rotational", "translational", "planet", "mixed"
#: Share of a mode's kinetic energy below which a motion is none: rounding leaves 1e-20, or where modes of two
#: kinds are all but equally fast its size over the distance of the frequencies, squared.
NO_MOTION = 1e-9


def mode_kinds(found: Modes, model: Model, central: Sequence[int]) -> tuple[str, ...]:
    """Kind of every mode; `central` are the bodies sun, ring and carrier. `MIXED`: planets are not alike."""
    layout, bodies = model.layout, model.bodies
    turning, shifting = np.zeros((2, len(found.frequency)))
    for body in central:
        turning += float(bodies.inertia[body]) * found.shape[:, turn_of(body, layout)] ** 2
        if body < layout.planar:
            moved = found.shape[:, shift_of(body) : shift_of(body) + 2]
            shifting += float(bodies.mass[body]) * np.sum(moved**2, axis=1)
    names = {
        (True, False): ROTATIONAL,
        (False, True): TRANSLATIONAL,
        (False, False): PLANET,
        (True, True): MIXED,
    }
    shares = zip(turning > NO_MOTION, shifting > NO_MOTION, strict=True)
    return tuple(names[bool(turns), bool(shifts)] for turns, shifts in shares)
