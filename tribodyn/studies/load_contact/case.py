"""A case of the static load contact study: everything one run needs to know, in SI units."""

from dataclasses import dataclass

from tribodyn.geometry.drive import Drive
from tribodyn.geometry.material import MaterialData
from tribodyn.geometry.modification import UNMODIFIED, Modifications
from tribodyn.studies.study import CaseHead


@dataclass(frozen=True)
class LoadContactCase(CaseHead):
    """One study of teeth in slow rotation under load, complete.

    Parameters
    ----------
    title, name, kind, toml, sha256, family, drive, materials
        As in `tribodyn.studies.gear_pair.case.Case`; `kind` is "load-contact".
    gear_torque : float
        T_g > 0 of the samples recorded, N m.
    gear_torques : tuple of float
        Torques of the Harris map, > 0 and increasing, N m; empty: none is made.
    friction_coefficient : float
        μ of all pairs, ≥ 0.
    modifications : Modifications
        What is missing on the flanks, and misalignment.
    slices : int
        Slices along the face.
    slice_coupling : bool
        Whether slices of one tooth hold each other.
    positions_per_cycle : int
        Positions of the pinion in one mesh cycle.
    cycles : int
        Mesh cycles to roll through; more than one where teeth differ.
    """

    family: str
    drive: Drive
    materials: tuple[MaterialData, MaterialData]
    gear_torque: float
    gear_torques: tuple[float, ...] = ()
    friction_coefficient: float = 0.0
    modifications: Modifications = UNMODIFIED
    slices: int = 1
    slice_coupling: bool = True
    positions_per_cycle: int = 60
    cycles: int = 1
