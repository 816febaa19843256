"""The mesh cycle of a pair of gears by the compliance that a case chooses for it."""

from typing import TYPE_CHECKING

from tribodyn.compliance.energy import loaded_tooth
from tribodyn.compliance.foundation import outside_fitted_range
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.material import MaterialData
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.data import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate

if TYPE_CHECKING:
    from tribodyn.compliance.loaded_flanks import LoadedFlanks


def mesh_cycle_of(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    gear_torque: float,
    back: bool = False,
) -> MeshCycle:
    """Tabulate the mesh cycle of a pair of plain numbers.

    Parameters
    ----------
    assembly : Assembly
        Checked (`geometry.checks`).
    materials : (MaterialData, MaterialData)
        Of pinion and gear.
    mesh : MeshData
        What the compliance is, errors, backlash.
    gear_torque : float
        T_g, N m; matters where `mesh.at_load` only.
    back : bool
        Whether back flanks can touch.

    Raises
    ------
    InputError
        As `tabulate.tabulate` and `tabulate_loaded.tabulate_loaded`.
    """
    if mesh.at_load:
        from tribodyn.mesh.tabulate_loaded import tabulate_loaded

        return tabulate_loaded(assembly, materials, mesh, gear_torque, back)
    return tabulate(assembly, materials, mesh, pair_slots(assembly), back)


def loaded_flanks_of(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData
) -> "LoadedFlanks | None":
    """Flanks that share their load by the load contact model, where the mesh is made by it; else None."""
    if not mesh.at_load:
        return None
    from tribodyn.mesh.tabulate_loaded import flanks_of

    return flanks_of(assembly, materials, mesh)


def compliance_remark(assembly: Assembly, mesh: MeshData) -> str:
    """Say where the compliance of the gear bodies is extrapolated; empty: it is not, or is not by a fit."""
    if mesh.compliance != "energy":
        return ""
    said = []
    for side in SIDES:
        tooth = loaded_tooth(assembly, side)
        ratio = float(tooth.tooth.root_radius) / float(tooth.body.bore_radius)
        said += [f"{side} {one}" for one in outside_fitted_range(ratio, float(tooth.root_half_angle))]
    return f"The bodies' compliance (Sainsot & Velex) is extrapolated: {'; '.join(said)}." if said else ""
