"""A case of an assessment: the gearbox, its meshes as pairs of gears, and what is recorded of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any, NamedTuple

from tribodyn.cases import cost
from tribodyn.cases.assessment_part import MeshAtDuty, WholeDrive
from tribodyn.gears.case import GearCase, LubricatedCase, OiledCase
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.gears.rating.bearings import TurningShaft, shafts_of_pair
from tribodyn.geometry.body import GEOMETRY
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout
from tribodyn.studies.assessment.settings import AssessedTable, AssessmentTable
from tribodyn.studies.protocol.load import Loaded
from tribodyn.studies.protocol.study import CaseHead
from tribodyn.tribology.law import FrictionData
from tribodyn.tribology.oil import LubricantData

_ALONG, _OVER = ("roll_angle",), ("input_speed",)

ROLL = Variable(
    _ALONG, "rad", "rotation of the pinion since the pair met at the pitch point, negative before it"
)
SPEED = Variable(_OVER, "rad/s", "speed of the input, increasing; that of the duty is one of them")

ALONG_PATH: dict[str, Variable] = {
    "normal_load": Variable(_ALONG, "N", "normal load of the pair in slow rotation"),
    "hertz_pressure": Variable(
        _ALONG, "Pa", "maximum Hertz pressure over the face, with application and dynamic factor"
    ),
    "equivalent_radius": Variable(_ALONG, "m", "radius of relative curvature"),
    "sliding_speed": Variable(_ALONG, "m/s", "sliding speed"),
    "flash_temperature_rise": Variable(_ALONG, "K", "flash temperature rise above the bulk"),
    "contact_temperature": Variable(_ALONG, "K", "contact temperature: bulk and flash"),
    "film_thickness": Variable(_ALONG, "m", "film thickness of ISO/TS 6336-22, method A"),
    "specific_film": Variable(_ALONG, "1", "specific film thickness: film over mean roughness Ra"),
}
OVER_SPEED: dict[str, Variable] = {
    "dynamic_factor": Variable(_OVER, "1", "largest dynamic factor of all meshes"),
    "mesh_load_factor": Variable(_OVER, "1", "largest mesh load factor K_gamma of all planetary stages"),
    "contact_loss_fraction": Variable(_OVER, "1", "largest share of the time without contact of all meshes"),
    "efficiency": Variable(_OVER, "1", "mean power out over mean power in"),
    "power_friction_mean": Variable(_OVER, "W", "mean power of tooth friction in all meshes"),
    "hertz_pressure_max": Variable(_OVER, "Pa", "largest Hertz pressure of all meshes in motion"),
    "film_parameter_min": Variable(_OVER, "1", "smallest film over roughness of all meshes"),
    "S_B": Variable(_OVER, "1", "smallest simulated safety against scuffing of all meshes"),
    "S_lambda": Variable(_OVER, "1", "smallest simulated safety against micropitting of all meshes"),
}


@dataclass(frozen=True, kw_only=True)
class RatedPair(OiledCase):
    """A pair of gears as it is rated, complete."""

    oil_temperature: float  # of the duty, K
    settings: AssessmentTable
    limits: Mapping[str, Any]  # name of a limit -> its value, SI units
    #: duties of the load spectrum: share of the time, pinion speed rad/s, gear torque N m; empty: none
    spectrum: tuple[tuple[float, float, float], ...] = ()

    def with_laws(self) -> LubricatedCase:
        """The gears at their duty with the first friction law, and the film law that goes with it."""
        gears = {field.name: getattr(self, field.name) for field in fields(GearCase)}
        first = FrictionData(self.settings.friction_laws[0])
        return with_chosen_laws(LubricatedCase(**gears, lubricant=self.lubricant, friction=first))


class RatedMesh(NamedTuple):
    """A mesh of the gearbox as its pair of gears is assessed."""

    mesh: MeshAtDuty
    rated: RatedPair  # the driver its pinion
    #: the same as it is pressed: of a ring that drives the planet is the pinion, in the opposite sense
    pressed: RatedPair

    @property
    def turned(self) -> bool:
        """Whether both differ."""
        return self.pressed is not self.rated

    @property
    def group(self) -> str:
        """Name that it shares with the meshes of a set's other planets."""
        return self.mesh.alike or self.mesh.name


@dataclass(frozen=True, kw_only=True)
class AssessmentCase(CaseHead):
    """One assessment, complete: of the gearbox of a scenario, or of the pair of gears of its own file."""

    settings: AssessedTable
    limits: Mapping[str, Any]  # name of a limit -> its value, SI units
    #: case -> its meshes with teeth whose driver drives, by name; the only one of a pair has none
    rated: Callable[[Any], Mapping[str, RatedMesh]] = field(compare=False, repr=False)
    own: RatedPair | None = None  # the pair of gears
    subject: Loaded | None = None  # or the scenario of the gearbox

    @cached_property
    def meshes(self) -> Mapping[str, RatedMesh]:
        """Its meshes by name, see `rated`."""
        return self.rated(self)

    @property
    def pair(self) -> RatedPair:
        """The pair of gears of the first mesh."""
        return self.own or next(iter(self.meshes.values())).rated

    @property
    def gearbox(self) -> Loaded:
        """The scenario of the gearbox, of which there is one."""
        assert self.subject is not None
        return self.subject

    @property
    def whole(self) -> WholeDrive:
        """What the study of the gearbox says of its meshes."""
        whole = self.gearbox.study.whole()
        assert whole is not None, "refused by the rules"
        return whole

    @property
    def speed(self) -> float:
        """Of the input, rad/s."""
        return self.own.operating.pinion_speed if self.own else self.whole.speed(self.gearbox.case)

    @property
    def oil(self) -> LubricantData:
        """Of all meshes."""
        return self.own.lubricant if self.own else self.whole.meshes(self.gearbox.case)[0].pair.lubricant

    @property
    def shafts(self) -> tuple[TurningShaft, ...]:
        """The drawn shafts at their speeds."""
        return shafts_of_pair(self.own) if self.own else tuple(self.whole.shafts(self.gearbox.case))

    def without_run(self) -> dict[str, float]:
        """Of a pair what its teeth have without a run."""
        return self.own.without_run() if self.own else {}

    def remarks_in_brief(self) -> list[str]:
        """Of a pair what is to be said of it where it is one of many."""
        return self.own.remarks_in_brief() if self.own else []


def layout_of(case: AssessmentCase) -> Layout:
    """What a record holds: values over the speed, and of a pair of gears along its path of contact first."""
    if case.own is None:
        return Layout(SPEED, OVER_SPEED)
    return Layout(ROLL, ALONG_PATH, {"input_speed": SPEED}, OVER_SPEED, {"geometry": GEOMETRY})


#: Positions of the slow rotation, and places of one pair's path among them.
_POSITIONS, _PLACES = 60, 120


def estimate(case: AssessmentCase) -> cost.Estimate:
    """What a run of a case takes: runs of its gearbox, steady states, and the teeth pressed together."""
    settings = case.settings
    drivers = (
        cost.CostKey("assessment.speeds", settings.speeds, 46),
        cost.CostKey("assessment.samples", settings.samples, 16),
    )
    record = cost.recorded(
        layout_of(case), {"roll_angle": _PLACES, "input_speed": settings.speeds + 1}, outlines=True
    )
    if case.own is not None:
        sharing = cost.load_sharing(float(_POSITIONS) * (1 + len(settings.torque_shares)), 1.0, _POSITIONS)
        steady = cost.steady_states(settings.speeds, len(settings.friction_laws), settings.samples)
        return cost.total(drivers, record, sharing, steady, cost.FINITE_ELEMENTS)
    gearbox, runs = case.gearbox, 1 + len(settings.friction_laws)
    one, meshes = gearbox.study.estimate(gearbox.case), len(case.whole.meshes(gearbox.case))
    steady = cost.steady_states(float(meshes * settings.speeds), 0.0, float(meshes * settings.samples))
    return one._replace(
        memory=one.memory + steady.memory,
        record=runs * one.record,
        seconds=runs * one.seconds + steady.seconds,
        drivers=(*one.drivers, *drivers),
    )
