"""Properties of the mesh cycle that hold for every valid drive."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.random_drives import drives
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import MaterialData
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.record_arrays import as_arrays, from_arrays
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate

STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
BRONZE = MaterialData("bronze", 110e9, 0.34, 8800.0, 60.0, 380.0, 2e9)


@st.composite
def cycles(draw, back=False):
    """Mesh cycle of a random valid drive."""
    family, drive = draw(drives())
    mesh = MeshData("energy", 0.05, points=17, backlash=4e-5)
    return tabulate(assemble(family, drive), (STEEL, BRONZE), mesh, pair_slots(assemble(family, drive)), back)


@settings(max_examples=12, deadline=None)
@given(cycles())
def test_compliance_of_the_loaded_pairs_is_positive_definite(cycle):
    for s in range(len(cycle.in_contact)):
        on = np.flatnonzero(cycle.in_contact[s])
        for k in range(cycle.phase.shape[1]):
            matrix = (cycle.coupling[s, k] + np.diag(cycle.compliance[s, k]))[np.ix_(on, on)]
            np.testing.assert_array_equal(matrix, matrix.T)
            assert np.linalg.eigvalsh(matrix).min() > 0.3 * np.diag(matrix).min()


@settings(max_examples=12, deadline=None)
@given(cycles())
def test_period(cycle):
    pairs = cycle.front_pairs
    for name in (
        "signed_distance",
        "pressure_angle",
        "equivalent_radius",
        "pinion_speed",
        "gear_speed",
        "compliance",
        "gap",
    ):
        values = getattr(cycle, name)
        assert np.all(np.isfinite(values))
        np.testing.assert_allclose(values[-1, -1, 1:pairs], values[0, 0, : pairs - 1], rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(
        cycle.coupling[-1, -1, 1:pairs, 1:pairs], cycle.coupling[0, 0, : pairs - 1, : pairs - 1], rtol=1e-9
    )


@settings(max_examples=12, deadline=None)
@given(cycles())
def test_segments_hold_as_many_pairs_as_the_contact_ratio_says(cycle):
    share = np.diff(cycle.boundary) @ cycle.in_contact.sum(axis=1)
    assert share == pytest.approx(cycle.contact_ratio, rel=1e-12)
    assert np.all(np.diff(cycle.boundary) >= 0)
    np.testing.assert_allclose(cycle.phase[1:, 0], cycle.phase[:-1, -1])


@settings(max_examples=12, deadline=None)
@given(cycles(back=True))
def test_back_flanks_touch_as_long_as_front_flanks(cycle):
    pairs = cycle.front_pairs
    share = np.diff(cycle.boundary) @ cycle.in_contact
    assert share[:pairs].sum() == pytest.approx(cycle.contact_ratio, rel=1e-10)
    assert share[pairs:].sum() == pytest.approx(cycle.contact_ratio, rel=1e-10)
    assert not cycle.coupling[..., :pairs, pairs:].any()
    assert np.all((cycle.boundary >= 0) & (cycle.boundary <= 1))


@settings(max_examples=15, deadline=None)
@given(cycles(), st.floats(10, 2000))
def test_pair_loads_carry_the_torque(cycle, torque):
    state = quasi_static(cycle, torque)
    arms = cycle.gear_pitch_radius * np.cos(cycle.pressure_angle)
    np.testing.assert_allclose((state.normal_load * arms).sum(axis=-1), torque, rtol=1e-10)
    assert np.all(state.normal_load >= 0)
    assert np.all(state.mesh_stiffness > 0)


@settings(max_examples=10, deadline=None)
@given(cycles(back=True))
def test_flat_arrays_and_back(cycle):
    again = from_arrays(as_arrays(cycle))
    for ours, theirs in zip(cycle, again, strict=True):
        np.testing.assert_array_equal(np.asarray(ours), np.asarray(theirs))
