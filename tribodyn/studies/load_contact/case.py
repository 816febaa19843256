"""A case of the static load contact study: everything one run needs to know, in SI units."""

from dataclasses import dataclass, field

from tribodyn.geometry.drive import Drive
from tribodyn.geometry.flanks.modification import UNMODIFIED, Modifications
from tribodyn.geometry.material import MaterialData
from tribodyn.scenario.tables.duty import Duty
from tribodyn.studies.protocol.study import CaseHead
from tribodyn.tribology.data import FilmData, FrictionData
from tribodyn.tribology.lubricant import LubricantData


@dataclass(frozen=True)
class Oiled:
    """What the film between the flanks follows from; see `tribology.closure.Lubricated`.

    Parameters
    ----------
    family, drive, materials, roughness, mean_roughness, lubricant, film
        As in `tribodyn.studies.gear_pair.case.Case`.
    operating : Duty
        Speed of the pinion, > 0, and torque on the gear.
    friction : FrictionData
        None: its law only says which film law goes with it.
    """

    family: str
    drive: Drive
    materials: tuple[MaterialData, MaterialData]
    roughness: float
    mean_roughness: float
    lubricant: LubricantData
    operating: Duty
    film: FilmData
    friction: FrictionData = field(default_factory=lambda: FrictionData("none"))


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
    oiled : Oiled or None
        For the film over the face; None: the scenario has no lubricant.
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
    oiled: Oiled | None = None
