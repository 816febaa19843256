"""A case of an assessment: everything that it needs to know, in SI units, and what it records."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal

from pydantic import Field

from tribodyn.cases import cost
from tribodyn.gears.case import GearCase, LubricatedCase, OiledCase
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.geometry.body import GEOMETRY
from tribodyn.input.quantity import NotNegative, Positive, Text
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout
from tribodyn.studies.assessment.settings import AssessedTable
from tribodyn.tribology.law import AUTO, FrictionData

_ALONG = ("roll_angle",)

ROLL = Variable(
    _ALONG, "rad", "rotation of the pinion since the pair met at the pitch point, negative before it"
)

SAMPLES: dict[str, Variable] = {
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

LAYOUT = Layout(ROLL, SAMPLES, groups={"geometry": GEOMETRY})


class AssessmentTable(AssessedTable):
    """What is asked beyond the duty, and what the standards need to know."""

    standard: Literal["iso", "agma"] = "iso"
    torque_shares: tuple[Positive, ...] = Field((0.25, 0.5, 0.75, 1.0, 1.25), min_length=2, max_length=50)
    friction_laws: tuple[Text, ...] = Field(
        (AUTO, "masjedi-khonsari", "niemann", "schlenk", "xu", "benedict-kelley", "iso-14179-1"),
        min_length=1,
        max_length=10,
    )
    damping_ratio: NotNegative = 0.05


@dataclass(frozen=True, kw_only=True)
class AssessmentCase(OiledCase):
    """One assessment, complete."""

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


#: Positions of the slow rotation, and places of one pair's path among them.
_POSITIONS, _PLACES = 60, 120


def estimate(case: AssessmentCase) -> cost.Estimate:
    """What a run of a case takes."""
    settings = case.settings
    return cost.total(
        (
            cost.CostKey("assessment.speeds", settings.speeds, 46),
            cost.CostKey("assessment.samples", settings.samples, 16),
        ),
        cost.recorded(LAYOUT, {"roll_angle": _PLACES}, outlines=True),
        cost.load_sharing(float(_POSITIONS) * (1 + len(settings.torque_shares)), 1.0, _POSITIONS),
        cost.steady_states(settings.speeds, len(settings.friction_laws), settings.samples),
        cost.FINITE_ELEMENTS,
    )
