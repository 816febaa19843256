"""A two-stage reducer of constant mesh stiffness under a step of its load, integrated in the global frame.

The matrices are `train_matrices`'. Nothing here knows of teeth: with the input's speed held the motion about
uniform rotation is a linear response, by SciPy's DOP853 (`step_response`). SI units, angles in rad, rotations
counter-clockwise for all bodies.
"""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from tests.support.train_matrices import (
    Bearing,
    Body,
    Mesh,
    Shaft,
    Train,
    approach_rows,
    damping_matrix,
    free_coordinates,
    mass_matrix,
    stiffness_matrix,
)
from tribodyn.numerics.shapes import Array, Float

TEETH = ((25, 51), (21, 50))
MODULES = (3e-3, 4e-3)
PRESSURE_ANGLE = np.radians(20.0)
#: Of the driven gear's axis seen from the driver's: the stages stand at an angle.
AZIMUTHS = (np.radians(25.0), np.radians(-50.0))
#: Input, gear 1, pinion 2, output: mass in kg, inertia in kg m².
BODIES = (Body(0.9, 7.0e-4), Body(3.6, 1.1e-2), Body(1.1, 1.0e-3), Body(6.4, 3.4e-2))
MESH_STIFFNESS = (3.4e8, 4.1e8)
DAMPING_RATIO = 0.05
BEARING_STIFFNESS = ((2.5e8, 3.1e8), (4.0e8, 3.3e8), (4.4e8, 2.9e8), (6.0e8, 5.2e8))
BEARING_DAMPING = ((600.0, 700.0), (1500.0, 1300.0), (900.0, 800.0), (2400.0, 2100.0))
SHAFT_STIFFNESS, SHAFT_DAMPING = 9.0e4, 4.0
#: Of the input, +1 counter-clockwise.
SENSE = -1
LOAD = (300.0, 450.0)  # N m on the output, before and after the step
#: Relative tolerance, and the longest step in radians of the fastest mode. With both the response's error,
#: against the exponential of the matrices, is within 1e-8 of each coordinate's maximum.
TOLERANCE, LONGEST_STEP = 1e-11, 0.25


class History(NamedTuple):
    """A response over time."""

    time: Float[Array, " time"]
    displacement: Float[Array, "time coordinate"]
    velocity: Float[Array, "time coordinate"]
    mesh_force: Float[Array, "time mesh"]  # N along the line of action, spring and damper
    rotation: Float[Array, "time body"]
    held_torque: Float[Array, "time held"]  # N m that keeps the held bodies' speed, counter-clockwise


def pitch_radii(stage: int) -> tuple[float, float]:
    """Of driver and driven gear of a stage."""
    first, second = (0.5 * MODULES[stage] * teeth for teeth in TEETH[stage])
    return first, second


def damping_of(stiffness: float, inertias: tuple[float, float], radii: tuple[float, float]) -> float:
    """Damping of a mesh, 2 ζ √(k J), J = J_1 J_2/(J_1 r_2² + J_2 r_1²) an equivalent mass; N s/m."""
    (one, two), (r_1, r_2) = inertias, radii
    return 2.0 * DAMPING_RATIO * np.sqrt(stiffness * one * two / (one * r_2**2 + two * r_1**2))


def two_stage(rigid_shaft: bool = False) -> Train:
    """The reducer: input, gear 1, pinion 2 and output, or with a rigid shaft input, shaft and output.

    The rigid shaft is one body with both gears: masses and inertias add, and so do the bearings.
    """
    bodies, stiffness, damping = BODIES, BEARING_STIFFNESS, BEARING_DAMPING
    ends, shafts = ((0, 1), (2, 3)), (Shaft((1, 2), SHAFT_STIFFNESS, SHAFT_DAMPING),)
    if rigid_shaft:
        joined = Body(BODIES[1].mass + BODIES[2].mass, BODIES[1].inertia + BODIES[2].inertia)
        bodies, ends, shafts = (BODIES[0], joined, BODIES[3]), ((0, 1), (1, 2)), ()
        stiffness = _joined(BEARING_STIFFNESS)
        damping = _joined(BEARING_DAMPING)
    meshes = []
    for stage, (driver, driven) in enumerate(ends):
        radii, k = pitch_radii(stage), MESH_STIFFNESS[stage]
        c = damping_of(k, (bodies[driver].inertia, bodies[driven].inertia), radii)
        sense = SENSE * (-1) ** stage
        meshes.append(Mesh((driver, driven), radii, AZIMUTHS[stage], PRESSURE_ANGLE, sense, k, c))
    bearings = tuple(Bearing(i, *both) for i, both in enumerate(zip(stiffness, damping, strict=True)))
    return Train(bodies, bearings, shafts, tuple(meshes))


def _joined(of: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
    return (of[0], (of[1][0] + of[2][0], of[1][1] + of[2][1]), of[3])


def output_load(train: Train, torque: float) -> Float[Array, " coordinate"]:
    """Generalised forces of a torque that opposes the rotation of the last mesh's driven body."""
    last, force = train.meshes[-1], np.zeros(3 * len(train.bodies))
    force[3 * last.ends[1] + 2] = last.sense * torque  # it turns against the driver, the torque with it
    return force


def step_response(
    train: Train,
    before: Float[Array, " coordinate"],
    after: Float[Array, " coordinate"],
    times: Float[Array, " time"],
    held: tuple[int, ...] = (0,),
) -> History:
    """Response at `times` (ascending, ≥ 0) to loads that step at time 0 from equilibrium; SI.

    Parameters
    ----------
    before, after : generalised forces until and from time 0
    held : bodies whose speed is prescribed: their rotation about the uniform one is 0

    Raises
    ------
    ValueError
        if a mesh would pull: flanks part, and the linear response is not theirs
    """
    chosen = free_coordinates(train, held)
    inside = np.ix_(chosen, chosen)
    mass, damping, stiffness = mass_matrix(train), damping_matrix(train), stiffness_matrix(train)
    inverse, count = np.linalg.inv(mass[inside]), len(chosen)
    start = np.linalg.solve(stiffness[inside], before[chosen])
    flow = np.block(
        [
            [np.zeros((count, count)), np.eye(count)],
            [-inverse @ stiffness[inside], -inverse @ damping[inside]],
        ]
    )
    forced = np.concatenate([np.zeros(count), inverse @ after[chosen]])
    fastest = np.sqrt(np.max(np.linalg.eigvals(inverse @ stiffness[inside]).real))
    # displacements of the static solution, and velocities of its fastest oscillation
    size = np.max(np.abs(np.linalg.solve(stiffness[inside], after[chosen])))
    scale = np.repeat([size, size * fastest], count)
    solution = solve_ivp(
        lambda _, y: flow @ y + forced,
        (0.0, times[-1]),
        np.append(start, np.zeros(count)),
        method="DOP853",
        t_eval=times,
        rtol=TOLERANCE,
        atol=TOLERANCE * scale,
        max_step=LONGEST_STEP / fastest,  # between its steps the method interpolates by a lower order
    )
    displacement, velocity = np.zeros((2, len(times), len(mass)))
    displacement[:, chosen], velocity[:, chosen] = solution.y[:count].T, solution.y[count:].T
    rows = approach_rows(train)
    springs, dampers = (
        np.array([getattr(m, name) for m in train.meshes]) for name in ("stiffness", "damping")
    )
    mesh_force = springs * (displacement @ rows.T) + dampers * (velocity @ rows.T)
    if np.any(mesh_force < 0.0):
        raise ValueError(f"a mesh pulls: minimum {mesh_force.min():.4g} N; choose a smaller step of the load")
    return History(
        times,
        displacement,
        velocity,
        mesh_force,
        displacement[:, 2::3],
        (displacement @ stiffness + velocity @ damping - after)[:, [3 * body + 2 for body in held]],
    )
