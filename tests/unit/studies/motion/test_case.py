"""The case of a train's scenario: hand counts, turned outlines in their places, and the pair as a train."""

from fractions import Fraction
from math import pi

import numpy as np
import pytest

from tests.support.train_scenarios import REDUCER
from tests.support.turning_outlines import assert_teeth_touch
from tribodyn.errors import InputError
from tribodyn.geometry.body import body_masses
from tribodyn.input.sources import find_scenario, read_toml
from tribodyn.studies.motion.assembly import assemblies, body_inertias, link_damping
from tribodyn.studies.motion.case import HOUSING, refuse_long_period
from tribodyn.studies.protocol.load import load_data, load_scenario


def test_speeds_senses_and_torques_of_a_two_stage_reducer(reduced):
    case = reduced()
    assert [body.name for body in case.bodies] == ["pinion-1", "middle", "wheel-2"]
    assert [body.ratio for body in case.bodies] == [1, Fraction(1, 3), Fraction(23, 171)]
    assert [body.sense for body in case.bodies] == [-1, 1, -1]
    assert [body.gears for body in case.bodies] == [(0,), (1, 2), (3,)]
    assert [(mesh.driver, mesh.driven, mesh.rate) for mesh in case.meshes] == [
        (0, 1, 1),
        (1, 2, Fraction(1, 3)),
    ]
    assert case.period == 3
    speed = 1480 * pi / 30
    assert case.source.speed == pytest.approx(speed)
    assert case.source.torque == pytest.approx(1800 * 23 / 171)
    pairs = [mesh.pair.operating for mesh in case.meshes]
    assert [pair.gear_torque for pair in pairs] == pytest.approx([1800 * 23 / 57, 1800])
    assert [pair.pinion_speed for pair in pairs] == pytest.approx([speed, speed / 3])
    assert [link.ends for link in case.links] == [(0, HOUSING), (1, HOUSING), (2, HOUSING)]


@pytest.mark.parametrize(
    "given",
    [
        {"operating.input_torque": f"{1800 * 23 / 171!r} N*m"},
        {"operating.power": f"{1800 * 23 / 171 * 1480 * pi / 30!r} W"},
    ],
)
def test_the_same_duty_however_it_is_given(reduced, given):
    operating = {key: value for key, value in REDUCER["operating"].items() if key != "output_torque"}
    del operating["input_speed"]
    speed = f"{1480 * 23 / 171!r} rpm"
    case = reduced(given, operating=operating | {"output_speed": speed})
    assert case.loads[0].torque == pytest.approx(1800)
    assert case.source.speed == pytest.approx(1480 * pi / 30)


def test_a_stage_may_name_its_gears_in_either_order(reduced):
    """The azimuth is from the first gear named to the second: turned by half a turn it is the same train."""
    turned = [dict(stage) for stage in REDUCER["stage"]]
    turned[1] |= {"gears": turned[1]["gears"][::-1], "azimuth": "-150 deg"}
    one, two = reduced(), reduced(stage=turned)
    for ours, theirs in zip(one.meshes, two.meshes, strict=True):
        assert (ours.driver, ours.driven, ours.gears) == (theirs.driver, theirs.driven, theirs.gears)
        assert ours.azimuth == pytest.approx(theirs.azimuth)
        assert ours.pair.drive == theirs.pair.drive
    for body, other in zip(one.bodies, two.bodies, strict=True):
        assert body.centre == pytest.approx(other.centre)


def test_masses_are_those_of_the_gears_and_what_is_fixed_to_them(reduced):
    shaft = [dict(REDUCER["shaft"][0], mass="2 kg", inertia="1e-3 kg*m**2")]
    case = reduced({"operating.load_inertia": "0.5 kg*m**2", "gear.pinion-2.mass": "3 kg"}, shaft=shaft)
    pairs = assemblies(case)
    first, second = (
        body_masses(pair, [(None, None)] * 2, [mesh.pair.materials[0].density] * 2)
        for pair, mesh in zip(pairs, case.meshes, strict=True)
    )
    found = [body[:2] for body in body_inertias(case, pairs)]
    assert found[0] == pytest.approx(first[0])
    assert found[1] == pytest.approx((first[1][0] + 3.0 + 2.0, first[1][1] + second[0][1] + 1e-3))
    assert found[2] == pytest.approx((second[1][0], second[1][1] + 0.5))


def test_a_compliant_shaft_is_two_bodies_and_a_spring(reduced):
    shaft = [
        dict(
            REDUCER["shaft"][0],
            stiffness="1e5 N*m/rad",
            damping_ratio=0.1,
            mass="2 kg",
            inertia="1e-2 kg*m**2",
        )
    ]
    case = reduced(shaft=shaft)
    assert [body.name for body in case.bodies] == ["pinion-1", "wheel-1", "pinion-2", "wheel-2"]
    assert case.bodies[1].ratio == case.bodies[2].ratio == Fraction(1, 3)
    assert case.bodies[1].centre == case.bodies[2].centre
    assert [body.inertia for body in case.bodies] == [0.0, 5e-3, 5e-3, 0.0]
    (spring,) = (link for link in case.links if link.ends[1] != HOUSING)
    assert (spring.name, spring.ends, spring.stiffness) == ("middle", (1, 2), (0.0, 0.0, 1e5))
    bodies = body_inertias(case, assemblies(case))
    one, two = bodies[1].inertia, bodies[2].inertia
    wanted = 2 * 0.1 * np.sqrt(1e5 * one * two / (one + two))
    assert link_damping(spring, bodies) == pytest.approx((0.0, 0.0, wanted))


@pytest.mark.parametrize("sense", ["clockwise", "counter-clockwise"])
@pytest.mark.parametrize("angle", ["0 deg", "5.3 deg"])
def test_the_teeth_of_a_reducer_touch(reduced, sense, angle):
    assert_teeth_touch(reduced({"operating.sense": sense, "gear.pinion-2.tooth_angle": angle}))


def test_a_motor_without_a_spring_is_part_of_the_input(reduced):
    given = {"operating.source": "torque", "operating.drive_inertia": "0.2 kg*m**2"}
    assert reduced(given).bodies[0].inertia == pytest.approx(0.2)
    shaft = {"operating.shaft_stiffness": "1e4 N*m/rad"}
    assert reduced(given | shaft).bodies[0].inertia == 0.0


def test_how_long_a_common_period_may_be(reduced):
    gear = {name: dict(table) for name, table in REDUCER["gear"].items()}
    gear["wheel-1"]["teeth"] = 70
    case = reduced(gear=gear)
    assert case.period == 70
    refuse_long_period(case)
    short = reduced({"solver.max_period": 69}, gear=gear)
    with pytest.raises(InputError, match=r"max_period = 69: .* after 70 cycles of the mesh pinion-1-wheel-1"):
        refuse_long_period(short)


def test_tooth_families_may_be_mixed_between_stages(reduced):
    gear = {name: dict(table) for name, table in REDUCER["gear"].items()}
    for name in ("pinion-1", "wheel-1"):
        del gear[name]["profile_shift"]
    stage = [dict(one) for one in REDUCER["stage"]]
    del stage[0]["pressure_angle"]
    stage[0] |= {
        "family": "cycloidal",
        "shape": {"approach_circle": "24 mm", "recess_circle": "24 mm"},
    }
    case = reduced(gear=gear, stage=stage)
    assert [mesh.pair.family for mesh in case.meshes] == ["cycloidal", "involute"]
    assert_teeth_touch(case)


def test_every_mesh_of_a_stage_may_have_a_stiffness():
    """Those of the sun and of the ring differ; what no stage says is that of [mesh]."""
    data = read_toml(find_scenario("planetary-24-84"))
    constant = {"compliance": "constant", "stiffness": "2e8 N/m", "damping_ratio": 0.07}
    data["mesh"], stage = constant, data["stage"][0]
    stage["sun_stiffness"] = "4e8 N/m"
    meshes = load_data(data, "set").case.meshes
    assert {mesh.pair.mesh.stiffness for mesh in meshes if "sun" in mesh.name} == {4e8}
    assert {mesh.pair.mesh.stiffness for mesh in meshes if "ring" in mesh.name} == {2e8}
    stage["ring_stiffness"] = "5e8 N/m"
    meshes = load_data(data, "set").case.meshes
    assert {mesh.pair.mesh.stiffness for mesh in meshes if "ring" in mesh.name} == {5e8}
    with pytest.raises(InputError, match=r"stage\.1\.stiffness .* contradicts mesh\.compliance"):
        load_scenario("two-stage-reducer", {"stage.1.stiffness": "4e8 N/m"})
