"""Natural frequencies of trains: matrices assembled by hand in another frame, and closed forms."""

import numpy as np
import pytest

from tests.support.spring_trains import Gears, scenario_of, spring_model
from tests.support.train_closed_forms import (
    elastic_two_stage,
    fixed_free_chain,
    free_chain,
    planar_idler_determinant,
    torsional_idler,
)
from tests.support.train_matrices import (
    Bearing,
    Body,
    Mesh,
    Shaft,
    Train,
    free_coordinates,
    natural_frequencies,
    normal,
    rotations,
)
from tests.support.two_stage_histories import DAMPING_RATIO, MODULES, TEETH, two_stage
from tribodyn.dynamics.modes import modes

ALPHA = np.radians(20.0)
EXACT = 1e-8
SPEED = {"input_speed": "100 rad/s", "output_torque": "300 N*m"}
TORQUE = {**SPEED, "source": "torque"}


def found(train, gears, operating, overrides=None):
    """The package's modes."""
    prepared = spring_model(scenario_of(train, gears, DAMPING_RATIO, operating), overrides)
    return modes(prepared.model, [each.cycle for each in prepared.tables]), prepared


def meshed(stages, senses=(-1, 1)):
    """Meshes and gears of (ends, teeth, module, azimuth, stiffness)."""
    meshes, gears = [], []
    for (ends, teeth, module, azimuth, stiffness), sense in zip(stages, senses, strict=False):
        radii = (0.5 * module * teeth[0], 0.5 * module * teeth[1])
        meshes.append(Mesh(ends, radii, azimuth, ALPHA, sense, stiffness))
        gears.append(Gears(teeth, module))
    return tuple(meshes), gears


def base_radii(train):
    return [radius * np.cos(ALPHA) for mesh in train.meshes for radius in mesh.radii]


@pytest.mark.parametrize("rigid", [False, True])
@pytest.mark.parametrize("operating", [SPEED, TORQUE], ids=["speed", "torque"])
def test_of_two_planar_stages(rigid, operating):
    """The held input does not turn; with a torque, the rigid rotation of the train is no mode."""
    train = two_stage(rigid)
    gears = [Gears(*each) for each in zip(TEETH, MODULES, strict=True)]
    of_model, _ = found(train, gears, operating)
    held = operating is SPEED
    expected = natural_frequencies(train, free_coordinates(train, (0,) if held else ()))
    np.testing.assert_allclose(of_model.frequency, expected[0 if held else 1 :], rtol=EXACT)
    np.testing.assert_allclose(of_model.share.sum(axis=1), 1.0, rtol=1e-12)


@pytest.mark.parametrize("count", [1, 2, 4])
def test_of_a_chain_from_a_held_gear(count):
    """Equal discs behind a mesh at 1:1, whose stiffness on the base circle is that of the shafts."""
    inertia, stiffness = 3e-3, 2e5
    base = 0.045 * np.cos(ALPHA)
    meshes, gears = meshed([((0, 1), (30, 30), 3e-3, 0.3, stiffness / base**2)])
    shafts = tuple(Shaft((i, i + 1), stiffness) for i in range(1, count))
    train = Train((Body(1.0, inertia),) * (count + 1), (), shafts, meshes)
    np.testing.assert_allclose(
        found(train, gears, SPEED)[0].frequency, fixed_free_chain(count, stiffness, inertia), rtol=EXACT
    )


#: Motor, pinion 1, gear 1, pinion 2, gear 2, load.
INERTIAS, SHAFTS, SPRINGS = (0.11, 7e-4, 1.1e-2, 1e-3, 3.4e-2, 0.8), (4e3, 9e4, 2e5), (3.4e8, 4.1e8)


def drive_line():
    meshes, gears = meshed(
        [((1, 2), TEETH[0], MODULES[0], 0.4, SPRINGS[0]), ((3, 4), TEETH[1], MODULES[1], -1.2, SPRINGS[1])]
    )
    shafts = tuple(Shaft(ends, k) for ends, k in zip(((0, 1), (2, 3), (4, 5)), SHAFTS, strict=True))
    return Train(tuple(Body(1.0, inertia) for inertia in INERTIAS), (), shafts, meshes), gears


def test_of_a_torsional_train_with_motor_and_load():
    """The input is a body behind a shaft, and the reference another, which drives the first mesh."""
    train, gears = drive_line()
    of_model, prepared = found(train, gears, TORQUE)
    assert prepared.names[0] == "b1"
    expected = elastic_two_stage(INERTIAS, SHAFTS, SPRINGS, base_radii(train))
    np.testing.assert_allclose(of_model.frequency, expected[1:], rtol=EXACT)
    # the fastest mode is no motor's
    assert of_model.share[-1, prepared.names.index("b0")] < 1e-3


def test_a_motor_behind_a_shaft_is_a_body_more():
    """Of one source, not of [[body]] and [[link]]: the same train."""
    train, gears = drive_line()
    whole, _ = found(train, gears, TORQUE)
    without = train._replace(
        bodies=train.bodies[1:],
        shafts=tuple(shaft._replace(ends=tuple(end - 1 for end in shaft.ends)) for shaft in train.shafts[1:]),
        meshes=tuple(mesh._replace(ends=tuple(end - 1 for end in mesh.ends)) for mesh in train.meshes),
    )
    motor = {"drive_inertia": f"{INERTIAS[0]} kg*m**2", "shaft_stiffness": f"{SHAFTS[0]} N*m/rad"}
    of_model, prepared = found(without, gears, TORQUE | motor)
    assert prepared.names[-1] == "motor"
    np.testing.assert_allclose(of_model.frequency, whole.frequency, rtol=1e-10)


def idler(bearings=()):
    """Driver, idler, driven gear out of line."""
    meshes, gears = meshed(
        [((0, 1), (24, 37), 3e-3, 0.7, 3.1e8), ((1, 2), (37, 41), 3e-3, -0.5, 4.3e8)], senses=(1, -1)
    )
    return Train((Body(1.3, 1.1e-3), Body(2.9, 6.2e-3), Body(4.1, 0.017)), bearings, (), meshes), gears


@pytest.mark.parametrize("operating", [SPEED, TORQUE], ids=["speed", "torque"])
def test_of_a_torsional_idler(operating):
    train, gears = idler()
    inertias = [body.inertia for body in train.bodies]
    if operating is SPEED:
        inertias[0] = np.inf
    expected = torsional_idler(inertias, base_radii(train), [mesh.stiffness for mesh in train.meshes])
    np.testing.assert_allclose(found(train, gears, operating)[0].frequency, expected[1:], rtol=EXACT)
    np.testing.assert_allclose(
        expected[1:], natural_frequencies(train, rotations(train)[1 if operating is SPEED else 0 :])[-2:]
    )


def test_of_an_idler_on_round_bearings():
    """Zeros of a determinant of the two line forces, which knows azimuths by the angle between normals."""
    stiffness = (1.1e8, 3.7e8, 2.2e8)
    train, gears = idler(tuple(Bearing(i, (k, k)) for i, k in enumerate(stiffness)))
    between = np.arccos(normal(train.meshes[0]) @ normal(train.meshes[1]))

    def determinant(frequency):
        return planar_idler_determinant(
            frequency,
            [body.mass for body in train.bodies],
            [body.inertia for body in train.bodies],
            stiffness,
            base_radii(train),
            [mesh.stiffness for mesh in train.meshes],
            between,
        )

    of_model, _ = found(train, gears, TORQUE)
    # driver and driven gear can move across their only normal, by their bearings alone
    own = [np.sqrt(stiffness[i] / train.bodies[i].mass) / (2.0 * np.pi) for i in (0, 2)]
    others = [f for f in of_model.frequency if np.min(np.abs(np.divide(own, f) - 1.0)) > 1e-8]
    assert (len(of_model.frequency), len(others)) == (8, 6)
    for frequency in others:
        assert determinant(frequency * (1.0 - 1e-8)) * determinant(frequency * (1.0 + 1e-8)) < 0.0


def test_a_free_chain_is_a_train_with_a_torque_at_one_end():
    """Three stages of 1:1 and shafts, by a polynomial."""
    inertias, stiffness = (2e-3, 3e-3, 5e-3, 1e-3), (3e5, 1e5, 2e5)
    base = 0.045 * np.cos(ALPHA)
    meshes, gears = meshed(
        [
            ((0, 1), (30, 30), 3e-3, 0.0, stiffness[0] / base**2),
            ((2, 3), (30, 30), 3e-3, 2.0, stiffness[2] / base**2),
        ]
    )
    train = Train(
        tuple(Body(1.0, inertia) for inertia in inertias), (), (Shaft((1, 2), stiffness[1]),), meshes
    )
    expected = free_chain(inertias, stiffness)
    np.testing.assert_allclose(found(train, gears, TORQUE)[0].frequency, expected[1:], rtol=EXACT)
