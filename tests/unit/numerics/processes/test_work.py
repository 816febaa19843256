"""Progress of work far below: monotone, whole, and unseen where nobody watches."""

import numpy as np

from tests.support.faces_in_slices import DRIVE
from tribodyn.compliance.fem.gear import lead_harmonics
from tribodyn.compliance.fem.gear_compliance import ElasticGear
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.numerics.processes.work import part, steps, watched


def test_steps_within_steps_share_the_whole():
    shares = []
    with watched(shares.append):
        for _ in steps("ab"):
            with part(0.5, 1.0):
                list(steps(range(4)))
    assert shares == sorted(shares)
    assert (shares[0], shares[-1]) == (0.0, 1.0)
    assert {0.25, 0.3125, 0.5, 0.75, 0.875, 1.0} <= set(shares)


def test_finite_elements_report_while_they_are_solved():
    pair = assemble(FAMILY, DRIVE)
    shares = []
    with watched(shares.append):
        gear = ElasticGear(pair.tooth("pinion"), 18, 12e-3, 0.3, 0.6e-3, 1)
        lead_harmonics(gear, np.array([0.0, 200.0]))
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert np.max(np.diff(shares)) < 0.06  # a step for every phase of the ring
