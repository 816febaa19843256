"""The case of gears that every study of a gear pair begins with, in SI units; its record and its quantities.

Plain frozen dataclasses, so that the physics never meets pydantic or pint. Pairs are ordered (pinion, gear).
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from tribodyn.cases.results import CaseHead, TextTable
from tribodyn.dynamics.data import OperatingData
from tribodyn.gears.by_standard import Quality
from tribodyn.gears.supports import GearSupports
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import BodyMass, Drive, MaterialData
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.limits import plain_distances
from tribodyn.input.tables.gears.drive_data import RoundedDistance, rounded_distance_of
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.teeth.fields import OwnTeeth
from tribodyn.quantities.catalogue import quantities
from tribodyn.tribology.bulk_temperature import TemperatureData
from tribodyn.tribology.contact import Asperities
from tribodyn.tribology.law import FilmData, FrictionData
from tribodyn.tribology.losses.pair import LOSSES, LossData
from tribodyn.tribology.oil import LubricantData

LawfulCase = TypeVar("LawfulCase", bound="LubricatedCase")

TRIBOLOGY = quantities(
    *("film_min", "film_parameter_min", "film_parameter_min_roll_angle", "hertz_pressure_max"),
    *("flash_temperature_max", "friction_coefficient_mean", "friction_force_mean"),
)
ENERGY = quantities(
    *("driving_gear", "power_in_mean", "power_friction_mean", "power_damping_mean"),
    *("friction_work_on_vibration", "efficiency"),
)
TEMPERATURE = quantities(
    *("bulk_temperature", "contact_temperature_max", "oil_temperature"),
    *(f"power_{name}" for name in LOSSES),
    "power_load_independent",
    "efficiency_with_losses",
)
#: What sweeps keep of a case that asks for temperatures or losses.
TEMPERATURE_SWEPT = quantities("bulk_temperature", "power_load_independent", "efficiency_with_losses")
#: Where a summary has its planetary stages; what they alone have, and what a table of them shows.
STAGES = "stages"
OF_PLANETS = quantities("mesh_load_factor", "planet_load_factor_max")
OF_A_STAGE = (*OF_PLANETS, *quantities("power_in_mean", "power_friction_mean", "efficiency"))


def stage_table(summary: Mapping[str, Any]) -> TextTable:
    """The table of a summary's planetary stages, a column for each; without rows where there are none."""
    stages = summary.get(STAGES) or {}
    rows = [
        [quantity.title, *(quantity.written(one[quantity.name]) for one in stages.values()), quantity.unit]
        for quantity in OF_A_STAGE
    ]
    return TextTable("Each planetary stage", ("", *stages, ""), rows if stages else [])


#: Of one of many cases.
ROUNDED = "the centre distance is taken as that without backlash, within the rounding of the printed digits"


def rounded_in(toml: str) -> RoundedDistance | None:
    """How the centre distance in the text of a scenario is rounded; None: it is meant as written."""
    if "centre_distance" not in toml:  # most have none, and need not be read
        return None
    return rounded_distance_of(tomllib.loads(toml).get("drive", {}))


@dataclass(frozen=True)
class OutputData:
    """What is recorded of a motion over time."""

    samples_per_cycle: int = 200
    #: cycles of the first mesh, from and to, of which samples are kept; None: all
    window: tuple[int, int] | None = None
    revolution: int = 0  # cycles of the first mesh that a row of statistics is of; 0: there are none

    def kept(self, cycles: int) -> range:
        """Numbers of the samples that are kept of so many cycles; one closes the last cycle."""
        first, last = (0, cycles) if self.window is None else self.window
        return range(first * self.samples_per_cycle, last * self.samples_per_cycle + 1)

    def revolutions(self, cycles: int) -> int:
        """Rows of statistics of so many cycles."""
        return cycles // self.revolution if self.revolution else 0


@dataclass(frozen=True, kw_only=True)
class GearCase(CaseHead):
    """Gears, their duty and their mesh."""

    family: str  # name of the family of paths of contact
    drive: Drive  # geometry of both gears
    materials: tuple[MaterialData, MaterialData]
    masses: tuple[BodyMass, BodyMass]
    roughness: float  # composite rms roughness σ of the flanks, m
    mean_roughness: float  # arithmetic mean roughness Ra, m
    asperities: Asperities  # of the flanks, as the solved contact takes them
    operating: OperatingData
    mesh: MeshData
    quality: Quality | None  # deviations of the gears by ISO 1328-1; None: the drive has no tolerance class
    #: what single teeth of both gears have of their own, in a study in which teeth differ
    teeth: tuple[OwnTeeth, OwnTeeth] = ((), ())
    #: what holds the gears, where shafts are drawn or matrices given
    supports: GearSupports = field(default_factory=GearSupports)

    def without_run(self) -> dict[str, float]:
        """The contact ratio, and the distances from the limits of existence of the teeth."""
        gears = assemble(family(self.family), self.drive)
        return {"contact_ratio": float(gears.contact_ratio), **plain_distances(gears)}

    def remarks_in_brief(self) -> list[str]:
        """That the centre distance is rounded, where it is."""
        return [ROUNDED] if rounded_in(self.toml) else []


@dataclass(frozen=True, kw_only=True)
class OiledCase(GearCase):
    """Gears and their oil."""

    #: at the temperature of the oil that enters the mesh; in `PreparedGears.case` at that of the teeth
    lubricant: LubricantData


@dataclass(frozen=True, kw_only=True)
class LubricatedCase(OiledCase):
    """Gears with oil between the flanks: the oil, the laws of film and friction, and where heat goes."""

    film: FilmData = field(default_factory=FilmData)
    friction: FrictionData = field(default_factory=lambda: FrictionData("none"))
    #: how the bulk temperature of the teeth follows from the losses; None: it is that of the oil
    temperature: TemperatureData | None = None
    losses: LossData | None = None  # load-independent losses, where they are to be added

    @property
    def pairs(self) -> "tuple[LubricatedCase, ...]":
        """The pair of gears in every mesh: of a pair itself."""
        return (self,)

    def chosen(self) -> dict[str, tuple[str, str]]:
        """Laws selected by "auto", and why."""
        laws = {"film.law": self.film, "friction.law": self.friction}
        return {key: (str(law.law), law.chosen) for key, law in laws.items() if law.chosen}

    def laws(self) -> dict[str, Any]:
        """Give the laws in use and their ratios to solved contacts of gears, whatever the duty."""
        from tribodyn.tribology.closure import law_ratios

        return law_ratios(with_chosen(self, self))


def with_chosen(case: LawfulCase, other: LubricatedCase) -> LawfulCase:
    """Return a case with the laws of another that has another duty."""
    film, friction = replace(other.film, ratio=None), replace(other.friction, ratio=None)
    return replace(case, film=film, friction=friction)
