"""A revolution of the gear with rolling elements in plain loops: sheet, summary, record, limits."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.irefc import run
from tribodyn.studies.irefc.engagement import RollingFriction, element_angles, engage, normal_loads
from tribodyn.studies.irefc.geometry import (
    RollingDrive,
    centre_path_curvature,
    element_centres,
    normal_direction,
)
from tribodyn.studies.irefc.run import geometry_sheet
from tribodyn.studies.irefc.scenario import RollingCase
from tribodyn.studies.protocol.load import load_scenario

SAMPLES = 6


@pytest.fixture(scope="module")
def case() -> RollingCase:
    drive = RollingDrive(0.05, 11, 1.3, 0.0025)
    return replace(
        load_scenario("irefc"), drive=drive, samples_per_cycle=SAMPLES, input_power=900.0, input_speed=70.0
    )


@pytest.fixture(scope="module")
def made(case: RollingCase, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[float]]:
    told: list[float] = []
    path = run.run(case, tmp_path_factory.mktemp("r") / "r.h5", progress=told.append).path
    return path, told


def test_a_sheet_is_in_the_units_of_a_drawing():
    drive = RollingDrive(0.02, 26, 1.4, 0.002)
    sheet = geometry_sheet(drive)
    expected = {
        "rolling elements": 26,
        "teeth of the cam": 25,
        "teeth of the crown": 27,
        "ratio of input to cam, which turns the other way": 12.5,
        "element radius": 2.0,
        "displacement coefficient": 1.4,
        "pitch radius of the cage": 20.0,
        "pitch radius of the cam": 20.0 * 25.0 / 26.0,
        "pitch radius of the crown": 20.0 * 27.0 / 26.0,
        "radius of the elements' centres": 28.0,
        "eccentricity": 40.0 / 26.0,
        "element radius at which neighbouring elements overlap": 28.0 * math.sin(math.pi / 26.0),
    }
    for name, value in expected.items():
        assert sheet[name][0] == pytest.approx(value), name
    assert {unit for value, unit in sheet.values() if isinstance(value, float)} <= {"", "mm"}
    angle = np.linspace(0.0, np.pi, 20001)
    cam, crown = centre_path_curvature(drive, angle)
    for name, radius in (("cam", 1.0 / np.max(cam)), ("crown", -1.0 / np.min(crown))):
        limit = sheet[f"element radius at which the protrusions of the {name} are undercut"]
        assert limit == (pytest.approx(1e3 * radius, rel=1e-6), "mm")


def test_the_summary_of_a_revolution_in_plain_loops(case: RollingCase):
    """All samples but the last, which is the first one again; extremes over all."""
    drive = case.drive
    turn = 2.0 * np.pi * np.arange(SAMPLES * 12 + 1) / (SAMPLES * 12)
    states = [
        engage(drive, element_angles(drive, np.array([rotation])), 900.0, 70.0, case.friction)
        for rotation in turn
    ]
    count = len(states) - 1
    found = run.quantities_of(case)

    def mean(values: list[float]) -> float:
        return sum(values[:count]) / count

    power_in = mean([float(moment.power_in[0]) for moment in states])
    power_out = mean([float(moment.power_out[0]) for moment in states])
    cam = mean([float(np.sum(moment.power_cam)) for moment in states])
    crown = mean([float(np.sum(moment.power_crown)) for moment in states])
    assert found["power_in_mean"] == pytest.approx(power_in)
    assert found["power_cam_mean"] == pytest.approx(cam)
    assert found["power_crown_mean"] == pytest.approx(crown)
    assert found["power_friction_mean"] == pytest.approx(cam + crown)
    assert found["efficiency"] == found["efficiency_by_energy"] == pytest.approx(power_out / power_in)
    assert found["energy_residual"] == pytest.approx(0.0, abs=1e-12)
    torque = [float(moment.power_out[0]) * 5.0 / 70.0 for moment in states]  # the cam turns five times slower
    assert found["output_torque_mean"] == pytest.approx(sum(torque) / len(torque))
    assert found["output_torque_peak_to_peak"] == pytest.approx(max(torque) - min(torque))
    for name in ("normal_load", "slip_speed", "spin_speed"):
        assert found[f"{name}_max"] == pytest.approx(
            max(np.max(np.abs(getattr(moment, name))) for moment in states)
        )
    lost = max(float(np.max(moment.power_cam + moment.power_crown)) for moment in states)
    assert found["power_element_max"] == pytest.approx(lost)
    loaded = [int(np.sum(moment.normal_load > 1e-6 * found["normal_load_max"])) for moment in states]
    assert (found["elements_loaded_min"], found["elements_loaded_max"]) == (min(loaded), max(loaded))
    assert found["mesh_frequency"] == pytest.approx(12.0 * 70.0 / (2.0 * math.pi))
    assert (found["ratio"], found["eccentricity"]) == (5.0, pytest.approx(0.1 / 11.0))


def test_a_record_is_the_revolution(case: RollingCase, made: tuple[Path, list[float]]):
    path, told = made
    turn = 2.0 * np.pi * np.arange(SAMPLES * 12 + 1) / (SAMPLES * 12)
    state = engage(case.drive, element_angles(case.drive, turn), 900.0, 70.0, case.friction)
    assert told[-1] == 1.0
    np.testing.assert_allclose(told[:3], np.array([1, 2, 3]) * SAMPLES / len(turn))
    with Record(path) as record:
        np.testing.assert_allclose(record["time"], turn / 70.0)
        np.testing.assert_allclose(record["input_angle"], turn)
        np.testing.assert_allclose(record["normal_load"], state.normal_load, atol=1e-9)
        np.testing.assert_allclose(
            record["power_friction"], (state.power_cam + state.power_crown).sum(axis=1)
        )
        np.testing.assert_array_equal(record["element"], np.arange(1, 12))
        sizes = record.geometry
        assert sizes["centre_circle_radius"] == pytest.approx(0.065)
        assert record.summary["efficiency"] == pytest.approx(run.quantities_of(case)["efficiency"])


@pytest.mark.parametrize(
    ("arm", "sliding", "key"), [(1.0, 0.05, "rolling_arm"), (1e-5, 900.0, "sliding_coefficient")]
)
def test_friction_that_locks_is_refused_with_the_limit(
    case: RollingCase, arm: float, sliding: float, key: str
):
    """At 0.99 of the limit that is named the gear turns, at 1.01 it locks."""
    heavy = RollingFriction(rolling_arm=arm * 1e-2 if arm < 1.0 else arm, sliding_coefficient=sliding)
    with pytest.raises(InputError) as caught:
        run.prepare(replace(case, friction=heavy))
    assert caught.value.key == f"friction.{key}"
    limit = float(caught.value.remedy.split()[3])
    limit *= 1e-3 if key == "rolling_arm" else 1.0
    run.prepare(replace(case, friction=heavy._replace(**{key: 0.985 * limit})))
    with pytest.raises(InputError, match="the gear locks"):
        run.prepare(replace(case, friction=heavy._replace(**{key: 1.015 * limit})))


def turned(points: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Points as they are seen from what turns by an angle."""
    return np.stack(
        [
            points[:, 0] * np.cos(angle) + points[:, 1] * np.sin(angle),
            points[:, 1] * np.cos(angle) - points[:, 0] * np.sin(angle),
        ],
        axis=1,
    )


@pytest.mark.parametrize("drive", [RollingDrive(0.05, 11, 1.3, 0.0025), RollingDrive(0.04, 8, 1.15, 0.002)])
def test_curvatures_of_the_paths_of_an_element(drive: RollingDrive):
    """By finite differences of its centre, as cam and crown see it; the eccentric stands still."""
    angle, step = np.array([0.3, 0.9, 1.7, 2.6, 3.9, 5.2]), 1e-4
    # relative to the eccentric the cage turns by φ, the bodies with their teeth's share of that
    for teeth, shift, found in (
        (drive.elements - 1, drive.eccentricity, centre_path_curvature(drive, angle)[0]),
        (drive.elements + 1, 0.0, centre_path_curvature(drive, angle)[1]),
    ):
        before, here, after = (
            turned(element_centres(drive, at) - np.array([shift, 0.0]), at * drive.elements / teeth)
            for at in (angle - step, angle, angle + step)
        )
        rate, bend = (after - before) / (2.0 * step), (after - 2.0 * here + before) / step**2
        towards = turned(-normal_direction(drive, angle), angle * drive.elements / teeth)
        np.testing.assert_allclose(
            found, np.sum(bend * towards, axis=1) / np.sum(rate**2, axis=1), rtol=2e-5, atol=1e-3
        )


def test_distances_powers_and_torques_of_an_instant():
    """Element by element; the cam lies within the elements, the crown around them."""
    drive, friction = RollingDrive(0.05, 11, 1.3, 0.0025), RollingFriction(1e-5, 0.08)
    angle = element_angles(drive, np.array([0.0, 0.13, 0.31]))
    found = engage(drive, angle, 900.0, 70.0, friction)
    for at in range(3):
        lost, turned_cam = 0.0, 0.0
        for n, phi in enumerate(angle[at]):
            x, y = 1.3 * 0.05 * math.cos(phi) - 0.05, 1.3 * 0.05 * math.sin(phi)
            distance = math.hypot(x, y)
            assert found.cam_distance[at, n] == pytest.approx(distance - 0.0025)
            assert found.crown_distance[at, n] == pytest.approx(distance + 0.0025)
            load = float(found.normal_load[at, n])
            rolling = load * 1e-5 * float(found.spin_speed[at, n])
            sliding = load * 0.08 * abs(float(found.slip_speed[at, n]))
            assert found.power_crown[at, n] == pytest.approx(rolling)
            assert found.power_cam[at, n] == pytest.approx(rolling + sliding)
            lost += 2.0 * rolling + sliding
            turned_cam += load * drive.cam_pitch_radius * y / distance
        assert found.power_in[at] == pytest.approx(900.0)
        assert found.power_out[at] == pytest.approx(70.0 / drive.ratio * turned_cam - lost)
        assert found.power_out[at] == pytest.approx(900.0 - lost)
        assert found.efficiency[at] == pytest.approx(1.0 - lost / 900.0)
    # one element alone presses where the others have no arm; a load of two is in proportion to their arms
    two = normal_loads(drive, np.array([[0.4, 2.2, 3.5], [0.8, 4.0, 5.0]]), 7.0)
    assert two[1, 1] == two[1, 2] == two[0, 2] == 0.0
    arms = [
        0.05
        * 1.3
        * 0.05
        * math.sin(phi)
        / math.hypot(1.3 * 0.05 * math.cos(phi) - 0.05, 1.3 * 0.05 * math.sin(phi))
        for phi in (0.4, 2.2, 0.8)
    ]
    assert two[0, 0] / two[0, 1] == pytest.approx(arms[0] / arms[1])
    assert two[0, 0] * arms[0] + two[0, 1] * arms[1] == pytest.approx(7.0 * 11 / 2.0)
    assert two[1, 0] * arms[2] == pytest.approx(7.0 * 11 / 2.0)


def test_as_published_every_element_takes_its_share_of_the_rest():
    """η as the product over the elements of 1 less their loss over the power."""
    drive, friction = RollingDrive(0.05, 11, 1.3, 0.0025), RollingFriction(1e-5, 0.08)
    angle = element_angles(drive, np.array([0.05, 0.2]))
    found = engage(drive, angle, 900.0, 70.0, friction, "as_published")
    for at in range(2):
        left = 1.0
        for n in range(11):
            left *= 1.0 - float(found.power_cam[at, n] + found.power_crown[at, n]) / 900.0
        assert found.efficiency[at] == pytest.approx(left)
