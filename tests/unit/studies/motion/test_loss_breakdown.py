"""Losses by term and element in `check` and runs: they add up, and one point summed by hand says the same."""

import math

import pytest

from tests.support.three_gearboxes import GEARBOXES
from tribodyn.gears.prepare import wheels_of
from tribodyn.gears.tabulated import quasi_static_loss
from tribodyn.record.reader import Record
from tribodyn.studies.motion.check import check
from tribodyn.studies.motion.losses.breakdown import loss_table
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.report import tables
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.studies.protocol.run import run

DRAG = {"type": "tapered-roller", "mean_diameter": "60 mm"}
IDLE = {
    "losses": {
        "churning": "iso-14179-1",
        "windage": "anderson-loewenthal",
        "bearings": "palmgren",
        "immersion": {"wheel-1": "20 mm", "wheel-2": "40 mm"},
        "shaft_bearings": {"middle": DRAG, "wheel-2": DRAG},
    }
}


def adds_up(losses):
    """Terms are the sums of elements, and what goes in comes out or is lost."""
    elements = losses["elements"]
    elements = elements if isinstance(elements, list) else list(elements.values())
    for term, power in losses["terms"].items():
        of_term = [each["power"] for each in elements if each["term"] == term]
        assert power == pytest.approx(sum(of_term), rel=1e-12)
    assert losses["power_lost"] == pytest.approx(sum(losses["terms"].values()), rel=1e-12)
    assert losses["power_in"] == pytest.approx(losses["power_out"] + losses["power_lost"], rel=1e-12)
    assert losses["efficiency"] == pytest.approx(losses["power_out"] / losses["power_in"], rel=1e-12)


@pytest.mark.parametrize("gearbox", GEARBOXES)
def test_every_gearbox_is_in_balance(gearbox):
    checked = check(load_data(GEARBOXES[gearbox], gearbox).case)
    losses = checked.data["losses"]
    adds_up(losses)
    assert losses["terms"]["P_VZP"] > 0.0
    assert any(table.title == "Losses by term and element" for table in checked.tables)


def test_one_point_summed_by_hand():
    case = load_scenario("two-stage-reducer", IDLE)
    losses = check(case).data["losses"]
    first, second = case.pairs
    tables = prepare(case).tables
    oil = case.pair.lubricant
    viscosity, density = float(oil.inlet_viscosity), float(oil.density)
    speeds = [first.operating.pinion_speed, second.operating.pinion_speed]
    speeds.append(speeds[1] * 23 / 57)

    def churned(wheel, speed):
        """ISO/TR 14179-1 by another hand, W."""
        diameter, dip = 2e3 * wheel.tip_radius, wheel.immersion / (2.0 * wheel.tip_radius)
        width, module = 1e3 * wheel.face_width, 1e3 * wheel.module
        common = dip * 1e6 * viscosity / density * (speed * 30.0 / math.pi) ** 3 / (0.2 * 1e26)
        teeth = (
            7.37 * diameter**4.7 * width * (7.93 - 4.648 / module) / math.sqrt(math.tan(math.radians(10.0)))
        )
        return 1e3 * common * (teeth + 1.474 * diameter**5.7)

    def dragged(speed):
        """Two bearings of f_0 = 6 and 60 mm by Palmgren, W."""
        flow = max(1e6 * viscosity / density * speed * 30.0 / math.pi, 2000.0)
        return 2.0 * 1e-3 * 1e-7 * 6.0 * 60.0**3 * flow ** (2.0 / 3.0) * speed

    of_wheels = [wheels_of(pair, table.assembly)[1] for pair, table in zip(case.pairs, tables, strict=True)]
    churning = sum(churned(wheel, speed) for wheel, speed in zip(of_wheels, speeds[1:], strict=True))
    by_method = {}
    for each in losses["elements"]:
        by_method[each["method"]] = by_method.get(each["method"], 0.0) + each["power"]
    assert by_method["iso-14179-1"] == pytest.approx(churning, rel=1e-9)
    assert losses["terms"]["P_VL0"] == pytest.approx(dragged(speeds[1]) + dragged(speeds[2]), rel=1e-4)
    alone = sum(quasi_static_loss(table)(pair) for table, pair in zip(tables, case.pairs, strict=True))
    # the meshes carry the drags besides
    assert losses["terms"]["P_VZP"] == pytest.approx(alone, rel=0.02)
    assert losses["terms"]["P_VZP"] > alone
    assert losses["power_out"] == pytest.approx(1770.0 * speeds[2], rel=1e-9)


def test_a_pair_and_its_train_lose_the_same_everywhere():
    pair = GEARBOXES["pair"]
    named = {"input": "pinion", "output": "gear", "input_speed": "1480 rpm", "output_torque": "150 N*m"}
    train = pair | {"kind": "gear-train", "operating": {"oil_temperature": "70 degC"} | named}
    churning = {"churning": "iso-14179-1", "bearings": "palmgren"}
    of_pair = {"gear_immersion": "20 mm", "pinion_bearings": DRAG, "gear_bearings": DRAG}
    of_train = {"immersion": {"gear": "20 mm"}, "shaft_bearings": {"pinion": DRAG, "gear": DRAG}}
    one, two = (
        check(load_data(written | {"losses": churning | keys}, "gears").case).data["losses"]
        for written, keys in ((pair, of_pair), (train, of_train))
    )
    for a, b in zip(one["elements"], two["elements"], strict=True):
        assert a["power"] == pytest.approx(b["power"], rel=1e-9)
        assert (a["term"], a["sort"], a["method"]) == (b["term"], b["sort"], b["method"])
    assert one["efficiency"] == pytest.approx(two["efficiency"], rel=1e-12)


def test_a_run_has_the_friction_of_its_motion(tmp_path):
    case = load_scenario("two-stage-reducer", IDLE | {"solver.cycles": 4, "output.samples_per_cycle": 40})
    done = run(case, tmp_path / "run.h5")
    losses = done.summary["losses"]
    adds_up(losses)
    friction = [mesh["power_friction_mean"] for mesh in done.summary["meshes"].values()]
    assert losses["terms"]["P_VZP"] == pytest.approx(sum(friction), rel=1e-12)
    assert losses["efficiency"] == pytest.approx(done.summary["efficiency_with_losses"], rel=1e-9)
    still = check(case).data["losses"]["terms"]
    for term in ("P_VZ0", "P_VL0"):
        assert losses["terms"][term] == pytest.approx(still[term], rel=1e-12)
    with Record(tmp_path / "run.h5") as record:
        assert loss_table(losses) in tables(record)
