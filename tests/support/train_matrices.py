"""Mass, damping and stiffness of planar trains of gears, assembled by hand in a convention of their own.

Every body has x, y and θ in one right-handed frame, θ counter-clockwise whichever way the body turns; they
are small motions about uniform rotation. The package counts rotation in each body's own sense and each mesh
in a frame of its own, so that a wrong sign there has no twin here. SI units, angles in rad.
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import eigh

from tribodyn.numerics.shapes import Array, Float

#: End of a link that is no body.
GROUND = -1
#: Which flanks of the driver touch: those that push it when it drives, or those behind.
DRIVING, BACK = 1, -1
#: Eigenvalues below this share of the largest are rigid-body motions: rounding makes them up to 1e-14 of it.
RIGID = 1e-12


class Body(NamedTuple):
    """A rigid body with one gear or several."""

    mass: float  # kg
    inertia: float  # kg m², about its axis


class Bearing(NamedTuple):
    """Springs and dampers along x and y between a body's axis and the ground."""

    body: int
    stiffness: tuple[float, float]  # N/m
    damping: tuple[float, float] = (0.0, 0.0)  # N s/m


class Shaft(NamedTuple):
    """A torsional spring and damper between two bodies, or between one and the ground."""

    ends: tuple[int, int]
    stiffness: float  # N m/rad
    damping: float = 0.0  # N m s/rad


class Mesh(NamedTuple):
    """A mesh of two external gears, a spring and damper along its line of action."""

    ends: tuple[int, int]  # driver, driven
    radii: tuple[float, float]  # operating pitch circles of driver and driven, m
    azimuth: float  # of the driven body's axis seen from the driver's, counter-clockwise from x
    pressure_angle: float  # operating
    sense: int  # of the driver's rotation, +1 counter-clockwise
    stiffness: float  # N/m
    damping: float = 0.0  # N s/m
    flank: int = DRIVING


class Train(NamedTuple):
    """Bodies and what joins them."""

    bodies: tuple[Body, ...]
    bearings: tuple[Bearing, ...] = ()
    shafts: tuple[Shaft, ...] = ()
    meshes: tuple[Mesh, ...] = ()


def cross(a: Float[Array, "*points 2"], b: Float[Array, "*points 2"]) -> Float[Array, "*points"]:
    """Component along the axis of rotation of the cross product of vectors in the plane."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def towards_driven(mesh: Mesh) -> Float[Array, " 2"]:
    """Unit vector from the driver's axis to the driven body's."""
    return np.array([np.cos(mesh.azimuth), np.sin(mesh.azimuth)])


def pitch_motion(mesh: Mesh) -> Float[Array, " 2"]:
    """Unit vector of the motion at the pitch point: a quarter turn from the line of centres."""
    x, y = towards_driven(mesh)
    return mesh.sense * np.array([-y, x])


def normal(mesh: Mesh) -> Float[Array, " 2"]:
    """Direction of the normal load on the driven body.

    Flanks of external gears press the axes apart, whichever of them touch; driving ones press the driven
    body along with the motion, back flanks against it.
    """
    along = mesh.flank * np.cos(mesh.pressure_angle)
    return along * pitch_motion(mesh) + np.sin(mesh.pressure_angle) * towards_driven(mesh)


def approach_row(mesh: Mesh, bodies: int) -> Float[Array, " coordinate"]:
    """Derivative of the flanks' approach along the normal by (x, y, θ) of every body.

    The approach is how far the driver's flank moves ahead of the driven one's along the normal. Both contain
    the pitch point, where the line of action crosses the line of centres.
    """
    row, direction, outwards = np.zeros(3 * bodies), normal(mesh), towards_driven(mesh)
    arms = (mesh.radii[0] * outwards, -mesh.radii[1] * outwards)
    for body, arm, sign in zip(mesh.ends, arms, (1.0, -1.0), strict=True):
        row[3 * body : 3 * body + 2] += sign * direction
        row[3 * body + 2] += sign * cross(arm, direction)
    return row


def approach_rows(train: Train) -> Float[Array, "mesh coordinate"]:
    """`approach_row` of every mesh."""
    return np.array([approach_row(mesh, len(train.bodies)) for mesh in train.meshes])


def mass_matrix(train: Train) -> Float[Array, "coordinate coordinate"]:
    """Masses and moments of inertia."""
    return np.diag([value for body in train.bodies for value in (body.mass, body.mass, body.inertia)])


def stiffness_matrix(train: Train) -> Float[Array, "coordinate coordinate"]:
    """Stiffness of bearings, shafts and meshes."""
    return _assembled(train, "stiffness")


def damping_matrix(train: Train) -> Float[Array, "coordinate coordinate"]:
    """Damping of bearings, shafts and meshes."""
    return _assembled(train, "damping")


def _assembled(train: Train, coefficient: str) -> Float[Array, "coordinate coordinate"]:
    count = len(train.bodies)
    matrix = np.zeros((3 * count, 3 * count))
    for bearing in train.bearings:
        for direction, value in enumerate(getattr(bearing, coefficient)):
            matrix[3 * bearing.body + direction, 3 * bearing.body + direction] += value
    for shaft in train.shafts:
        twist = np.zeros(3 * count)
        for end, sign in zip(shaft.ends, (1.0, -1.0), strict=True):
            if end != GROUND:
                twist[3 * end + 2] += sign
        matrix += getattr(shaft, coefficient) * np.outer(twist, twist)
    for mesh in train.meshes:
        row = approach_row(mesh, count)
        matrix += getattr(mesh, coefficient) * np.outer(row, row)
    return matrix


def senses(train: Train) -> list[int]:
    """Sense of every body's nominal rotation, +1 counter-clockwise: along meshes, and shafts from them."""
    found: dict[int, int] = {}
    for mesh in train.meshes:
        found[mesh.ends[0]], found[mesh.ends[1]] = mesh.sense, -mesh.sense
    for shaft in train.shafts:
        known = [found[end] for end in shaft.ends if end in found]
        found |= {end: known[0] for end in shaft.ends if end != GROUND and known}
    return [found[body] for body in range(len(train.bodies))]


def rotations(train: Train) -> list[int]:
    """Coordinates that are rotations: what is free on rigid bearings."""
    return list(range(2, 3 * len(train.bodies), 3))


def free_coordinates(train: Train, held: tuple[int, ...]) -> list[int]:
    """All coordinates but the rotations of bodies whose speed is prescribed."""
    return [i for i in range(3 * len(train.bodies)) if i not in {3 * body + 2 for body in held}]


def natural_frequencies(train: Train, free: list[int] | None = None) -> Float[Array, " mode"]:
    """Undamped natural frequencies, Hz, ascending; rigid-body motions are 0.

    `free` names the coordinates that move, all if None: `rotations`, or `free_coordinates` where the speed of
    a body is prescribed, which takes the rotation of the whole train away.
    """
    chosen = np.ix_(*2 * [range(3 * len(train.bodies)) if free is None else free])
    squares = eigh(stiffness_matrix(train)[chosen], mass_matrix(train)[chosen], eigvals_only=True)
    squares = np.where(np.abs(squares) < RIGID * squares[-1], 0.0, squares)
    return np.sqrt(squares) / (2.0 * np.pi)
