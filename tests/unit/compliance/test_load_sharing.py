"""How positions are parted and pairs counted; the batches of a face do not change its loads."""

import numpy as np
import pytest

from tests.support.faces_in_slices import DRIVE
from tribodyn.compliance import load_sharing
from tribodyn.compliance.load_sharing import (
    SharedLoad,
    effective_contact_ratio,
    extended_rolls,
    in_batches,
    share_load,
)
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families.involute import FAMILY


def of_overlap(overlap):
    none = np.zeros(1)
    return SharedLoad(none, none, overlap, none, none)


@pytest.mark.parametrize("limits", [(-0.31, 0.42), (-0.2, 0.5), (-0.45, 0.1)])
def test_all_pairs_between_the_limits_are_there_once(limits):
    assembly = assemble(FAMILY, DRIVE)
    pitch = assembly.pitch_angle
    roll = extended_rolls(assembly, limits, 7)
    assert np.all(np.diff(roll, axis=1) < 0)  # the pair that entered first in front
    count = next(n for n in range(20) if limits[0] + n * pitch >= limits[1])
    expected = [limits[0] + (n + 0.5) * pitch / 7 for n in range(7 * count)]
    np.testing.assert_allclose(np.sort(roll, axis=None), expected, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize(("begin", "end"), [(-0.21, 0.29), (-0.1234, 0.4567)])
def test_contact_ratio_is_from_where_the_overlap_begins_to_where_it_ends(begin, end):
    """An overlap of two straight lines, one slice ahead of the other: ends are met between positions."""
    assembly = assemble(FAMILY, DRIVE)
    pitch = assembly.pitch_angle
    roll = extended_rolls(assembly, (begin - 0.1, end + 0.15), 9)
    first = np.minimum(roll - begin, 2.0 * (end - 0.02 - roll))
    second = np.minimum(roll - begin - 0.03, 2.0 * (end - roll))
    overlap = np.stack([first, second], axis=-1)
    assert effective_contact_ratio(roll, of_overlap(overlap), pitch) == pytest.approx((end - begin) / pitch)


@pytest.mark.parametrize(("positions", "pairs", "slices"), [(17, 3, 1), (5, 2, 40), (300, 4, 9)])
def test_batches_are_all_positions_and_bound_the_memory(monkeypatch, positions, pairs, slices):
    monkeypatch.setattr(load_sharing, "_ENTRIES", 5000)
    batches = in_batches((positions, pairs, slices))
    places = (pairs * slices) ** 2
    assert np.concatenate([np.arange(positions)[rows] for rows in batches]).tolist() == list(range(positions))
    sizes = [rows.stop - rows.start for rows in batches]
    assert all(size == 1 or size * places <= 5000 for size in sizes)
    assert all(size == positions or (size + 1) * places > 5000 for size in sizes[:-1])


def test_loads_do_not_know_of_batches(monkeypatch, pair):
    roll = extended_rolls(pair.assembly, (-0.3, 0.4), 5)
    whole = share_load(pair, roll, 200.0, 0.05, 2e-6 * np.cos(9.0 * roll), slices=3)
    monkeypatch.setattr(load_sharing, "_ENTRIES", 300)
    for one, other in zip(
        whole, share_load(pair, roll, 200.0, 0.05, 2e-6 * np.cos(9.0 * roll), 3), strict=True
    ):
        np.testing.assert_allclose(one, other, rtol=1e-12)
