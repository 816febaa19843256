"""The mesh cycle by the load contact model: quasi-static limit, corner contact, back flanks, bad input."""

import dataclasses
import math

import numpy as np
import pytest

from tribodyn.compliance.sharing.load_sharing import (
    LoadedFlanks,
    flexibility,
)
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
    back_flanks,
)
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.table import slots
from tribodyn.mesh.tabulate_loaded import flanks_of, segments, tabulate_loaded
from tribodyn.studies.protocol.load import load_scenario

NAME = "involute-18-36-fem"


def table(case, **changes):
    mesh = dataclasses.replace(case.mesh, **changes)
    torque = case.operating.gear_torque
    back = mesh.backlash is not None
    return tabulate_loaded(assemble(family(case.family), case.drive), case.materials, mesh, torque, back)


def rolls(cycle):
    pairs = cycle.front_pairs
    position = cycle.phase[..., None] + np.arange(pairs - 1.0, -1.0, -1.0)
    roll = cycle.roll_start + cycle.pitch_angle * position
    return np.clip(roll, cycle.roll_start, cycle.roll_end).reshape(-1, pairs)


def loads_of_model(case, cycle):
    pair = assemble(family(case.family), case.drive)
    flexible = flexibility(pair, case.materials, held=case.mesh.held)
    return LoadedFlanks(flexible).share(rolls(cycle), case.operating.gear_torque)


@pytest.mark.parametrize("torque", ["80 N*m", "318.3 N*m", "1274 N*m"])
def test_quasi_static_loads_are_the_load_contact_models(torque):
    case = load_scenario(NAME, {"operating.gear_torque": torque}).pair
    cycle = table(case)
    shared = loads_of_model(case, cycle)
    still = quasi_static(cycle, case.operating.gear_torque)
    loads = still.normal_load.reshape(shared.normal_load.shape)
    np.testing.assert_allclose(loads, shared.normal_load, atol=0.01 * shared.normal_load.max())
    np.testing.assert_allclose(still.deflection.ravel(), shared.deflection, rtol=2e-3)


def test_pairs_touch_before_and_after_their_path():
    case = load_scenario(NAME, {}).pair
    cycle = table(case)
    loads = quasi_static(cycle, case.operating.gear_torque).normal_load.reshape(-1, 2)
    assembly = assemble(family(case.family), case.drive)
    start, end = (float(assembly.path.rotation(r)) for r in (assembly.r_start, assembly.r_end))
    roll = rolls(cycle)
    assert np.any(loads[roll < start - 1e-6] > 0)
    assert np.any(loads[roll > end + 1e-6] > 0)
    assert cycle.contact_ratio == pytest.approx(1.611, abs=1e-3)
    # nothing touches at the ends of the table: it reaches far enough
    ends = (roll < cycle.roll_start + 1e-3) | (roll > cycle.roll_end - 1e-3)
    assert np.all(loads[ends] == 0.0)


def test_table_is_periodic():
    cycle = table(load_scenario(NAME, {}).pair)
    for name in ("compliance", "gap", "signed_distance", "pressure_angle"):
        values = getattr(cycle, name)
        # the newest pair at the end of a cycle is the older one at the beginning of the next
        assert values[-1, -1, 1] == pytest.approx(values[0, 0, 0], rel=1e-9, abs=1e-12), name
    assert np.all(np.isfinite(cycle.compliance))
    assert np.all(cycle.compliance > 0)


def test_without_coupling_pairs_do_not_know_of_each_other():
    assert not np.any(table(load_scenario(NAME, {}).pair, foundation_coupling=False).coupling)


def test_back_flanks_mirror_the_front():
    case = load_scenario(NAME, {}).pair
    cycle, front = table(case, backlash=5e-5), table(case)
    assert cycle.slots == 4
    # a back pair half a table later, in the mirrored world: same gaps plus the backlash
    assert cycle.gap[..., 2:].min() == pytest.approx(5e-5, abs=1e-9)
    assert cycle.gap[..., :2].max() == pytest.approx(front.gap.max(), rel=1e-6)
    still = quasi_static(cycle, case.operating.gear_torque)
    assert not np.any(still.normal_load[..., 2:])


@pytest.mark.parametrize("start", [-0.61, -0.83, -0.27])
@pytest.mark.parametrize("span", [1.37, 1.92, 2.08])
def test_back_flanks_stand_half_a_pitch_behind_their_front_flanks(start, span):
    """At every phase every tooth's back flank that is on the path, angles in pitches: ½ less its front's."""
    pairs = math.ceil(span)
    marks = [0.0, span, 0.11, -start]
    boundary = segments(marks, (0.5 - 2.0 * start) % 1.0)
    at = slots(boundary, (start, start + span), 1.0, pairs, 5, True)
    assert np.all(np.diff(boundary) > 0.0)
    for segment in range(len(boundary) - 1):
        # within a segment no pair begins or ends, and none in contact passes a mark
        on_path = (at.roll[segment, 1:-1] > start) & (at.roll[segment, 1:-1] < start + span)
        assert np.all(on_path == (at.in_contact[segment] > 0.0))
        low, high = np.sort(at.roll[segment, [0, -1]], axis=0)[..., None]
        assert not np.any((low + 1e-9 < start + np.array(marks)) & (start + np.array(marks) < high - 1e-9))
        for node in (1, 2, 3):
            front = start + at.phase[segment, node] + np.arange(-5, 6)
            for rolls, own in ((front, slice(0, pairs)), (0.5 - front, slice(pairs, None))):
                expected = rolls[(rolls > start) & (rolls < start + span)]
                found = at.roll[segment, node, own]
                found = found[(found > start) & (found < start + span)]
                np.testing.assert_allclose(np.sort(found), np.sort(expected), atol=1e-12)


def test_back_flanks_carry_as_they_are_modified():
    """Under a negative torque they are the load contact model's, on the axes as these stand for them."""
    tip = {"amount": 2e-5, "length": 4e-3}
    relieved = FlankModification(tip=Relief(**tip), both_flanks=True)
    front_only = FlankModification(lead=LeadRelief(crowning=5e-6))
    given = Modifications(relieved, front_only, Misalignment(3e-4, 1e-3))
    case = load_scenario(NAME, {"mesh.points": 9}).pair
    assembly = assemble(family(case.family), case.drive)
    mesh = dataclasses.replace(case.mesh, modifications=given, slices=3, backlash=5e-5)
    cycle = tabulate_loaded(assembly, case.materials, mesh, -300.0, True)
    assert np.array_equal(cycle.gap, tabulate_loaded(assembly, case.materials, mesh, 300.0, True).gap)
    for side, modified in ((1, given), (-1, back_flanks(given, float(assembly.path.pressure_angle(0.0))))):
        still = quasi_static(cycle._replace(side=side * cycle.side), 300.0)
        own = cycle.side * side > 0
        flanks = flanks_of(assembly, case.materials, dataclasses.replace(mesh, modifications=modified))
        roll = assembly.path.rotation(cycle.signed_distance[..., own].reshape(-1, own.sum()))
        shared = flanks.share(roll, 300.0)
        loads = still.normal_load[..., own].reshape(shared.normal_load.shape)
        np.testing.assert_allclose(loads, shared.normal_load, atol=0.003 * loads.max())
        clear = 0.0 if side > 0 else mesh.backlash / np.cos(np.radians(20.0))
        np.testing.assert_allclose(still.deflection.ravel() - clear, shared.deflection, rtol=3e-3)


def test_errors_over_roll_angle_shift_the_load():
    case = load_scenario(NAME, {}).pair
    at = np.array([-0.5, 0.5])
    flat = table(case, error_table=(at, np.array([1e-5, 1e-5])))
    loads = [quasi_static(c, case.operating.gear_torque) for c in (table(case), flat)]
    np.testing.assert_allclose(loads[0].normal_load, loads[1].normal_load, atol=20.0)
    shift = (loads[1].deflection - loads[0].deflection) * np.cos(np.radians(20.0))
    np.testing.assert_allclose(shift, 1e-5, rtol=2e-3)


def test_every_family_has_a_load_contact_model():
    case = load_scenario("crc-23-47", {"mesh.compliance": "fem"}).pair
    cycle = table(case)
    shared = loads_of_model(case, cycle)
    loads = quasi_static(cycle, 500.0).normal_load.reshape(shared.normal_load.shape)
    np.testing.assert_allclose(loads, shared.normal_load, atol=0.01 * loads.max())
    # single contact carries F_n = T/(r_g cos α), 7.69 kN (Liu & Ni print 7687 N)
    assert loads.max() == pytest.approx(7690.0, rel=0.03)


@pytest.mark.parametrize("drive", ["cycloidal-23-47", "jia-parabolic-17-29", "s-gear-23-47"])
def test_radii_that_vanish_at_the_pitch_point_leave_a_smooth_table(drive):
    case = load_scenario(NAME, {"drive": drive}).pair
    cycle = table(case)
    # the neighbouring nodes differ by no more than the course of the table asks for: no spike at P
    change = np.abs(np.diff(cycle.compliance, axis=1)) / cycle.compliance[:, 1:]
    assert np.max(change * (cycle.in_contact[:, None, :] > 0)) < 0.05
    still = quasi_static(cycle, case.operating.gear_torque)
    shared = loads_of_model(case, cycle)
    loads = still.normal_load.reshape(shared.normal_load.shape)
    np.testing.assert_allclose(loads, shared.normal_load, atol=0.01 * loads.max())


def test_no_load_is_refused():
    case = load_scenario(NAME, {"mesh.backlash": "50 um"}).pair
    with pytest.raises(InputError, match="gear_torque"):
        tabulate_loaded(assemble(family(case.family), case.drive), case.materials, case.mesh, 0.0, True)
