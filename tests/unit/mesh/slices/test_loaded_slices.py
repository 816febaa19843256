"""The table of helical pairs by finite elements: slots apart carry as slices that hold each other."""

import dataclasses

import numpy as np
import pytest

from tests.support.faces_in_slices import STEEL
from tests.support.helical import PAIR, assembly
from tests.support.helical import WIDTH as FACE
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
    turned_round,
)
from tribodyn.mesh.slices.fine import parts_of_slices
from tribodyn.mesh.slices.loaded import PER_CYCLE, WIDTH
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate_loaded import flanks_of, tabulate_loaded

TORQUE, SLICES = 300.0, 7
MODIFIED = Modifications(
    FlankModification(tip=Relief(8e-6, 3e-3), lead=LeadRelief(4e-6, 9e-6, 8e-3)),
    misalignment=Misalignment(2e-4),
)


def tabulated(helix, modifications, backlash=None):
    pair = assembly(PAIR, helix, FACE)
    mesh = MeshData("fem", 0.05, modifications=modifications, slices=SLICES, backlash=backlash)
    return pair, mesh, tabulate_loaded(pair, (STEEL, STEEL), mesh, TORQUE, backlash is not None)


@pytest.fixture(scope="module")
def modified():
    return tabulated(20.0, MODIFIED)


@pytest.fixture(scope="module")
def model(modified):
    pair, mesh, cycle = modified
    start = -float(cycle.pitch_point_phase) * pair.pitch_angle
    phase = cycle.phase[0][:, None] + np.arange(cycle.front_pairs - 1.0, -1.0, -1.0)
    flanks = flanks_of(pair, (STEEL, STEEL), mesh)
    finer = flanks._replace(slices=SLICES * parts_of_slices(pair, SLICES, WIDTH, PER_CYCLE))
    return finer.share(start + pair.pitch_angle * phase, TORQUE)


def arms(cycle):
    return np.cos(cycle.pressure_angle) / np.hypot(1.0, cycle.pitch_slope * np.cos(cycle.pressure_angle))


def loads(cycle, deflection):
    """Loads of the slots turned by `deflection` (m), and their growth, as the dynamics have them."""
    approach = deflection * arms(cycle) - cycle.gap
    stiffness = cycle.share / cycle.compliance
    return stiffness * np.maximum(approach, 0.0), np.where(approach > 0.0, stiffness * arms(cycle), 0.0)


def test_the_slots_carry_and_stiffen_as_the_model_s_finer_slices(modified, model):
    assert model.slice_load.shape[-1] > 2 * SLICES
    _, _, cycle = modified
    load, growth = loads(cycle, model.deflection[None, :, None])
    expected = model.slice_load.reshape(*load[0].shape, -1).sum(axis=-1)
    np.testing.assert_allclose(load[0], expected, atol=1e-9 * np.max(expected))
    torque = float(cycle.gear_pitch_radius) * np.sum(load * arms(cycle), axis=-1)
    np.testing.assert_allclose(torque, TORQUE, rtol=1e-9)
    stiffness = float(cycle.gear_pitch_radius) * np.sum(growth * arms(cycle), axis=-1)[0]
    np.testing.assert_allclose(stiffness, model.stiffness, rtol=1e-6)


def test_slots_are_positive_finite_and_repeat_after_a_cycle(modified):
    pair, _, cycle = modified
    assert cycle.front_slots == cycle.front_pairs * SLICES
    assert np.all(np.isfinite(cycle.gap))
    assert np.min(cycle.compliance) > 0.0
    assert np.min(cycle.share) == 0.0
    assert np.max(cycle.share) == 1.0
    # a pair goes on in the place before its own
    for name in ("gap", "compliance", "share", "signed_distance", "equivalent_radius"):
        values = getattr(cycle, name)[0]
        end, start = values[-1, SLICES:], values[0, :-SLICES]
        touching = cycle.share[0][0, :-SLICES] > 0.0  # elsewhere gap and compliance mean nothing
        chosen = touching if name in ("gap", "compliance") else np.ones_like(touching)
        np.testing.assert_allclose(end[chosen], start[chosen], rtol=1e-6, atol=1e-12)
    limits = (cycle.roll_end - cycle.roll_start) / pair.pitch_angle
    assert limits > pair.contact_ratio + 26e-3 * np.sin(np.radians(20.0)) / (np.pi * 3e-3)


def test_a_left_hand_pair_has_the_table_of_its_mirror_image(modified):
    _, _, right = modified
    _, _, left = tabulated(-20.0, turned_round(MODIFIED))
    for name in right._fields:
        np.testing.assert_allclose(getattr(left, name), getattr(right, name), rtol=1e-8, atol=1e-15)


def test_back_flanks_are_as_stiff_as_the_front_ones_and_their_backlash_away():
    """Unmodified teeth are alike on both flanks: each pair's slices add up to the same over its life."""
    _, _, cycle = tabulated(20.0, Modifications(), backlash=80e-6)
    front = cycle.side > 0
    assert np.any(~front)
    turned = cycle.share / cycle.compliance * arms(cycle) ** 2
    lives = [np.mean(np.sum(turned[..., part], axis=-1)) for part in (front, ~front)]
    assert lives[1] == pytest.approx(lives[0], rel=0.02)
    inside = cycle.share == 1.0
    opened = (cycle.gap / arms(cycle))[..., ~front][inside[..., ~front]]
    assert np.min(opened) > 60e-6


def test_fewer_points_leave_the_loads_of_the_nodes(modified):
    """Nodes follow the slices' width: a number of points asked for is a minimum."""
    pair, mesh, cycle = modified
    coarse = tabulate_loaded(pair, (STEEL, STEEL), dataclasses.replace(mesh, points=9), TORQUE)
    assert coarse.phase.shape == cycle.phase.shape
