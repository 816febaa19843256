"""Efficiency of epicyclic trains by their rolling powers: published formulas, closed balances, locking."""

from fractions import Fraction
from itertools import pairwise, permutations
from math import prod

import pytest

from tests.support.epicyclic_types import CARRIER, FIRST, LARGE, LAST, LONG, RING, SHORT, SMALL, TEETH, TYPES
from tribodyn.train.power_flow import LossyMesh, power_flow
from tribodyn.train.willis import of_mesh, of_speed, solve


def turned(meshes, held, driving, loaded):
    """Power flow where one member is held, one turns at 1 rad/s, and one bears 1 N m against its motion."""
    count = 1 + max(body for mesh in meshes for body in (mesh.one, mesh.two))
    rows = [of_speed(held), of_speed(driving, Fraction(1))]
    willis = [of_mesh(mesh.one, mesh.two, mesh.teeth, mesh.carrier) for mesh in meshes]
    speeds = [float(speed) for speed in solve(count, [*willis, *rows]).speed]
    return power_flow(meshes, rows, speeds, {loaded: -1.0 if speeds[loaded] > 0.0 else 1.0})


def chain_of(chain, loss):
    """Meshes of a chain as in `test_willis.py`, its basic ratio and basic efficiency."""
    bodies = [FIRST, *range(3, 1 + len(chain)), LAST]
    gears = [each if isinstance(each, list) else [each] for each in chain]
    ends = zip(pairwise(bodies), pairwise(gears), strict=True)
    meshes = [LossyMesh(one, two, (a[-1], b[0]), CARRIER, loss) for (one, two), (a, b) in ends]
    return meshes, prod(Fraction(-b[0], a[-1]) for a, b in pairwise(gears)), (1.0 - loss) ** len(meshes)


def published(held, driving, basic, eta):
    """Efficiency by Müller (Die Umlaufgetriebe) and VDI 2157; 0 or less: self-locking.

    `basic` is i_0 = n_1/n_2 with the carrier held.
    """
    i = float(basic)
    if held == CARRIER:
        return eta
    if FIRST in (held, driving) and held == FIRST:  # second gear and carrier: as the first with 1/i_0
        i = 1.0 / i
    if driving == CARRIER:
        by = eta if 0.0 < i < 1.0 else 1.0 / eta
        return (1.0 - i) / (1.0 - i * by)
    by = 1.0 / eta if 0.0 < i < 1.0 else eta
    return (1.0 - i * by) / (1.0 - i)


@pytest.mark.parametrize(("held", "driving"), list(permutations((CARRIER, FIRST, LAST), 2)))
@pytest.mark.parametrize("name", TYPES)
def test_six_modes_of_twelve_types_by_published_formulas(name, held, driving):
    meshes, basic, eta = chain_of(TYPES[name], 0.01)
    (loaded,) = {CARRIER, FIRST, LAST} - {held, driving}
    flow = turned(meshes, held, driving, loaded)
    expected = published(held, driving, basic, eta)
    assert flow is not None
    assert flow.efficiency == pytest.approx(expected, rel=1e-12)
    assert flow.put_in == pytest.approx(flow.taken_out + sum(flow.loss), rel=1e-12)


@pytest.mark.parametrize(("last", "locks"), [(-41, True), (-60, False)])
def test_sets_with_high_ratios_lock_themselves(last, locks):
    """Rings of 40 and 41 teeth and planets alike: the ring drives the carrier only where η_0 > i_0."""
    chain = [-40, [20, 20], last]
    meshes, basic, eta = chain_of(chain, 0.02)
    flow = turned(meshes, LAST, FIRST, CARRIER)
    assert (published(LAST, FIRST, basic, eta) <= 0.0) is locks
    assert (flow is None) is locks
    forward = turned(meshes, LAST, CARRIER, FIRST)
    assert forward is not None
    assert forward.efficiency == pytest.approx(published(LAST, CARRIER, basic, eta), rel=1e-12)
    assert (forward.efficiency < 0.5) is locks
    circulating = max(map(abs, forward.rolling)) / forward.put_in
    assert (circulating > 10.0) is locks


def ravigneaux(loss):
    pairs = (SMALL, SHORT), (SHORT, LONG), (LONG, RING), (LARGE, LONG)
    return [LossyMesh(one, two, (TEETH[one], TEETH[two]), CARRIER, loss) for one, two in pairs]


@pytest.mark.parametrize(
    ("held", "driving"), [(CARRIER, SMALL), (LARGE, SMALL), (LARGE, CARRIER), (CARRIER, LARGE)]
)
def test_power_of_a_ravigneaux_set_closes(held, driving):
    flow = turned(ravigneaux(0.013), held, driving, RING)
    assert flow is not None
    assert abs(flow.put_in - flow.taken_out - sum(flow.loss)) < 1e-12 * flow.put_in
    for on, rolling, loss in zip(flow.on, flow.rolling, flow.loss, strict=True):
        assert sum(on) == pytest.approx(0.0, abs=1e-14)
        assert loss == pytest.approx(0.013 * abs(rolling), rel=1e-12)
    if held == CARRIER:
        assert flow.efficiency == pytest.approx((1.0 - 0.013) ** (3 if driving == SMALL else 2), rel=1e-12)
    # small losses leave the directions as they are: each costs its share of the rolling power
    ideal = turned(ravigneaux(0.0), held, driving, RING)
    small = turned(ravigneaux(1e-7), held, driving, RING)
    assert ideal is not None
    assert small is not None
    cost = sum(map(abs, ideal.rolling)) / ideal.put_in
    assert (1.0 - small.efficiency) / 1e-7 == pytest.approx(cost, rel=1e-5)


def test_two_driven_members_share_the_loss():
    """Sun and ring drive the carrier: torques by the direction in which power rolls, not by the speeds."""
    meshes = [LossyMesh(1, 3, (24, 30), 0, 0.02), LossyMesh(3, 2, (30, -84), 0, 0.02)]
    eta = 0.98**2
    for ring, sun_drives in ((0.1, True), (2.0, False)):
        carrier = (24 + 84 * ring) / 108
        planet = carrier - 24 / 30 * (1.0 - carrier)
        flow = power_flow(meshes, [of_speed(1), of_speed(2)], [carrier, 1.0, ring, planet], {0: -108.0})
        assert flow is not None
        on_ring = 84 / 24 * (eta if sun_drives else 1.0 / eta)
        assert flow.torque[0] == pytest.approx(108.0 / (1.0 + on_ring), rel=1e-12)
        assert flow.torque[1] == pytest.approx(flow.torque[0] * on_ring, rel=1e-12)
        assert flow.put_in == pytest.approx(flow.taken_out + sum(flow.loss), rel=1e-12)
