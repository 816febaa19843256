"""The tables of `models/drives/` and `models/materials/`: gears with their modified flanks, and solids."""

from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.geometry.drive import PROFILES
from tribodyn.geometry.families import FAMILIES
from tribodyn.geometry.modification import FlankModification, LeadRelief, Relief
from tribodyn.input import quantity, units
from tribodyn.input.fields import ErrorCurve
from tribodyn.standards.allowances import CODES
from tribodyn.standards.metals import Grade, Treatment
from tribodyn.tribology.contact import FinishName

Pressure = Annotated[float, quantity.InUnit(units.positive(units.PRESSURE))]
Strength = Annotated[float, quantity.InUnit(units.positive(units.PRESSURE), "1500 MPa")]
CaseDepth = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "0.7 mm")]
CoreHardness = Annotated[float, quantity.InUnit(units.positive(units.PRESSURE), "350 HV")]

#: Title of a model that a scenario writes out.
OWN_VALUES = "own values"


class Described(quantity.Table):
    """What every model begins with; a table in a scenario may leave it out."""

    title: quantity.Text = OWN_VALUES
    source: quantity.Text = "not stated"
    assumptions: quantity.Text = ""


class Material(Described):
    """A solid (`models/materials/`)."""

    youngs_modulus: Pressure
    poisson_ratio: Annotated[float, Field(strict=True, ge=0, lt=0.5)]
    density: Annotated[float, quantity.InUnit(units.positive(units.DENSITY))]
    thermal_conductivity: Annotated[float, quantity.InUnit(units.positive(units.CONDUCTIVITY))]
    specific_heat: Annotated[float, quantity.InUnit(units.positive(units.SPECIFIC_HEAT))]
    hardness: Annotated[float, quantity.InUnit(units.positive(units.PRESSURE), "7 GPa")]
    treatment: Treatment | None = None
    grade: Grade = "MQ"
    contact_stress_limit: Strength | None = None
    bending_stress_limit: Strength | None = None
    yield_strength: Strength | None = None
    case_depth: CaseDepth | None = None
    core_hardness: CoreHardness | None = None


MaterialReference = Annotated[Material, quantity.model_file("materials")]


Amount = Annotated[float, quantity.InUnit(units.not_negative(units.RELIEF))]
Length = Annotated[float, quantity.InUnit(units.positive(units.LENGTH))]
Shape = Literal["linear", "parabolic"]

_EXPONENT = {"linear": 1.0, "parabolic": 2.0}


class FlankErrors(quantity.Columns):
    """Errors of single teeth on the flank that drives or is driven, positive where material is missing.

    Every tooth at the same heights (0 at the root's end of the path of contact, 1 at the tip's) and places on
    the face, from its middle.
    """

    tooth: Annotated[quantity.Column, units.NUMBER]
    height: Annotated[quantity.Column, units.NUMBER]
    face: Annotated[quantity.Column, units.LENGTH]
    error: Annotated[quantity.Column, units.DEVIATION]


class Modification(quantity.Table):
    """What is missing on the flanks of a gear, along their normal: the driving flanks, or both."""

    tip_relief: Amount = quantity.written("0 um")
    tip_relief_length: Length | None = None
    tip_relief_shape: Shape = "linear"
    root_relief: Amount = quantity.written("0 um")
    root_relief_length: Length | None = None
    root_relief_shape: Shape = "linear"
    lead_relief_start: Amount = quantity.written("0 um")
    lead_relief_end: Amount = quantity.written("0 um")
    lead_unmodified: Annotated[float, quantity.InUnit(units.not_negative(units.LENGTH))] = quantity.written(
        "0 mm"
    )
    crowning: Amount | None = None
    helix_slope: Annotated[float, quantity.InUnit(units.DEVIATION, "6 um")] = quantity.written("0 um")
    bias: Annotated[float, quantity.InUnit(units.DEVIATION, "6 um")] = quantity.written("0 um")
    profile_error: Annotated[ErrorCurve, quantity.csv_file("roll_angle", "error")] | None = None
    pitch_errors: Annotated[
        tuple[Annotated[float, quantity.InUnit(units.DEVIATION)], ...],
        quantity.csv_file("error", as_list=True),
    ] = ()
    tooth_errors: Annotated[FlankErrors, quantity.csv_file("tooth", "height", "face", "error")] | None = None
    tooth_errors_back: (
        Annotated[FlankErrors, quantity.csv_file("tooth", "height", "face", "error")] | None
    ) = None
    tooth_formula: quantity.Text | None = Field(None, examples=["5 * sin(2 * pi * i / z)"])
    both_flanks: quantity.Switch = False


class MisalignmentTable(quantity.Table):
    """Angles between the axes of the gears."""

    in_plane: Annotated[float, quantity.InUnit(units.SMALL_ANGLE)] = quantity.written("0 arcmin")
    out_of_plane: Annotated[float, quantity.InUnit(units.SMALL_ANGLE)] = quantity.written("0 arcmin")
    from_quality: quantity.NotNegative = 0.0


def flank_of(table: Modification, module: float) -> FlankModification:
    """Return the modification of a gear's flanks; `module` in m is the length of reliefs without one."""
    return FlankModification(
        tip=_relief(table, "tip", module),
        root=_relief(table, "root", module),
        lead=LeadRelief(
            table.lead_relief_start,
            table.lead_relief_end,
            table.lead_unmodified,
            table.crowning or 0.0,
            table.helix_slope,
        ),
        bias=table.bias,
        profile_error=table.profile_error.in_si() if table.profile_error else None,
        pitch_error=table.pitch_errors,
        both_flanks=table.both_flanks,
    )


def _relief(table: Modification, end: str, module: float) -> Relief:
    amount, length = getattr(table, f"{end}_relief"), getattr(table, f"{end}_relief_length")
    if length is None:
        length = module if amount else 0.0
    return Relief(amount, length, _EXPONENT[getattr(table, f"{end}_relief_shape")])


Angle = Annotated[float, quantity.InUnit(units.positive(units.ANGLE_KIND))]
Mass = Annotated[float, quantity.InUnit(units.positive(units.MASS))]
Inertia = Annotated[float, quantity.InUnit(units.positive(units.INERTIA))]
FaceWidth = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "20 mm")]
Radius = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "12 mm")]
Diameter = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "30 mm")]
BoreRadius = Annotated[float, quantity.InUnit(units.not_negative(units.LENGTH), "12 mm")]
BoreDiameter = Annotated[float, quantity.InUnit(units.not_negative(units.LENGTH), "30 mm")]
Rounding = Annotated[float, quantity.InUnit(units.not_negative(units.LENGTH), "0.03 mm")]
Allowance = Annotated[float, quantity.InUnit(units.DEVIATION, "-60 um")]
Span = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "32.4 mm")]
OverPins = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "83.2 mm")]
Pin = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "5.25 mm")]
QualityGrade = Annotated[int, Field(strict=True, ge=1, le=11)]
QualityEdition = Literal[2013, 1995]
Roughness = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "0.5 um")]


Hand = Literal["right", "left"]


class Gear(quantity.Table):
    """One gear of a drive."""

    teeth: Annotated[int, Field(strict=True, ge=4, le=10_000)]
    face_width: FaceWidth
    internal: quantity.Switch = False
    bore_radius: BoreRadius | None = None
    bore_diameter: BoreDiameter | None = None
    profile_shift: quantity.Number = 0.0
    profile_shift_of: Literal["tooth", "gap"] = "tooth"
    addendum: quantity.Positive | None = None
    dedendum: quantity.Positive | None = None
    fillet_radius: quantity.NotNegative | None = None
    outer_diameter: Diameter | None = None
    rim: Literal["fixed", "pins", "free"] = "fixed"
    pins: Annotated[int, Field(strict=True, ge=3, le=1000)] | None = None
    cutter_teeth: Annotated[int, Field(strict=True, ge=3, le=10_000)] | None = None
    cutter_profile_shift: quantity.Number | None = None
    cutter_addendum: quantity.Positive | None = None
    cutter_rounding: quantity.NotNegative | None = None
    tip_radius: Radius | None = None
    tip_diameter: Diameter | None = None
    tip_rounding: Rounding | None = None
    thickness_allowance: Allowance | None = None
    thickness_tolerance: Rounding | None = None
    thickness_code: Annotated[quantity.Text, quantity.Names(CODES)] | None = Field(None, examples=["cd25"])
    span: Span | None = None
    span_teeth: Annotated[int, Field(strict=True, ge=1, le=10_000)] | None = None
    over_pins: OverPins | None = None
    pin_diameter: Pin | None = None
    mean_roughness: Roughness | None = None
    mass: Mass | None = None
    inertia: Inertia | None = None
    rim_thickness: Length | None = None
    web_thickness: Length | None = None
    material: MaterialReference | None = None
    quality: QualityGrade | None = None
    hand: Hand | None = None
    modification: Modification = quantity.written({})
    eccentricity: Amount = quantity.written("0 um")
    eccentricity_angle: Annotated[float, quantity.InUnit(units.ANGLE_KIND)] = quantity.written("0 deg")
    wobble: Annotated[float, quantity.InUnit(units.not_negative(units.SMALL_ANGLE))] = quantity.written(
        "0 arcmin"
    )
    wobble_angle: Annotated[float, quantity.InUnit(units.ANGLE_KIND)] = quantity.written("0 deg")


class TeethTable(quantity.Table):
    """What both gears of a mesh have in common."""

    family: Annotated[quantity.Text, quantity.Names(FAMILIES)]
    module: Length
    pressure_angle: Angle | None = None
    helix_angle: Annotated[float, quantity.InUnit(units.ANGLE_KIND)] | None = None
    centre_distance: (
        Annotated[quantity.Printed, quantity.PrintedQuantity(units.positive(units.LENGTH))] | None
    ) = None
    rack: Annotated[quantity.Text, quantity.Names(PROFILES)] | None = None
    shape: Annotated[dict[str, Any] | None, quantity.FamilyShape()] = None
    roughness: Roughness | None = None
    finish: FinishName | None = None
    asperity_density: quantity.Positive | None = None
    asperity_slope: quantity.Positive | None = None


class DriveTable(TeethTable, Described):
    """A gear pair (`models/drives/`)."""

    hand: Hand | None = None
    mean_roughness: Roughness | None = None
    material: MaterialReference | None = None
    quality: QualityGrade | None = None
    quality_edition: QualityEdition = 2013
    centre_distance_grade: Annotated[int, Field(strict=True, ge=5, le=11)] | None = None
    pinion: Gear
    gear: Gear

    @property
    def has_ring(self) -> bool:
        """Whether one of the gears is internal."""
        return self.pinion.internal or self.gear.internal


class GearboxTable(quantity.Table):
    """A mesh of another scenario."""

    scenario: quantity.Text
    mesh: quantity.Text = quantity.written("")
