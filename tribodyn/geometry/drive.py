"""A gear drive as numbers: module, pressure angle, two bodies, and what these are made of."""

import math
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple


@dataclass(frozen=True)
class MaterialData:
    """What a gear is made of."""

    name: str  # name of the material's file, or its title
    youngs_modulus: float  # E, Pa
    poisson_ratio: float  # ν, 0 ≤ ν < 0.5
    density: float  # ρ of the solid, kg/m³
    thermal_conductivity: float  # K, W/(m K)
    specific_heat: float  # c_p, J/(kg K)
    hardness: float  # Vickers hardness as a pressure, Pa
    #: heat treatment and grade of quality by ISO 6336-5; None: no strength is known
    treatment: str | None = None
    grade: str = "MQ"
    #: σ_Hlim and σ_Flim, Pa, where they are not those of ISO 6336-5 for treatment, grade and hardness
    contact_stress_limit: float | None = None
    bending_stress_limit: float | None = None
    yield_strength: float | None = None  # of the root, Pa; None: estimated from the hardness
    #: depth of 550 HV, m, and hardness of the core, Pa, of a case-hardened gear; None: no flank fracture
    case_depth: float | None = None
    core_hardness: float | None = None


@dataclass(frozen=True)
class BodyMass:
    """A gear's body: mass, kg, polar moment of inertia, kg m²; None: computed from outline, bore, width."""

    mass: float | None = None
    inertia: float | None = None
    #: rim under the teeth and web, m, for the standards' stiffness and root stress; None: a solid disc
    rim: float | None = None
    web: float | None = None


Side = Literal["pinion", "gear"]
SIDES: tuple[Side, Side] = ("pinion", "gear")

# Every field may be a float or a JAX tracer; a drive is a pytree.
Number = Any


class GearBody(NamedTuple):
    """One gear of the drive; lengths "in modules" are in transverse modules.

    An internal gear has a negative number of teeth, and so negative radii, centre distance and gear ratio
    (ISO 21771): every formula of external gears holds for it as it stands. Its tip circle is -(|z|/2 - x -
    h_a*) m, its profile shift positive where it makes the tooth thicker, its bore minus the outer radius.
    """

    teeth: Number  # number of teeth; negative: internal
    #: shift of the rack away from the axis (involute only), in modules; of an internal gear towards it
    profile_shift: Number
    #: addendum, dedendum: tooth height above and below the shifted reference line, in modules
    addendum: Number
    dedendum: Number
    fillet_radius: Number  # radius of the tool's rounded tip, in modules
    face_width: Number  # width of the teeth along the axis, m
    bore_radius: Number  # radius of the bore, m; 0 for a solid body; of an internal gear its outside, < 0
    #: float, optional Radius of the tip circle, m, where it is not r + (addendum + profile shift) × module.
    tip_radius: Number = None
    #: deviation of the tooth thickness on the reference circle from that of teeth which mesh without play,
    #: m, in the section of the drive's module: A_sn/cos β in the transverse one (ISO 21771); < 0: thinner
    thickness_allowance: Number = 0.0
    #: height below the tip circle at which the rounding of the tip leaves the flank, m
    tip_break: Number = 0.0
    #: number of teeth of the pinion-type cutter that makes an internal gear; None: a rack, of external gears
    cutter_teeth: Number = None
    cutter_shift: Number = 0.0  # profile shift of this cutter, in modules
    #: addendum of this cutter, in modules, of which the root circle follows; None: as high as the dedendum of
    #: the gear needs
    cutter_addendum: Number = None
    #: what holds the outside of an internal gear in shape: None: its fit; 0: nothing; else so many pins
    pins: Number | None = None


class Drive(NamedTuple):
    """A gear pair; of helical gears the transverse section, which their path of contact lies in."""

    module: Number  # m_t, reference pitch diameter over number of teeth, m
    #: α_t, rad; of the rack for the involute, at the pitch point for every other family
    pressure_angle: Number
    #: pinion, gear: the driver and the driven gear
    pinion: GearBody
    gear: GearBody
    #: what else the family's path needs: a NamedTuple of numbers and arrays that the family defines
    shape: Any = ()
    #: float, optional Between the axes, m, where it is not that of the mesh without backlash (involute only).
    centre_distance: Number = None
    helix_angle: Number = 0.0  # β on the reference circles, rad; > 0: right-hand pinion, left-hand gear


def body_of(drive: Drive, side: Side) -> GearBody:
    """Return the pinion or the gear of the drive."""
    return drive.pinion if side == "pinion" else drive.gear


def internal_side(drive: Drive) -> Side | None:
    """Which gear of the pair is internal; None: neither."""
    return next((side for side in SIDES if body_of(drive, side).teeth < 0), None)


def reference_radius(drive: Drive, side: Side) -> Number:
    """Radius of the circle that rolls with the rack: module × teeth / 2, m."""
    return drive.module * body_of(drive, side).teeth / 2


def reference_radii(drive: Drive) -> tuple[Number, Number]:
    """Reference radii of pinion and gear, m."""
    return reference_radius(drive, "pinion"), reference_radius(drive, "gear")


def tip_radius(drive: Drive, side: Side) -> Number:
    """Radius at which the flank ends, m: of the tip circle, less what a rounding of the tip takes."""
    return tip_circle_radius(drive, side) - body_of(drive, side).tip_break


def tip_circle_radius(drive: Drive, side: Side) -> Number:
    """Radius of the tip circle, m: m (z/2 + x + h_a*) unless the body overrides it."""
    body = body_of(drive, side)
    if body.tip_radius is not None:
        return body.tip_radius
    return reference_radius(drive, side) + drive.module * (body.addendum + body.profile_shift)


class RackProfile(NamedTuple):
    """Tooth of a basic rack, as the gear's own counterpart has it."""

    pressure_angle: float  # rad
    #: addendum, dedendum: h_aP and h_fP, modules
    addendum: float
    dedendum: float
    fillet_radius: float  # ρ_fP of the root, which is the tip of the cutter, modules


_ALPHA = math.radians(20.0)
#: Table 2 of the standard; A for high torques, B and C for usual service, D for ground or shaved flanks.
PROFILES = {
    "ISO 53 A": RackProfile(_ALPHA, 1.0, 1.25, 0.38),
    "ISO 53 B": RackProfile(_ALPHA, 1.0, 1.25, 0.3),
    "ISO 53 C": RackProfile(_ALPHA, 1.0, 1.25, 0.25),
    "ISO 53 D": RackProfile(_ALPHA, 1.0, 1.4, 0.39),
}
