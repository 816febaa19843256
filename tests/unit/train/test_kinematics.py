"""Speeds of trains against hand counts, and every train that is none."""

from fractions import Fraction

import pytest

from tribodyn.errors import InputError
from tribodyn.train.joints import Joint, Named, Toothed
from tribodyn.train.kinematics import TrainSpeeds, kinematics


def train(
    gears: dict[str, tuple[str, int]],
    meshes: list[tuple[str, str]],
    couplings: list[tuple[str, str]] = [],  # noqa: B006
    source: str = "",
    sense: int = -1,
    bodies: tuple[str, ...] = (),
) -> TrainSpeeds:
    """Gears by name as (body, teeth); the input is the first gear's body."""
    names = list(dict.fromkeys([*(body for body, _ in gears.values()), *bodies]))
    places = list(gears)
    return kinematics(
        [Named(name, f"body.{name}") for name in names],
        [Toothed(name, f"gear.{name}", names.index(body), teeth) for name, (body, teeth) in gears.items()],
        [Joint(f"stage.{n}", (places.index(a), places.index(b))) for n, (a, b) in enumerate(meshes)],
        [Joint(f"shaft.{n}", (names.index(a), names.index(b))) for n, (a, b) in enumerate(couplings)],
        names.index(source or names[0]),
        sense,
    )


def test_a_pair_is_its_own_reference():
    found = train({"p": ("in", 23), "g": ("out", 47)}, [("g", "p")])
    assert found.ratio == (1, Fraction(23, 47))
    assert found.sense == (-1, 1)
    assert (found.driver, found.driven, found.gears) == ((0,), (1,), ((0, 1),))
    assert (found.rate, found.period, found.input) == ((1,), 1, 0)


def test_an_idler_keeps_the_outer_ratio_and_sense():
    found = train({"a": ("A", 21), "i": ("I", 53), "b": ("B", 37)}, [("a", "i"), ("b", "i")])
    assert found.ratio[2] == Fraction(21, 37)
    assert found.sense == (-1, 1, -1)
    assert found.rate == (1, 1)
    assert found.driver == (0, 1)
    assert found.driven == (1, 2)


@pytest.mark.parametrize(("z2", "z3", "period"), [(60, 20, 3), (50, 17, 50), (48, 36, 4), (40, 40, 1)])
def test_two_stages_repeat_when_the_shared_shaft_does(z2, z3, period):
    """Meshes with z2 and z3 teeth on one shaft repeat after 1/gcd(z2, z3) of its turn: z2/gcd cycles."""
    gears = {"a": ("s1", 23), "b": ("s2", z2), "c": ("s2", z3), "d": ("s3", 71)}
    found = train(gears, [("a", "b"), ("c", "d")])
    assert found.rate == (1, Fraction(z3, z2))
    assert found.period == period
    assert found.ratio == (1, Fraction(23, z2), Fraction(23 * z3, z2 * 71))
    assert found.sense == (-1, 1, -1)


def test_a_bull_gear_in_the_middle_drives_only_what_is_behind_it():
    gears = {"p1": ("P1", 20), "p2": ("P2", 30), "bull": ("B", 90)}
    outward = train(gears, [("p1", "bull"), ("p2", "bull")], source="B")
    assert outward.bodies[0] == 2
    assert outward.driver == (0, 0)
    assert outward.ratio == (1, Fraction(9, 2), 3)
    through = train(gears, [("p1", "bull"), ("p2", "bull")], source="P2")
    assert through.meshes == (1, 0)
    assert [through.bodies[body] for body in through.driver] == [1, 2]


def test_a_motor_before_the_train_is_the_input_and_not_the_reference():
    gears = {"p": ("pinion", 23), "g": ("gear", 47)}
    found = train(gears, [("p", "g")], [("motor", "pinion")], source="motor", bodies=("motor",))
    assert found.bodies == (0, 1, 2)
    assert found.input == 2
    assert found.ratio[2] == 1
    assert found.sense[2] == found.sense[0] == -1


def test_power_flows_outward_through_both_ways_of_a_loop():
    """One pinion drives two compound shafts, which drive one bull gear."""
    gears = {
        "p": ("in", 20),
        "b1": ("s1", 40),
        "c1": ("s1", 25),
        "b2": ("s2", 40),
        "c2": ("s2", 25),
        "bull": ("out", 100),
    }
    found = train(gears, [("p", "b1"), ("p", "b2"), ("c1", "bull"), ("bull", "c2")])
    assert found.driver == (0, 0, 1, 2)
    assert found.driven == (1, 2, 3, 3)
    assert found.rate == (1, 1, Fraction(5, 8), Fraction(5, 8))
    assert found.period == 8


def refused(call, *words: str) -> InputError:
    with pytest.raises(InputError) as caught:
        call()
    for word in words:
        assert word in str(caught.value)
    return caught.value


def test_a_coupling_of_bodies_that_turn_at_different_speeds():
    gears = {"a": ("A", 20), "i": ("I", 30), "b": ("B", 41)}
    error = refused(lambda: train(gears, [("a", "i"), ("i", "b")], [("A", "B")]), "contradict")
    assert error.key == "stage.1"
    gears = {"motor": ("M", 20), **gears, "n": ("N", 20)}
    meshes = [("motor", "a"), ("motor", "n"), ("a", "i"), ("i", "b")]
    error = refused(lambda: train(gears, meshes, [("B", "A")]), "contradict", "20/41")
    assert error.key == "stage.3"


def test_bodies_that_the_input_does_not_turn():
    gears = {"a": ("A", 20), "b": ("B", 41), "c": ("C", 20), "d": ("D", 41)}
    error = refused(lambda: train(gears, [("a", "b"), ("c", "d")]), "not connected to the input")
    assert error.key == "gear.c"
    gears = {"a": ("A", 20), "b": ("B", 41)}
    error = refused(lambda: train(gears, [("a", "b")], bodies=("wheel",)), "not connected")
    assert error.key == "body.wheel"


def test_a_train_without_a_mesh():
    assert refused(lambda: train({}, [], bodies=("A",)), "missing").key == "stage"
