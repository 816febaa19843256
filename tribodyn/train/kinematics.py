"""Speeds and senses of rotation of a train of external gears and planetary sets, in whole numbers.

A mesh turns its gears against each other, at speeds in the inverse ratio of their teeth. A coupling (a shaft,
rigid or compliant) turns its bodies alike. A planetary set of which one member is held turns the other two in
one ratio. Power flows outward from the input: of a mesh's two bodies the one that is fewer meshes away from
the input drives; in a set as its torques have it, from the sun or from the ring to the planets.

Mesh 0 of the result is the *reference mesh*, the first one that the input's power meets; body 0, the
*reference body*, drives it, or carries the planet that does. Speeds are given over that body's; turns are
measured in cycles of that mesh.
"""

from collections import deque
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.train.planetary import CARRIER, RING, SUN, SetTeeth, speeds, willis
from tribodyn.train.schedule import common_period


class Named(NamedTuple):
    """A body, or whatever else a message may have to name."""

    name: str
    key: str  # where it stands in the scenario, dotted


class Toothed(NamedTuple):
    """A gear on a body."""

    name: str
    key: str
    body: int
    teeth: int  # negative of an internal gear


class Joint(NamedTuple):
    """A mesh of two gears, or a coupling of two bodies, by their indices, in either order."""

    key: str
    ends: tuple[int, int]
    of_set: int = -1  # number of the planetary set that a mesh belongs to; -1: none


class SetMembers(NamedTuple):
    """A planetary set by its bodies."""

    key: str  # where it stands in the scenario, dotted
    members: dict[str, int]  # sun, ring, carrier
    planets: tuple[int, ...]
    teeth: SetTeeth
    held: str  # the member that does not turn

    def turning(self) -> tuple[str, str]:
        """The two members that turn."""
        first, second = (name for name in self.members if name != self.held)
        return first, second


class Turning(NamedTuple):
    """A body as it was reached."""

    speed: Fraction  # over the input's
    sense: int
    away: int  # meshes between it and the input

    @property
    def signed(self) -> Fraction:
        """Speed, counter-clockwise positive."""
        return self.speed * self.sense


#: Away from the input by more meshes than any train has: what it does not turn.
HELD = 1_000_000


def driving_in_set(
    gears: Sequence[Toothed], mesh: Joint, members: SetMembers, drives: str
) -> tuple[int, int]:
    """Driving and driven gear of a set's mesh, where the sun or the ring `drives` the planets."""
    one, two = mesh.ends
    central, planet = (two, one) if gears[one].body in members.planets else (one, two)
    is_driver = gears[central].body == members.members[drives]
    return (central, planet) if is_driver else (planet, central)


def turn_set(bodies: Sequence[Named], gearset: SetMembers, turning_of: dict[int, Turning]) -> str:
    """Add a set's held member and planets to what turns; returns which of sun and ring drives the planets."""
    held = gearset.members[gearset.held]
    if held in turning_of and turning_of[held].speed:
        rule = f"{bodies[held].name} is held, and other stages or shafts turn it"
        raise InputError(f"{gearset.key}.held", gearset.held, rule, "hold another member, or part the two")
    members = [gearset.members[name] for name in gearset.turning() if gearset.members[name] in turning_of]
    if len(members) < 2:
        names = " nor ".join(bodies[gearset.members[name]].name for name in gearset.turning())
        rule = f"the input turns neither {names} of this planetary stage"
        remedy = "add the [[stage]], [[shaft]] or [[link]] that turns one of them"
        raise InputError(gearset.key, None, rule, remedy)
    driving = min(gearset.turning(), key=lambda name: turning_of[gearset.members[name]].away)
    turning = turning_of[gearset.members[driving]]
    each = {
        name: speed * turning.signed for name, speed in speeds(gearset.teeth, gearset.held, driving).items()
    }
    for name, speed in each.items():
        for body in gearset.planets if name == "planet" else (gearset.members[name],):
            rolling = speed if name == CARRIER else speed - each[CARRIER]
            way = -1 if rolling < 0 else 1
            if body == held and body in turning_of and turning_of[body].sense != way:
                rule = f"{bodies[body].name} is held in two stages whose planets roll in opposite senses"
                raise InputError(
                    f"{gearset.key}.held", gearset.held, rule, "name two gears, one in each stage"
                )
            if name == "planet" or body == held:
                turning_of[body] = Turning(abs(speed), way, turning.away + 1 if body != held else HELD)
    enters = willis(gearset.teeth)[SUN] * (each[SUN] - each[CARRIER]) / willis(gearset.teeth)[driving]
    return SUN if enters * turning.sense > 0 else RING


class TrainSpeeds(NamedTuple):
    """Motion of a train; indices are those given but for `driver` and `driven`.

    Turns and rates count cycles of the reference mesh.
    """

    bodies: tuple[int, ...]  # in their new order: the reference body first, the others as given
    meshes: tuple[int, ...]  # in their new order: the reference mesh first, the others as given
    input: int  # new index of the body at which power enters
    ratio: tuple[Fraction, ...]  # of each body in the new order: |speed| over the reference body's
    #: likewise: +1 counter-clockwise seen from +z, −1 clockwise; of gears of a set as they turn against its
    #: carrier
    sense: tuple[int, ...]
    #: driver, driven: new indices of the bodies of each mesh in the new order
    driver: tuple[int, ...]
    driven: tuple[int, ...]
    gears: tuple[tuple[int, int], ...]  # driving and driven gear of each mesh in the new order
    rate: tuple[Fraction, ...]  # cycles of each mesh, in the new order, per cycle of the reference mesh
    period: int  # fewest reference cycles after which every mesh is at the phase it began at
    carrier: tuple[int, ...]  # new index of the body that carries each mesh; -1: the housing

    def carried(self, body: int, carrier: int) -> Fraction:
        """Speed of a carrier (new index) over the reference's in the sense of a body; of -1 nothing."""
        if carrier < 0:
            return Fraction(0)
        return self.ratio[carrier] * self.sense[carrier] * self.sense[body]


def kinematics(
    bodies: Sequence[Named],
    gears: Sequence[Toothed],
    meshes: Sequence[Joint],
    couplings: Sequence[Joint],
    source: int,
    sense: int,
    sets: Sequence[SetMembers] = (),
) -> TrainSpeeds:
    """Work out which end of each mesh drives, and how fast and which way every body turns.

    `source` is the body at which power enters, `sense` its sense of rotation (+1: counter-clockwise seen from
    +z). Raises InputError for a gear without a mesh, a mesh of gears that turn together, loops whose ratios
    or senses contradict each other, bodies that the input does not turn, and a train without a mesh.
    """
    _refuse_idle_gears(gears, meshes)
    joints = [_by_bodies(gears, mesh) for mesh in meshes]
    turning_of = _spread(len(bodies), gears, meshes, joints, couplings, source, sense, sets)
    drives = [turn_set(bodies, one, turning_of) for one in sets]
    _refuse_unreached(bodies, gears, turning_of)
    for place, mesh in enumerate(meshes):
        if mesh.of_set < 0:
            _check_mesh(bodies, gears, mesh, joints[place], turning_of)
    for coupling in couplings:
        _check_coupling(bodies, coupling, turning_of)

    driving = [
        _driving(gears, mesh, turning_of)
        if mesh.of_set < 0
        else driving_in_set(gears, mesh, sets[mesh.of_set], drives[mesh.of_set])
        for mesh in meshes
    ]
    away = [min(turning_of[end].away for end in joint) for joint in joints]
    turning = [place for place, (driver, _) in enumerate(driving) if turning_of[gears[driver].body].speed]
    reference = min(turning, key=lambda m: (away[m], m))
    order = (reference, *(place for place in range(len(meshes)) if place != reference))
    carrier = [sets[mesh.of_set].members[CARRIER] if mesh.of_set >= 0 else -1 for mesh in meshes]
    driving, carrier = [driving[place] for place in order], [carrier[place] for place in order]
    first = gears[driving[0][0]].body
    if carrier[0] >= 0 and first in sets[meshes[reference].of_set].planets and turning_of[carrier[0]].speed:
        first = carrier[0]
    numbers = (first, *(body for body in range(len(bodies)) if body != first))
    new = {body: index for index, body in enumerate(numbers)} | {-1: -1}
    scale = turning_of[first].speed
    ratio = tuple(turning_of[body].speed / scale for body in numbers)
    cycles = [
        abs(gears[driver].teeth)
        * abs(turning_of[gears[driver].body].signed - (turning_of[by].signed if by >= 0 else 0))
        for (driver, _), by in zip(driving, carrier, strict=True)
    ]
    rate = tuple(each / cycles[0] for each in cycles)
    return TrainSpeeds(
        bodies=numbers,
        meshes=order,
        input=new[source],
        ratio=ratio,
        sense=tuple(turning_of[body].sense for body in numbers),
        driver=tuple(new[gears[driver].body] for driver, _ in driving),
        driven=tuple(new[gears[driven].body] for _, driven in driving),
        gears=tuple(driving),
        rate=rate,
        period=common_period(rate),
        carrier=tuple(new[by] for by in carrier),
    )


def _driving(gears: Sequence[Toothed], mesh: Joint, turning: dict[int, Turning]) -> tuple[int, int]:
    """Driving and driven gear of a mesh in the housing."""
    one, two = mesh.ends
    return (one, two) if turning[gears[one].body].away < turning[gears[two].body].away else (two, one)


def _by_bodies(gears: Sequence[Toothed], mesh: Joint) -> tuple[int, int]:
    one, two = (gears[end].body for end in mesh.ends)
    if one == two:
        names = " and ".join(gears[end].name for end in mesh.ends)
        raise InputError(mesh.key, None, f"{names} turn together and cannot mesh", "mesh gears of two shafts")
    return one, two


def _refuse_idle_gears(gears: Sequence[Toothed], meshes: Sequence[Joint]) -> None:
    if not meshes:
        remedy = 'add a [[stage]] with gears = ["pinion", "wheel"]'
        raise InputError("stage", None, "missing: a train has a mesh at least", remedy)
    meshing = {end for mesh in meshes for end in mesh.ends}
    for place, gear in enumerate(gears):
        if place not in meshing:
            remedy = "name it in a [[stage]], or leave it out"
            raise InputError(gear.key, None, "meshes with no other gear", remedy)


def _spread(
    count: int,
    gears: Sequence[Toothed],
    meshes: Sequence[Joint],
    joints: Sequence[tuple[int, int]],
    couplings: Iterable[Joint],
    source: int,
    sense: int,
    sets: Sequence[SetMembers],
) -> dict[int, Turning]:
    """Go outward from the input, over couplings first, so that every body is reached by fewest meshes."""
    coupled: list[list[int]] = [[] for _ in range(count)]
    for coupling in couplings:
        one, two = coupling.ends
        coupled[one].append(two)
        coupled[two].append(one)
    # bodies that a mesh or a set turns, and by how much, < 0: the other way
    meshing: list[list[tuple[int, Fraction]]] = [[] for _ in range(count)]
    for mesh, (one, two) in zip(meshes, joints, strict=True):
        if mesh.of_set < 0:
            ratio = Fraction(-gears[mesh.ends[0]].teeth, gears[mesh.ends[1]].teeth)
            meshing[one].append((two, ratio))
            meshing[two].append((one, 1 / ratio))
    for gearset in sets:
        one, two = gearset.turning()
        ratio = speeds(gearset.teeth, gearset.held, one)[two]
        meshing[gearset.members[one]].append((gearset.members[two], ratio))
        meshing[gearset.members[two]].append((gearset.members[one], 1 / ratio))
    turning = {source: Turning(Fraction(1), sense, 0)}
    waiting = deque([source])
    done: set[int] = set()
    while waiting:
        body = waiting.popleft()
        if body in done:
            continue
        done.add(body)
        speed, way, away = turning[body]
        for other in coupled[body]:
            if other not in turning or turning[other].away > away:
                turning[other] = Turning(speed, way, away)
                waiting.appendleft(other)
        for other, ratio in meshing[body]:
            if other not in turning:
                turning[other] = Turning(speed * abs(ratio), way if ratio > 0 else -way, away + 1)
                waiting.append(other)
    return turning


def _refuse_unreached(bodies: Sequence[Named], gears: Sequence[Toothed], turning: dict[int, Turning]) -> None:
    for place, body in enumerate(bodies):
        if place in turning:
            continue
        gear = next((gear for gear in gears if gear.body == place), None)
        key = body.key if gear is None else gear.key
        rule = "is not connected to the input by meshes and shafts"
        raise InputError(key, None, rule, "add the [[stage]] or [[shaft]] that turns it, or leave it out")


def _check_mesh(
    bodies: Sequence[Named],
    gears: Sequence[Toothed],
    mesh: Joint,
    joint: tuple[int, int],
    turning: dict[int, Turning],
) -> None:
    one, two = (turning[body] for body in joint)
    names = [bodies[body].name for body in joint]
    external = gears[mesh.ends[0]].teeth * gears[mesh.ends[1]].teeth > 0
    if (one.sense == two.sense) is external:
        rule = f"closes a loop in which {names[0]} and {names[1]} turn the same way, and cannot mesh"
        remedy = "a loop of external gears needs an even number of meshes"
        raise InputError(mesh.key, None, rule, remedy)
    by_mesh = one.speed * abs(Fraction(gears[mesh.ends[0]].teeth, gears[mesh.ends[1]].teeth))
    if by_mesh != two.speed:
        rule = (
            f"closes a loop whose ratios contradict each other: by this mesh {names[1]} turns at {by_mesh} "
            f"of the input's speed, by the others at {two.speed}"
        )
        raise InputError(mesh.key, None, rule, "change numbers of teeth, or open the loop")


def _check_coupling(bodies: Sequence[Named], coupling: Joint, turning_of: dict[int, Turning]) -> None:
    one, two = (turning_of[body] for body in coupling.ends)
    names = [bodies[body].name for body in coupling.ends]
    if one.sense != two.sense or one.speed != two.speed:
        speeds = [f"{turning.sense * turning.speed}" for turning in (one, two)]
        rule = (
            f"closes a loop whose ratios contradict each other: {names[0]} and {names[1]} turn at "
            f"{speeds[0]} and {speeds[1]} of the input's speed"
        )
        raise InputError(coupling.key, None, rule, "change numbers of teeth, or open the loop")
