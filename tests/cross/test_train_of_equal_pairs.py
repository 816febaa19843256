"""Trains that are one pair, or one pair twice: what the equations of a pair say holds in them."""

import tomllib
from typing import Any

import numpy as np
import pytest

from tests.support.states import random_place, random_state, sampled
from tests.support.train_scenarios import REDUCER, case_of_table
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import rotational_error, turn_of

SAMPLES = 40
#: Of runs whose rounding differs, or their step control by having other states: what the steps add up to.
RTOL, NEAR = 1e-11, 1e-7


def motion(model, cycles, rtol=RTOL, start=None, method="dopri5"):
    return sampled(model, TransientSettings(method, rtol, cycles, 10**6, SAMPLES), start)[1]


def furthest(found, expected):
    """Of every column from the other, over the maximum of that."""
    scale = np.maximum(np.max(np.abs(expected), axis=0), 1e-300)
    return np.max(np.max(np.abs(found - expected), axis=0) / scale)


# One stage is a pair.


def as_train(name: str, **overrides: Any) -> dict[str, Any]:
    """A scenario of a pair as that of a train of one stage."""
    table = tomllib.loads(load_scenario(name, overrides).toml)
    named = {"pinion_speed": "input_speed", "gear_torque": "output_torque"}
    operating = {named.get(key, key): value for key, value in table["operating"].items() if value != []}
    kept = ("title", "lubricant", "bearings", "drive", "mesh", "film", "friction", "temperature", "solver")
    return {"kind": "gear-train", "operating": operating} | {key: table[key] for key in kept if key in table}


PAIRS = [
    ("crc-23-47", {"operating.pinion_speed": "300 rad/s"}),
    ("crc-23-47", {"friction.sliding": "dynamic", "mesh.hertz": "load-dependent"}),
    ("spur-25-51", {}),
    ("jump-involute-23-47", {}),
    (
        "involute-18-36",
        {
            "operating.source": "torque",
            "operating.drive_inertia": "0.02 kg*m**2",
            "operating.load_inertia": "0.1 kg*m**2",
            "mesh.backlash": "40 um",
        },
    ),
    (
        "involute-18-36",
        {
            "operating.source": "torque",
            "operating.drive_inertia": "0.02 kg*m**2",
            "operating.shaft_stiffness": "3000 N*m/rad",
            "operating.shaft_damping": "0.5 N*m*s/rad",
            "operating.speed_regulation": "0.5 N*m*s/rad",
        },
    ),
]


@pytest.mark.parametrize(("name", "overrides"), PAIRS)
def test_a_train_of_one_stage_is_the_pair(prepared, name, overrides):
    """The same derivatives at random states to rounding, and so the same run, tried with two bodies."""
    pair = prepared(name, **overrides).model
    train = prepare(case_of_table(as_train(name, **overrides))).model
    assert train.layout == pair.layout
    rng = np.random.default_rng(7)
    for _ in range(20):
        phase, interval = random_place(rng, pair.schedule)
        y = random_state(rng, pair, float(pair.operation.nominal_speed))
        expected = accelerations(y, phase, interval, pair)
        np.testing.assert_allclose(
            accelerations(y, phase, interval, train),
            expected,
            rtol=1e-9,
            atol=1e-12 * np.max(np.abs(expected)),
        )
    if "operating.shaft_stiffness" not in overrides:  # a third body's would be machine code of its own
        assert furthest(motion(train, 2), motion(pair, 2)) < NEAR


# The same teeth, placed elsewhere or twice.

#: A pinion and a wheel that give their masses.
MASSES = {"pinion": ("2 kg", 2e-3), "wheel": ("5 kg", 1.2e-2)}
STIFFNESS = 4e8


def gear(which: str, share: float = 1.0, **keys: Any) -> dict[str, Any]:
    """A gear with a share of its inertia."""
    mass, inertia = MASSES[which]
    teeth = {"pinion": 24, "wheel": 36}[which]
    own = {"mass": mass, "inertia": f"{share * inertia} kg*m**2"}
    return {"teeth": teeth, "face_width": "30 mm", **own, **keys}


def stage(one: str, two: str, azimuth: float) -> dict[str, Any]:
    place = {"module": "3 mm", "pressure_angle": "20 deg", "azimuth": f"{azimuth} deg"}
    return {"gears": [one, two], **place}


def bearing(times: float = 1.0) -> dict[str, Any]:
    stiffness = {f"stiffness_{axis}": f"{times * STIFFNESS} N/m" for axis in "xy"}
    return {**stiffness, "damping_ratio": 0.05}


def train_of(gears, stages, shafts=(), bearings=None, law="coulomb", loads=(), **operating):
    return prepare(
        case_of_table(
            REDUCER
            | {
                "gear": gears,
                "stage": stages,
                "shaft": list(shafts),
                "bearings": bearings or {},
                "load": list(loads),
                "friction": {"law": law} | ({} if law == "none" else {"coefficient": 0.06}),
                "operating": {
                    "input": next(iter(gears)),
                    "output": list(gears)[-1],
                    "input_speed": "1480 rpm",
                    "output_torque": "400 N*m",
                    "oil_temperature": "70 degC",
                }
                | operating,
            }
        )
    ).model


def single(azimuth: float = 90.0, bearings: dict[str, Any] | None = None, **operating: Any):
    gears = {"pinion": gear("pinion"), "wheel": gear("wheel")}
    return train_of(gears, [stage("pinion", "wheel", azimuth)], bearings=bearings, **operating)


@pytest.mark.parametrize("azimuth", [0.0, 37.0, -160.0])
@pytest.mark.parametrize("sense", ["clockwise", "counter-clockwise"])
def test_a_pair_moves_alike_wherever_it_stands(azimuth, sense):
    """Turned, and mirrored about the line of centres where it turns the other way round."""
    bearings = {"default": bearing()}
    expected = motion(single(bearings=bearings), 3)
    found = motion(single(azimuth, bearings, sense=sense), 3)
    angle = np.radians(azimuth)
    outwards, sideways = np.array([np.cos(angle), np.sin(angle)]), np.array([np.sin(angle), -np.cos(angle)])
    if sense != "clockwise":
        sideways = -sideways
    turned = found.copy()
    for x in (0, 3, 6, 9):
        turned[:, x], turned[:, x + 1] = found[:, x : x + 2] @ sideways, found[:, x : x + 2] @ outwards
    assert furthest(turned, expected) < NEAR


def twice(azimuths=(90.0, 90.0), bearings=None, turned="0 deg", **operating):
    """Two pinions on a rigid shaft, each with a wheel and a load."""
    gears = {
        "pinion-1": gear("pinion", 0.5),
        "wheel-1": gear("wheel"),
        "pinion-2": gear("pinion", 0.5, plane=2, tooth_angle=turned),
        "wheel-2": gear("wheel", plane=2),
    }
    stages = [stage(f"pinion-{i}", f"wheel-{i}", azimuth) for i, azimuth in enumerate(azimuths, start=1)]
    shaft = {"name": "shaft", "gears": ["pinion-1", "pinion-2"]}
    return train_of(
        gears, stages, [shaft], bearings, loads=[{"at": "wheel-1", "torque": "400 N*m"}], **operating
    )


def test_two_equal_meshes_side_by_side_move_as_one():
    """On a shaft of twice the mass and bearings, with the inertia that damps the mesh of one pair."""
    pair = motion(single(bearings={"default": bearing()}), 4)
    both = twice(bearings={"default": bearing(), "shaft": bearing(2.0)})
    assert both.layout.bodies == 3
    assert len(both.schedule.start) == 2  # the meshes change together
    found = motion(both, 4)
    for wheel in (3, 6):
        places = [0, 1, *range(wheel, wheel + 3)]
        places += [both.layout.half + i for i in places]
        assert furthest(found[:, places], pair[:, [0, 1, 3, 4, 5, 6, 7, 9, 10, 11]]) < NEAR
    # the shaft's loss is shared equally
    assert found[-1, -4:].tolist() == pytest.approx([*pair[-1, -2:], *pair[-1, -2:]], rel=1e-8)


def test_opposite_equal_meshes_leave_their_shaft_at_rest():
    """Of an even number of teeth: their forces cancel, and the wheels move point to point."""
    both = twice((0.0, 180.0), bearings={"default": bearing()})
    found, half = motion(both, 4), both.layout.half
    moved = np.max(np.abs(found[:, 3:5]))
    assert np.max(np.abs(found[:, :2])) < 1e-9 * moved
    assert furthest(found[:, [3, 4]], -found[:, [6, 7]]) < NEAR
    assert furthest(found[:, [5, half + 5]], found[:, [8, half + 8]]) < NEAR


def test_a_mesh_half_a_cycle_later_moves_half_a_cycle_later():
    """Torsional, with a held shaft between: each mesh is a pair for itself, as where both are in phase."""
    half_tooth = f"{0.5 * 360.0 / 24} deg"
    both, together = twice(turned=half_tooth, law="none"), twice(law="none")
    assert both.layout.planar == 0
    assert both.schedule.offset[0, 1] % 1.0 == pytest.approx(0.5)
    alone, half = motion(together, 6), together.layout.half
    start = static_equilibrium(both)
    # wheel 2 starts as wheel 1 is half a cycle after its start
    second = turn_of(2, both.layout)
    start[[second, both.layout.half + second]] = alone[SAMPLES // 2, [1, half + 1]]
    found = motion(both, 4, start=start)
    whole = len(found)
    first = [1, both.layout.half + 1]
    assert furthest(found[:, first], alone[:whole, [1, half + 1]]) < NEAR
    later = alone[SAMPLES // 2 : SAMPLES // 2 + whole, [1, half + 1]]
    assert furthest(found[:, [second, both.layout.half + second]], later) < NEAR


def test_two_equal_stages_in_series_rest_as_the_pair_at_each_mesh():
    """At any phase, each under its own torque, without friction, which would take from the first mesh's."""
    gears = {
        "pinion": gear("pinion"),
        "wheel-1": gear("wheel"),
        "pinion-2": gear("pinion", plane=2),
        "wheel": gear("wheel", plane=2),
    }
    shaft = {"name": "shaft", "gears": ["wheel-1", "pinion-2"]}
    stages = [stage("pinion", "wheel-1", 0.0), stage("pinion-2", "wheel", 30.0)]
    series = train_of(gears, stages, [shaft], law="none")
    torques = (400.0 * 24 / 36, 400.0)
    pairs = [single(law="none", output_torque=f"{torque} N*m") for torque in torques]
    rng = np.random.default_rng(3)
    assert series.schedule.rate.tolist() == pytest.approx([1.0, 2.0 / 3.0])
    for _ in range(30):
        phase, interval = random_place(rng, series.schedule)
        y = static_equilibrium(series, phase, interval)
        for m, pair in enumerate(pairs):
            own = np.array([series.schedule.rate[m] * phase + series.schedule.offset[interval, m]])
            _, at, segment = interval_of(own, pair.schedule)
            alone = static_equilibrium(pair, float(at[0]), int(segment[0]))
            expected = float(rotational_error(alone, 0, pair))
            assert float(rotational_error(y, m, series)) == pytest.approx(expected, rel=1e-9)
