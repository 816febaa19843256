"""A case of the quasi-static efficiency study: everything one run needs to know, in SI units."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tribodyn.dynamics.data import OperatingData
from tribodyn.geometry.drive import Drive
from tribodyn.geometry.material import MaterialData
from tribodyn.mesh.data import MeshData
from tribodyn.studies.protocol.study import CaseHead
from tribodyn.tribology.bulk_temperature import TemperatureData
from tribodyn.tribology.data import FilmData, FrictionData
from tribodyn.tribology.losses import LossData
from tribodyn.tribology.lubricant import LubricantData

if TYPE_CHECKING:  # the study's array code, and SciPy with it, is for the run
    from tribodyn.studies.efficiency.places import Sharing


@dataclass(frozen=True)
class EfficiencyCase(CaseHead):
    """One efficiency study, complete.

    Parameters
    ----------
    title, name, kind, toml, sha256, family, drive, materials, roughness, mean_roughness
    lubricant, friction, film
        As in `tribodyn.studies.gear_pair.case.Case`; `kind` is "efficiency".
    operating : pinion speed and gear torque, both constant
    mesh : compliance by the energy method or, "fem", the load contact model, for the elastic load sharing
    load_sharing : {"elastic", "uniform", "single-pair"}
        That of the samples recorded; the summary has all three.
    samples_per_cycle : samples over the one mesh cycle recorded
    spectrum : tuple of (float, EfficiencyCase)
        Share of time and case of every duty of a load spectrum; empty: there is none.
    """

    family: str
    drive: Drive
    materials: tuple[MaterialData, MaterialData]
    roughness: float
    mean_roughness: float
    lubricant: LubricantData
    operating: OperatingData
    mesh: MeshData
    friction: FrictionData
    load_sharing: "Sharing" = "elastic"
    samples_per_cycle: int = 200
    film: FilmData = field(default_factory=FilmData)
    temperature: TemperatureData | None = None
    losses: LossData | None = None
    spectrum: tuple[tuple[float, "EfficiencyCase"], ...] = ()
