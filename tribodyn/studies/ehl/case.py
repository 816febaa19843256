"""A case of the solved contact study: everything one run needs to know, in SI units."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tribodyn.dynamics.data import OperatingData
from tribodyn.geometry.drive import Drive
from tribodyn.geometry.material import MaterialData
from tribodyn.mesh.data import MeshData
from tribodyn.studies.protocol.study import CaseHead
from tribodyn.tribology.data import FilmData, FrictionData
from tribodyn.tribology.lubricant import LubricantData


@dataclass(frozen=True)
class EhlCase(CaseHead):
    """One study of the solved contact, complete.

    Parameters
    ----------
    title, name, kind, toml, sha256, family, drive, materials, roughness, mean_roughness, lubricant
        As in `tribodyn.studies.gear_pair.case.Case`; `kind` is "ehl".
    operating : pinion speed, and gear torque > 0, both constant
    mesh : compliance by which the pairs share the load
    positions : positions of the pair at which its contact is solved
    transient : whether the way is also solved with squeeze
    loads : (array, array) or None
        Roll angles from the pitch point, rad, and normal loads there, N; None: quasi-static.
    step : of the contact's grid, over the distance from inlet and end of the film
    film, friction : FilmData, FrictionData
        None of their own: every law of the registries is evaluated beside the solution.
    """

    family: str
    drive: Drive
    materials: tuple[MaterialData, MaterialData]
    roughness: float
    mean_roughness: float
    lubricant: LubricantData
    operating: OperatingData
    mesh: MeshData
    positions: int
    transient: bool
    loads: tuple[NDArray[np.float64], NDArray[np.float64]] | None
    step: float
    film: FilmData
    friction: FrictionData
