"""The mesh cycle of a pair of gears by the compliance that a case chooses for it."""

from dataclasses import replace
from typing import TYPE_CHECKING

from tribodyn.compliance.energy import loaded_tooth, polynomials_over_ring
from tribodyn.compliance.foundation import outside_fitted_range
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.slices.fine import tabulate_integrated
from tribodyn.mesh.slices.number import slices_needed, too_few
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate

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
) -> MeshCycle:
    """Tabulate the mesh cycle of a checked pair of plain numbers; `back`: whether back flanks can touch.

    The torque T_g (N m) matters where `mesh.at_load`, and where slices of a helical pair hold each other
    (`coupled_slices`) or are not counted yet (`slice_number.slices_needed`). Raises InputError as
    `tabulate.tabulate` and `tabulate_loaded.tabulate_loaded`.
    """
    if mesh.at_load:
        from tribodyn.mesh.tabulate_loaded import tabulate_loaded

        return tabulate_loaded(assembly, materials, mesh, gear_torque, back)
    if assembly.drive.helix_angle or mesh.slices > 1:
        mesh = in_slices(assembly, materials, mesh, gear_torque)
        return tabulate_integrated(assembly, materials, mesh, gear_torque, back)
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
