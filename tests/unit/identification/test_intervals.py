"""The truth lies in the 95 % intervals as often as it should: simulated data with noise of many seeds."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.identification.fit import fitted, whiteness
from tribodyn.identification.simulated import SignalComparison, measured_of, turn_of
from tribodyn.identification.unknowns import shares_of, unknowns_of

SCENARIO = {
    "title": "A pair of gears of which two numbers are sought",
    "kind": "gear-pair",
    "drive": "liu-ni-involute-23-47",
    "lubricant": "liu-ni-2022",
    "bearings": "rigid-1e9",
    "operating": {"pinion_speed": "1500 rpm", "gear_torque": "200 N*m"},
    "mesh": {"damping_ratio": 0.05},
    "friction": {"law": "coulomb", "coefficient": 0.05},
    "film": {"law": "masjedi-khonsari"},
    "sensor": [{"name": "te", "kind": "transmission-error", "rate": "5 kHz"}],
    "solver": {"revolutions": 2.75},
}
UNKNOWNS = {
    "mesh.damping_ratio": (0.01, 0.2),
    "drive.pinion.eccentricity": ("0 um", "30 um"),
    ("bearings.gear.stiffness_x", "bearings.gear.stiffness_y"): ("2e8 N/m", "2e9 N/m"),
}
TRUTH = {
    "mesh.damping_ratio": 0.06,
    "drive.pinion.eccentricity": "12 um",
    "bearings.gear.stiffness_x": "6e8 N/m",
    "bearings.gear.stiffness_y": "6e8 N/m",
}
RUN_IN, NOISE = 0.75, 2e-7


@pytest.fixture(scope="module")
def heard():
    """The clean signal of the truth, and the scenario."""
    from tribodyn.record.reader import Record
    from tribodyn.record.sensors import read_sensed

    run = td.run(SCENARIO, TRUTH, progress=False)
    with Record(run.path) as record:
        return read_sensed(record)["te"], td.scenario(SCENARIO)


def estimate(heard, seed: int):
    """Estimates, half widths of their intervals and the truth, as shares of the ranges; the residual."""
    signal, case = heard
    sought = unknowns_of(case, UNKNOWNS)
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(signal.values))
    data = measured_of({"te": signal.values + noise}, case, float(signal.time[0]), RUN_IN * turn_of(case))
    compare = SignalComparison(case, sought, data, RUN_IN, False, None)
    found = fitted(compare, [shares_of(sought)])
    truth = shares_of(unknowns_of(td.scenario(SCENARIO, TRUTH), UNKNOWNS))
    return found.shares, found.half_width(0.95), truth, compare.apart(found.shares[None])[0][0]


@pytest.mark.slow
def test_a_seed_finds_the_truth_within_four_half_widths(heard):
    shares, half, truth, rest = estimate(heard, 1)
    assert np.all(np.abs(shares - truth) < 2.0 * half)
    assert np.all(half < 0.1)
    assert np.std(rest) == pytest.approx(NOISE, rel=0.1)
    assert whiteness(rest) > 1e-3


@pytest.mark.soak
def test_the_truth_lies_in_the_intervals_of_at_least_90_of_100_seeds(heard):
    inside = np.zeros(len(UNKNOWNS))
    for seed in range(100):
        shares, half, truth, _ = estimate(heard, seed)
        inside += np.abs(shares - truth) <= half
    print("inside:", dict(zip(map(str, UNKNOWNS), inside.tolist(), strict=True)))
    assert np.all(inside >= 90)
