"""The tables of `models/drives/`: what drives, with their modified flanks, are."""

from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.geometry.drive import PROFILES
from tribodyn.geometry.families import FAMILIES
from tribodyn.geometry.flanks.modification import FlankModification, LeadRelief, Relief
from tribodyn.input import quantity, units
from tribodyn.input.fields import ErrorCurve
from tribodyn.input.tables.gears.material import Described, MaterialReference
from tribodyn.standards.allowances import CODES
from tribodyn.tribology.asperities import FinishName

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

    tip_relief: Amount = quantity.written("0 um", description="at the end of the active profile")
    tip_relief_length: Length | None = Field(
        None, description="along the line of action, from the end of the active path; default: the module"
    )
    tip_relief_shape: Shape = "linear"
    root_relief: Amount = quantity.written("0 um", description="at the beginning of the active profile")
    root_relief_length: Length | None = Field(
        None, description="along the line of action, from the end of the active path; default: the module"
    )
    root_relief_shape: Shape = "linear"
    lead_relief_start: Amount = quantity.written("0 um", description="at one end of the face, parabolic")
    lead_relief_end: Amount = quantity.written("0 um", description="at the other end")
    lead_unmodified: Annotated[float, quantity.InUnit(units.not_negative(units.LENGTH))] = quantity.written(
        "0 mm", description="straight part of the face between the two, in its middle"
    )
    crowning: Amount | None = Field(
        None, description="the same at both ends of the face, without a straight part"
    )
    bias: Annotated[float, quantity.InUnit(units.DEVIATION, "6 um")] = quantity.written(
        "0 um", description="twist: missing at the tip at the end of the face and at the root at its start"
    )
    profile_error: Annotated[ErrorCurve, quantity.csv_file("roll_angle", "error")] | None = Field(
        None, description="positive where material is missing"
    )
    pitch_errors: Annotated[
        tuple[Annotated[float, quantity.InUnit(units.DEVIATION)], ...],
        quantity.csv_file("error", as_list=True),
    ] = Field((), description="one per tooth, positive where material is missing")
    tooth_errors: Annotated[FlankErrors, quantity.csv_file("tooth", "height", "face", "error")] | None = (
        Field(None, description="of single teeth over their flank; over time")
    )
    tooth_formula: quantity.Text | None = Field(
        None,
        description="of every tooth, um, over i, z, h and f; over time",
        examples=["5 * sin(2 * pi * i / z)"],
    )
    both_flanks: quantity.Switch = Field(
        False, description="whether all of it but pitch errors is on the back flanks too"
    )


class MisalignmentTable(quantity.Table):
    """Angles between the axes of the gears."""

    in_plane: Annotated[float, quantity.InUnit(units.SMALL_ANGLE)] = quantity.written(
        "0 arcmin", description="within the plane of action"
    )
    out_of_plane: Annotated[float, quantity.InUnit(units.SMALL_ANGLE)] = quantity.written(
        "0 arcmin", description="perpendicular to the plane of action"
    )
    from_quality: quantity.NotNegative = Field(
        0.0, description="share of both gears' helix slope tolerances that adds to in_plane"
    )


def flank_of(table: Modification, module: float) -> FlankModification:
    """Return the modification of a gear's flanks; `module` in m is the length of reliefs without one."""
    return FlankModification(
        tip=_relief(table, "tip", module),
        root=_relief(table, "root", module),
        lead=LeadRelief(
            table.lead_relief_start, table.lead_relief_end, table.lead_unmodified, table.crowning or 0.0
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
Grade = Annotated[int, Field(strict=True, ge=1, le=11)]
QualityEdition = Literal[2013, 1995]
Roughness = Annotated[float, quantity.InUnit(units.positive(units.LENGTH), "0.5 um")]


Hand = Literal["right", "left"]


class Gear(quantity.Table):
    """One gear of a drive."""

    teeth: Annotated[int, Field(strict=True, ge=4, le=10_000)]
    face_width: FaceWidth
    internal: quantity.Switch = Field(
        False, description="teeth inwards; lengths and numbers of teeth are written without sign all the same"
    )
    bore_radius: BoreRadius | None = Field(
        None, description="of the body; 0: a solid one; default: 0.2 times the reference diameter"
    )
    bore_diameter: BoreDiameter | None = Field(None, description="in place of the bore's radius")
    profile_shift: quantity.Number = Field(0.0, description="x, times the module")
    profile_shift_of: Literal["tooth", "gap"] = Field(
        "tooth", description="what a positive shift makes thicker: the tooth, or the gap of an internal gear"
    )
    addendum: quantity.Positive | None = Field(
        None, description="h_a*, times the module; default: the rack's, else 1 (ISO 53)"
    )
    dedendum: quantity.Positive | None = Field(
        None, description="h_f*, times the module; default: the rack's, else 1.25 (ISO 53)"
    )
    fillet_radius: quantity.NotNegative | None = Field(
        None, description="of the cutter's tip, times the module; default: the rack's, else 0.25 (ISO 53 C)"
    )
    outer_diameter: Diameter | None = Field(
        None, description="of the body of an internal gear; default: 3 modules outside its root circle"
    )
    rim: Literal["fixed", "pins", "free"] = Field(
        "fixed", description="outside of an internal gear: held in its fit, on pins, or free to bend"
    )
    pins: Annotated[int, Field(strict=True, ge=3, le=1000)] | None = Field(
        None, description="number of pins that hold the rim, evenly spaced"
    )
    cutter_teeth: Annotated[int, Field(strict=True, ge=3, le=10_000)] | None = Field(
        None, description="of the pinion-type cutter of an internal gear; default: 20, at most half its teeth"
    )
    cutter_profile_shift: quantity.Number | None = Field(None, description="x_0 of this cutter; default: 0")
    cutter_addendum: quantity.Positive | None = Field(
        None, description="h_a0* of this cutter, times the module; default: what the dedendum needs"
    )
    cutter_rounding: quantity.NotNegative | None = Field(
        None, description="of this cutter's tip, times the module; default: fillet_radius"
    )
    tip_radius: Radius | None = Field(None, description="takes the place of the addendum")
    tip_diameter: Diameter | None = Field(None, description="in place of the tip's radius")
    tip_rounding: Rounding | None = Field(None, description="radius of the tip's rounded edge")
    thickness_allowance: Allowance | None = Field(
        None, description="A_sne, upper deviation of the tooth thickness; negative: thinner"
    )
    thickness_tolerance: Rounding | None = Field(
        None, description="T_sn, tolerance of the tooth thickness below its upper deviation"
    )
    thickness_code: Annotated[quantity.Text, quantity.Names(CODES)] | None = Field(
        None, description="allowance and tolerance of the tooth thickness by DIN 3967", examples=["cd25"]
    )
    span: Span | None = Field(None, description="W_k, measured over span_teeth teeth; of involutes")
    span_teeth: Annotated[int, Field(strict=True, ge=1, le=10_000)] | None = Field(
        None, description="k, number of teeth of the span"
    )
    over_pins: OverPins | None = Field(None, description="M_d, measured over two pins; of involutes")
    pin_diameter: Pin | None = Field(None, description="D_M of these pins")
    mean_roughness: Roughness | None = Field(None, description="Ra of its flanks; default: the drive's")
    mass: Mass | None = Field(None, description="default: from outline, bore and width")
    inertia: Inertia | None = Field(None, description="polar; default: from outline, bore and width")
    rim_thickness: Length | None = Field(
        None,
        description="under the teeth, of a webbed body, for the standards; default: down to the bore",
    )
    web_thickness: Length | None = Field(
        None, description="of such a body, with rim_thickness; default: a solid disc"
    )
    material: MaterialReference | None = Field(None, description="default: the drive's")
    quality: Grade | None = Field(None, description="its tolerance class; default: the drive's")
    hand: Hand | None = Field(None, description="of its helix; default: by the drive's")
    modification: Modification = quantity.written({})
    eccentricity: Amount = quantity.written(
        "0 um", description="of its axis from that which it turns about; over time"
    )
    eccentricity_angle: Annotated[float, quantity.InUnit(units.ANGLE_KIND)] = quantity.written(
        "0 deg", description="its direction from the axis of tooth 1, in the gear's sense of rotation"
    )
    wobble: Annotated[float, quantity.InUnit(units.not_negative(units.SMALL_ANGLE))] = quantity.written(
        "0 arcmin", description="angle between both axes; over time"
    )
    wobble_angle: Annotated[float, quantity.InUnit(units.ANGLE_KIND)] = quantity.written(
        "0 deg", description="direction in which the axis stands off at the +z end, likewise"
    )


#: Keys of a pair of gears, in a drive file and in a stage of a train.
PressureAngle = Annotated[
    Angle | None,
    Field(
        description="of the rack's normal section for involutes; at the pitch point, in the transverse "
        "section, for other families, if they take one"
    ),
]
CentreDistance = Annotated[
    Annotated[quantity.Printed, quantity.PrintedQuantity(units.positive(units.LENGTH))] | None,
    Field(description="of involutes; default: that of nominal teeth in mesh without backlash"),
]
HelixAngle = Annotated[
    Annotated[float, quantity.InUnit(units.ANGLE_KIND)] | None,
    Field(
        description="of the reference circles, 0 to below 45 deg; module, pressure angle and rack of "
        "involutes are then of the normal section, those of other families of the transverse section; "
        "default: spur gears"
    ),
]
Rack = Annotated[
    Annotated[quantity.Text, quantity.Names(PROFILES)] | None,
    Field(description="basic rack, for what the pressure angle and the gears do not say themselves"),
]
FamilyKeys = Annotated[
    dict[str, Any] | None,
    quantity.FamilyShape(),
    Field(description="what else the family needs, see `tribodyn list`"),
]
CompositeRoughness = Annotated[
    Roughness | None,
    Field(description="composite rms roughness of the flanks; default: from the mean roughness of both"),
]


Finish = Annotated[
    FinishName | None,
    Field(description="of the flanks, for asperity_density and asperity_slope; default: ground"),
]
AsperityDensity = Annotated[
    quantity.Positive | None,
    Field(description="σβn of Greenwood & Tripp in the solved contact; default: by finish"),
]
AsperitySlope = Annotated[
    quantity.Positive | None,
    Field(description="σ/β of Greenwood & Tripp in the solved contact; default: by finish"),
]


class DriveTable(Described):
    """A gear pair (`models/drives/`)."""

    family: Annotated[quantity.Text, quantity.Names(FAMILIES)] = Field(
        description="family of the path of contact"
    )
    module: Length = Field(description="of involutes the normal module")
    pressure_angle: PressureAngle = None
    helix_angle: HelixAngle = None
    hand: Hand | None = Field(None, description="of the pinion's helix; default: right")
    centre_distance: CentreDistance = None
    rack: Rack = None
    shape: FamilyKeys = None
    roughness: CompositeRoughness = None
    mean_roughness: Roughness | None = Field(
        None, description="Ra of the flanks; default: the gears' own, or roughness/sqrt(pi)"
    )
    finish: Finish = None
    asperity_density: AsperityDensity = None
    asperity_slope: AsperitySlope = None
    material: MaterialReference | None = None
    quality: Grade | None = Field(None, description="tolerance class of both gears by ISO 1328-1")
    quality_edition: QualityEdition = Field(
        2013, description="edition of ISO 1328-1 that has the tolerances of this class"
    )
    centre_distance_grade: Annotated[int, Field(strict=True, ge=5, le=11)] | None = Field(
        None, description="js class of the centre distance of involutes by ISO 286"
    )
    pinion: Gear
    gear: Gear

    @property
    def has_ring(self) -> bool:
        """Whether one of the gears is internal."""
        return self.pinion.internal or self.gear.internal


class GearboxTable(quantity.Table):
    """A mesh of another scenario."""

    scenario: quantity.Text = Field(description="name of a scenario of a train, or its file")
    mesh: quantity.Text = quantity.written("", description="name of the mesh; default: every mesh")
