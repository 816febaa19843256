"""Speeds, driving ends and torques of trains with a planetary set, in all six arrangements."""

from itertools import permutations

import pytest

from tests.support.single_set import speeds, torques
from tribodyn.errors import InputError
from tribodyn.train.flow import nominal_torques
from tribodyn.train.joints import Joint, Named, SetMembers, Toothed
from tribodyn.train.kinematics import TrainSpeeds, kinematics
from tribodyn.train.planetary import (
    CARRIER,
    MEMBERS,
    RING,
    SUN,
    SetTeeth,
)

TEETH = SetTeeth(18, 36, -93)
BODIES = [Named(name, name) for name in (*MEMBERS, "planet-1", "planet-2", "planet-3", "load")]
GEARS = [
    Toothed("sun", "", 0, 18),
    Toothed("ring", "", 1, -93),
    *(Toothed(f"planet-{n}", "", 2 + n, 36) for n in (1, 2, 3)),
]
MESHES = [Joint("stage.0", (0, 1 + n), 0) for n in (1, 2, 3)]
MESHES += [Joint("stage.0", (1 + n, 1), 0) for n in (1, 2, 3)]
NUMBERS = dict(zip(MEMBERS, range(3), strict=True))


def members(held: str) -> SetMembers:
    return SetMembers("stage.0", NUMBERS[CARRIER], (0, 1), (3, 4, 5), NUMBERS[held], held)


def turning(held: str, driving: str, sense: int = 1) -> TrainSpeeds:
    """The set, whose driven member turns a load by a shaft."""
    own = members(held)
    shaft = Joint("link.0", (NUMBERS[driven_by(held, driving)], 6))
    return kinematics(BODIES, GEARS, MESHES, [shaft], NUMBERS[driving], sense, [own], [6])


def driven_by(held: str, driving: str) -> str:
    return next(member for member in MEMBERS if member not in (held, driving))


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(("held", "driving"), list(permutations(MEMBERS, 2)))
def test_set_turns_by_willis_and_its_torques_balance(held, driving, sense):
    found = turning(held, driving, sense)
    new = {body: number for number, body in enumerate(found.bodies)}
    signed = {name: found.ratio[new[body]] * found.sense[new[body]] for name, body in NUMBERS.items()}
    expected = speeds(TEETH, held, driving)
    scale = signed[driving] / expected[driving]
    assert {name: speed / scale for name, speed in signed.items()} == {
        name: expected[name] for name in MEMBERS
    }
    assert all(ratio >= 0 for ratio in found.ratio)
    assert set(found.rate) == {1}
    loads = [0.0] * len(BODIES)
    loads[new[6]] = 100.0
    teeth = [(abs(GEARS[one].teeth), abs(GEARS[two].teeth)) for one, two in found.gears]
    driven = new[NUMBERS[driven_by(held, driving)]]
    balanced = nominal_torques(found, teeth, [(driven, new[6])], loads)
    ideal = torques(TEETH, held, driving, 1.0)
    ratio = abs(ideal[driving] / ideal[driven_by(held, driving)])
    assert balanced.source == pytest.approx(100.0 * ratio)
    # power flows from driver to driven in every mesh
    assert min(balanced.driven) > 0.0
    on_planet = balanced.driven[0] if found.gears[0][1] > 1 else balanced.driven[0] * 36.0 / teeth[0][1]
    assert on_planet == pytest.approx(abs(ideal[SUN] / ideal[driven_by(held, driving)]) * 100.0 * 2.0 / 3.0)


def test_sun_or_ring_drives_the_planets_as_the_torques_have_it():
    """With a held sun and the carrier driving, the sun, which rolls backwards under the load, drives."""
    drives = {}
    for held, driving in permutations(MEMBERS, 2):
        found = turning(held, driving)
        drivers = {found.bodies[found.driver[mesh]] for mesh in range(6)}
        drives[held, driving] = SUN if NUMBERS[SUN] in drivers else RING
    assert drives == {
        (SUN, RING): RING,
        (SUN, CARRIER): SUN,
        (RING, SUN): SUN,
        (RING, CARRIER): RING,
        (CARRIER, SUN): SUN,
        (CARRIER, RING): RING,
    }


def test_reference_body_turns():
    """Where a held member drives the planets, their carrier is the reference."""
    assert turning(RING, CARRIER).bodies[0] == NUMBERS[CARRIER]
    assert turning(RING, SUN).bodies[0] == NUMBERS[SUN]


def test_a_held_member_that_something_turns_is_refused():
    own = members(RING)
    shaft = Joint("link.0", (NUMBERS[SUN], NUMBERS[RING]))
    load = Joint("link.1", (NUMBERS[CARRIER], 6))
    with pytest.raises(InputError, match="ring is held, and other stages or shafts turn it"):
        kinematics(BODIES, GEARS, MESHES, [shaft, load], NUMBERS[SUN], 1, [own])


def test_a_set_that_nothing_turns_is_refused():
    own = members(RING)
    with pytest.raises(InputError, match="not connected to the input"):
        kinematics(BODIES, GEARS, MESHES, [], 6, 1, [own])
