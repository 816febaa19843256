"""Bodies of helical sets in space, in the frame of their carrier: what holds planets on tilting pins.

A pin at (ξ, η) from the carrier's axis moves along z by z + ψ_x η − ψ_y ξ and tilts with the carrier; what it
moves by in x and y, where it turns with the carrier too, is the link's (`dynamics.loads`). In a frame that
turns with Ω a body that spins with ω has, of its angular momentum J ω about z,

    J_t ψ_x'' − Δ ψ_y' + κ ψ_x = M_x,   J_t ψ_y'' + Δ ψ_x' + κ ψ_y = M_y,   Δ = 2 J_t Ω − J ω,
    κ = (J ω − J_t Ω) Ω.

Left out: what centrifugal forces on planets do to a carrier that tilts, of the order of m r² Ω² over the
stiffness of its bearings.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import sqrt

import numpy as np

from tribodyn.dynamics.data import BearingData, in_space
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.assembly import BodyInertia, in_space_of
from tribodyn.studies.motion.case import Gearbox
from tribodyn.train.coupling import CoupledMatrices
from tribodyn.train.layout import TrainLayout
from tribodyn.train.structure import AXIAL, IN_SPACE, Bodies, place_in_space

#: z and tilts among the coordinates of a body in space.
_OUT_OF_PLANE = slice(AXIAL, IN_SPACE)


def on_pin(data: BearingData, width: float) -> BearingData:
    """A planet's bearing, as long as its face (m) where nothing is said: k b²/12 against tilts."""
    return (
        replace(data, span=width / sqrt(3.0)) if data.span is None and data.stiffness_tilt is None else data
    )


def along_axis(data: BearingData, width: float) -> BearingData:
    """What is left of the bearing of a member that floats: z and tilts; `width` of the set's faces, m."""
    (_, _, axial, tilt, _), _ = in_space(data, width)
    return replace(
        data, stiffness_x=0.0, stiffness_y=0.0, stiffness_axial=axial, stiffness_tilt=tilt, span=None
    )


def pins_in_space(
    case: Gearbox,
    layout: TrainLayout,
    new: dict[int, int],
    damping: Sequence[tuple[float, float, float]],
    inertias: Sequence[BodyInertia],
) -> Iterator[CoupledMatrices]:
    """How planets are held along z and in tilts; `new` are the model's numbers of the case's bodies."""
    for number, link in enumerate(case.links):
        planet, carrier = (new[body] if body >= 0 else -1 for body in link.ends)
        if not link.lever or planet >= layout.spatial or carrier >= layout.spatial:
            continue
        width = max(case.gears[gear].face_width for gear in case.bodies[link.ends[0]].gears)
        matrices = in_space_of(link, damping[number], inertias, width)
        right, up = np.subtract(case.bodies[link.ends[0]].centre, case.bodies[link.ends[1]].centre)
        pin = np.array([[1.0, up, -right], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        apart = np.hstack([np.eye(3), -pin])
        stiffness, losses = (apart.T @ each[_OUT_OF_PLANE, _OUT_OF_PLANE] @ apart for each in matrices)
        places = [
            place_in_space(body, direction, layout)
            for body in (planet, carrier)
            for direction in range(AXIAL, IN_SPACE)
        ]
        nothing = np.zeros_like(stiffness)
        yield CoupledMatrices(np.array(places), stiffness, losses, nothing, nothing[0])


def tilts_in_frames(
    case: Gearbox, order: Sequence[int], layout: TrainLayout, bodies: Bodies
) -> Iterator[CoupledMatrices]:
    """What spin and frame do to the tilts of bodies of helical sets whose frame forces are counted."""
    reference = case.source.speed / float(case.bodies[case.source.body].ratio)
    spatial = {body for gearset in case.sets if gearset.in_space for body in gearset.bodies}
    for number, body in enumerate(order[: layout.spatial]):
        if body not in spatial or (frame := float(bodies.frame_speed[number])) == 0.0:
            continue
        spin = case.bodies[body].sense * float(case.bodies[body].ratio) * reference
        momentum, tilting = float(bodies.inertia[number]) * spin, float(bodies.tilting[number])
        turning = 2.0 * tilting * frame - momentum
        places = [place_in_space(number, direction, layout) for direction in range(AXIAL + 1, IN_SPACE)]
        nothing: Float[Array, "2 2"] = np.zeros((2, 2))
        yield CoupledMatrices(
            np.array(places),
            (momentum - tilting * frame) * frame * np.eye(2),
            turning * np.array([[0.0, -1.0], [1.0, 0.0]]),
            nothing,
            nothing[0],
        )
