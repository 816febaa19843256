"""The mesh cycle of a pair of gears by the compliance that a case chooses for it."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tribodyn.compliance.energy import loaded_tooth, polynomials_over_ring
from tribodyn.compliance.foundation import outside_fitted_range
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData
from tribodyn.geometry.helix import overlap_ratio
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import normal_arms, quasi_static, sliding_side
from tribodyn.mesh.slices.fine import tabulate_integrated
from tribodyn.mesh.slices.helical import minimum_slices
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.numerics.shapes import Array, Float

#: A body's compliance by the polynomials that differs by this share from the ring's is reported.
REPORTED_DEVIATION = 0.1

if TYPE_CHECKING:
    from tribodyn.compliance.sharing.load_sharing import LoadedFlanks


def mesh_cycle_of(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    gear_torque: float,
    back: bool = False,
    nodes: int | None = None,
) -> MeshCycle:
    """Tabulate the mesh cycle of a checked pair of plain numbers; `back`: whether back flanks can touch.

    Slices by the energy method with as many nodes as they take, unless their number is given.
    The torque T_g (N m) matters where `mesh.at_load`, and where slices of a helical pair hold each other
    (`coupled_slices`) or are not counted yet (`slice_number.slices_needed`). Raises InputError as
    `tabulate.tabulate` and `tabulate_loaded.tabulate_loaded`.
    """
    if mesh.at_load:
        from tribodyn.mesh.tabulate_loaded import tabulate_loaded

        return tabulate_loaded(assembly, materials, mesh, gear_torque, back)
    if assembly.drive.helix_angle or mesh.slices > 1:
        mesh = in_slices(assembly, materials, mesh, gear_torque)
        return tabulate_integrated(assembly, materials, mesh, gear_torque, back, nodes)
    return tabulate(assembly, materials, mesh, pair_slots(assembly), back)


def in_slices(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData, gear_torque: float
) -> MeshData:
    """Count the slices that a helical pair needs where they are left open; a given number is not judged."""
    return mesh if mesh.slices > 1 else with_slices(assembly, materials, mesh, gear_torque)[0]


def with_slices(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData, gear_torque: float
) -> tuple[MeshData, str]:
    """Count the slices that a helical pair needs where they are left open; the remark says why, or is empty.

    Where too few are given the remark says so: judged by the energy method, also of `compliance = "fem"`, of
    which the number stays, as of spur gears.
    """
    if not assembly.drive.helix_angle or (mesh.at_load and mesh.slices == 1):
        return mesh, ""
    if mesh.slices > 1:
        judged = replace(mesh, compliance="energy") if mesh.at_load else mesh
        return mesh, too_few(assembly, materials, judged, gear_torque)
    needed = slices_needed(assembly, materials, mesh, gear_torque)
    return replace(mesh, slices=needed.slices), needed.remark


def loaded_flanks_of(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData
) -> "LoadedFlanks | None":
    """Flanks that share their load by the load contact model, where the mesh is made by it; else None."""
    if not mesh.at_load:
        return None
    from tribodyn.mesh.tabulate_loaded import flanks_of

    return flanks_of(assembly, materials, mesh)


def compliance_remark(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData
) -> str:
    """Say where the compliance of the gear bodies is extrapolated or off; empty: neither, or it is no fit."""
    if mesh.compliance != "energy" or mesh.foundation != "sainsot-velex":
        return ""
    beyond, off = [], []
    for side, material in zip(SIDES, materials, strict=True):
        tooth = loaded_tooth(assembly, side, mesh.held)
        if tooth.body.teeth < 0:  # its rim is solved
            continue
        ratio = float(tooth.tooth.root_radius) / float(tooth.body.bore_radius) if mesh.held else None
        beyond += [f"{side} {limit}" for limit in outside_fitted_range(ratio, float(tooth.root_half_angle))]
        over = polynomials_over_ring(tooth, material)
        if abs(over - 1.0) > REPORTED_DEVIATION:
            off.append(f"the {side}'s is {over:.3g} times that of the elastic ring")
    remark = (
        f"The bodies' compliance (Sainsot & Velex) is extrapolated: {'; '.join(beyond)}." if beyond else ""
    )
    if off:
        remark += (
            f"{' ' if remark else ''}Of the compliances of the bodies by the polynomials {' and '.join(off)} "
            'that they are fitted to: mesh.foundation = "ring" uses the ring itself, '
            'compliance = "fem" resolves the rim.'
        )
    return remark


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
#: Nodes of tables that are looked at, and not moved by.
FEW_NODES = 129
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
            assembly, materials, replace(mesh, slices=slices), gear_torque, nodes=FEW_NODES
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
