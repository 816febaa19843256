"""Epicyclic trains of every type by Willis: ratios and torques by hand, degrees of freedom."""

from fractions import Fraction
from itertools import pairwise
from math import prod

import pytest

from tests.support.epicyclic_types import CARRIER, FIRST, LARGE, LAST, LONG, RING, SHORT, SMALL, TEETH, TYPES
from tribodyn.train.willis import of_coupling, of_mesh, of_speed, reactions, solve


def rows_of(chain):
    """Meshes of a chain; bodies: carrier, first and last central gear, planets."""
    bodies = [FIRST, *range(3, 1 + len(chain)), LAST]
    gears = [each if isinstance(each, list) else [each] for each in chain]
    return [
        of_mesh(one, two, (a[-1], b[0]), CARRIER)
        for one, two, a, b in zip(bodies, bodies[1:], gears, gears[1:], strict=False)
    ]


@pytest.mark.parametrize("name", TYPES)
def test_twelve_types_by_willis(name):
    chain = TYPES[name]
    gears = [each if isinstance(each, list) else [each] for each in chain]
    basic = prod(Fraction(-b[0], a[-1]) for a, b in pairwise(gears))  # carrier held
    rows = rows_of(chain)
    count = 1 + len(chain)
    assert solve(count, rows).freedom == 2
    fast, slow = Fraction(7, 3), Fraction(-5, 4)
    found = solve(count, [*rows, of_speed(CARRIER, slow), of_speed(FIRST, fast)])
    assert (found.freedom, found.against) == (0, ())
    assert found.speed[LAST] == slow + (fast - slow) / basic
    torques = reactions([*rows, of_speed(CARRIER), of_speed(FIRST)], {LAST: 1.0})
    # of the last on the carrier and on the first: 1 : (basic − 1) : −basic, in balance
    assert torques[-1] == pytest.approx(-1.0 / float(basic), rel=1e-12)
    assert torques[-2] == pytest.approx(-1.0 + 1.0 / float(basic), rel=1e-12)


def ravigneaux():
    pairs = (SMALL, SHORT), (SHORT, LONG), (LONG, RING), (LARGE, LONG)
    return [of_mesh(one, two, (TEETH[one], TEETH[two]), CARRIER) for one, two in pairs]


@pytest.mark.parametrize(
    ("held", "driving", "ratio"),
    [
        (CARRIER, SMALL, Fraction(84, 28)),  # first gear of a usual automatic
        (LARGE, SMALL, (1 + Fraction(36, 28)) / (1 + Fraction(36, 84))),
        (LARGE, CARRIER, 1 / (1 + Fraction(36, 84))),
        (CARRIER, LARGE, -Fraction(84, 36)),
    ],
)
def test_gears_of_a_ravigneaux_set(held, driving, ratio):
    found = solve(6, [*ravigneaux(), of_speed(held), of_speed(driving, Fraction(1))])
    assert found.freedom == 0
    assert 1 / found.speed[RING] == ratio
    rows = [*ravigneaux(), of_speed(held), of_speed(driving)]
    torques = reactions(rows, {RING: -1.0})
    power_in = torques[-1] * 1.0
    assert power_in == pytest.approx(float(found.speed[RING]), rel=1e-12)


def test_locked_set_turns_as_one():
    found = solve(6, [*ravigneaux(), of_coupling(SMALL, LARGE), of_speed(CARRIER, Fraction(1))])
    assert set(found.speed) == {Fraction(1)}


def test_torque_by_two_ways():
    """A layshaft couples the ring of a set to its sun: both bear their shares of the carrier's load."""
    # sun 1, ring 2, planet 3; a layshaft 4 couples sun and ring: its teeth 20, 60 and 40, 39
    rows = [
        of_mesh(1, 3, (24, 30), CARRIER),
        of_mesh(3, 2, (30, -84), CARRIER),
        of_mesh(1, 4, (20, 60)),
        of_mesh(4, 2, (40, 39)),
    ]
    found = solve(5, [*rows, of_speed(1, Fraction(1))])
    ring = Fraction(20 * 40, 60 * 39)
    assert found.speed[2] == ring
    assert found.speed[CARRIER] == (24 + 84 * ring) / 108
    torques = reactions([*rows, of_speed(1)], {CARRIER: -1.0})
    by_sun = torques[0] * 24  # of the load 1 on the carrier 24/108, and 84/108 by the ring
    assert by_sun == pytest.approx(-24 / 108, rel=1e-12)
    assert torques[-1] == pytest.approx(24 / 108 + 84 / 108 * float(ring), rel=1e-12)


def test_what_is_open_and_what_contradicts():
    rows = rows_of(TYPES["sun-planet-ring"])
    free = solve(4, [*rows, of_speed(FIRST, Fraction(1))])
    assert free.freedom == 1
    assert free.speed == (None, Fraction(1), None, None)
    fixed = [of_speed(FIRST, Fraction(1)), of_speed(CARRIER), of_speed(LAST)]
    assert solve(4, [*rows, *fixed]).against == (4,)
