"""A case of the dynamics of a gear pair: everything one simulation needs to know, in SI units.

Plain frozen dataclasses, so that the physics never meets pydantic or pint. Pairs are ordered (pinion, gear)
throughout.
"""

from dataclasses import dataclass, field

from tribodyn.dynamics.data import BearingData, OperatingData
from tribodyn.geometry.drive import Drive
from tribodyn.geometry.material import BodyMass, MaterialData
from tribodyn.mesh.data import MeshData
from tribodyn.solve.data import SolverData
from tribodyn.studies.gears.by_standard import Quality
from tribodyn.studies.protocol.study import CaseHead
from tribodyn.tribology.bulk_temperature import TemperatureData
from tribodyn.tribology.data import FilmData, FrictionData
from tribodyn.tribology.losses import LossData
from tribodyn.tribology.lubricant import LubricantData


@dataclass(frozen=True)
class OutputData:
    """What is recorded."""

    samples_per_cycle: int = 200


@dataclass(frozen=True)
class Case(CaseHead):
    """One simulation, complete.

    Parameters
    ----------
    title : str
        What it shows.
    name : str
        Stem of the scenario's file; names the record.
    kind : str
        "gear-pair".
    toml : str
        The scenario as TOML with everything written out (references replaced by their content, units kept,
        overrides applied); loading it gives this case again.
    sha256 : str
        Digest of `toml`.
    family : str
        Name of the path-of-contact family.
    drive : Drive
        Geometry of both gears.
    materials : (MaterialData, MaterialData)
        Of pinion and gear.
    masses : (BodyMass, BodyMass)
        Of pinion and gear.
    roughness : float
        Composite rms roughness σ of the flanks, m.
    mean_roughness : float
        Arithmetic mean roughness Ra of the flanks, m.
    lubricant, bearings, operating, mesh, friction, solver, output, film
        See the classes.
    quality : Quality or None
        Deviations of the gears by ISO 1328-1, for the standard's dynamic factor; None: not said.
    """

    family: str
    drive: Drive
    materials: tuple[MaterialData, MaterialData]
    masses: tuple[BodyMass, BodyMass]
    roughness: float
    mean_roughness: float
    lubricant: LubricantData
    bearings: tuple[BearingData, BearingData]
    operating: OperatingData
    mesh: MeshData
    friction: FrictionData
    solver: SolverData
    output: OutputData
    film: FilmData = field(default_factory=FilmData)
    temperature: TemperatureData | None = None
    losses: LossData | None = None
    quality: Quality | None = None
