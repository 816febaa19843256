"""Where friction reverses: on a table whose distances are cubics over the phase, with known roots."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, SLIDING_KINEMATIC
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.solve.march.reversal import SHARES, filled_up, passages, stops, stops_of_many
from tribodyn.train.schedule import of_one_mesh

DISTANCE = CHANNELS.index("signed_distance")
BOUNDARY = np.array([0.0, 0.37, 1.0])
CELLS = 7
#: Distance of each pair over the phase, mm: coefficients from the constant term on.
PAIRS = ((-0.9, 2.0, 0.7, 0.3), (0.8, -1.3, -0.4, -0.2), (-2.0, 0.1, 0.0, 0.0))


def model(in_contact=((1, 1, 1), (1, 0, 1)), width=0.05, sliding=SLIDING_KINEMATIC):
    channel = np.zeros((2, CELLS, 3, len(CHANNELS), 4))
    for segment in range(2):
        start, end = BOUNDARY[segment : segment + 2]
        size = (end - start) / CELLS
        for cell in range(CELLS):
            left = start + cell * size
            for slot, pair in enumerate(PAIRS):
                place = Polynomial(pair)(Polynomial([left, size])).coef
                channel[segment, cell, slot, DISTANCE, : len(place)] = place
    table = SimpleNamespace(boundary=BOUNDARY, channel=channel, in_contact=np.array(in_contact))
    return cast(
        Any,
        SimpleNamespace(
            meshes=(SimpleNamespace(table=table),),
            schedule=of_one_mesh(BOUNDARY),
            operation=SimpleNamespace(reversal_width=width),
            options=SimpleNamespace(sliding=sliding),
        ),
    )


def roots(pair, distance, low, high):
    found = (Polynomial(PAIRS[pair]) - distance).roots()
    return [float(root.real) for root in found if abs(root.imag) < 1e-12 and low <= root.real <= high]


@pytest.mark.parametrize("distance", [-0.35, 0.0, 0.02, 0.31])
def test_passages_are_the_roots_of_the_distance(distance):
    table = model().meshes[0].table
    for segment in range(2):
        low, high = BOUNDARY[segment : segment + 2]
        touching = np.flatnonzero(table.in_contact[segment])
        expected = sorted(phase for pair in touching for phase in roots(pair, distance, low, high))
        assert sorted(passages(table, segment, distance)) == pytest.approx(expected, abs=1e-12)


def test_steps_end_on_every_share_of_the_width_and_on_the_segments_end():
    found = stops(model())
    rows = []
    for segment in range(2):
        low, high = BOUNDARY[segment : segment + 2]
        touching = [pair for pair in range(3) if model().meshes[0].table.in_contact[segment][pair]]
        inside = [phase for pair in touching for s in SHARES for phase in roots(pair, 0.05 * s, low, high)]
        rows.append([*sorted(inside), high])
    assert len(rows[0]) != len(rows[1])
    count = max(map(len, rows))
    assert found.shape == (2, count)
    for row, expected in zip(found, rows, strict=True):
        np.testing.assert_allclose(row, expected + expected[-1:] * (count - len(expected)), rtol=1e-12)
    assert list(SHARES) == sorted(SHARES) == [-share for share in reversed(SHARES)]


def test_with_the_bodies_own_sliding_steps_end_on_segments_only():
    np.testing.assert_array_equal(stops(model(sliding=SLIDING_DYNAMIC)), BOUNDARY[1:, None])


def test_stops_of_many_cases_are_those_of_each():
    wide, narrow = model(), model(width=0.01)
    moving = model(sliding=SLIDING_DYNAMIC)
    same, other = SimpleNamespace(**vars(wide)), SimpleNamespace(**vars(wide))
    other.operation = narrow.operation
    found = stops_of_many(cast(Any, [wide, moving, same, other]))
    count = found.shape[2]
    assert count == max(stops(case).shape[1] for case in (wide, moving, narrow))
    for row, case in zip(filled_up(found, count + 2), (wide, moving, wide, narrow), strict=True):
        np.testing.assert_array_equal(row, filled_up(stops(case), count + 2))
    np.testing.assert_array_equal(found[0], found[2])
    assert np.any(found[0] != found[3])


def test_stops_of_cases_with_more_segments_than_others():
    """A deviation of one case's flanks may end its contact elsewhere, and make another number of segments."""
    double, single = model(), model()
    table = single.meshes[0].table
    table.boundary, table.in_contact, table.channel = BOUNDARY[:2], table.in_contact[:1], table.channel[:1]
    single.schedule = of_one_mesh(BOUNDARY[:2])
    found = stops_of_many([double, single])
    count = found.shape[2]
    np.testing.assert_array_equal(found[0], filled_up(stops(double), count))
    np.testing.assert_array_equal(found[1, :1], filled_up(stops(single), count))
