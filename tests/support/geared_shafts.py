"""Two stepped shafts with discs on springs, joined by a mesh: what the package and ROSS both compute."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.beam import ShaftMetal, ShaftSection
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.system import PlacedBearing, PlacedShaft, ShaftSystem, settled, structure_of

YOUNG, SHEAR, DENSITY = 206e9, 206e9 / 2.6, 7850.0
MESH_STIFFNESS, PRESSURE_ANGLE = 3e8, np.radians(20.0)


class Disc(NamedTuple):
    """A disc at a node; kg, kg m²."""

    node: int
    mass: float
    transverse: float
    polar: float


class GearedShaft(NamedTuple):
    """Pieces (length, diameter, bore), springs (node, k_x, k_y, k_z), and discs, first of them the gear."""

    pieces: tuple[tuple[float, float, float], ...]
    springs: tuple[tuple[int, float, float, float], ...]
    discs: tuple[Disc, ...]
    teeth: int
    pitch_radius: float  # m


PINION = GearedShaft(
    ((0.05, 0.03, 0.01),) * 2 + ((0.04, 0.045, 0.01),) * 4 + ((0.05, 0.035, 0.0),) * 3,
    ((1, 1.5e8, 2.0e8, 8e7), (7, 1.2e8, 0.9e8, 0.0)),
    (Disc(4, 1.2, 7e-4, 1.2e-3), Disc(9, 3.0, 8e-3, 1.4e-2)),
    23,
    0.0345,
)
GEAR = GearedShaft(
    ((0.06, 0.05, 0.0),) * 3 + ((0.05, 0.06, 0.02),) * 4,
    ((0, 2e8, 2e8, 1e8), (6, 2e8, 3e8, 0.0)),
    (Disc(3, 5.0, 1.3e-2, 2.4e-2), Disc(7, 8.0, 4e-2, 7e-2)),
    47,
    0.0705,
)


def frequencies(speed: float) -> Float[Array, " mode"]:
    """Of the motion along and about all axes, Hz, without that of rotation as a whole; speed of the pinion.

    The line of centres is x, the pinion turns counter-clockwise.
    """
    shafts = []
    for shaft, spin in ((PINION, speed), (GEAR, -speed * PINION.teeth / GEAR.teeth)):
        ends = np.cumsum([0.0, *(length for length, _, _ in shaft.pieces)])
        bearings = tuple(
            PlacedBearing(float(ends[node]), tuple(map(tuple, np.diag([*along, 0.0, 0.0]).tolist())))
            for node, *along in shaft.springs
        )
        sections = tuple(ShaftSection(*piece) for piece in shaft.pieces)
        points = tuple(float(ends[disc.node]) for disc in shaft.discs)
        shafts.append(PlacedShaft(sections, ShaftMetal(YOUNG, 0.3), DENSITY, points, bearings, spin))
    structure = structure_of(ShaftSystem(tuple(shafts)))
    stiffness = settled(structure, np.zeros((4, SIX)).tolist()).tangent()
    mass, damping = structure.mass.copy(), structure.damping.copy()
    discs = [
        (disc, shaft.spin)
        for shaft, drawn in zip(shafts, (PINION, GEAR), strict=True)
        for disc in drawn.discs
    ]
    for first, (disc, spin) in zip(structure.points, discs, strict=True):
        at = range(first, first + SIX)
        mass[at, at] += [disc.mass] * 3 + [disc.transverse] * 2 + [disc.polar]
        damping[first + 3, first + 4] += disc.polar * spin
        damping[first + 4, first + 3] -= disc.polar * spin
    pressed = np.zeros(len(mass))
    normal = np.array([np.sin(PRESSURE_ANGLE), np.cos(PRESSURE_ANGLE)])
    for first, sign, radius in (
        (structure.points[0], 1.0, PINION.pitch_radius),
        (structure.points[2], -1.0, GEAR.pitch_radius),
    ):
        pressed[first : first + 2] = sign * normal
        pressed[first + 5] = radius * normal[1]
    stiffness = stiffness + MESH_STIFFNESS * np.outer(pressed, pressed)
    return natural_frequencies(mass, damping, stiffness)


def natural_frequencies(mass: Array, damping: Array, stiffness: Array) -> Float[Array, " mode"]:
    """Hz, increasing, of an undamped gyroscopic system; rigid motions left out."""
    none, one = np.zeros_like(mass), np.eye(len(mass))
    inverse = np.linalg.inv(mass)
    values = np.linalg.eigvals(np.block([[none, one], [-inverse @ stiffness, -inverse @ damping]])).imag
    found = np.sort(values[values > 0.0]) / (2.0 * np.pi)
    return found[found > 1.0]
