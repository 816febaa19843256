"""Losses of a two-stage reducer at points of operation, beside rigid involutes written out in NumPy.

Of the gears' data alone: base circles, path of contact, all pairs in contact bear the same load (teeth of one
constant stiffness), Coulomb's friction with its moment, the first stage with the loss of the second.
"""

from typing import NamedTuple

import numpy as np
import pytest

from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.studies.motion.losses.part import LOSSES
from tribodyn.studies.protocol.load import load_scenario

FRICTION = 0.06
KEYS = {
    "mesh.compliance": "constant",
    "mesh.stiffness": "4e8 N/m",
    "friction.law": "coulomb",
    "friction.coefficient": FRICTION,
}


class Stage(NamedTuple):
    """Module, m, teeth and profile shifts of `two-stage-reducer`; 20° and tips of full height."""

    module: float
    teeth: tuple[float, float]
    shifts: tuple[float, float]

    def losses(self, torque: float) -> tuple[float, float]:
        """Loss over the pinion's speed, and mean torque on the pinion, by that on the gear, N m.

        A torque below 0 drives: friction then helps the pinion's torque less.
        """
        teeth, shifts, way = np.array(self.teeth), np.array(self.shifts), np.sign(torque)
        normal = np.radians(20.0)
        target = np.tan(normal) - normal + 2.0 * np.tan(normal) * shifts.sum() / teeth.sum()
        working = normal
        for _ in range(60):
            working -= (np.tan(working) - working - target) / np.tan(working) ** 2
        base = self.module * teeth / 2.0 * np.cos(normal)
        tips = self.module * (teeth / 2.0 + 1.0 + shifts)
        whole, pitch = base.sum() * np.tan(working), 2.0 * np.pi * base[0] / teeth[0]
        start = whole - np.sqrt(tips[1] ** 2 - base[1] ** 2)
        end = np.sqrt(tips[0] ** 2 - base[0] ** 2)
        cycle = (np.arange(20000) + 0.5) / 20000
        pinion = start + (cycle[:, None] + np.arange(3)) * pitch  # radius of curvature
        inside, gear = pinion < end, whole - pinion
        sliding = pinion - gear * teeth[0] / teeth[1]  # over the pinion's speed
        rubbing = way * FRICTION * np.sign(sliding)
        load = abs(torque) / np.sum((base[1] + rubbing * gear) * inside, axis=1)
        on_pinion = np.sum((base[0] + rubbing * pinion) * inside, axis=1) * load
        lost = np.sum(FRICTION * np.abs(sliding) * inside, axis=1) * load
        return float(lost.mean()), float(way * on_pinion.mean())


FIRST = Stage(3e-3, (23.0, 69.0), (0.25, -0.1))
SECOND = Stage(4e-3, (23.0, 57.0), (0.25, 0.1))


@pytest.fixture(scope="module")
def case():
    return load_scenario("two-stage-reducer", KEYS)


@pytest.mark.parametrize("load", [1.0, 0.25, -1.0])
def test_both_meshes_lose_what_rigid_involutes_do(case, load: float):
    nominal = LOSSES.nominal(case)
    second, middle = SECOND.losses(load * 1770.0)
    first, driving = FIRST.losses(middle)
    speed = nominal.input_speed * np.array([1.0, 0.0, -0.3])
    points = OperatingPoints(np.full(3, load), speed, np.full(3, nominal.oil_temperature))
    found = LOSSES.at(case, points)
    expected = [first, second * 23.0 / 69.0]
    for row in found.drag:
        assert row == pytest.approx(expected, rel=1e-4)
    assert driving - load * nominal.input_torque == pytest.approx(sum(expected), rel=1e-9)


def test_drags_of_shafts_load_the_meshes_before_them():
    """Palmgren's M_0, seals by ISO/TR 14179-2, a pump: torques of shafts from printed formulas."""
    sizes = {"pinion-1": (35.0, 30.0), "middle": (55.0, None), "wheel-2": (90.0, 70.0)}  # d_m, seal; mm
    losses = {
        "bearings": "palmgren",
        "seals": "iso-14179-2",
        "shaft_bearings": {
            name: {"type": "deep-groove-ball", "mean_diameter": f"{size} mm", "count": 2}
            for name, (size, _) in sizes.items()
        },
        "shaft_seals": {name: {"diameter": f"{seal} mm"} for name, (_, seal) in sizes.items() if seal},
        "pump": {"shaft": "middle", "pressure": "4 bar", "displacement": "5 ml", "efficiency": 0.8},
    }
    case = load_scenario("two-stage-reducer", KEYS | {"losses": losses})
    nominal = LOSSES.nominal(case)
    oil = case.pair.lubricant
    kinematic, turns = 1e6 * oil.inlet_viscosity / oil.density, {}
    torques = {}
    for name, ratio in (("pinion-1", 1.0), ("middle", 1.0 / 3.0), ("wheel-2", nominal.ratio)):
        turns[name] = abs(ratio)
        size, seal = sizes[name]
        rpm = 1480.0 * abs(ratio)
        torques[name] = 2e-3 * 2.0 * 1e-7 * (kinematic * rpm) ** (2.0 / 3.0) * size**3
        if seal:
            torques[name] += 7.69e-6 * seal**2 * 30.0 / np.pi
    torques["middle"] += 4e5 * 5e-6 / (2.0 * np.pi * 0.8)
    second, on_middle = SECOND.losses(1770.0 + torques["wheel-2"])
    first, driving = FIRST.losses(on_middle + torques["middle"])
    found = LOSSES.at(case, _at(nominal, 1.0))
    assert found.drag[0, :2] == pytest.approx([first, second / 3.0], rel=1e-4)
    of_shafts = sum(torque * turns[name] for name, torque in torques.items())
    assert float(found.drag[0, 2:].sum()) == pytest.approx(of_shafts, rel=1e-9)
    assert driving + torques["pinion-1"] - nominal.input_torque == pytest.approx(found.total()[0], rel=1e-4)
    terms = found.by_term()
    pump = 4e5 * 5e-6 / (2.0 * np.pi * 0.8) / 3.0
    assert float(terms["P_VX"][0]) == pytest.approx(pump, rel=1e-12)
    assert sum(float(term[0]) for term in terms.values()) == pytest.approx(found.total()[0], rel=1e-12)


def test_power_in_is_power_out_and_losses(case):
    """By η both ways: with the same loss driven backwards as forwards it were 2 − 1/η."""
    nominal = LOSSES.nominal(case)
    forth, back = (LOSSES.at(case, _at(nominal, load)).total()[0] for load in (1.0, -1.0))
    efficiency = nominal.input_torque / (nominal.input_torque + forth)
    backwards = (nominal.input_torque - back) / nominal.input_torque
    assert FIRST.losses(SECOND.losses(1770.0)[1])[1] == pytest.approx(
        nominal.input_torque / efficiency, rel=1e-6
    )
    loss = 1.0 - efficiency
    assert backwards == pytest.approx(2.0 - 1.0 / efficiency, abs=1.5 * loss**2)


def _at(nominal, load: float) -> OperatingPoints:
    return OperatingPoints(
        np.array([load]), np.array([nominal.input_speed]), np.array([nominal.oil_temperature])
    )
