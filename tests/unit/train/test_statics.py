"""Torques of trains against the balance by hand."""

import pytest

from tribodyn.train.flow import nominal_torques
from tribodyn.train.joints import Joint, Named, Toothed
from tribodyn.train.kinematics import TrainSpeeds, kinematics


def motion(bodies: list[tuple[int, ...]], meshes: list[tuple[int, int]], source: int = 0) -> TrainSpeeds:
    """Gears by their teeth in the order of the bodies; meshes by the numbers of their gears."""
    gears = [
        Toothed(f"{body}{place}", "", body, teeth)
        for body, own in enumerate(bodies)
        for place, teeth in enumerate(own)
    ]
    named = [Named(str(body), "") for body in range(len(bodies))]
    return kinematics(named, gears, [Joint("", ends) for ends in meshes], [], source, -1)


def test_an_idler_and_a_load_on_it():
    chain = motion([(20,), (40,), (30,)], [(0, 1), (1, 2)])
    found = nominal_torques(chain, [(20, 40), (40, 30)], [], [0.0, 100.0, 300.0])
    assert found.driven == pytest.approx((500.0, 300.0))
    assert found.source == pytest.approx(250.0)


def test_a_motor_before_the_pinion():
    gears = [Toothed("p", "", 0, 20), Toothed("g", "", 1, 30)]
    named = [Named(name, "") for name in ("pinion", "gear", "motor")]
    train = kinematics(named, gears, [Joint("", (0, 1))], [Joint("", (0, 2))], 2, 1)
    found = nominal_torques(train, [(20, 30)], [(2, 0)], [0.0, 90.0, 0.0])
    assert found.coupling == pytest.approx((60.0,))
    assert found.source == pytest.approx(60.0)
