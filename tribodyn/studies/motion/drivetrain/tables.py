"""Tables of a train: gears, stages, shafts; bodies, links and meshes of a bare model; bearings, duty."""

from math import pi
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from tribodyn.geometry.families import FAMILIES
from tribodyn.input import fields, quantity, units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import (
    Count,
    InUnit,
    NotNegative,
    Number,
    Table,
    Text,
    csv_file,
    written,
)
from tribodyn.input.tables.gears.model_files import (
    Angle,
    AsperityDensity,
    AsperitySlope,
    CentreDistance,
    CompositeRoughness,
    FaceWidth,
    FamilyKeys,
    Finish,
    Gear,
    HelixAngle,
    Inertia,
    Length,
    Mass,
    PressureAngle,
    Rack,
)
from tribodyn.input.tables.laws import LinkTable
from tribodyn.input.tables.supports.bearings import Stiffness
from tribodyn.train.planetary import CARRIER, RING, SUN

#: Stages, bodies, links, meshes and loads, each: as many as any train has.
MOST_PARTS = 100
#: The other end of a link that holds a body in the housing.
GROUND = "ground"

Backlash = Annotated[float, InUnit(units.not_negative(units.LENGTH), "0.1 mm")]
Azimuth = Annotated[float, InUnit(units.ANGLE_KIND, "30 deg")]
NotNegativeMass = Annotated[float, InUnit(units.not_negative(units.MASS))]
SpringStiffness = Annotated[float, InUnit(units.not_negative(units.STIFFNESS))]
Damping = Annotated[float, InUnit(units.not_negative(units.DAMPING))]


class TrainGear(Gear):
    """One gear of a train; what it does not say of material and flanks is said for all gears."""

    plane: Count | None = Field(
        None, description="axial plane; default: one for all gears that stages join, another for others"
    )
    tooth_angle: Azimuth = written(
        "0 deg", description="of one of its teeth from the mark of its shaft, counter-clockwise"
    )
    axial_position: Annotated[float, InUnit(units.LENGTH, "30 mm")] = written(
        "0 mm", description="of a helical train: z of the middle of its face from that of its shaft"
    )


class StageTeeth(Table):
    """What a drive file says of both gears of a mesh."""

    family: Annotated[Text, quantity.Names(FAMILIES)] = Field(
        "involute", description="family of the path of contact"
    )
    module: Length
    pressure_angle: PressureAngle = None
    helix_angle: HelixAngle = None
    centre_distance: CentreDistance = None
    backlash: Backlash | None = Field(
        None, description="normal backlash at the pitch point; default: that of [mesh], or of the teeth"
    )
    rack: Rack = None
    shape: FamilyKeys = None
    roughness: CompositeRoughness = None
    finish: Finish = None
    asperity_density: AsperityDensity = None
    asperity_slope: AsperitySlope = None
    damping_ratio: NotNegative | None = Field(None, description="default: that of [mesh]")


class Stage(StageTeeth):
    """Two gears that mesh; the pinion of a drive file is the gear that drives."""

    type: Literal["pair", "planetary"] = "pair"
    stiffness: Stiffness | None = Field(
        None, description="of a single pair of teeth; default: that of [mesh]"
    )
    name: PartName | None = Field(None, description="default: the names of its gears")
    gears: tuple[Text, ...] = Field(min_length=2, max_length=2, description="that mesh, in either order")
    azimuth: Azimuth | None = Field(
        None,
        description="direction from the first gear's axis to the second's, counter-clockwise from x; "
        "default: as the other stages leave it, else along x away from the input",
    )


class PlanetaryStage(StageTeeth):
    """Sun, planets and ring on one axis, and the carrier of the planets; one member of the set is held."""

    type: Literal["planetary"]
    name: PartName
    sun: Text = Field(description="gear")
    planet: Text = Field(description="gear, of which there are several")
    ring: Text = Field(description="internal gear")
    carrier: Text = Field(description="[[body]]")
    planets: Annotated[int, Field(strict=True, ge=1, le=12)] = Field(description="number of them")
    angles: tuple[Azimuth, ...] = Field(
        (), max_length=12, description="of the planets, counter-clockwise from x; default: evenly spaced"
    )
    held: Literal["sun", "ring", "carrier"] = Field(description="which member does not turn")
    support_stiffness: fields.TorsionalStiffness | None = Field(
        None, description="that holds it against rotation; default: 1e9 N/m on its pitch circle"
    )
    support_damping_ratio: NotNegative = Field(0.02, description="of this")
    floating: tuple[Literal["sun", "ring", "carrier"], ...] = Field(
        (), max_length=3, description="members that no bearing holds in x and y"
    )
    radial_pin_errors: tuple[Annotated[float, InUnit(units.LENGTH)], ...] = Field(
        (), max_length=12, description="of every planet's pin, outwards; default: none"
    )
    tangential_pin_errors: tuple[Annotated[float, InUnit(units.LENGTH)], ...] = Field(
        (), max_length=12, description="of every planet's pin, counter-clockwise; default: none"
    )
    sun_stiffness: Stiffness | None = Field(
        None, description="of a single pair of teeth of sun and planet; default: that of [mesh]"
    )
    ring_stiffness: Stiffness | None = Field(
        None, description="of a single pair of teeth of planet and ring; default: that of [mesh]"
    )
    frame_forces: bool = Field(True, description="Coriolis and centrifugal forces in the carrier's frame")

    @property
    def members(self) -> dict[str, str]:
        """Names of sun, ring and carrier by what they are."""
        return {SUN: self.sun, RING: self.ring, CARRIER: self.carrier}

    @property
    def placed(self) -> tuple[float, ...]:
        """Angles of the planets, rad."""
        return self.angles or tuple(2.0 * pi * i / self.planets for i in range(self.planets))


def _stage_type(stage: Any) -> str:
    """Which of both a [[stage]] is."""
    if isinstance(stage, dict):
        planetary = stage.get("type") == "planetary" or "planet" in stage
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
    inertia: Inertia = Field(description="polar")


class Link(LinkTable):
    """Springs and dampers between two bodies, or between a body and the housing."""

    name: PartName | None = Field(None, description="default: the names of its ends")
    ends: tuple[Text, ...] = Field(
        min_length=2, max_length=2, description=f'gears, shafts or bodies; "{GROUND}": the housing'
    )
    stiffness_x: SpringStiffness = written("0 N/m")
    stiffness_y: SpringStiffness = written("0 N/m")
    damping_x: Damping = written("0 N*s/m")
    damping_y: Damping = written("0 N*s/m")
    stiffness: fields.TorsionalStiffness | None = Field(
        None, description="torsional; bodies that it joins share an axis; default: none"
    )
    damping: fields.TorsionalDamping = written("0 N*m*s/rad", description="torsional")
    damping_ratio: NotNegative = Field(0.0, description="of every direction that has a stiffness, added")


class BareMesh(Table):
    """A mesh of two bodies, whose stiffness is given: involutes of standard height."""

    name: PartName | None = Field(None, description="default: the names of its bodies")
    bodies: tuple[Text, ...] = Field(min_length=2, max_length=2, description="in either order")
    teeth: tuple[Annotated[int, Field(strict=True, ge=4, le=10_000)], ...] = Field(
        min_length=2, max_length=2, description="of both, in the order of the bodies"
    )
    module: Length
    pressure_angle: Angle
    face_width: FaceWidth
    profile_shift: tuple[Number, ...] = Field(
        (0.0, 0.0), min_length=2, max_length=2, description="x of both, times the module"
    )
    azimuth: Azimuth | None = Field(
        None, description="direction from the first body's axis to the second's; default: as for a stage"
    )
    stiffness: Stiffness | None = Field(None, description="of a single pair of teeth")
    table: Annotated[fields.StiffnessCurve, csv_file("roll_angle", "stiffness")] | None = Field(
        None, description="in its place: over the driver's roll angle from the pitch point"
    )
    damping_ratio: NotNegative
    backlash: Backlash | None = Field(
        None, description="normal backlash at the pitch point; default: back flanks never touch"
    )
