"""Tables of a train: gears, stages, shafts; bodies, links and meshes of a bare model; bearings, duty."""

from math import pi
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from tribodyn.geometry.families import FAMILIES
from tribodyn.input import fields, quantity, units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import (
    Column,
    Count,
    CurveTable,
    InUnit,
    NotNegative,
    Number,
    Table,
    Text,
    csv_file,
    written,
)
from tribodyn.input.tables.bearings import Stiffness
from tribodyn.input.tables.gears.model_files import Angle, FaceWidth, Gear, Inertia, Length, Mass, TeethTable
from tribodyn.input.tables.housing_matrices import Matrices, SeatNames, SeatPlaces, Units
from tribodyn.input.tables.laws import LinkTable
from tribodyn.train.elastic.pin import Pin, pin_stiffness
from tribodyn.train.planetary import (
    CARRIER,
    IN_PAIRS,
    MESHED,
    PLANETS,
    RAVIGNEAUX,
    RING,
    SECOND_SUN,
    SETS,
    SUN,
)

#: Stages, bodies, links, meshes and loads, each: as many as any train has.
MOST_PARTS = 100
#: The other end of a link that holds a body in the housing.
GROUND = "ground"

Backlash = Annotated[float, InUnit(units.not_negative(units.LENGTH), "0.1 mm")]
Azimuth = Annotated[float, InUnit(units.ANGLE_KIND, "30 deg")]
SpringStiffness = Annotated[float, InUnit(units.not_negative(units.STIFFNESS))]
Damping = Annotated[float, InUnit(units.not_negative(units.DAMPING))]


class TrainGear(Gear):
    """One gear of a train; what it does not say of material and flanks is said for all gears."""

    plane: Count | None = None
    tooth_angle: Azimuth = written("0 deg")
    axial_position: Annotated[float, InUnit(units.LENGTH, "30 mm")] = written("0 mm")


class StageTeeth(TeethTable):
    """What a drive file says of both gears of a mesh."""

    family: Annotated[Text, quantity.Names(FAMILIES)] = "involute"
    backlash: Backlash | None = None
    damping_ratio: NotNegative | None = None


class Stage(StageTeeth):
    """Two gears that mesh; the pinion of a drive file is the gear that drives."""

    type: Literal["pair", "planetary", "stepped", "meshed", "ravigneaux"] = "pair"
    stiffness: Stiffness | None = None
    name: PartName | None = None
    gears: tuple[Text, ...] = Field(min_length=2, max_length=2)
    azimuth: Azimuth | None = None


class RingRim(Table):
    """Rim of a ring that bends, on pins, in an elastic fit, or free."""

    orders: Annotated[int, Field(strict=True, ge=2, le=24)] = 6
    pins: Annotated[int, Field(strict=True, ge=5, le=360)] | None = None
    stiffness: Stiffness | None = None
    tangential_stiffness: SpringStiffness | None = None
    damping_ratio: NotNegative = 0.02


class PlanetPin(Table):
    """Pins of planets that bend: as drawn, or their stiffness."""

    mounting: Literal["cantilever", "straddle"] = "straddle"
    diameter: Length | None = None
    length: Length | None = None
    bore: Annotated[float, InUnit(units.not_negative(units.LENGTH), "10 mm")] = written("0 mm")
    youngs_modulus: Annotated[float, InUnit(units.positive(units.PRESSURE))] = written("206 GPa")
    poisson_ratio: Annotated[float, Field(strict=True, ge=0.0, lt=0.5)] = 0.3
    stiffness: Stiffness | None = None

    @property
    def rigidity(self) -> float:
        """Force over displacement at the planet's middle, N/m."""
        if self.stiffness is not None:
            return self.stiffness
        assert self.diameter is not None
        assert self.length is not None
        size = self.diameter, self.length, self.bore
        return pin_stiffness(Pin(self.mounting, *size, self.youngs_modulus, self.poisson_ratio))


class FlexibleCarrier(Table):
    """A carrier that gives, by matrices over its hub and the pins of its planets."""

    matrices: Matrices
    units: Units | None = None
    seats: SeatNames = ()
    places: SeatPlaces = written({})
    hub: PartName
    pins: SeatNames
    damping_ratio: NotNegative = 0.02


class PlanetaryStage(StageTeeth):
    """Sun, planets and ring on one axis, and the carrier of the planets; one may be held."""

    type: Literal["planetary", "stepped", "meshed", "ravigneaux"]
    name: PartName
    sun: Text
    planet: Text
    second_sun: Text | None = None
    second_planet: Text | None = None
    second_module: Length | None = None
    ring: Text
    carrier: Text
    planets: Annotated[int, Field(strict=True, ge=1, le=12)]
    angles: tuple[Azimuth, ...] = Field((), max_length=12)
    held: Literal["sun", "second_sun", "ring", "carrier"] | None = None
    support_stiffness: fields.TorsionalStiffness | None = None
    support_damping_ratio: NotNegative = 0.02
    floating: tuple[Literal["sun", "second_sun", "ring", "carrier"], ...] = Field((), max_length=4)
    radial_pin_errors: tuple[Annotated[float, InUnit(units.LENGTH)], ...] = Field((), max_length=12)
    tangential_pin_errors: tuple[Annotated[float, InUnit(units.LENGTH)], ...] = Field((), max_length=12)
    sun_stiffness: Stiffness | None = None
    ring_stiffness: Stiffness | None = None
    frame_forces: bool = True
    ring_rim: RingRim | None = None
    pin: PlanetPin | None = None
    flexible_carrier: FlexibleCarrier | None = None

    @property
    def members(self) -> dict[str, str]:
        """Names of suns, ring and carrier by what they are."""
        second = {} if self.second_sun is None else {SECOND_SUN: self.second_sun}
        return {SUN: self.sun, **second, RING: self.ring, CARRIER: self.carrier}

    @property
    def planet_gears(self) -> tuple[str, ...]:
        """Names of the planets' gears, those that mesh with the sun first."""
        return (self.planet,) if self.second_planet is None else (self.planet, self.second_planet)

    @property
    def planet_bodies(self) -> tuple[str, ...]:
        """Names of the planets that turn by themselves."""
        return self.planet_gears if self.type in IN_PAIRS else (self.planet,)

    @property
    def meshing(self) -> tuple[tuple[str, str, str], ...]:
        """Which gears mesh: what is at one end, and the names of both, seen outwards."""
        last = self.planet_gears[-1]
        second = () if self.second_sun is None else ((SECOND_SUN, self.second_sun, last),)
        between = ((PLANETS, self.planet, last),) if self.type in IN_PAIRS else ()
        return (SUN, self.sun, self.planet), *second, *between, (RING, last, self.ring)

    @property
    def spaces(self) -> str:
        """With which member the planets' mesh says how far from the axis those that the ring meshes with are.

        "": the mesh with the ring itself.
        """
        return {MESHED: "", RAVIGNEAUX: SECOND_SUN}.get(self.type, SUN)

    def module_at(self, member: str) -> float:
        """Module of the gears that mesh at a member, m."""
        return self.second_module if member == RING and self.second_module is not None else self.module

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of members and planets."""
        return (*self.members.values(), *self.planet_gears)

    @property
    def placed(self) -> tuple[float, ...]:
        """Angles of the planets, rad."""
        return self.angles or tuple(2.0 * pi * i / self.planets for i in range(self.planets))


def _stage_type(stage: Any) -> str:
    """Which of both a [[stage]] is."""
    if isinstance(stage, dict):
        planetary = stage.get("type") in SETS or "planet" in stage
    else:
        planetary = isinstance(stage, PlanetaryStage)
    return "(planetary)" if planetary else "(pair)"


AnyStage = Annotated[
    Annotated[Stage, Tag("(pair)")] | Annotated[PlanetaryStage, Tag("(planetary)")],
    Discriminator(_stage_type),
]


class BareBody(Table):
    """A body without teeth, such as a flywheel or a motor, or any body of a bare model."""

    name: PartName
    mass: Mass
    inertia: Inertia


class Link(LinkTable):
    """Springs and dampers between two bodies, or between a body and the housing."""

    name: PartName | None = None
    ends: tuple[Text, ...] = Field(min_length=2, max_length=2)
    stiffness_x: SpringStiffness = written("0 N/m")
    stiffness_y: SpringStiffness = written("0 N/m")
    damping_x: Damping = written("0 N*s/m")
    damping_y: Damping = written("0 N*s/m")
    stiffness: fields.TorsionalStiffness | None = None
    damping: fields.TorsionalDamping = written("0 N*m*s/rad")
    damping_ratio: NotNegative = 0.0


class ClutchTorque(CurveTable):
    """Torque of a clutch over time; held constant outside the points."""

    time: Annotated[Column, units.TIME]
    torque: Annotated[Column, units.not_negative(units.TORQUE)]


class ClutchForce(CurveTable):
    """Force that presses the faces of a clutch together over time; held constant outside the points."""

    time: Annotated[Column, units.TIME]
    normal_force: Annotated[Column, units.not_negative(units.FORCE)]


class Clutch(Table):
    """A friction clutch between two bodies, or a brake between a body and the housing."""

    name: PartName | None = None
    ends: tuple[Text, ...] = Field(min_length=2, max_length=2)
    torque: Annotated[float, InUnit(units.not_negative(units.TORQUE))] | None = None
    torque_table: Annotated[ClutchTorque, csv_file("time", "torque")] | None = None
    normal_force: Annotated[float, InUnit(units.not_negative(units.FORCE))] | None = None
    normal_force_table: Annotated[ClutchForce, csv_file("time", "normal_force")] | None = None
    friction_coefficient: NotNegative | None = None
    effective_radius: Length | None = None
    faces: Count = 1
    static_ratio: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=1.0)] = 1.0
    static_speed: Annotated[float, InUnit(units.positive(units.ANGULAR_SPEED))] | None = None
    reversal_speed: Annotated[float, InUnit(units.positive(units.ANGULAR_SPEED))] = written("0.1 rad/s")
    slip: Annotated[float, InUnit(units.ANGULAR_SPEED)] | None = None


class BareMesh(Table):
    """A mesh of two bodies, whose stiffness is given: involutes of standard height."""

    name: PartName | None = None
    bodies: tuple[Text, ...] = Field(min_length=2, max_length=2)
    teeth: tuple[Annotated[int, Field(strict=True, ge=4, le=10_000)], ...] = Field(min_length=2, max_length=2)
    module: Length
    pressure_angle: Angle
    face_width: FaceWidth
    profile_shift: tuple[Number, ...] = Field((0.0, 0.0), min_length=2, max_length=2)
    azimuth: Azimuth | None = None
    stiffness: Stiffness | None = None
    table: Annotated[fields.StiffnessCurve, csv_file("roll_angle", "stiffness")] | None = None
    damping_ratio: NotNegative
    backlash: Backlash | None = None
