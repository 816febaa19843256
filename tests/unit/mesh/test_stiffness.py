"""One pair that carries the whole torque at the pitch point."""

import dataclasses
import math

import numpy as np
import pytest

from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.mesh.quasi_static import single_pair
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.studies.protocol.load import load_scenario

TORQUE = 500.0


def pair_of(name, **changes):
    case = load_scenario(name).pair
    assembly = assemble(family(case.family), case.drive)
    mesh = dataclasses.replace(case.mesh, **changes)
    cycle = tabulate(assembly, case.materials, mesh, pair_slots(assembly))
    return assembly, cycle, single_pair(cycle, TORQUE)


@pytest.mark.parametrize("name", ["involute-23-47", "crc-23-47", "circular-arc-23-47"])
def test_the_load_balances_the_torque_about_the_gear(name):
    assembly, _, pair = pair_of(name)
    arm = float(assembly.path.gear_pitch_radius) * math.cos(float(assembly.path.pressure_angle(0.0)))
    assert pair.normal_load * arm == pytest.approx(TORQUE, rel=1e-8)


def test_a_constant_stiffness_is_what_was_given():
    *_, pair = pair_of("crc-23-47", compliance="constant", stiffness=3e8)
    assert pair.stiffness == pytest.approx(3e8, rel=1e-14)


def test_a_contact_that_stiffens_is_taken_at_its_tangent():
    """The deflection c F + A F^0.9, differentiated numerically at the load along the normal."""
    *_, rigid = pair_of("crc-23-47", hertz="linear")
    _, cycle, pair = pair_of("crc-23-47", hertz="load-dependent")
    rest = 1.0 / single_pair(cycle._replace(hertz_coefficient=0.0), TORQUE).stiffness

    def deflection(load):
        return rest * load + float(cycle.hertz_coefficient) * load**0.9

    step = 1e-4 * pair.normal_load
    slope = (deflection(pair.normal_load + step) - deflection(pair.normal_load - step)) / (2 * step)
    assert pair.stiffness == pytest.approx(1.0 / slope, rel=1e-7)
    assert pair.normal_load == pytest.approx(rigid.normal_load, rel=1e-14)


def test_the_sign_of_the_torque_does_not_matter():
    _, cycle, pair = pair_of("crc-23-47")
    assert single_pair(cycle, -TORQUE) == pair


def test_the_pair_is_as_stiff_as_at_the_pitch_point():
    """Among the nodes beside it; the numerical derivative of the compliance there is far from zero."""
    _, cycle, pair = pair_of("involute-23-47")
    roll, there = cycle.signed_distance[..., : cycle.front_pairs], cycle.in_contact[:, : cycle.front_pairs]
    inside = np.broadcast_to(there[:, None] > 0, roll.shape)
    at, compliance = roll[inside], cycle.compliance[..., : cycle.front_pairs][inside]
    order = np.argsort(at)
    after = int(np.searchsorted(at[order], 0.0))
    beside = compliance[order][[after - 1, after]]
    assert beside.min() <= 1.0 / pair.stiffness <= beside.max()
    assert np.ptp(beside) < 2e-2 * beside.min() < np.ptp(compliance)
