"""A shaft on its bearings under the load of its gear, and the loads of a mesh on both of its gears."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.beam import DIRECTIONS
from tribodyn.train.elastic.rolling_bearing import BearingState
from tribodyn.train.elastic.system import (
    NotHeld,
    PlacedShaft,
    ShaftSystem,
    reduced,
    settled,
    structure_of,
)


class UnderLoad(NamedTuple):
    """A shaft under the load of its gear."""

    displacement: Float[Array, "5"]  # of the gear
    stiffness: Float[Array, "5 5"]  # at the gear, about this load
    bearings: tuple[BearingState, ...]  # their forces are those of the shaft on them


def under_load(shaft: PlacedShaft, load: Sequence[float]) -> UnderLoad:
    """Settle a shaft of one gear under its load: forces (N) along x, y, z, moments (N m) about x and y.

    Raises NotHeld.
    """
    state = settled(structure_of(ShaftSystem((shaft,))), [load])
    stiffness = reduced(state).stiffness[:DIRECTIONS, :DIRECTIONS]
    return UnderLoad(state.points[0][:DIRECTIONS], stiffness, state.bearings)


def displacement_on(stiffness: Float[Array, "5 5"], load: Float[Array, "5"]) -> Float[Array, "5"]:
    """Where a gear on a stiffness matrix settles under a load; raises NotHeld where that does not hold it.

    Forces along x, y, z (N) and moments about x and y (N m) to displacements, m and rad.
    """
    moved, *_ = np.linalg.lstsq(stiffness, load, rcond=None)
    if np.max(np.abs(stiffness @ moved - load)) > 1e-6 * np.max(np.abs(load)):
        raise NotHeld(
            "does not hold the gear against the load of its mesh: it is zero in some direction of that"
        )
    return moved


def mesh_loads(
    tangential: float, radii: tuple[float, float], pressure_slope: float, helix_slope: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Load of a mesh on pinion and gear: forces along x, y, z (N), moments about x and y (N m).

    F_r = F_t tan α_t, F_a = F_t tan β, all in the middle of the face at the pitch `radii` (m). A negative
    tangential force loads the back flanks, which press the gears apart all the same. The pinion turns
    clockwise, seen from +z; its flanks move along +x at the pitch point, and y is from its centre to the
    gear's.
    """
    on_pinion = np.array([-tangential, -abs(tangential) * pressure_slope, -tangential * helix_slope])
    pinion, gear = (
        (*map(float, force), arm * float(force[2]), 0.0)
        for force, arm in ((on_pinion, radii[0]), (-on_pinion, -radii[1]))
    )
    return pinion, gear
