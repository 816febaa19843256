"""A gearbox, the case of the dynamics of gears: everything one simulation needs to know, in SI units.

Bodies and meshes are numbered from the reference ones: body 0 drives mesh 0. A body's rotation, speed and
torque count positive in its own sense of rotation; x, y are the train's, seen from +z.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from tribodyn.cases.results import CaseHead
from tribodyn.dynamics.data import BearingData
from tribodyn.errors import InputError
from tribodyn.gears.case import ROUNDED, LubricatedCase, OutputData, rounded_in
from tribodyn.gears.drawn_system import DrawnSystem
from tribodyn.gears.supports import GearSupport
from tribodyn.geometry.drive import BodyMass, Side
from tribodyn.numerics.curve import Table
from tribodyn.sensing.data import HousingData, SensorData
from tribodyn.solve.methods import SolverData
from tribodyn.train.elastic.ring import RimData
from tribodyn.train.links.law import LAW as LINEAR_LINK
from tribodyn.train.links.law import LinkLaw
from tribodyn.train.phases import ToothedShaft
from tribodyn.train.planetary import IN_PAIRS, SetTeeth
from tribodyn.tribology.heat.data import GearboxHeatData
from tribodyn.tribology.law import FilmData, FrictionData

#: As an end of a link: the housing.
HOUSING = -1


@dataclass(frozen=True)
class GearData:
    """A gear of the train."""

    name: str
    key: str  # where it stands in the scenario, dotted
    body: int
    shaft: int  # number of its shaft: bodies that couplings join have one
    teeth: int  # negative of an internal gear
    plane: int  # gears in the same plane need room beside each other
    tooth_angle: float  # of one of its teeth from the shaft's mark, counter-clockwise, rad
    stated: BodyMass  # its mass and inertia, as far as the scenario states them
    density: float  # of its material, kg/m³
    #: meshes that it belongs to, and what it is in the pair of each: "pinion" drives
    meshes: tuple[tuple[int, Side], ...]
    face_width: float = 0.0  # m
    axial_position: float = 0.0  # z of the middle of its face from its body's centre, m
    places: int = 1  # see `train.phases.ToothedShaft`


@dataclass(frozen=True)
class BodyData:
    """A body of the train."""

    name: str
    key: str
    gears: tuple[int, ...]
    #: mass, inertia: beside its gears', kg and kg m²: of shafts, toothless bodies, what is joined rigidly
    mass: float
    inertia: float
    ratio: Fraction  # |speed| over the reference body's
    sense: int  # +1 counter-clockwise seen from +z, −1 clockwise
    centre: tuple[float, float]  # m; the reference body's is the origin
    attached: float = 0.0  # share of `inertia` that the body drives or is driven by, kg m²
    floating: bool = False  # whether it moves in the plane without a bearing


@dataclass(frozen=True)
class LinkData:
    """Springs and dampers between two bodies, or a body and the housing; directions x, y and rotation.

    Rotation acts on the difference of both bodies' micro-rotations, each in its own sense; ends that a
    torsional spring joins have one sense and one speed. Damping is what is given plus that of the ratio,
    2 ζ √(k m), with m the mass of the body, or of two against each other, m_1 m_2/(m_1 + m_2), or inertia.
    """

    name: str
    key: str
    ends: tuple[int, int]  # the second may be `HOUSING`
    stiffness: tuple[float, float, float]  # N/m, N/m, N m/rad
    damping: tuple[float, float, float]  # N s/m, N s/m, N m s/rad
    damping_ratio: tuple[float, float, float]
    law: LinkLaw = LINEAR_LINK  # of its rotation
    values: Mapping[str, Any] = field(default_factory=dict)  # of the law's own keys, in SI units
    bearing: BearingData | None = None  # that the link is, for bodies that move in space
    #: lever, offset: of a planet's pin, see `train.structure.Links`: lever of the carrier, m/rad; m
    lever: tuple[float, float] | None = None
    offset: tuple[float, float] = (0.0, 0.0)
    #: whether it holds the first end at its nominal speed: 0, or `train.structure.DRIVES`, or `BRAKES`
    holds: int = 0

    @classmethod
    def of_bearing(
        cls, name: str, key: str, ends: tuple[int, int], data: BearingData, **more: Any
    ) -> "LinkData":
        """A bearing, or a planet's pin: its springs in the plane, and what `more` says."""
        stiffness = data.stiffness_x, data.stiffness_y, 0.0
        damping_ratio = data.damping_ratio_x, data.damping_ratio_y, 0.0
        return cls(name, key, ends, stiffness, (0.0, 0.0, 0.0), damping_ratio, **more)


@dataclass(frozen=True)
class ClutchData:
    """A clutch between two bodies, or a brake on one: capacity over time, and friction over slip speed."""

    name: str
    key: str
    ends: tuple[int, int]  # the second may be `HOUSING`
    capacity: Table  # torque while it slips over time (s, N m), constant before and after its points
    static_ratio: float = 1.0  # of the torque at rest over that
    static_speed: float = 1.0  # slip speed over which it falls off, rad/s
    reversal_speed: float = 0.1  # slip speed over which the friction reverses, rad/s
    slip: float | None = (
        None  # at the start, of the first end over the second, rad/s; None: see `train.clutches`
    )


@dataclass(frozen=True)
class TrainMesh:
    """A mesh of the train: where it is, and the pair of gears in it."""

    name: str
    key: str
    #: driver, driven: bodies; the driver's driving flanks push while power flows from the input
    driver: int
    driven: int
    gears: tuple[int, int]  # driving and driven gear
    azimuth: float  # of the driven axis as seen from the driver's, counter-clockwise from x, rad
    rate: Fraction  # cycles per cycle of the reference mesh
    #: its gears as a pair whose pinion is the driver, at the nominal speed of that and the nominal torque of
    #: the driven gear
    pair: LubricatedCase
    carrier: int = -1  # body that carries it; -1: the housing


@dataclass(frozen=True)
class SetData:
    """A planetary set by its bodies."""

    name: str
    key: str
    members: Mapping[str, int]  # suns, ring, carrier
    planets: tuple[int, ...]  # those that mesh with the sun first, those that do with the ring last
    angles: tuple[float, ...]  # of the planets, counter-clockwise from x, rad
    teeth: SetTeeth
    held: str  # the member that does not turn; "": all turn
    frame_forces: bool  # whether Coriolis and centrifugal forces are counted
    in_space: bool = False  # whether its teeth are helical: its bodies then move in space
    rim: RimData | None = None  # of the ring; None: it does not bend
    carrier: Any = None  # a `planetary.carriers.CarrierData`; None: it does not give

    @property
    def arms(self) -> int:
        """Number of planets that every member meets."""
        return len(self.planets) // (2 if self.teeth.kind in IN_PAIRS else 1)

    @property
    def bodies(self) -> tuple[int, ...]:
        """All of its bodies, the members first."""
        return (*self.members.values(), *self.planets)


@dataclass(frozen=True)
class LoadData:
    """What a body drives."""

    body: int
    torque: float  # against its motion, N m
    damping: float = 0.0  # torque per speed above nominal, N m s/rad
    table: Table | None = None  # torque over time (s, N m), added; constant before and after its points
    #: (amplitude N m, angular frequency rad/s, phase rad) of cosines that are added
    harmonics: tuple[tuple[float, float, float], ...] = ()


@dataclass(frozen=True)
class SourceData:
    """How the train is driven."""

    kind: str  # "speed": the rotation of `body` is prescribed; "torque": a motor with inertia
    body: int
    speed: float  # nominal, of `body` and of the reference body, rad/s
    torque: float  # of the motor at nominal speed, N m; not given: it balances the loads without losses
    inertia: float = 0.0  # of the motor, kg m²; without a `shaft_stiffness` it is in the body's own
    shaft_stiffness: float | None = None  # between motor and body, N m/rad; None: rigid
    shaft_damping: float = 0.0  # N m s/rad
    speed_regulation: float = 0.0  # fall of the torque per speed above nominal, N m s/rad
    start_speed: float | None = None  # of `body` at the start, rad/s; None: nominal
    curve: Table | None = None  # its torque over the speed of `body` (rad/s, N m), in place of both

    @classmethod
    def of(cls, operating: Any, body: int, speed: float, torque: float) -> "SourceData":
        """By what a table [operating] says of the drive."""
        curve = operating.torque_speed_curve
        return cls(
            operating.source,
            body,
            speed,
            torque,
            operating.drive_inertia,
            operating.shaft_stiffness,
            operating.shaft_damping,
            operating.speed_regulation,
            operating.start_speed,
            curve.in_si() if curve else None,
        )


@dataclass(frozen=True, kw_only=True)
class Gearbox(CaseHead):
    """One simulation of a gearbox, complete: a pair of gears, a train, planetary sets."""

    gears: tuple[GearData, ...]
    bodies: tuple[BodyData, ...]
    links: tuple[LinkData, ...]  # bearings first, one for every body that has one
    meshes: tuple[TrainMesh, ...]
    source: SourceData
    loads: tuple[LoadData, ...]
    period: int  # cycles of the reference mesh after which all meshes are at their phases again
    max_period: int  # of which steady states are looked for, at most
    solver: SolverData
    output: OutputData
    sets: tuple[SetData, ...] = ()
    clutches: tuple[ClutchData, ...] = ()
    supports: Mapping[int, GearSupport] = field(default_factory=dict)  # drawn shafts and matrices, by body
    system: DrawnSystem | None = None  # shafts drawn with all that they carry, which then have no links
    sensors: tuple[SensorData, ...] = ()
    housing: HousingData = field(default_factory=HousingData)  # that they sit on
    heat: GearboxHeatData | None = None  # of the whole gearbox; None: not asked for
    #: whether its file names the meshes: then a record has a dimension over them; else there is one mesh
    named: bool = True

    @property
    def pair(self) -> LubricatedCase:
        """The pair of gears in the first mesh."""
        return self.meshes[0].pair

    @property
    def pairs(self) -> tuple[LubricatedCase, ...]:
        """The pair of gears in every mesh."""
        return tuple(mesh.pair for mesh in self.meshes)

    @property
    def film(self) -> FilmData:
        """The film law, one in all meshes."""
        return self.meshes[0].pair.film

    @property
    def friction(self) -> FrictionData:
        """The friction law, one in all meshes."""
        return self.meshes[0].pair.friction

    @property
    def bearings(self) -> tuple[BearingData, ...]:
        """The bearings of all bodies that have some, and planets' pins."""
        return tuple(link.bearing for link in self.links if link.bearing is not None)

    def with_pair(self, **fields: Any) -> "Gearbox":
        """The gearbox with other fields of the pair in every mesh: its mesh, laws, oil, temperatures.

        Speed, load, teeth and masses stand in `source`, `loads`, `gears` too, and are not changed there.
        """
        meshes = tuple(replace(mesh, pair=replace(mesh.pair, **fields)) for mesh in self.meshes)
        return replace(self, meshes=meshes)

    def under_laws(self, **laws: Any) -> "Gearbox":
        """The gearbox with other laws, arguments as of `tribology.closure.with_laws`."""
        from tribodyn.tribology.closure import with_laws  # the registries of all laws

        return replace(
            self, meshes=tuple(replace(mesh, pair=with_laws(mesh.pair, **laws)) for mesh in self.meshes)
        )

    @property
    def is_pair(self) -> bool:
        """Whether all power passes one mesh: two gears on bearings, of which one drives, one bears a load."""
        first, loaded = self.meshes[0], [load.body for load in self.loads]
        alone = len(self.meshes) == 1 and len(self.bodies) == 2 and self.source.body == first.driver
        alone = alone and not self.clutches
        return alone and loaded == [first.driven] and all(HOUSING in link.ends for link in self.links)

    @property
    def tilts(self) -> bool:
        """Whether bodies outside sets that bearings hold move in space: slices are inclined, matrices couple.

        Helical teeth are cut into slices, and spur teeth where a scenario says so.
        """
        matrices = any(link.bearing is not None and link.bearing.matrix is not None for link in self.links)
        if matrices or self.system is not None:
            return True
        return any(float(pair.drive.helix_angle) != 0.0 or pair.mesh.slices > 1 for pair in self.pairs)

    @property
    def laid_out(self) -> int:
        """Reference cycles of which is laid out when contacts change: the common period, or a run and one."""
        whole = self.period <= self.max_period
        return self.period if whole or self.in_time else min(self.period, self.solver.cycles + 1)

    @property
    def in_time(self) -> bool:
        """Whether it is run by time: then its gears may stand and turn back."""
        return self.solver.duration is not None

    def without_run(self) -> dict[str, float]:
        """As of a pair of gears, where there is one."""
        return {} if self.named else self.pair.without_run()

    def remarks_in_brief(self) -> list[str]:
        """As of a pair of gears."""
        return [ROUNDED] if rounded_in(self.toml) else []

    def chosen(self) -> dict[str, tuple[str, str]]:
        """Laws selected by "auto", those of the reference mesh for all."""
        return self.meshes[0].pair.chosen()

    def laws(self) -> dict[str, Any]:
        """As of a pair; one film and one friction law hold in the whole train."""
        return self.meshes[0].pair.laws()

    @property
    def toothed_shafts(self) -> tuple[ToothedShaft, ...]:
        """The gears as `train.phases` puts them together."""
        return tuple(
            ToothedShaft(
                gear.name, gear.shaft, gear.teeth, self.bodies[gear.body].sense, gear.tooth_angle, gear.places
            )
            for gear in self.gears
        )


def refuse_long_period(case: Gearbox) -> None:
    """Raise InputError where a steady state, or what a run by time may pass, is longer than is allowed."""
    if case.period > case.max_period:
        mesh = case.meshes[0]
        rule = f"the meshes are at their phases again after {case.period} cycles of the mesh {mesh.name}"
        remedy = f"allow max_period = {case.period}, "
        remedy += "or give gears of one shaft numbers of teeth with a divisor"
        raise InputError("solver.max_period", case.max_period, rule, remedy)
