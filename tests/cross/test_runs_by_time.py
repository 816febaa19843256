"""Runs by time: gears that stand under load, start, stall against a brake, and are turned back."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline, PchipInterpolator

import tribodyn as td
from tests.support.time_runs import ANGLE, LOAD, RADIUS, SPEED, STIFFNESS, TOTAL, pair, run, springs
from tribodyn.errors import InputError, InputErrors
from tribodyn.record.reader import Record
from tribodyn.studies.motion.batch import BATCH
from tribodyn.studies.motion.prepare import prepare

INDUCTION = ([0.0, 40.0, 60.0, 85.0, 95.0, 100.0], [60.0, 52.0, 65.0, 110.0, 60.0, 0.0])


def curve(speeds: list[float], torques: list[float]) -> dict[str, Any]:
    columns = {"speed": {"unit": "rad/s", "values": speeds}, "torque": {"unit": "N*m", "values": torques}}
    return {"torque_speed_curve": columns}


def test_what_is_in_balance_stands():
    """The wind-up is that of the spring, T/(k r² cos² α), and nothing moves."""
    found = run(springs("20 ms", input_torque=f"{LOAD} N*m"))
    assert np.max(np.abs(found["speed"])) < 1e-8 * SPEED
    windup = found["angle"][:, 0] - found["angle"][:, 1]
    expected = LOAD / (STIFFNESS * RADIUS**2 * np.cos(ANGLE) ** 2)
    np.testing.assert_allclose(windup, expected, rtol=1e-6)
    assert np.max(np.abs(found["power_in"])) < 1e-9 * LOAD * SPEED
    assert np.all(np.isnan(found["efficiency"]))


def test_the_load_turned_round_passes_the_backlash():
    """Gears that stand: between loads of either sign lie j_n/r_b and what the pairs in contact give."""
    gap, torque, ends, give = 1e-4, 40.0, list[float](), list[float]()
    for sign in (1.0, -1.0):
        prepared = pair(
            {
                "operating.gear_torque": f"{sign * torque} N*m",
                "operating.pinion_torque": f"{sign * torque * 23 / 47} N*m",
                "mesh.backlash": f"{gap} m",
                "mesh.compliance": "constant",
                "mesh.stiffness": "2e8 N/m",
            },
            "1 ms",
        )
        found = run(prepared)
        assert np.max(np.abs(found["speed"])) < 1e-7
        (loads,) = (mesh["normal_load"][-1] for mesh in found.seen.meshes)
        radius = float(prepared.cycle.gear_pitch_radius) * np.cos(np.radians(20.0))
        force = torque / radius
        give.append(force / (np.count_nonzero(loads) * 2e8) + 2.0 * force / 1e9)  # teeth, and both bearings
        ends.append(found["angle"][-1, 1] * radius)
    assert abs(ends[1] - ends[0]) == pytest.approx(gap + sum(give), rel=1e-5)


@pytest.mark.parametrize("method", ["auto", "dop853", "lsoda"])
def test_a_motor_starts_it_like_a_drive_of_one_degree_of_freedom(method):
    """SciPy on J ω' = T(ω) − T_load from rest; energy put in is taken out, lost, or in the masses."""
    found = run(springs("90 ms", **curve(*INDUCTION)), method)
    line = PchipInterpolator(*INDUCTION)
    drive = solve_ivp(
        lambda _, y: [(line(y[0]) - LOAD) / TOTAL],
        (0.0, found["time"][-1]),
        [0.0],
        t_eval=found["time"],
        rtol=1e-10,
        atol=1e-10,
    )
    assert found["speed"][0, 0] == 0.0
    assert drive.y[0, -1] > 95.0
    np.testing.assert_allclose(found["speed"][:, 0], drive.y[0], rtol=0.0, atol=2e-5 * SPEED)
    assert abs(found.residual) < 1e-6


def test_a_load_turns_it_back_evenly():
    """ω = ω0 + a t through standstill, whatever pairs of teeth it goes through in either direction."""
    first, torque = 20.0, 5.0
    found = run(springs("60 ms", input_torque=f"{torque} N*m", start_speed=f"{first} rad/s"))
    speed = first + (torque - LOAD) / TOTAL * found["time"]
    assert speed[-1] < -15.0
    np.testing.assert_allclose(found["speed"][:, 0], speed, rtol=0.0, atol=1e-6 * SPEED)
    angle = first * found["time"] + (torque - LOAD) / TOTAL * found["time"] ** 2 / 2.0
    np.testing.assert_allclose(found["reference_angle"], angle, rtol=0.0, atol=1e-7)
    assert abs(found.residual) < 1e-8


def test_teeth_with_friction_are_turned_back_without_a_jump():
    """Friction changes its direction with the rotation, and the balance of energy closes."""
    found = run(pair({"operating.pinion_torque": "20 N*m", "operating.start_speed": "6 rad/s"}, "60 ms"))
    speed = found["speed"][:, 0]
    assert speed[0] > 5.0
    assert speed[-1] < -10.0
    assert np.max(np.abs(np.diff(speed))) < 0.05 * np.ptp(speed)
    turned = found.seen.cycles
    assert np.ptp(turned) > 1.0
    loss = found["power_friction"]
    assert np.all(loss[np.abs(speed) > 2.0] > 0.0)
    assert abs(found.residual) < 1e-6
    for values in (found["power_friction"], found.seen.meshes[0]["friction_force"]):
        assert np.all(np.isfinite(values))


def test_by_time_it_is_the_motion_by_rotation():
    """Two integrators of the same equations, from 6 rad/s."""
    changes = {"operating.start_speed": "6 rad/s", "solver.cycles": 3, "solver.rtol": 1e-9}
    plain = {"operating.pinion_torque": "57 N*m", "mesh.damping_ratio": 0.1}
    by_rotation = td.run(td.scenario("run-up", changes | plain))
    with Record(by_rotation.path) as record:
        speed, time = record["velocity"][:, -2], record["time"]
    found = run(pair(changes, "90 ms"), samples=400)
    assert time[-1] > 0.04
    inside = (time < found["time"][-1]) & (np.arange(len(time)) % 40 > 0)  # where a pair enters is a kink
    again = CubicSpline(found["time"], found["speed"][:, 0])(time[inside])
    np.testing.assert_allclose(again, speed[inside], rtol=0.0, atol=1e-5)


def test_friction_at_rest_converges_as_it_reverses_more_sharply():
    """Speeds after a start, and while it stands no friction but that of creep."""
    ends = []
    for width in (40.0, 20.0, 10.0, 5.0):
        found = run(pair({"friction.reversal_width": f"{width} um"}, "8 ms"), rtol=1e-8)
        ends.append(found["speed"][-1, 0])
        (first,) = (mesh["friction_force"][0] for mesh in found.seen.meshes)
        assert not np.any(first)
    steps = np.abs(np.diff(ends))
    assert np.all(steps[1:] < 0.7 * steps[:-1])
    assert steps[-1] < 3e-3 * ends[-1]


def test_a_brake_stalls_it():
    """A brake holds more than the motor gives: it creeps at 2 w sin(arcsin(T/C)/3), and says what passes."""
    width, capacity, torque, drag = 0.1, 200.0, 60.0, 5.0
    brake = {"ends": ["b1", "ground"], "torque": f"{capacity} N*m", "reversal_speed": f"{width} rad/s"}
    line = curve([0.0, SPEED], [torque, 0.0])
    found = run(springs("40 ms", brake, output_torque=f"{drag} N*m", **line))
    creep = found["speed"][-1, 0]
    held = torque * (1.0 - creep / SPEED) - drag
    assert creep == pytest.approx(2.0 * width * np.sin(np.arcsin(held / capacity) / 3.0), rel=1e-4)
    assert found["clutch_torque"][-1, 0] == pytest.approx(held, rel=1e-5)
    assert found["clutch_power"][-1, 0] == pytest.approx(held * creep, rel=1e-4)
    assert abs(found.residual) < 1e-6


#: A planetary set under a motor, from rest.
SET = {
    "operating.source": "torque",
    "operating.start_speed": "0 rad/s",
    "operating.drive_inertia": "0.01 kg*m**2",
    "operating.input_torque": "300 N*m",
    "friction.law": "none",
    "solver.duration": "2 ms",
}


def test_a_planetary_set_starts_as_its_inertias_say():
    """Σ J_b i_b ω_b + Σ m_b r_b² i_c² ω = (T − Σ T_b i_b) t, planets carried along with their carrier."""
    prepared = prepare(td.scenario("planetary-24-84", SET | {"stage.0.frame_forces": False}))
    bodies = prepared.model.bodies
    ratio, turning = np.asarray(bodies.ratio), np.asarray(bodies.inertia)
    places = np.asarray(bodies.carried)[:, None] * np.asarray(bodies.place)
    carried = float(np.asarray(bodies.mass) @ np.sum(places**2, axis=1))
    torque = 300.0 - float(np.asarray(bodies.load) @ ratio)
    found = run(prepared, rtol=1e-7, samples=40)
    momentum = found["speed"] @ (turning * ratio) + carried * found["speed"][:, 0]
    impulse = torque * found["time"]
    np.testing.assert_allclose(momentum, impulse, rtol=0.0, atol=0.02 * impulse[-1])
    assert abs(found.residual) < 1e-6


def test_what_has_the_nominal_speed_in_it_is_refused():
    """Forces in a carrier's frame; cases beside each other, which go by the rotation."""
    case = td.scenario("planetary-24-84", SET)
    with pytest.raises(InputError, match=r"frame_forces.*the gears may stand"):
        prepare(case)
    with pytest.raises(InputError, match=r"solver\.duration.*by the rotation"):
        BATCH.settings([case], None, "native")


@pytest.mark.parametrize("law", ["masjedi-khonsari", "coulomb", "niemann", "xu", "benedict-kelley"])
def test_laws_are_finite_where_nothing_moves(law):
    own = {"friction.coefficient": 0.05} if law == "coulomb" else {}
    prepared = pair({"friction.law": law, "operating.pinion_torque": "48.936170 N*m"} | own, "0.2 ms")
    found = run(prepared, "dop853", rtol=1e-6)
    (mesh,) = found.seen.meshes
    loaded = mesh["normal_load"] > 0.0
    assert loaded.any()
    for name in (
        "friction_coefficient",
        "central_film_thickness",
        "flash_temperature_rise",
        "friction_force",
    ):
        assert np.all(np.isfinite(mesh[name][loaded])), name


def test_a_record_begins_at_rest(tmp_path):
    """Its efficiency is told where power flows, of the run as of each moment."""
    made = {
        "operating.start_speed": "0 rad/s",
        "operating.pinion_torque": f"{100.0 * 23 / 47!r} N*m",
        "solver.duration": "5 ms",
    }
    case = td.scenario("run-up", made)
    stands = td.run(case, output=tmp_path / "stands.h5")
    assert stands.summary["efficiency"] is None
    assert "no power" in stands.summary["efficiency_withheld"]
    assert stands.summary["power_friction_mean"] == 0.0
    starts = td.run(td.scenario("run-up", made | {"operating.pinion_torque": "80 N*m"}))
    with Record(starts.path) as record:
        assert record["velocity"][0, -2] == 0.0
        assert np.isnan(record["efficiency"][0])
    assert 0.99 < starts.summary["efficiency"] <= 1.0


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"operating.source": "speed"}, "solver.duration"),
        ({"solver.method": "rodas4"}, "solver.method"),
        ({"solver.revolutions": 2.0}, "solver.revolutions"),
        ({"output.window": "all"}, "output.window"),
        ({"mesh.formulation": "energy-consistent"}, "mesh.formulation"),
    ],
)
def test_what_goes_by_rotation_alone_is_refused(changes, key):
    plain = {"solver.duration": "5 ms", "operating.source": "torque"}
    with pytest.raises((InputErrors, td.InputError)) as refused:
        td.scenario("run-up", plain | changes)
    assert key in str(refused.value)
