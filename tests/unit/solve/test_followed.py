"""What lies beyond the ends of a leg, by a family that is asked and no more."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np

from tribodyn.solve.branch import followed
from tribodyn.solve.branch.unstable import UnstableBranch


def test_unstable_motions_are_sampled_on_their_own_line_and_values(monkeypatch):
    """Of the second of three ends nothing goes on; five motions are thinned to three."""
    asked, count = [], 5
    branch = UnstableBranch(
        2, np.arange(5.0), np.arange(10.0).reshape(5, 2), np.full((5, 2), 1.5 + 0j), np.zeros(5), None
    )

    class Family:
        def at(self, lines, values):
            asked.append((lines, values))
            return object.__new__(followed.GearMap), [""] * len(values)

    monkeypatch.setattr(followed, "unstable_branches", lambda *_: [branch, None, branch])
    monkeypatch.setattr(
        followed, "sampled", lambda _, orbits, samples: [(one.period, samples) for one in orbits]
    )
    beyond = cast(Any, SimpleNamespace(span=(0.0, 9.0), motions=3))
    found = followed._continued(cast(Any, Family()), 7, cast(Any, SimpleNamespace(seeds=[])), beyond, 40)
    assert [one.end for one in found] == [0, 2]
    assert asked == [([7, 7, 7], [0.0, 2.0, 4.0])] * 2
    for one in found:
        assert list(one.branch.values) == [0.0, 2.0, 4.0]
        assert one[2] == [(2, 40)] * 3
    whole = branch.thinned(count)
    assert len(whole.values) == len(branch.thinned(9).values) == count
    orbits = branch.orbits()
    assert [orbit.period for orbit in orbits] == [2] * 5
    np.testing.assert_array_equal(orbits[3].state, [6.0, 7.0])
    assert not any(orbit.stable for orbit in orbits)
