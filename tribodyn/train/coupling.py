"""What couples any coordinates of a train linearly: shafts of several gears, housings, pins in space, rings.

Entries of matrices by their places in the state, which the layout keeps: force and power of an entry are
−k q_j − c q_j' on coordinate i. Of what passes, such as pins of a ring in the frame of its carrier, k is a
cosine and a sine of the reference's rotation, which does work on it. A gyroscopic matrix is skew and takes no
power. Where the inertia of coordinates is coupled, forces are spread by diag(m) M⁻¹, so that each divided by
the mass that its body has of its own is its acceleration; coordinates of no body have the mass 1. For all
compilers.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import RuntimeIndices, cos, law, sin
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.train.layout import TrainLayout
from tribodyn.train.structure import (
    DAMPING,
    PARAMETRIC,
    Bodies,
    Couplings,
    shift_of,
    speed_of,
    turn_of,
)

#: A period of what passes, rad.
TURN = 2.0 * np.pi


class PassingStiffness(NamedTuple):
    """A stiffness C cos φ + S sin φ with φ = 2π `rate` times the reference cycles; symmetric matrices."""

    rate: float
    cosine: Float[Array, "coordinate coordinate"]
    sine: Float[Array, "coordinate coordinate"]


class CoupledMatrices(NamedTuple):
    """Matrices over coordinates of a train; rotations about z in the senses of their bodies."""

    places: Int[Array, " coordinate"]
    stiffness: Float[Array, "coordinate coordinate"]
    damping: Float[Array, "coordinate coordinate"]
    mass: Float[Array, "coordinate coordinate"]  # beside that of the bodies
    force: Float[Array, " coordinate"]
    passing: tuple[PassingStiffness, ...] = ()


def coupled(
    layout: TrainLayout,
    parts: Sequence[CoupledMatrices],
    bodies: Bodies,
    prescribed: bool,
) -> tuple[TrainLayout, Couplings]:
    """The layout with the places of entries, and their numbers.

    `prescribed` says whether the rotation of the reference is. It has no micro-rotation: entries may turn it,
    and nothing is strained by its coordinate.
    """
    half = layout.half
    stiffness, damping, mass = np.zeros((3, half, half))
    force = np.zeros(half)
    for part in parts:
        at = np.ix_(part.places, part.places)
        stiffness[at] += part.stiffness
        damping[at] += part.damping
        mass[at] += part.mass
        force[part.places] += part.force
    assert not np.any(stiffness[:, layout.lag])
    assert not np.any(damping[:, layout.lag])
    rows, columns = np.nonzero((stiffness != 0.0) | (damping != 0.0))
    forced = np.flatnonzero(force)
    weights = own_mass(layout, bodies)
    own = np.diag(np.where(np.arange(half) < half - layout.modes, weights, 0.0))
    moved = np.flatnonzero(np.any(mass != 0.0, axis=1))
    spread = _spread(mass + own, weights, moved, layout.lag if prescribed else -1)
    inertial = np.array([(i, j) for i in moved for j in moved if spread[i, j] or mass[i, j] or i == j])
    i, j = inertial.T if len(inertial) else np.zeros((2, 0), dtype=int)
    passing = [(part.places, one) for part in parts for one in part.passing]
    entries = [np.nonzero((one.cosine != 0.0) | (one.sine != 0.0)) for _, one in passing]
    kind = type(layout.half)
    layout = layout._replace(
        passing_first=_places([0, *np.cumsum([len(at) for at, _ in entries])] if passing else []),
        passing_rows=_places(
            place for (at, _), (own, _) in zip(entries, passing, strict=True) for place in own[at]
        ),
        passing_columns=_places(
            place for (_, at), (own, _) in zip(entries, passing, strict=True) for place in own[at]
        ),
        coupled=kind(int(len(rows) + len(forced) > 0)),
        coupled_rows=_places(rows),
        coupled_columns=_places(columns),
        forced=_places(forced),
        inertial=kind(int(len(i) > 0)),
        inertial_rows=_places(i),
        inertial_columns=_places(j),
    )
    numbers = Couplings(
        stiffness[rows, columns], damping[rows, columns], force[forced], spread[i, j], mass[i, j]
    )
    if passing:
        numbers = numbers._replace(
            passing_rate=np.array([one.rate for _, one in passing]),
            passing_cosine=np.concatenate(
                [one.cosine[at] for (_, one), at in zip(passing, entries, strict=True)]
            ),
            passing_sine=np.concatenate(
                [one.sine[at] for (_, one), at in zip(passing, entries, strict=True)]
            ),
        )
    return layout, numbers


def own_mass(layout: TrainLayout, bodies: Bodies) -> Float[Array, " coordinate"]:
    """Mass and inertia that the bodies have of their own, of all coordinates; 1 of those of no body."""
    mass = np.ones(layout.half)
    for body in range(layout.bodies):
        mass[turn_of(body, layout)] = bodies.inertia[body]
        if body < layout.planar:
            mass[shift_of(body) : shift_of(body) + 2] = bodies.mass[body]
        if body < layout.spatial:
            first = layout.tilts + 3 * body
            mass[first] = bodies.mass[body]
            mass[first + 1 : first + 3] = bodies.tilting[body]
    return mass


def _places(numbers: Any) -> RuntimeIndices:
    return RuntimeIndices(int(number) for number in numbers)


def _spread(
    mass: Float[Array, "coordinate coordinate"],
    own: Float[Array, " coordinate"],
    moved: Int[Array, " moved"],
    held: int,
) -> Float[Array, "coordinate coordinate"]:
    """diag(m) M⁻¹; where a coordinate is `held`, in its row what accelerates the others is taken off."""
    spread = np.zeros_like(mass)
    free = moved[moved != held]
    if len(free):
        spread[np.ix_(free, free)] = own[free, None] * np.linalg.inv(mass[np.ix_(free, free)])
    if held in moved:
        spread[held] = -(mass[held] / own) @ spread
        spread[held, held] = 1.0
    return spread


@law
def _passed(t, cycles, model):
    """Cosine and sine of a stiffness that passes; half their change by a radian of the reference."""
    turned = TURN * model.links.coupled.passing_rate[t]
    return cos(turned * cycles), sin(turned * cycles), 0.5 * turned / model.operation.pitch_angle


@law
def coupling_forces(cycles, y, model, dy):
    """Add the forces of entries to those in `dy` after so many reference cycles.

    Returns the power that they take by damping, W, and the torque ∂V/∂φ on the reference of what passes, N m.
    """
    layout, parts = model.options.layout, model.links.coupled
    half = layout.half
    power = 0.0 * y[0]
    for e in range(parts.stiffness.shape[0]):
        i, j = layout.coupled_rows[e], layout.coupled_columns[e]
        damping = parts.damping[e] * y[half + j]
        if i != layout.lag:
            power = power + damping * y[half + i]
        dy[half + i] = dy[half + i] - (parts.stiffness[e] * y[j] + damping)
    for e in range(parts.force.shape[0]):
        i = layout.forced[e]
        dy[half + i] = dy[half + i] + parts.force[e]
    torque = 0.0 * y[0]
    for t in range(parts.passing_rate.shape[0]):
        cosine, sine, slope = _passed(t, cycles, model)
        for e in range(layout.passing_first[t], layout.passing_first[t + 1]):
            i, j = layout.passing_rows[e], layout.passing_columns[e]
            force = (parts.passing_cosine[e] * cosine + parts.passing_sine[e] * sine) * y[j]
            dy[half + i] = dy[half + i] - force
            torque = torque + slope * y[i] * (
                (parts.passing_sine[e] * cosine - parts.passing_cosine[e] * sine) * y[j]
            )
    return power, torque


@law
def carry_along(acceleration, model, dy):
    """Take off the forces in `dy` what the prescribed acceleration of the reference takes of `mass`."""
    layout, parts = model.options.layout, model.links.coupled
    for e in range(parts.mass.shape[0]):
        if layout.inertial_columns[e] == layout.lag:
            i = layout.half + layout.inertial_rows[e]
            dy[i] = dy[i] - parts.mass[e] * acceleration


@law
def spread_forces(y, model, dy):
    """Turn the forces in `dy` into those that accelerate their coordinates' own masses alike."""
    layout, parts = model.options.layout, model.links.coupled
    half = layout.half
    for e in range(parts.spread.shape[0]):
        dy[layout.inertial_rows[e]] = 0.0 * y[0]
    for e in range(parts.spread.shape[0]):
        i, j = layout.inertial_rows[e], layout.inertial_columns[e]
        dy[i] = dy[i] + parts.spread[e] * dy[half + j]
    for e in range(parts.spread.shape[0]):
        i = layout.inertial_rows[e]
        dy[half + i] = dy[i]


@law
def rate_at(place, y, model):
    """Rate of a coordinate; of a rotation the speed of its body, rad/s."""
    layout = model.options.layout
    if place < 3 * layout.planar:
        if place % 3 == 2:
            return speed_of(place // 3, y, model)
    elif place < layout.tilts:
        return speed_of(place - 2 * layout.planar, y, model)
    return y[layout.half + place]


@law
def coupling_energy(cycles, y, model):
    """Strain energy of the entries less the work of constant forces, and the kinetic one of `mass`, J."""
    layout, parts = model.options.layout, model.links.coupled
    energy = 0.0 * y[0]
    for e in range(parts.stiffness.shape[0]):
        i = layout.coupled_rows[e]
        if i != layout.lag:
            energy = energy + 0.5 * parts.stiffness[e] * y[i] * y[layout.coupled_columns[e]]
    for t in range(parts.passing_rate.shape[0]):
        cosine, sine, _ = _passed(t, cycles, model)
        for e in range(layout.passing_first[t], layout.passing_first[t + 1]):
            stiffness = parts.passing_cosine[e] * cosine + parts.passing_sine[e] * sine
            energy = energy + 0.5 * stiffness * y[layout.passing_rows[e]] * y[layout.passing_columns[e]]
    for e in range(parts.force.shape[0]):
        energy = energy - parts.force[e] * y[layout.forced[e]]
    for e in range(parts.mass.shape[0]):
        one = rate_at(layout.inertial_rows[e], y, model)
        other = rate_at(layout.inertial_columns[e], y, model)
        energy = energy + 0.5 * parts.mass[e] * one * other
    return energy


@law
def differentiate_couplings(cycles, y, model, works, jacobian):
    """Add what the entries do to the forces of a Jacobian, and to the power of damping among the `works`.

    The row of parametric work receives the torque on the reference.
    """
    lost, parametric = works + DAMPING, works + PARAMETRIC
    layout, parts = model.options.layout, model.links.coupled
    half = layout.half
    for e in range(parts.stiffness.shape[0]):
        i, j = layout.coupled_rows[e], layout.coupled_columns[e]
        jacobian[half + i, j] -= parts.stiffness[e]
        jacobian[half + i, half + j] -= parts.damping[e]
        if i != layout.lag:
            jacobian[lost, half + j] += parts.damping[e] * y[half + i]
            jacobian[lost, half + i] += parts.damping[e] * y[half + j]
    for t in range(parts.passing_rate.shape[0]):
        cosine, sine, slope = _passed(t, cycles, model)
        for e in range(layout.passing_first[t], layout.passing_first[t + 1]):
            i, j = layout.passing_rows[e], layout.passing_columns[e]
            jacobian[half + i, j] -= parts.passing_cosine[e] * cosine + parts.passing_sine[e] * sine
            change = slope * (parts.passing_sine[e] * cosine - parts.passing_cosine[e] * sine)
            jacobian[parametric, i] += change * y[j]
            jacobian[parametric, j] += change * y[i]


@law
def spread_column(column, model, jacobian):
    """`spread_forces` of one column of a Jacobian; its rows of displacements serve as scratch."""
    layout, parts = model.options.layout, model.links.coupled
    half = layout.half
    for e in range(parts.spread.shape[0]):
        jacobian[layout.inertial_rows[e], column] = 0.0
    for e in range(parts.spread.shape[0]):
        i, j = layout.inertial_rows[e], layout.inertial_columns[e]
        jacobian[i, column] += parts.spread[e] * jacobian[half + j, column]
    for e in range(parts.spread.shape[0]):
        i = layout.inertial_rows[e]
        jacobian[half + i, column] = jacobian[i, column]
    for e in range(parts.spread.shape[0]):
        jacobian[layout.inertial_rows[e], column] = 0.0
