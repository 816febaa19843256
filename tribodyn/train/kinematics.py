"""Speeds and senses of rotation of a train of gears and epicyclic sets, in whole numbers; which gear drives.

Speeds solve one linear system, see `willis`. Power flows outward from the input: of the two bodies of a mesh
in the housing the one that is fewer meshes away from the input drives. In a set the torques say it: that gear
drives by which power goes into the mesh, in rotation against the carrier.

Mesh 0 of the result is the *reference mesh*, the first one that the input's power meets; body 0, the
*reference body*, drives it, or carries the planet that does, or is the input. Speeds are given over that
body's; turns are measured in cycles of that mesh.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.train.joints import GivenSpeed, Joint, Named, SetMembers, Toothed, distances, joined, rows_of
from tribodyn.train.schedule import common_period
from tribodyn.train.willis import Equation, Speeds, reactions, solve


class TrainSpeeds(NamedTuple):
    """Motion of a train; indices are those given but for `driver` and `driven`.

    Turns and rates count cycles of the reference mesh.
    """

    bodies: tuple[int, ...]  # in their new order: the reference body first, the others as given
    meshes: tuple[int, ...]  # in their new order: the reference mesh first, the others as given
    input: int  # new index of the body at which power enters
    ratio: tuple[Fraction, ...]  # of each body in the new order: speed in its sense over the reference's
    #: likewise: +1 counter-clockwise seen from +z, −1 clockwise; of gears of a set as they turn against its
    #: carrier, whose ratio is negative where they turn the other way all the same
    sense: tuple[int, ...]
    #: driver, driven: new indices of the bodies of each mesh in the new order
    driver: tuple[int, ...]
    driven: tuple[int, ...]
    gears: tuple[tuple[int, int], ...]  # driving and driven gear of each mesh in the new order
    rate: tuple[Fraction, ...]  # cycles of each mesh, in the new order, per cycle of the reference mesh
    period: int  # fewest reference cycles after which every mesh is at the phase it began at
    carrier: tuple[int, ...]  # new index of the body that carries each mesh; -1: the housing
    given: tuple[int, ...] = ()  # new indices of bodies beside the input whose speeds are given

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
    outputs: Sequence[int] = (),
    given: Sequence[GivenSpeed] = (),
) -> TrainSpeeds:
    """Work out which end of each mesh drives, and how fast and which way every body turns.

    `source` is the body at which power enters, `sense` its sense of rotation (+1: counter-clockwise seen from
    +z). `outputs` are bodies at which it leaves, alike where there are several; `given` the speeds of further
    bodies, whose torques follow: as many as sets leave open. Raises InputError
    for a gear without a mesh, a mesh of gears that turn together, loops whose ratios or senses contradict
    each other, bodies whose speeds the input does not fix, and a train without a mesh.
    """
    _refuse_idle_gears(gears, meshes)
    joints = [_by_bodies(gears, mesh) for mesh in meshes]
    carrier_of = [sets[mesh.of_set].carrier if mesh.of_set >= 0 else -1 for mesh in meshes]
    away = distances(len(bodies), meshes, joints, couplings, source, sets)
    _refuse_unreached(bodies, gears, away)
    system = rows_of(gears, meshes, joints, couplings, away, source, sense, sets, given)
    rows = [row for _, row in system]
    _refuse_given_twice(bodies, given, rows)
    found = solve(len(bodies), rows)
    _refuse_open(bodies, sets, found)
    speed = [Fraction(0) if each is None else each for each in found.speed]
    _refuse_moved_held(bodies, sets, [rows[k] for k in found.against])
    for place, mesh in enumerate(meshes):
        if mesh.of_set < 0:
            _check_mesh(bodies, gears, mesh, joints[place], speed)
    for coupling in couplings:
        _check_coupling(bodies, coupling, speed)
    for k in found.against:
        raise InputError(*_contradiction(bodies, system[k]))
    senses = _senses(bodies, couplings, sets, speed)

    on_ends = dict(
        zip(
            (kind for kind, _ in system),
            reactions(rows, {body: -1.0 if speed[body] > 0 else 1.0 for body in outputs if speed[body]}),
            strict=True,
        )
    )
    largest = max(abs(torque) for torque in on_ends.values())
    driving = []
    for place, mesh in enumerate(meshes):
        one, two = mesh.ends
        carried = speed[carrier_of[place]] if mesh.of_set >= 0 else Fraction(0)
        torque = on_ends["mesh", place] * gears[one].teeth
        if abs(torque) > 1e-9 * largest * abs(gears[one].teeth) and (mesh.of_set >= 0 or given):
            first = torque * float(speed[joints[place][0]] - carried) < 0.0
        elif mesh.of_set < 0:
            first = away[joints[place][0]] < away[joints[place][1]]
        else:
            first = gears[one].body not in sets[mesh.of_set].planets
        driving.append((one, two) if first else (two, one))
    nearness = [min(away[end] for end in joint) for joint in joints]
    turning = [place for place, (driver, _) in enumerate(driving) if speed[gears[driver].body]]
    rolls = [
        place
        for place in turning
        if speed[joints[place][0]] != speed[carrier_of[place]] or (carrier_of[place] < 0)
    ]
    reference = min(rolls or turning, key=lambda m: (nearness[m], m))
    order = (reference, *(place for place in range(len(meshes)) if place != reference))
    driving, carrier = [driving[place] for place in order], [carrier_of[place] for place in order]
    first_body = gears[driving[0][0]].body
    if carrier[0] >= 0 and first_body in sets[meshes[reference].of_set].planets and speed[carrier[0]]:
        first_body = carrier[0]
    shafts = joined(len(bodies), [coupling.ends for coupling in couplings])
    if (given and shafts[first_body] != shafts[source]) or (carrier[0] >= 0 and abs(speed[first_body]) != 1):
        first_body = source
    numbers = (first_body, *(body for body in range(len(bodies)) if body != first_body))
    new = {body: index for index, body in enumerate(numbers)} | {-1: -1}
    scale = speed[first_body] * senses[first_body]
    if scale < 0:
        rule = f"{bodies[first_body].name} turns slower than the carrier of its planets, and the same way"
        raise InputError("operating.input", bodies[source].name, rule, "let power enter at another member")
    cycles = [
        abs(gears[driver].teeth * (speed[gears[driver].body] - (speed[by] if by >= 0 else 0)))
        for (driver, _), by in zip(driving, carrier, strict=True)
    ]
    for place, each in zip(order, cycles, strict=True):
        if not each:
            rule = "turns as one body at these speeds: its teeth do not roll"
            raise InputError(meshes[place].key, None, rule, "give members other speeds")
    rate = tuple(each / cycles[0] for each in cycles)
    return TrainSpeeds(
        bodies=numbers,
        meshes=order,
        input=new[source],
        ratio=tuple(speed[body] * senses[body] / scale for body in numbers),
        sense=tuple(senses[body] for body in numbers),
        driver=tuple(new[gears[driver].body] for driver, _ in driving),
        driven=tuple(new[gears[driven].body] for _, driven in driving),
        gears=tuple(driving),
        rate=rate,
        period=common_period(rate),
        carrier=tuple(new[by] for by in carrier),
        given=tuple(new[one.body] for one in given),
    )


def _senses(
    bodies: Sequence[Named], couplings: Sequence[Joint], sets: Sequence[SetMembers], speed: Sequence[Fraction]
) -> list[int]:
    """Senses of rotation: of gears of sets against the carrier; what couplings join has one."""
    rolling: dict[int, int] = {}
    for one in sets:
        for body in (*one.central, *one.planets):
            way = -1 if speed[body] < speed[one.carrier] else 1
            if rolling.setdefault(body, way) != way:
                is_held = "is held" if speed[body] == 0 else "turns"
                rule = f"{bodies[body].name} {is_held} in two stages whose planets roll in opposite senses"
                raise InputError(
                    f"{one.key}.held", one.held_as or None, rule, "name two gears, one in each stage"
                )
    group = joined(len(bodies), [coupling.ends for coupling in couplings])
    of_group: dict[int, int] = {}
    for body, way in rolling.items():
        if of_group.setdefault(group[body], way) != way:
            rule = f"{bodies[body].name} and what turns with it roll in opposite senses against two carriers"
            raise InputError(bodies[body].key, None, rule, "join them by two bodies with an idler between")
    return [of_group.get(group[body], -1 if speed[body] < 0 else 1) for body in range(len(bodies))]


def _refuse_open(bodies: Sequence[Named], sets: Sequence[SetMembers], found: Speeds) -> None:
    """Refuse a train whose speeds the input does not fix."""
    free = [body for body, speed in enumerate(found.speed) if speed is None]
    if not free:
        return
    for one in sets:
        members = (*one.central, one.carrier)
        if open_ones := [bodies[body].name for body in members if body in free]:
            names = " and ".join((", ".join(open_ones[:-1]), open_ones[-1]) if open_ones[1:] else open_ones)
            rule = f"the input does not fix how fast {names} turn: {found.freedom} more must be known"
            remedy = (
                'hold one (held = "ring"), give a [[load]] at one its speed_ratio, or join two by a [[link]]'
            )
            raise InputError(one.key, None, rule, remedy)
    body = bodies[free[0]]
    raise InputError(
        body.key, None, "the input does not fix how fast it turns", "add the [[stage]] that does"
    )


def _refuse_given_twice(
    bodies: Sequence[Named], given: Sequence[GivenSpeed], rows: Sequence[Equation]
) -> None:
    """Refuse to give a speed that the input, or one given before, fixes: the last rows are of those given."""
    for place, one in enumerate(given):
        fixed = solve(len(bodies), rows[: len(rows) - len(given) + place]).speed[one.body]
        if fixed is not None:
            rule = f"{bodies[one.body].name} turns at {abs(fixed)} of the input's speed already"
            remedy = "give it a torque in place of the speed, or leave a member of a stage free: held"
            raise InputError(one.key, str(one.speed), rule, remedy)


def _refuse_moved_held(
    bodies: Sequence[Named], sets: Sequence[SetMembers], against: Sequence[Equation]
) -> None:
    """Refuse to hold a member that others turn: the rows against it touch the set, or lead there."""
    for one in sets:
        if one.held >= 0 and any(one.held in row.factors for row in against):
            rule = f"{bodies[one.held].name} is held, and other stages or shafts turn it"
            remedy = "hold another member, or part the two"
            raise InputError(f"{one.key}.held", one.held_as, rule, remedy)


def _contradiction(
    bodies: Sequence[Named], row: tuple[tuple[str, int], Equation]
) -> tuple[str, str | None, str, str]:
    """Key, value, rule and remedy of a row that contradicts others."""
    (kind, _), equation = row
    names = " and ".join(bodies[body].name for body in equation.factors)
    rule = f"{names} cannot turn as other stages, shafts and held members turn them"
    return (
        bodies[next(iter(equation.factors))].key,
        None,
        f"{rule} ({kind})",
        "open the loop, or hold one less",
    )


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


def _refuse_unreached(bodies: Sequence[Named], gears: Sequence[Toothed], away: Sequence[int]) -> None:
    for place, body in enumerate(bodies):
        if away[place] >= 0:
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
    speed: Sequence[Fraction],
) -> None:
    one, two = (speed[body] for body in joint)
    names = [bodies[body].name for body in joint]
    by_mesh = one * Fraction(-gears[mesh.ends[0]].teeth, gears[mesh.ends[1]].teeth)
    if by_mesh * two < 0:
        rule = f"closes a loop in which {names[0]} and {names[1]} turn the same way, and cannot mesh"
        remedy = "a loop of external gears needs an even number of meshes"
        raise InputError(mesh.key, None, rule, remedy)
    if by_mesh != two:
        rule = (
            f"closes a loop whose ratios contradict each other: by this mesh {names[1]} turns at "
            f"{abs(by_mesh)} of the input's speed, by the others at {abs(two)}"
        )
        raise InputError(mesh.key, None, rule, "change numbers of teeth, or open the loop")


def _check_coupling(bodies: Sequence[Named], coupling: Joint, speed: Sequence[Fraction]) -> None:
    one, two = (speed[body] for body in coupling.ends)
    names = [bodies[body].name for body in coupling.ends]
    if one != two:
        rule = (
            f"closes a loop whose ratios contradict each other: {names[0]} and {names[1]} turn at "
            f"{one} and {two} of the input's speed"
        )
        raise InputError(coupling.key, None, rule, "change numbers of teeth, or open the loop")
