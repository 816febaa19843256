"""Figures of a window whose answers are known beforehand; extremes of blocks."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tests.support.states import (
    LAG,
    PAIR,
    WORK_DAMPING,
    WORK_FRICTION,
    WORK_IN,
    WORK_OUT,
    WORK_PARAMETRIC,
    WORK_SLIDING,
)
from tribodyn.gears.motion.extremes import RECORDED, Extreme, RunningExtremes
from tribodyn.gears.motion.running import energy_residual
from tribodyn.studies.motion.summary import concluded, steady_quantities

SAMPLES, CYCLES, SPEED, PITCH, RADIUS = 50, 4, 100.0, 0.27, 0.07
#: Pinion speed of the window on the average, rad/s, and time of it, s.
MEAN_SPEED = 80.0
TIME = CYCLES * PITCH / MEAN_SPEED
CYCLE = cast(
    Any,
    SimpleNamespace(
        side=np.array([1, 1, -1, -1]),
        pair_side=np.array([1, 1, -1, -1]),
        slices=1,
        front_pairs=2,
        gear_pitch_radius=RADIUS,
        pinion_pitch_radius=0.035,
        pitch_angle=PITCH,
    ),
)
MODEL = SimpleNamespace(
    layout=PAIR,
    options=SimpleNamespace(layout=PAIR),
    meshes=[
        SimpleNamespace(
            driver_radius=CYCLE.pinion_pitch_radius, driven_radius=RADIUS, driver_sense=1.0, driven_sense=1.0
        )
    ],
)
MODEL.operation = SimpleNamespace(nominal_speed=SPEED, pitch_angle=PITCH)
OILED = SimpleNamespace(lubricant=SimpleNamespace(sheet=None, temperature=None))
PREPARED = cast(
    Any,
    SimpleNamespace(
        cycle=CYCLE,
        model=MODEL,
        case=SimpleNamespace(is_pair=True, named=False, in_time=False, meshes=[SimpleNamespace(pair=OILED)]),
        warm_pairs=[OILED],
        thermal=[None],
    ),
)
MESH = cast(Any, SimpleNamespace(cycle=CYCLE, assembly=None, rate=1.0))


def window(way: int, torque: float) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Two pairs of one side share a load whose sum has a ripple; the gear turns at 40 rad/s."""
    count = SAMPLES * CYCLES
    phase = np.arange(count) / SAMPLES
    zero = np.zeros((count, 4))
    own = slice(0, 2) if way > 0 else slice(2, 4)
    load, angle, sliding, error = zero.copy(), zero + 0.4, zero.copy(), zero * np.nan
    whole = torque / RADIUS / np.cos(0.4) * (1.0 + 0.25 * np.cos(2.0 * np.pi * phase))
    load[:, own] = whole[:, None] * np.array([0.3, 0.7])
    sliding[:, own] = np.array([2.0, -1.0])
    error[:, own] = 2e-5 + 3e-6 * np.cos(2.0 * np.pi * phase)[:, None]
    error[:, own.stop - 1] += 1e-6
    work = np.zeros(PAIR.states)
    work[LAG] = TIME - CYCLES * PITCH / SPEED
    gear = way * torque * 40.0 * TIME
    work[WORK_OUT], work[WORK_FRICTION], work[WORK_SLIDING] = gear, 0.02 * torque, 0.025 * torque
    work[WORK_DAMPING] = 0.004 * torque
    work[WORK_IN] = gear + work[WORK_FRICTION]
    friction = np.sign(sliding) * load * np.array([0.1, 0.04, 0.1, 0.04])
    return {
        "sliding_load": np.sum(load * np.abs(sliding), axis=1),
        "sliding_loss": np.sum(friction * sliding, axis=1),
        "transmission_error_rotational": 1e-5 + 4e-6 * np.cos(6.0 * np.pi * phase),
        "transmission_error_normal": error,
        "normal_load": load,
        "tangent_load": load * np.cos(angle),
        "tangent_stiffness": np.where(load > 0.0, 3e8 + 1e8 * np.cos(2.0 * np.pi * phase)[:, None], 0.0)
        * np.cos(angle) ** 2,
        "mesh_stiffness": np.where(load > 0.0, 3e8 + 1e8 * np.cos(2.0 * np.pi * phase)[:, None], 0.0),
        "friction_force": friction,
        "sliding_speed": sliding,
        "velocity": np.tile([0.0, 0.0, 0.0, 0.0, MEAN_SPEED, 40.0], (count, 1)),
        "closure_in_range": np.ones((count, 4)),
        "friction_in_range": np.where(np.arange(4) % 2, 1.0, 0.0) * np.ones((count, 1)),
    }, work


def quantities_of(block, work):
    """Of a window whose extremes its samples meet."""
    cycles = np.arange(SAMPLES * CYCLES) / SAMPLES
    count = (len(cycles), 4)
    none = {name: np.full(count, np.nan) for name, _ in RECORDED.values() if name not in block}
    extremes = RunningExtremes(CYCLE)
    extremes.add(cycles, cycles, {**block, **none})
    whole, each = steady_quantities([block], work, PREPARED, [MESH], SAMPLES, [extremes])
    return concluded(PREPARED, whole, each)


@pytest.mark.parametrize("way", [1, -1], ids=["pinion", "gear"])
def test_quantities_of_a_known_window(way):
    torque = 300.0
    found = quantities_of(*window(way, torque))
    assert found["averaging_cycles"] == CYCLES
    assert found["mesh_frequency"] == pytest.approx(MEAN_SPEED / PITCH, rel=1e-12)
    assert found["dynamic_factor"] == pytest.approx(1.25, rel=1e-12)
    assert found["transmission_error_normal_mean"] == pytest.approx(2.1e-5, rel=1e-12)
    assert found["transmission_error_normal_peak_to_peak"] == pytest.approx(6e-6, rel=1e-9)
    assert found["transmission_error_mean"] == pytest.approx(1e-5, rel=1e-12)
    # by loss: (0.1 · 0.3 · 2 + 0.04 · 0.7 · 1)/(0.3 · 2 + 0.7 · 1)
    assert found["friction_coefficient_mean"] == pytest.approx(0.088 / 1.3, rel=1e-12)
    static = torque / RADIUS / np.cos(0.4)
    mean = np.array([0.03, 0.028]) * static
    expected = [*mean, 0.0, 0.0] if way > 0 else [0.0, 0.0, *mean]
    np.testing.assert_allclose(found["friction_force_mean"], expected, rtol=1e-12)
    # two pairs of 3e8 ± 1e8 N/m along normals at 0.4 rad
    assert found["mesh_stiffness_mean"] == pytest.approx(6e8 * np.cos(0.4) ** 2, rel=1e-12)
    assert found["mesh_stiffness_peak_to_peak"] == pytest.approx(4e8 * np.cos(0.4) ** 2, rel=1e-9)
    np.testing.assert_allclose(found["transmission_error_harmonics"], [0, 0, 4e-6, 0, 0], atol=1e-18)
    assert found["power_damping_mean"] == pytest.approx(0.004 * torque / TIME, rel=1e-12)
    put_in = torque * 40.0 * TIME + (0.02 * torque if way > 0 else 0.0)
    assert found["driving_gear"] == ("pinion" if way > 0 else "gear")
    assert found["power_in_mean"] == pytest.approx(put_in / TIME, rel=1e-12)
    assert found["power_friction_mean"] == pytest.approx(0.02 * torque / TIME, rel=1e-12)
    assert found["efficiency"] == pytest.approx(1.0 - 0.02 * torque / put_in, rel=1e-12)
    assert found["friction_work_on_vibration"] == pytest.approx(0.2, rel=1e-12)
    assert found["closure_in_range_fraction"] == 1.0
    assert found["friction_in_range_fraction"] == pytest.approx(0.5)
    assert found["contact_loss_fraction"] == 0.0
    frequencies, amplitudes = found["spectrum_frequencies"], found["spectrum_amplitudes"]
    assert frequencies.max() == pytest.approx(20.0 * found["mesh_frequency"], rel=1e-9)
    largest = np.argmax(amplitudes[1:]) + 1
    assert frequencies[largest] == pytest.approx(3.0 * found["mesh_frequency"], rel=1e-9)
    assert amplitudes[largest] == pytest.approx(4e-6, rel=1e-9)


def test_time_without_contact_and_without_load():
    block, work = window(1, 300.0)
    block["normal_load"][: SAMPLES // 2] = 0.0
    found = quantities_of(block, work)
    assert found["contact_loss_fraction"] == pytest.approx(0.5 / CYCLES, rel=1e-12)
    block["normal_load"][:] = block["sliding_load"][:] = 0.0
    found = quantities_of(block, 0.0 * work)
    assert np.isnan(found["dynamic_factor"])
    assert np.isnan(found["friction_coefficient_mean"])
    assert np.isnan(found["efficiency"])
    assert found["friction_work_on_vibration"] is None
    assert found["driving_gear"] == "neither"


def test_extremes_of_blocks_are_those_of_the_whole(rng):
    values = {name: rng.normal(size=(30, 4)) for name, _ in RECORDED.values()}
    values |= {name: rng.normal(size=(30, 4)) for name in ("transmission_error_normal", "tangent_load")}
    values |= {name: rng.normal(size=30) for name in ("transmission_error_rotational", "time")}
    values["film_parameter"][:10] = np.nan
    extremes = RunningExtremes(CYCLE)
    cycles = np.arange(30) / 10
    for start in (0, 10, 20):
        part = slice(start, start + 10)
        extremes.add(
            cycles[part], values["time"][part], {name: samples[part] for name, samples in values.items()}
        )
    found = extremes.values()
    assert found["normal_load_max"] == values["normal_load"].max()
    assert found["film_min"] == values["central_film_thickness"].min()
    assert found["film_parameter_min"] == np.nanmin(values["film_parameter"])
    where = extremes.by_name["normal_load_max"]
    row, slot = np.argwhere(values["normal_load"] == where.value)[0]
    assert (where.mesh_cycle, where.time, where.pair) == (cycles[row], values["time"][row], slot)
    assert extremes.spread("transmission_error") == np.ptp(values["transmission_error_rotational"])
    assert extremes.spread("back_transmission_error_normal") == np.ptp(
        values["transmission_error_normal"][:, 3]
    )


def test_a_minimum_has_its_place_on_the_path_of_contact():
    """Pair 0 entered a pitch before pair 1, which enters at the start of a mesh cycle."""
    extremes = RunningExtremes(CYCLE)
    cycle = SimpleNamespace(roll_start=-0.2, pitch_angle=PITCH)
    for pair, pitches in ((1, 0.25), (0, 1.25), (-1, 2.25)):
        extremes.by_name["film_parameter_min"] = Extreme(1.2, 0.1, 7.25, pair)
        (found,) = extremes.where("film_parameter_min", cast(Any, cycle)).values()
        assert found == pytest.approx(-0.2 + pitches * PITCH)
    extremes.by_name["film_parameter_min"] = Extreme(1.2, 0.1, 7.25, 2)
    assert extremes.where("film_parameter_min", cast(Any, cycle)) == {}
    assert extremes.where("normal_load_max", cast(Any, cycle)) == {}


def test_what_is_missing_in_the_balance_of_energy():
    first, last = np.zeros(PAIR.states), np.zeros(PAIR.states)
    last[[WORK_IN, WORK_OUT, WORK_FRICTION, WORK_DAMPING]] = 100.0, 90.0, 4.0, 3.0
    last[WORK_PARAMETRIC] = 2.0
    assert energy_residual(first, last, 5.0, PAIR) == pytest.approx(0.0, abs=1e-15)
    assert energy_residual(first, last, 3.0, PAIR) == pytest.approx(0.02)
    assert energy_residual(last, last, 0.0, PAIR) == 0.0
