"""The case of a train's scenario: hand counts, turned outlines in their places, and the pair as a train."""

import tomllib
from fractions import Fraction
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

from tests.support.train_scenarios import REDUCER, train_case
from tests.support.turning_outlines import Turning, assert_touching
from tribodyn.errors import InputError
from tribodyn.geometry.body import body_masses
from tribodyn.studies.gear_train.assembled import (
    assemblies,
    body_inertias,
    link_damping,
    phases,
    table_numbers,
)
from tribodyn.studies.gear_train.case import HOUSING, Case, refuse_long_period
from tribodyn.studies.gears.prepare import assembled
from tribodyn.studies.protocol.load import load_scenario


@pytest.fixture
def reduced(tmp_path: Path):
    """Make the case of the reducer with other tables or keys: dotted keys to values."""

    def made(overrides: dict[str, Any] | None = None, **tables: Any) -> Case:
        path = tmp_path / "reducer.toml"
        path.write_text(tomli_w.dumps(REDUCER | tables), encoding="utf-8")
        return train_case(path, overrides)

    return made


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
    found = body_inertias(case, pairs)
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


def assert_teeth_touch(case: Case) -> None:
    """Turn all outlines of a train in their places, by the same time."""
    pairs = assemblies(case)
    put = phases(case, pairs)
    centres = np.array([body.centre for body in case.bodies])
    for number, (mesh, pair) in enumerate(zip(case.meshes, pairs, strict=True)):
        apart = centres[mesh.driven] - centres[mesh.driver]
        assert np.hypot(*apart) == pytest.approx(pair.path.pinion_pitch_radius + pair.path.gear_pitch_radius)
        assert np.cos(np.arctan2(*apart[::-1]) - mesh.azimuth) == pytest.approx(1.0)
        driver = case.bodies[mesh.driver]
        teeth = put.teeth[mesh.gears[0]], put.teeth[mesh.gears[1]]
        ratio = float(driver.ratio)
        turning = Turning(pair, mesh.azimuth, driver.sense, teeth, put.meshes[number])
        assert_touching(turning, [ratio * turn for turn in (0.0, 0.07, 1.9)])
        # after the common period every mesh is where it was
        assert mesh.rate * case.period == int(mesh.rate * case.period)


@pytest.mark.parametrize("sense", ["clockwise", "counter-clockwise"])
@pytest.mark.parametrize("angle", ["0 deg", "5.3 deg"])
def test_the_teeth_of_a_reducer_touch(reduced, sense, angle):
    assert_teeth_touch(reduced({"operating.sense": sense, "gear.pinion-2.tooth_angle": angle}))


def split(angle: str | None = None) -> dict[str, Any]:
    """One pinion, two compound shafts above and below, one bull gear."""
    gear = {"face_width": "30 mm"}
    turned = {} if angle is None else {"tooth_angle": angle}
    stage = {"module": "3 mm", "pressure_angle": "20 deg"}
    return {
        "gear": {
            "pinion": {"teeth": 20, **gear},
            "up-1": {"teeth": 40, **gear},
            "up-2": {"teeth": 21, **gear},
            "down-1": {"teeth": 40, **gear},
            "down-2": {"teeth": 21, **gear, **turned},
            "bull": {"teeth": 90, **gear},
        },
        "stage": [
            {"gears": ["pinion", "up-1"], "azimuth": "100 deg", **stage},
            {"gears": ["pinion", "down-1"], "azimuth": "-100 deg", **stage},
            # 90 mm sin(100°) = 166.5 mm sin(32.16°)
            {"gears": ["up-2", "bull"], "azimuth": "-32.1632 deg", **stage},
            {"gears": ["down-2", "bull"], **stage},
        ],
        "shaft": [
            {"name": "up", "gears": ["up-1", "up-2"]},
            {"name": "down", "gears": ["down-1", "down-2"]},
        ],
        "operating": REDUCER["operating"] | {"input": "pinion", "output": "bull"},
    }


def test_a_train_of_two_ways_goes_together_with_the_angle_that_is_said(reduced):
    with pytest.raises(InputError) as caught:
        reduced(**split())
    (error,) = caught.value.errors  # pyright: ignore[reportAttributeAccessIssue]
    assert error.key == "stage.3"
    assert "do not meet" in error.rule
    said = error.remedy.partition('tooth_angle = "')[2].partition('"')[0]
    case = reduced(**split(said))
    assert [mesh.driven for mesh in case.meshes] == [1, 2, 3, 3]
    torques = [mesh.pair.operating.gear_torque for mesh in case.meshes]
    assert torques == pytest.approx([1800 * 21 / 90 / 2] * 2 + [900] * 2)
    # both ways are the same pairs, each with one table
    assert table_numbers(case) == (0, 0, 1, 1)


def test_a_drive_is_a_train_of_one_stage(tmp_path: Path):
    """The same pair, oil, bearings and duty as of a gear pair, in the same axes."""
    pair = load_scenario("spur-25-51")
    table = tomllib.loads(pair.toml)
    operating = {
        "input_speed": table["operating"]["pinion_speed"],
        "output_torque": table["operating"]["gear_torque"],
        "oil_temperature": table["operating"]["oil_temperature"],
    }
    kept = {
        name: table[name]
        for name in ("title", "lubricant", "bearings", "drive", "mesh", "friction", "solver")
    }
    path = tmp_path / "train.toml"
    path.write_text(tomli_w.dumps({"kind": "gear-train", **kept, "operating": operating}), encoding="utf-8")
    case = train_case(path)
    (mesh,) = case.meshes
    for name in ("family", "drive", "materials", "masses", "roughness", "mean_roughness", "mesh", "quality"):
        assert getattr(mesh.pair, name) == getattr(pair, name), name
    for name in ("lubricant", "film", "friction"):
        assert getattr(mesh.pair, name) == getattr(pair, name), name
    assert mesh.pair.operating.gear_torque == pytest.approx(pair.operating.gear_torque)
    assert case.solver == pair.solver
    assert [body.sense for body in case.bodies] == [-1, 1]
    assert case.bodies[1].centre[0] == pytest.approx(0.0, abs=1e-15)
    assert case.bodies[1].centre[1] > 0.0
    for link, bearing in zip(case.links, pair.bearings, strict=True):
        assert link.stiffness == (bearing.stiffness_x, bearing.stiffness_y, 0.0)
    wanted = body_masses(
        assembled(pair), [(one.mass, one.inertia) for one in pair.masses], [m.density for m in pair.materials]
    )
    assert body_inertias(case, assemblies(case)) == wanted


BARE = {
    "gear": {},
    "stage": [],
    "shaft": [],
    "body": [
        {"name": "motor", "mass": "30 kg", "inertia": "0.1 kg*m**2"},
        {"name": "a", "mass": "2 kg", "inertia": "2e-3 kg*m**2"},
        {"name": "b", "mass": "4 kg", "inertia": "8e-3 kg*m**2"},
        {"name": "c", "mass": "3 kg", "inertia": "4e-3 kg*m**2"},
    ],
    "link": [{"ends": ["motor", "a"], "stiffness": "1e4 N*m/rad", "damping": "2 N*m*s/rad"}],
    "mesh": [
        {
            "bodies": bodies,
            "teeth": teeth,
            "module": "3 mm",
            "pressure_angle": "20 deg",
            "face_width": "20 mm",
            "stiffness": "2e8 N/m",
            "damping_ratio": 0.05,
        }
        for bodies, teeth in ((["a", "b"], [20, 40]), (["c", "b"], [30, 40]))
    ],
    "operating": REDUCER["operating"] | {"input": "motor", "output": "c", "output_torque": "90 N*m"},
}


def test_a_bare_model_of_bodies_links_and_meshes(reduced):
    case = reduced(**BARE)
    assert [body.name for body in case.bodies] == ["a", "motor", "b", "c"]
    assert case.source.body == 1
    assert case.source.torque == pytest.approx(60.0)
    assert [(mesh.driver, mesh.driven) for mesh in case.meshes] == [(0, 2), (2, 3)]
    # the teeth of b are one gear, an idler
    assert [gear.name for gear in case.gears] == ["a", "b", "c"]
    assert [mesh.pair.mesh.compliance for mesh in case.meshes] == ["constant"] * 2
    assert [mesh.pair.operating.gear_torque for mesh in case.meshes] == pytest.approx([120.0, 90.0])
    assert body_inertias(case, assemblies(case)) == ((2.0, 2e-3), (30.0, 0.1), (4.0, 8e-3), (3.0, 4e-3))
    spring = case.links[-1]
    assert (spring.ends, spring.stiffness, spring.damping) == ((1, 0), (0.0, 0.0, 1e4), (0.0, 0.0, 2.0))
    assert_teeth_touch(case)


def test_a_flywheel_and_loads_of_several_bodies(reduced):
    body = [{"name": "flywheel", "mass": "20 kg", "inertia": "0.3 kg*m**2"}]
    link = [{"ends": ["flywheel", "wheel-2"], "stiffness": "1e5 N*m/rad"}]
    load = [{"at": "middle", "torque": "30 N*m", "damping": "0.1 N*m*s/rad"}]
    case = reduced(body=body, link=link, load=load)
    assert case.bodies[3].centre == case.bodies[2].centre
    assert [(one.body, one.torque) for one in case.loads] == [(2, 1800.0), (1, 30.0)]
    assert case.source.torque == pytest.approx(1800 * 23 / 171 + 30 / 3)


def test_loads_without_an_output(reduced):
    operating = {key: value for key, value in REDUCER["operating"].items() if "output" not in key}
    load = [{"at": "wheel-2", "torque": "1800 N*m", "inertia": "2 kg*m**2"}]
    case = reduced(operating=operating, load=load)
    assert case.loads == reduced().loads
    assert case.source == reduced().source
    assert case.bodies[2].inertia == 2.0
    motor = {"source": "torque", "drive_inertia": "0.1 kg*m**2", "input_torque": "300 N*m"}
    assert reduced(operating=operating | motor, load=load).source.torque == 300.0


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
