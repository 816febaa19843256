"""A contact ratio of exactly one, as cycloidal studies assume: a pair leaves when the next one enters."""

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.support.states import TURN_G, sampled
from tribodyn.geometry.drive import tip_radius
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.path import contact_limits, contact_ratio
from tribodyn.solve.transient import TransientSettings

CYCLES, SAMPLES = 4, 50


def contact_ratio_with(drive, addendum):
    drive = drive._replace(
        pinion=drive.pinion._replace(addendum=addendum), gear=drive.gear._replace(addendum=addendum)
    )
    path = FAMILY.working_path(drive)
    limits = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    return float(contact_ratio(path, *limits, drive.pinion.teeth))


#: Of the multistage method, each of whose steps is costly, enough for a difference of a thousandth.
RTOL = {"dopri5": 1e-8, "radau": 1e-6}


def run(prepared, addendum, method):
    case = prepared("involute-23-47", **{"drive.pinion.addendum": addendum, "drive.gear.addendum": addendum})
    settings = TransientSettings(method, RTOL[method], CYCLES, 100000, SAMPLES)
    return case, sampled(case.model, settings)[1]


@pytest.mark.parametrize("method", ["dopri5", pytest.param("radau", marks=pytest.mark.soak)])
def test_runs_at_a_contact_ratio_of_one(prepared, method):
    drive = prepared("involute-23-47").warm_pairs[0].drive
    exact = brentq(lambda h: contact_ratio_with(drive, h) - 1.0, 0.3, 1.0, xtol=1e-16, rtol=1e-15)
    while contact_ratio_with(drive, exact) < 1.0:
        exact = np.nextafter(exact, 1.0)
    case, at_one = run(prepared, float(exact), method)
    assert case.cycle.contact_ratio == pytest.approx(1.0, abs=1e-14)
    assert np.all(np.diff(case.cycle.boundary) > 0)
    # the limit of contact ratios a little above one, once the start (two pairs loaded there) is forgotten
    _, above = run(prepared, float(exact) + 1e-7, method)
    late = slice(CYCLES * SAMPLES // 2, None)
    assert np.max(np.abs(at_one[late, TURN_G] - above[late, TURN_G])) < 1e-3 * np.ptp(at_one[late, TURN_G])
