"""Ends of a gear pair's branch, met on ways of other steps, against its multipliers near the end."""

import numpy as np
import pytest

from tribodyn.gears.tabulated import tables
from tribodyn.solve.branch.arclength import NEIMARK_SACKER
from tribodyn.solve.branch.continuation import Leg, follow
from tribodyn.solve.branch.gear_pairs import GearLines
from tribodyn.solve.orbit.gear_map import moving_states
from tribodyn.solve.orbit.periodic import steady_states
from tribodyn.solve.orbit.shooting import shoot
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

#: Lightly damped, at constant stiffness: its doubled motion ends where two multipliers leave the unit circle.
DRIVE = {
    "friction.law": "none",
    "mesh.damping_ratio": 0.01,
    "mesh.compliance": "constant",
    "mesh.stiffness": "2.8e8 N/m",
    "operating.gear_torque": "100 N*m",
}
START = 1000.0
WAYS = {"4": (868.0, 864.0, 860.0), "12": (868.0, 856.0), "36": (892.0, 856.0), "150": (850.0,)}


@pytest.mark.soak
def test_a_neimark_sacker_point():
    mesh = tables(load_scenario("crc-23-47", DRIVE).pair)

    def model_at(line, value):
        return prepare(
            load_scenario("crc-23-47", {**DRIVE, "operating.pinion_speed": f"{value!r} rad/s"}), (mesh,)
        ).model

    model = model_at(0, START)
    (begin,) = steady_states([model], samples=1)
    assert begin.kind == "period-2"
    moving = moving_states(model)
    settings = {"solver": "dopri5", "rtol": 1e-6, "fine_rtol": 1e-9, "max_steps": 10**5, "workers": 1}
    family = GearLines(model_at, {0: begin.state}, moving, **settings)
    located, last = {}, None
    for name, values in WAYS.items():
        leg = Leg(0, START, START, begin.state[list(moving.states)], 2, reach=START)
        for value in values:
            leg = leg._replace(target=value)
            (arrival,) = follow(family, [leg])
            if arrival.ends:
                end = arrival.ends[0]
                located[name], last = end.value, arrival.seeds[0]
                assert end.kind == NEIMARK_SACKER
                assert end.within <= 1e-4 * end.value
                break
            leg = Leg(0, value, value, arrival.next_state, arrival.orbit.period, reach=START)
    print(located)
    assert len(located) == len(WAYS)
    middle = float(np.mean(list(located.values())))
    assert np.ptp(list(located.values())) <= 1e-4 * middle
    # the branch itself, beside the end: Newton's method from the last stable place
    assert last is not None
    moduli = []
    for value in (middle * (1.0 + 1e-4), middle * (1.0 - 1e-4)):
        period_map, _ = family.at([0], [value])
        (shot,) = shoot(period_map, last.state[None], np.array([0]), 2, 1e-7)
        assert not shot.reason
        moduli.append(abs(shot.multipliers[0]))
    assert moduli[0] < 1.0 < moduli[1]
