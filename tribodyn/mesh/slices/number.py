"""How many slices a helical pair needs: as many as the forces that move it take."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData
from tribodyn.geometry.helix import overlap_ratio
from tribodyn.mesh.quasi_static import normal_arms, quasi_static, sliding_side
from tribodyn.mesh.slices.fine import tabulate_integrated
from tribodyn.mesh.slices.helical import minimum_slices
from tribodyn.mesh.table import MeshData
from tribodyn.numerics.shapes import Array, Float

#: Share of its largest harmonic by which a harmonic may differ from that with twice the slices.
TOLERANCE = 0.02
#: Harmonics of the mesh cycle that are compared.
HARMONICS = 8
#: Where the largest harmonic of the transmission error is below this share of the deflection, `TOLERANCE` is
#: of this share of the deflection.
SMALL_ERROR = 0.01
#: Minimum and maximum number, unless the overlap asks for more; odd, so that one slice is in the middle.
FEWEST, MOST = 5, 31
_GROWTH = 1.45  # 5, 7, 11, 15, 21, 31
#: Slices per overlap ratio that are taken at least, and below which they are too few: coefficients of
#: friction are those of the speeds in the middles of slices.
PER_OVERLAP, TOO_FEW_PER_OVERLAP = 13.0, 7.0
_NODES = 129
_WHAT = "transmission error", "tilting moment", "friction"


class SliceNumber(NamedTuple):
    """Number of slices of a helical pair, and why."""

    slices: int
    remark: str


class Change(NamedTuple):
    """What twice as many slices change most."""

    size: float  # of a harmonic, over the largest one of the same quantity
    what: str

    def sentence(self) -> str:
        """Say it."""
        return (
            f"twice as many change the first {HARMONICS} harmonics of the {self.what} in slow rotation by "
            f"{100.0 * self.size:.2g} % of the largest"
        )


def slices_needed(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData, gear_torque: float
) -> SliceNumber:
    """Choose the number of slices of a helical pair of plain numbers at a torque T_g ≠ 0, N m.

    From `FEWEST` on the number grows until `change_by_doubling` is at most `TOLERANCE`, or until `MOST`.
    Without a torque `FEWEST` is doubled once.
    """
    first = max(FEWEST, minimum_slices(assembly), math.ceil(PER_OVERLAP * float(overlap_ratio(assembly)))) | 1
    if gear_torque == 0.0:
        return SliceNumber(
            2 * first + 1, f"{2 * first + 1} slices along the face, without a torque to judge by."
        )
    harmonics = _harmonics_of(assembly, materials, mesh, gear_torque)
    slices = first
    while True:
        change = _change(harmonics(slices), harmonics(2 * slices + 1))
        more = int(_GROWTH * slices) | 1
        if change.size <= TOLERANCE or more > MOST:
            break
        slices = more
    return SliceNumber(slices, f"{slices} slices along the face: {change.sentence()}.")


def too_few(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData, gear_torque: float
) -> str:
    """Say of a given number of slices that it is too few; empty where it is not, or without a torque."""
    if gear_torque == 0.0 or mesh.slices < minimum_slices(assembly):
        return ""
    harmonics = _harmonics_of(assembly, materials, mesh, gear_torque)
    change = _change(harmonics(mesh.slices), harmonics(2 * mesh.slices + 1))
    overlap = float(overlap_ratio(assembly))
    if change.size > TOLERANCE:
        why = change.sentence()
    elif mesh.slices < TOO_FEW_PER_OVERLAP * overlap:
        why = f"friction takes {TOO_FEW_PER_OVERLAP:g} for each unit of the overlap ratio, {overlap:.3g}"
    else:
        return ""
    return f"mesh.slices = {mesh.slices} is too few for the motion: {why}; leave it out, or give more."


def _harmonics_of(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData, gear_torque: float
) -> Callable[[int], Float[Array, "quantity harmonic"]]:
    """Function of the number of slices that gives the harmonics, kept between calls."""

    @cache
    def harmonics(slices: int) -> Float[Array, "quantity harmonic"]:
        cycle = tabulate_integrated(
            assembly, materials, replace(mesh, slices=slices), gear_torque, nodes=_NODES
        )
        state = quasi_static(cycle, float(cycle.gear_sense) * abs(gear_torque))
        load = state.normal_load[0]
        force = np.sum(load * normal_arms(cycle)[0], axis=-1)
        moment = np.sum(load * np.asarray(cycle.face_place)[0], axis=-1) / force
        friction = np.sum(load * sliding_side(cycle)[0], axis=-1) / force
        over = np.stack([state.deflection[0], moment, friction])[:, :-1]
        return np.fft.rfft(over, axis=-1)[:, : HARMONICS + 1] / over.shape[-1]

    return harmonics


def _change(coarse: Float[Array, "quantity harmonic"], fine: Float[Array, "quantity harmonic"]) -> Change:
    size = np.max(np.abs(fine[:, 1:]), axis=-1)
    size[0] = max(size[0], SMALL_ERROR * abs(fine[0, 0]))
    change = np.max(np.abs(coarse - fine)[:, 1:], axis=-1) / size
    worst = int(np.argmax(change))
    return Change(float(change[worst]), _WHAT[worst])
