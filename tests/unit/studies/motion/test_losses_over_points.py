"""Losses of gearboxes at points of operation: against single equilibria, Willis, closed forms, limits."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.three_gearboxes import GEARBOXES
from tests.support.warmed_reducer import NETWORK, temperatures_of
from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.errors import InputError
from tribodyn.gears.tabulated import quasi_static_loss
from tribodyn.studies.motion import TRAIN
from tribodyn.studies.motion.losses.part import LOSSES
from tribodyn.studies.motion.planetary.powers import flow_of
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_data, load_scenario

COULOMB = {"friction.law": "coulomb", "friction.coefficient": 0.05}
#: Of many nodes against some of them, slices and spur teeth.
OF_SLICES, OF_SPUR = 1.5e-3, 5e-6


def points(case, load, speed, oil=None):
    """Points by multiples of the nominal load, speed and, in K, temperature."""
    nominal = LOSSES.nominal(case)
    load, speed = np.broadcast_arrays(np.atleast_1d(load), np.atleast_1d(speed))
    temperature = nominal.oil_temperature if oil is None else oil
    return OperatingPoints(load.astype(float), speed * nominal.input_speed, np.full(load.shape, temperature))


def with_duty(pair, torque, speed):
    """A pair with another torque and speed."""
    return replace(pair, operating=replace(pair.operating, gear_torque=torque, pinion_speed=speed))


@pytest.mark.parametrize(
    ("name", "close"),
    [("cycloidal-23-47", OF_SPUR), ("helical-23-47", OF_SLICES), ("high-contact-ratio", OF_SPUR)],
)
def test_a_mesh_loses_what_it_loses_in_one_equilibrium(name, close):
    case = load_scenario(name)
    pair, tabulated = case.pair, prepare(case).tables[0]
    asked = points(case, [1.0, 0.3, 1.0, -0.6], [1.0, 1.0, 0.2, 0.5])
    found = LOSSES.at(case, asked).power(asked.speed)[:, 0]
    alone = [
        quasi_static_loss(tabulated)(with_duty(pair, load * pair.operating.gear_torque, speed))
        for load, speed in zip(asked.load, asked.speed, strict=True)
    ]
    assert found == pytest.approx(alone, rel=close)


def test_two_stages_are_two_equilibria_the_first_with_the_loss_of_the_second():
    case = load_scenario("two-stage-reducer")
    first, second = prepare(case).tables
    one, two = case.pairs
    found = LOSSES.at(case, points(case, [1.0, -1.0], [1.0, 1.0])).power([one.operating.pinion_speed] * 2)
    for way, row in zip((1.0, -1.0), found, strict=True):
        downstream = quasi_static_loss(second)(
            with_duty(two, way * two.operating.gear_torque, two.operating.pinion_speed)
        )
        torque = way * one.operating.gear_torque + downstream / two.operating.pinion_speed
        upstream = quasi_static_loss(first)(with_duty(one, torque, one.operating.pinion_speed))
        assert row == pytest.approx([upstream, downstream], rel=OF_SPUR)


@pytest.mark.parametrize("name", ["planetary-24-84", "ravigneaux"])
def test_a_planetary_set_loses_what_willis_says(name):
    case = load_scenario(name, COULOMB)
    flow = flow_of(prepare(case))
    found = LOSSES.at(case, points(case, 1.0, 1.0))
    power = found.power([case.source.speed])[0]
    assert sum(power) == pytest.approx(flow.put_in - flow.taken_out, rel=2e-4)
    assert power == pytest.approx(list(flow.loss), rel=2e-4)


def test_a_ring_that_drives_planets_loses_as_much_as_in_one_equilibrium():
    """The carrier is the input and the ring stands: against the carrier the ring drives."""
    duty = {"input": "carrier", "output": "sun", "input_speed": "300 rpm", "output_torque": "100 N*m"}
    case = load_data(
        GEARBOXES["planetary"] | {"operating": duty | {"oil_temperature": "70 degC"}}, "set"
    ).case
    found = LOSSES.at(case, points(case, [1.0, -1.0], 1.0))
    rings = [m for m, mesh in enumerate(case.meshes) if mesh.pair.drive.pinion.teeth < 0]
    assert rings
    for m in rings:
        pair = case.meshes[m].pair
        alone = quasi_static_loss(prepare(case).tables[m])(pair)
        assert found.drag[0, m] * case.source.speed == pytest.approx(alone, rel=0.02)
        assert found.drag[1, m] == pytest.approx(found.drag[0, m], rel=0.03)


def test_power_that_flows_back_has_the_efficiency_of_a_constant_friction():
    case = load_scenario("two-pinions-bull-gear", COULOMB)
    nominal = LOSSES.nominal(case)
    lost = LOSSES.at(case, points(case, [1.0, -1.0], 1.0)).total()
    forth = nominal.input_torque / (nominal.input_torque + lost[0])
    back = (nominal.input_torque - lost[1]) / nominal.input_torque
    assert back == pytest.approx(2.0 - 1.0 / forth, abs=2e-4)


@pytest.mark.parametrize("name", ["involute-23-47", "helical-23-47"])
def test_nothing_jumps_through_rest_and_reversal(name):
    case = load_scenario(name, {"friction.law": "masjedi-khonsari"})
    fine = np.array([-1e-3, -1e-6, 0.0, 1e-6, 1e-3])
    over_speed = LOSSES.at(case, points(case, 0.5, fine)).total()
    assert np.all(over_speed > 0.0)
    assert over_speed == pytest.approx(over_speed[2], rel=1e-12)
    turning = LOSSES.at(case, points(case, 0.5, [-1.0, 1.0])).total()
    assert turning[0] == turning[1]
    over_load = LOSSES.at(case, points(case, fine, 1.0)).total()
    assert over_load[2] == 0.0
    assert np.all(np.diff(np.abs(over_load - over_load[2]))[2:] > 0.0)
    assert over_load[4] < 1e-2 * LOSSES.at(case, points(case, 1.0, 1.0)).total()[0]


def test_a_pair_written_as_a_train_loses_the_same():
    pair, oil = GEARBOXES["pair"], {"oil_temperature": "70 degC"}
    named = {"input": "pinion", "output": "gear", "input_speed": "1480 rpm", "output_torque": "150 N*m"}
    train = pair | {"kind": "gear-train", "operating": oil | named}
    of_both = [load_data(written, "gears").case for written in (pair, train)]
    one, two = (LOSSES.at(case, points(case, [1.0, -0.4, 0.0], [1.0, 0.3, 0.0])) for case in of_both)
    assert one.drag == pytest.approx(two.drag, rel=1e-9)
    assert [source.term for source in one.sources] == [source.term for source in two.sources]


def test_teeth_warm_as_their_losses_say():
    case = load_scenario("two-stage-reducer", NETWORK)
    asked = points(case, [1.0, 0.5], [1.0, 0.7])
    found = LOSSES.at(case, asked)
    for row, bulk in zip(found.power(asked.speed), found.meshes["bulk_temperature"], strict=True):
        _, gears = temperatures_of(row)
        assert bulk == pytest.approx([sum(own) / 2.0 for own in gears], abs=0.05)


def test_teeth_are_as_warm_as_they_are_told():
    case = load_scenario("two-stage-reducer", NETWORK)
    asked = points(case, [1.0], [1.0])._replace(bulk_temperature=np.array([[350.0, 360.0]]))
    assert LOSSES.at(case, asked).meshes["bulk_temperature"].tolist() == [[350.0, 360.0]]


def test_oil_of_one_temperature_is_not_known_at_others():
    case = load_scenario("involute-23-47")
    asked = points(case, [1.0, 1.0], 1.0)._replace(oil_temperature=np.array([300.0, 310.0]))
    with pytest.raises(InputError, match=r"(?s)lubricant.*one temperature.*data sheet"):
        LOSSES.at(case, asked)


@pytest.mark.parametrize(
    ("load", "speed", "oil", "told"),
    [
        ([np.nan], [1.0], 350.0, "load = nan"),
        ([1.0], [np.inf], 350.0, "speed = inf"),
        ([1.0], [1.0], -5.0, "absolute zero"),
        ([], [], 350.0, "no point"),
    ],
)
def test_points_that_are_none_are_refused(load, speed, oil, told):
    with pytest.raises(InputError, match=told):
        LOSSES.at(load_scenario("involute-23-47"), OperatingPoints(load, speed, oil))


def test_a_train_of_constant_stiffness_gives_way_as_springs_in_series():
    keys = {"mesh.compliance": "constant", "mesh.stiffness": "4e8 N/m", "bearings": "rigid-1e9"}
    keys |= {"mesh.backlash": "50 um"}
    case = load_scenario("involute-23-47", keys)
    found = LOSSES.statics(case, [-0.2, 0.0, 1.0])
    radius = float(prepare(case).cycle.gear_pitch_radius) * np.cos(np.radians(20.0))
    count = found.stiffness_mean[0, 0] / (4e8 * np.cos(np.radians(20.0)) ** 2)
    assert 1.0 < count < 2.0  # pairs in contact on the mean
    bearing = 1e9
    expected = radius**2 / (1.0 / (4e8 * count) + 2.0 / bearing)
    assert found.stiffness_total == pytest.approx(expected, rel=0.02)
    assert found.mesh_order.tolist() == [23.0]
    assert found.error_at_output == pytest.approx([np.cos(np.radians(20.0)) / radius], rel=1e-12)
    assert found.backlash == pytest.approx(50e-6 / radius, rel=1e-12)


def test_a_study_of_gearboxes_offers_its_losses():
    assert TRAIN.losses() is LOSSES


def test_regressions_are_held_at_the_friction_of_asperities_where_they_grow_without_bound():
    case = load_scenario("two-pinions-bull-gear", {"friction.law": "iso-14179-1"})
    limit = float(case.pair.lubricant.asperity_friction)
    found = LOSSES.at(case, points(case, [1.0, 1.0, 1e-5], [0.0, 1.0, 1.0]))
    stall, nominal, light = found.meshes["friction_coefficient_mean"]
    assert stall == pytest.approx(limit, rel=1e-9)
    assert light == pytest.approx(limit, rel=1e-9)
    assert np.all(nominal < limit)
    assert all("held at the friction of asperities" in "; ".join(limits) for limits in found.exceeded)


@pytest.mark.parametrize("name", ["helical-23-47", "involute-23-47"])
def test_back_flanks_that_carry_nothing_lose_nothing(name):
    both = [load_scenario(name), load_scenario(name, {"mesh.backlash": "80 um"})]
    one, two = (LOSSES.at(case, points(case, [1.0, -0.5], [1.0, 0.5])).drag for case in both)
    assert two == pytest.approx(one, rel=1e-9)


def test_loads_beyond_those_of_the_tables_are_told():
    """Teeth share 100 times the load as they share 10 times, which is told."""
    case = load_scenario("involute-18-36")
    found = [LOSSES.at(case, points(case, load, 1.0, 333.15)).exceeded for load in (10.0, -9.0, 100.0, -11.0)]
    assert [any("10 times" in limit for limit in one[0]) for one in found] == [False, False, True, True]
