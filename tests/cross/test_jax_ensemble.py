"""Batches and sweeps through JAX against those in lanes: one compiled function serves all tests here."""

from pathlib import Path

import numpy as np
import pytest

from tests.support.compilations import compilations
from tests.support.feeding_bearing import fed_by_a_bearing
from tests.support.states import TURN_G, X_G, X_P, Y_G, Y_P, altered
from tests.support.verbs import invoke, sets
from tribodyn.gears.case import OF_PLANETS
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE as RECORDED
from tribodyn.record.sweep_schema import FAILED
from tribodyn.solve import ensemble
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.jax import ensemble as jax_ensemble
from tribodyn.studies.motion.report import SWEPT

pytestmark = pytest.mark.slow

#: Of the native engine and JAX alike, as a share of the transmission error's range, at rtol 1e-8.
AGREE = 2e-6
#: Kinematic sliding takes the same steps in both, and one program serves all.
MOTOR = {"operating.source": "torque", "output.samples_per_cycle": 40, "friction.sliding": "kinematic"}


@pytest.fixture(autouse=True)
def narrow(monkeypatch):
    """Eight cases side by side: what is tested is the same, and a third of the time."""
    monkeypatch.setattr(jax_ensemble, "WIDTH_ON_CPU", 8)


@pytest.fixture(scope="module")
def compiled():
    """Names of what XLA compiled so far, which grows."""
    return compilations()


@pytest.fixture
def motors(prepared):
    """Three motors that carry their load and one that does not: models and states."""
    balanced = 500.0 * 23 / 47
    base = prepared("crc-23-47-300", **MOTOR).model
    models = [
        altered(
            base,
            operation={"nominal_speed": speed, "drive_torque": torque},
            bodies={"load": np.array([0.0, 500.0 * torque / balanced if torque > 100 else 500.0])},
        )
        for speed, torque in ((300.0, balanced), (420.0, 0.8 * balanced), (10.0, 20.0), (350.0, balanced))
    ]
    states = np.array([static_equilibrium(model) for model in models])
    states[2] = 0.0
    return models, states


def test_jax_and_lanes_agree_and_tell_the_same_failure(motors):
    models, states = motors
    settings = {"cycles": 3, "window": 1, "samples": 12, "rtol": 1e-8}
    native = ensemble.march(models, states, **settings)
    mapped = ensemble.march(models, states, method="tsit5", **settings)
    for found in (native, mapped):
        assert found.status[[0, 1, 3]].tolist() == [Status.DONE] * 3
        assert found.status[2] == Status.STALLED
    assert 0 < native.reached[2] < 3
    # JAX reports the segment, lanes the phase
    assert 0 <= native.reached[2] - mapped.reached[2] < 1
    assert np.isnan(mapped.samples[2]).all()
    for case in (0, 1, 3):
        ours, theirs = native.samples[case, :, TURN_G], mapped.samples[case, :, TURN_G]
        assert np.max(np.abs(ours - theirs)) < AGREE * np.ptp(ours)
        assert mapped.state[case, TURN_G] == pytest.approx(native.state[case, TURN_G], rel=AGREE)


def test_neither_numbers_nor_fewer_cases_compile_anything_again(motors, compiled):
    """And a case has the same bits whatever the other cases."""
    models, states = motors
    settings = {"cycles": 2, "window": 1, "rtol": 1e-6, "method": "tsit5"}
    whole = ensemble.march(models, states, samples=40, **settings)
    before = len(compiled)
    order = [3, 1]
    fewer = ensemble.march([models[i] for i in order], states[order], samples=40, **settings)
    for name in set(whole._fields) - {"extremes"}:  # none are asked for
        np.testing.assert_array_equal(getattr(fewer, name), getattr(whole, name)[order], err_msg=name)
    heavier = [
        altered(
            model,
            bodies={"load": 1.1 * model.bodies.load},
            mesh={
                "damping": 0.5 * mesh.damping,
                "film": mesh.film._replace(log_inlet_viscosity=mesh.film.log_inlet_viscosity + np.log(2.0)),
            },
        )
        for model in models
        for mesh in model.meshes
    ]
    others = ensemble.march([*heavier, *models, *heavier], np.tile(states, (3, 1)), samples=17, **settings)
    assert np.sum(others.status == Status.DONE) == 9
    hurried = ensemble.march(models[:2], states[:2], samples=40, max_steps=10, **settings)
    assert np.all(hurried.status == Status.TOO_MANY_STEPS)
    assert len(compiled) == before


def test_a_motion_that_grows_without_bound_ends_alone(motors):
    """Of a bearing that feeds whatever moves in it, in JAX as in lanes."""
    models, states = motors
    fed = fed_by_a_bearing(models[0])
    settings = {"cycles": 5, "window": 1, "samples": 12, "rtol": 1e-6}
    ended = {
        method: ensemble.march([fed, models[1]], states[:2], method=method, **settings)
        for method in ("auto", "tsit5")
    }
    places = [X_P, Y_P, X_G, Y_G]
    for found in ended.values():
        assert found.status.tolist() == [Status.UNBOUNDED, Status.DONE]
        assert np.max(np.abs(found.state[0, places])) < 1.0
    assert 0 <= ended["auto"].reached[0] - ended["tsit5"].reached[0] < 1


def swept(engine: str, path: Path, *words: str) -> Path:
    invoke("sweep", "crc-23-47", *sets(MOTOR), *words, "--engine", engine, "-o", path)
    return path


def assert_alike(jax_path: Path, native_path: Path, figures: float) -> None:
    """The same statuses, transmission errors, and figures to a relative tolerance."""
    error = "transmission_error_rotational"
    with SweepRecord(jax_path) as mapped, SweepRecord(native_path) as native:
        np.testing.assert_array_equal(mapped["status"], native["status"])
        for a, b in zip(mapped[error], native[error], strict=True):
            assert np.isfinite(a).all() == np.isfinite(b).all()
            assert not np.isfinite(b).all() or np.max(np.abs(a - b)) < AGREE * np.ptp(b)
        for name in (quantity.name for quantity in SWEPT if quantity not in OF_PLANETS):
            np.testing.assert_allclose(mapped[name], native[name], rtol=figures, atol=0.0, err_msg=name)


def test_the_verb_gives_the_record_of_the_native_engine(tmp_path: Path):
    """One speed of four takes more steps in a mesh cycle than it may."""
    words = ("--vary", "operating.pinion_speed=40,250,300,350rad/s", "--transient", "4")
    words += ("--set", "solver.max_steps=800", "--set", "solver.rtol=1e-8")
    native = swept("native", tmp_path / "native.h5", *words)
    mapped = swept("jax", tmp_path / "jax.h5", *words)
    assert_alike(mapped, native, 1e-5)
    with SweepRecord(mapped) as record:
        assert record["status"].tolist() == [FAILED, RECORDED, RECORDED, RECORDED]
        assert "the limit of steps" in record["message"][0]


def test_steady_states_through_jax(tmp_path: Path):
    """Marched, closed by Newton's method, and judged by their multipliers, all with the mapped batch."""
    words = ("--vary", "operating.pinion_speed=300,400rad/s")
    words += ("--set", "operating.speed_regulation=10 N*m*s/rad", "--set", "mesh.damping_ratio=0.1")
    native = swept("native", tmp_path / "native.h5", *words)
    mapped = swept("jax", tmp_path / "jax.h5", *words)
    assert_alike(mapped, native, 1e-5)
    with SweepRecord(mapped) as by_jax, SweepRecord(native) as in_lanes:
        assert set(by_jax["solution"]) == {"period-1"}
        assert (by_jax["residual"] <= 1e-7).all()
        np.testing.assert_allclose(by_jax["multiplier_max"], in_lanes["multiplier_max"], atol=1e-3)
