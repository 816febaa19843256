"""What turns in a train before it is put in order: bodies, gears, joints, planetary sets, and speeds."""

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.train.planetary import CARRIER, RING, SUN, SetTeeth, speeds, willis


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
