"""What joins the bodies of a train: meshes, couplings, epicyclic sets; their equations, and their ways."""

from collections import deque
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from tribodyn.train.willis import Equation, of_coupling, of_mesh, of_speed


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
    """An epicyclic set by its bodies: gears on its axis, and planets on pins of its carrier."""

    key: str  # where it stands in the scenario, dotted
    carrier: int
    central: tuple[int, ...]
    planets: tuple[int, ...]
    held: int = -1  # the one of carrier and central gears that does not turn; -1: none
    held_as: str = ""  # what the scenario calls it


class GivenSpeed(NamedTuple):
    """A body that turns at a speed of its own, whatever torque that takes: a second drive, or a brake."""

    key: str  # where it stands in the scenario, dotted
    body: int
    speed: Fraction  # over the input's, negative against its sense


#: Away from the input by more meshes than any train has: what it does not turn.
HELD = 1_000_000


def rows_of(
    gears: Sequence[Toothed],
    meshes: Sequence[Joint],
    joints: Sequence[tuple[int, int]],
    couplings: Sequence[Joint],
    away: Sequence[int],
    source: int,
    sense: int,
    sets: Sequence[SetMembers],
    given: Sequence[GivenSpeed],
) -> list[tuple[tuple[str, int], Equation]]:
    """The equations of a train: input and held members, joints from the input outward, given speeds."""
    rows = [(("source", source), of_speed(source, Fraction(sense)))]
    rows += [(("held", k), of_speed(one.held)) for k, one in enumerate(sets) if one.held >= 0]
    joined = [
        (min(away[end] for end in coupling.ends), 0, ("coupling", place), of_coupling(*coupling.ends))
        for place, coupling in enumerate(couplings)
    ]
    joined += [
        (
            min(away[end] for end in joint),
            1,
            ("mesh", place),
            of_mesh(
                *joint,
                (gears[mesh.ends[0]].teeth, gears[mesh.ends[1]].teeth),
                sets[mesh.of_set].carrier if mesh.of_set >= 0 else -1,
            ),
        )
        for place, (mesh, joint) in enumerate(zip(meshes, joints, strict=True))
    ]
    rows += [(what, row) for *_, what, row in sorted(joined, key=lambda one: one[:2])]
    return rows + [
        (("given", place), of_speed(one.body, sense * one.speed)) for place, one in enumerate(given)
    ]


def joined(count: int, pairs: Iterable[tuple[int, int]]) -> list[int]:
    """Number alike what pairs join, of so many."""
    groups = list(range(count))
    for one, two in pairs:
        low, high = sorted((groups[one], groups[two]))
        groups = [low if group == high else group for group in groups]
    return groups


def distances(
    count: int,
    meshes: Sequence[Joint],
    joints: Sequence[tuple[int, int]],
    couplings: Iterable[Joint],
    source: int,
    sets: Sequence[SetMembers],
) -> list[int]:
    """Meshes between the input and every body, fewest; a set counts as one, its planets behind it.

    -1 of what the input does not reach, `HELD` of what is held.
    """
    coupled: list[list[int]] = [[] for _ in range(count)]
    meshing: list[list[int]] = [[] for _ in range(count)]
    held = {one.held for one in sets if one.held >= 0}
    planets = {planet for one in sets for planet in one.planets}
    for coupling in couplings:
        one, two = coupling.ends
        coupled[one].append(two)
        coupled[two].append(one)
    pairs = [joint for mesh, joint in zip(meshes, joints, strict=True) if mesh.of_set < 0]
    for gearset in sets:
        turning = [body for body in (*gearset.central, gearset.carrier) if body not in held]
        pairs += combinations(turning, 2)
        pairs += [(body, planet) for body in turning for planet in gearset.planets]
    for one, two in pairs:
        meshing[one].append(two)
        meshing[two].append(one)
    away = [-1] * count
    away[source] = 0
    waiting, done = deque([source]), set[int]()
    while waiting:
        body = waiting.popleft()
        if body in done:
            continue
        done.add(body)
        for other in coupled[body]:
            if away[other] < 0 or away[other] > away[body]:
                away[other] = away[body]
                waiting.appendleft(other)
        for other in meshing[body]:
            if away[other] < 0 and body not in planets:
                away[other] = away[body] + 1
                waiting.append(other)
    return [HELD if body in held else distance for body, distance in enumerate(away)]
