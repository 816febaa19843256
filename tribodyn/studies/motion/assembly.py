"""A train's pairs put together: assemblies and tables, one for equal meshes; masses, phases, damping.

`PreparedGearbox` is what comes of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.dynamics.data import matrices_in_space, spring_damping
from tribodyn.errors import InputError
from tribodyn.gears.bearings_in_time import cages_turn
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.model import resting_slopes, tilting_inertia
from tribodyn.gears.prepare import Thermal, assembled
from tribodyn.gears.tabulated import Tabulated, table_key
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import mass_and_inertia
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import (
    HOUSING,
    BodyData,
    ClutchData,
    Gearbox,
    LinkData,
    LoadData,
    refuse_long_period,
)
from tribodyn.studies.motion.drivetrain.teeth import engagement
from tribodyn.train.clutches import Clutches, common_knots
from tribodyn.train.phases import Engagement, Phases, nominal_phases

#: Share of the nominal speed at which a run from rest starts: time over rotation has no slope at rest.
CREEP = 1e-4


class BodyInertia(NamedTuple):
    """Mass (kg) and moments of inertia (kg m²) of a body, with everything that is fixed to it."""

    mass: float
    inertia: float  # polar
    #: about a diameter; shafts and other bodies as thin discs in the middle, without what drives and loads
    tilting: float = 0.0


@dataclass(frozen=True)
class PreparedGearbox:
    """A case made ready to integrate; bodies of the model in its own order."""

    case: Gearbox
    model: parameters.Model
    tables: tuple[Tabulated, ...]  # of every mesh; equal meshes share one
    warm_pairs: tuple[LubricatedCase, ...]  # of every mesh, with the oil at its teeth's temperature
    thermal: tuple[Thermal | None, ...]
    phases: Phases  # of the teeth without load
    order: tuple[int, ...]  # bodies of the case as the model has them; behind these the motor
    inertias: tuple[BodyInertia, ...]  # of the case's bodies
    twist: Float[Array, " mesh"]  # cycles by which the load brings every mesh further, `static_twist`
    near: Float[Array, "place state"] | None = None  # static equilibria, or near those, where they are known

    @property
    def cycle(self) -> MeshCycle:
        """The mesh cycle of the first mesh."""
        return self.tables[0].cycle

    @property
    def assembly(self) -> Assembly:
        """The gears of the first mesh, put together."""
        return self.tables[0].assembly

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the model's bodies."""
        names = tuple(self.case.bodies[body].name for body in self.order)
        return names if len(names) == self.model.layout.bodies else (*names, "motor")

    @property
    def bodies(self) -> tuple[BodyData, ...]:
        """Bodies of the case as the model has them; a motor stands and turns as what it drives."""
        bodies = tuple(self.case.bodies[body] for body in self.order)
        motor = self.case.bodies[self.case.source.body]
        return bodies if len(bodies) == self.model.layout.bodies else (*bodies, motor)


def table_numbers(case: Gearbox) -> tuple[int, ...]:
    """Number of the table of every mesh: equal meshes share one; the first mesh's is 0."""
    numbers: dict[object, int] = {}
    return tuple(numbers.setdefault(table_key(mesh.pair), len(numbers)) for mesh in case.meshes)


def assemblies(case: Gearbox) -> tuple[Assembly, ...]:
    """The pair of every mesh put together, its pinion the driver; meshes with one table share it.

    Raises InputError, in the terms of a drive file, where teeth cannot be made; the rules of a scenario have
    found that before.
    """
    numbers = table_numbers(case)
    by_number: dict[int, Assembly] = {}
    for number, mesh in zip(numbers, case.meshes, strict=True):
        if number not in by_number:
            by_number[number] = assembled(mesh.pair)
    return tuple(by_number[number] for number in numbers)


def body_inertias(case: Gearbox, pairs: Sequence[Assembly]) -> tuple[BodyInertia, ...]:
    """Mass and inertia of every body; those of a gear that gives none follow from its outline and bore."""
    inertias = []
    for number, body in enumerate(case.bodies):
        mass, inertia, tilting = body.mass, body.inertia, (body.inertia - body.attached) / 2.0
        inertia += case.system.inertia_of(number) if case.system is not None else 0.0
        for gear in (case.gears[number] for number in body.gears):
            mass_of_gear, turned = gear.stated.mass, gear.stated.inertia
            if mass_of_gear is None or turned is None:
                mesh, side = gear.meshes[0]
                computed = mass_and_inertia(pairs[mesh], side, gear.density)
                mass_of_gear = computed[0] if mass_of_gear is None else mass_of_gear
                turned = computed[1] if turned is None else turned
            mass, inertia = mass + float(mass_of_gear), inertia + float(turned)
            tilting += tilting_inertia(float(mass_of_gear), float(turned), gear.face_width)
            tilting += float(mass_of_gear) * gear.axial_position**2
        inertias.append(BodyInertia(mass, inertia, tilting))
    return tuple(inertias)


def phases(case: Gearbox, pairs: Sequence[Assembly], entries: Sequence[float] | None = None) -> Phases:
    """Phase of every mesh while the reference mesh begins its cycle, and where the teeth of all gears stand.

    `entries` are the pinions' angles at which the meshes' cycles begin, `roll_start` of their tables; None:
    where their paths of contact begin. Raises InputError where the teeth of a loop do not meet.
    """
    return nominal_phases(case.toothed_shafts, engagements(case, pairs, entries))


def engagements(
    case: Gearbox, pairs: Sequence[Assembly], entries: Sequence[float] | None = None
) -> list[Engagement]:
    """How the teeth of every mesh touch; `entries` as of `phases`."""
    return [
        engagement(mesh.key, mesh.gears, mesh.azimuth, pair, entry)
        for mesh, pair, entry in zip(case.meshes, pairs, entries or [None] * len(pairs), strict=True)
    ]


def link_damping(link: LinkData, bodies: Sequence[BodyInertia]) -> tuple[float, float, float]:
    """Damping of a link in x, y (N s/m) and rotation (N m s/rad): what is given, and 2 ζ √(k m).

    m is the mass of the body, or of two against each other, m_1 m_2/(m_1 + m_2); in rotation the inertia.
    """
    ends = [bodies[body] for body in link.ends if body != HOUSING]
    moved = [(one.mass, one.mass, one.inertia) for one in ends]
    x, y, rotation = map(spring_damping, link.damping, link.damping_ratio, link.stiffness, *moved)
    return x, y, rotation


def in_space_of(
    link: LinkData, damping: tuple[float, float, float], bodies: Sequence[BodyInertia], width: float
) -> tuple[Float[Array, "5 5"], Float[Array, "5 5"]]:
    """Stiffness and damping of a link in x, y, z and tilts; of one that is no bearing in x and y alone.

    `damping` is that in x and y, `width` of the faces of the bearing's body, m.
    """
    if link.bearing is None:
        nothing = [0.0, 0.0, 0.0]
        return np.diag([*link.stiffness[:2], *nothing]), np.diag([*damping[:2], *nothing])
    body = bodies[link.ends[0]]
    return matrices_in_space(link.bearing, width, body.mass, body.tilting)


def loads_in_own_sense(case: Gearbox) -> list[LoadData]:
    """The loads with torques against the sense of their bodies, of which some turn the other way."""
    return [
        replace(
            load,
            torque=-load.torque,
            table=load.table and (load.table[0], -np.asarray(load.table[1])),
            harmonics=tuple((-amplitude, *rest) for amplitude, *rest in load.harmonics),
        )
        if case.bodies[load.body].ratio < 0
        else load
        for load in case.loads
    ]


def teeth_differ(case: Gearbox) -> bool:
    """Whether teeth of one gear differ, so that no mesh cycle is like the one before."""
    return any(any(pair.teeth) for pair in case.pairs)


def settles(case: Gearbox) -> bool:
    """Whether what moves a case repeats with its meshes: no load or cage has a period of its own."""
    varying = any(load.table or load.harmonics for load in case.loads)
    return not (case.in_time or varying or teeth_differ(case) or cages_turn(case.system))


def varying_of(case: Gearbox) -> LoadData:
    """The load that varies over time, or the first one."""
    loads = loads_in_own_sense(case)
    varying = [number for number, load in enumerate(loads) if load.table or load.harmonics]
    if len(varying) > 1:
        rule = "two loads vary over time"
        raise InputError(f"load.{varying[1]}.torque_table", None, rule, "let one of them be constant")
    return loads[varying[0] if varying else 0] if loads else LoadData(0, 0.0)


def clutches_of(clutches: Sequence[ClutchData]) -> Clutches:
    """Numbers of clutches and brakes as the equations of motion read them."""
    if not clutches:
        return Clutches()
    curves = [(*one.capacity, resting_slopes(*one.capacity)) for one in clutches]
    numbers = [
        (
            one.static_ratio - 1.0,
            one.static_speed,
            one.reversal_speed,
            np.nan if one.slip is None else one.slip,
        )
        for one in clutches
    ]
    return Clutches(*common_knots(curves), *np.ascontiguousarray(np.array(numbers).T))


def start_slip_of(case: Gearbox) -> float:
    """Speed of the input at the start less the nominal one, rad/s.

    From rest a run by rotation starts at `CREEP` of that, one by time at 0.
    """
    source, least = case.source, 0.0 if case.in_time else CREEP
    start = source.speed if source.start_speed is None else max(source.start_speed, least * source.speed)
    return start - source.speed


def refuse_in_time(case: Gearbox) -> None:
    """Raise InputError where a gearbox cannot be run by time."""
    refuse_long_period(case)
    own = [mesh.name for mesh in case.meshes if any(mesh.pair.teeth)]
    if len(case.meshes) > 1 and own:
        rule = (
            "a motion by time may come to any teeth, and those of several meshes that differ repeat too late"
        )
        remedy = (
            "leave out what single teeth have of their own; a run may have solver.cycles, no solver.duration"
        )
        raise InputError("mesh", own[0], rule, remedy)
    for one in case.sets:
        if one.frame_forces:
            rule = "counts the forces of the nominal speed, and in a motion by time the gears may stand"
            raise InputError(f"{one.key}.frame_forces", True, rule, "set it to false")
