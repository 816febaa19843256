"""Slices integrated over finer ones: what moves the gears does not depend on them; how many are needed."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.helical_pairs import ENERGY, STEEL, helical_pair, sliced
from tribodyn.geometry.modification import FlankModification, LeadRelief, Modifications, Relief
from tribodyn.mesh.by_compliance import FEWEST, MOST, mesh_cycle_of, with_slices
from tribodyn.mesh.quasi_static import quasi_static, sliding_side
from tribodyn.mesh.slices.coupled import couple_slices

MATERIALS, TORQUE, MANY = (STEEL, STEEL), 300.0, 61
RELIEVED = Modifications(
    FlankModification(tip=Relief(8e-6, 2e-3), lead=LeadRelief(crowning=5e-6)),
    FlankModification(tip=Relief(8e-6, 2e-3)),
)
MESHES = {"even": ENERGY, "relieved": replace(ENERGY, modifications=RELIEVED)}


def moving(cycle, place):
    """Harmonics 0 to 8 of deflection (m), of moment over load (m), of friction."""
    state = quasi_static(cycle, float(cycle.gear_sense) * TORQUE)
    load = state.normal_load[0]
    total = load.sum(axis=-1)
    moment = (load * place).sum(axis=-1) / total
    friction = (load * sliding_side(cycle)[0]).sum(axis=-1) / total
    over = np.stack([state.deflection[0], moment, friction])[:, :-1]
    return np.fft.rfft(over, axis=-1)[:, :9] / over.shape[-1]


@pytest.mark.parametrize("name", MESHES)
def test_what_moves_the_gears_does_not_depend_on_the_slices(name):
    """Against many slices that hold each other, each with its load in its middle."""
    pair, mesh = helical_pair(1.7), MESHES[name]
    many = couple_slices(pair, MATERIALS, mesh, sliced(pair, mesh, MANY, nodes=257), TORQUE)
    exact = moving(many, np.tile(many.face_position, many.front_pairs))
    size = np.max(np.abs(exact[:, 1:]), axis=-1)
    for slices in (7, 15):
        cycle = mesh_cycle_of(pair, MATERIALS, replace(mesh, slices=slices), TORQUE)
        assert cycle.slices == slices
        found = moving(cycle, cycle.face_place[0])
        assert np.all(np.max(np.abs(found - exact)[:, 1:], axis=-1) < 0.02 * size)
        np.testing.assert_allclose(found[0, 0], exact[0, 0], rtol=1e-3)


@pytest.mark.parametrize("overlap", [0.4, 1.7])
def test_the_number_that_is_chosen_is_sound_and_few_are_named(overlap):
    """Slices that do not hold each other are not integrated: few of them make forces of their own."""
    pair, mesh = helical_pair(overlap), replace(ENERGY, slice_coupling=False)
    chosen, remark = with_slices(pair, MATERIALS, mesh, TORQUE)
    assert FEWEST <= chosen.slices <= MOST
    assert chosen.slices % 2 == 1
    assert remark.startswith(f"{chosen.slices} slices along the face: twice as many change")
    assert with_slices(pair, MATERIALS, chosen, TORQUE)[1] == ""
    few = with_slices(pair, MATERIALS, replace(mesh, slices=3), TORQUE)[1]
    assert ("is too few" in few) == (overlap > 1.0)
