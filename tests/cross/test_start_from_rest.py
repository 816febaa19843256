"""Trains that a motor starts from rest: closed forms of the motion, energy, and what does not start."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator

from tests.support.spring_trains import Gears, scenario_of, spring_model
from tests.support.states import sampled
from tests.support.train_matrices import Body, Mesh, Train
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs, train_outputs
from tribodyn.errors import InputError
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import Stop, TransientSettings, transient
from tribodyn.studies.motion.assembly import CREEP

#: Inertias of driver, driven gear and a motor behind a clutch, kg m²; torques of motor and load, N m.
DRIVER, DRIVEN, MOTOR, TORQUE, LOAD = 2e-2, 4e-3, 3e-2, 50.0, 20.0
TEETH, RADIUS, SPEED = 30, 0.045, 100.0
TOTAL = DRIVER + DRIVEN


def scenario(
    start: float | None = 0.0, clutch: dict[str, Any] | None = None, **operating: Any
) -> dict[str, Any]:
    """Two equal gears without friction; with a clutch also a motor behind it."""
    bodies = [Body(1.0, DRIVER), Body(1.0, DRIVEN)]
    mesh = Mesh((0, 1), (RADIUS, RADIUS), 0.0, np.radians(20.0), -1, 3e8)
    duty = {"source": "torque", "input_speed": f"{SPEED} rad/s", "output_torque": f"{LOAD} N*m"}
    duty |= {"input_torque": f"{TORQUE} N*m"} | operating
    duty |= {} if start is None else {"start_speed": f"{start} rad/s"}
    duty = {name: value for name, value in duty.items() if value is not None}
    made = scenario_of(Train(tuple(bodies), (), (), (mesh,)), [Gears((TEETH, TEETH), 3e-3)], 0.0, duty)
    if clutch is not None:
        made["body"].append({"name": "motor", "mass": "1 kg", "inertia": f"{MOTOR} kg*m**2"})
        made["clutch"] = [{"ends": ["motor", "b0"], **clutch}]
        made["operating"]["input"] = "motor"
    return made


def course(made: dict[str, Any], cycles: int, method: str = "dopri5") -> dict[str, np.ndarray]:
    prepared = spring_model(made)
    seen = evaluated(
        *sampled(prepared.model, TransientSettings(method, 1e-9, cycles, 10**6, 20)), prepared.model
    )
    whole = train_outputs(seen, mesh_outputs(0, seen)["sliding_loss"])
    return whole | {"names": np.array(prepared.names)}


def energy_left(whole: dict[str, np.ndarray]) -> float:
    """What the balance of energy leaves of the work put in."""
    works = {name: whole[name][-1] - whole[name][0] for name in whole if name.startswith("work_")}
    left = works["work_in"] + works["work_parametric"] - works["work_out"] - works["work_damping"]
    stored = whole["stored_energy"][-1] - whole["stored_energy"][0]
    return float(abs(left - works["work_friction"] - stored) / works["work_in"])


@pytest.mark.parametrize("start", [0.0, 1.0, 10.0])
def test_a_constant_torque_accelerates_evenly(start):
    """t = (√(ω0² + 2 a θ) − ω0)/a; from rest by the creep, and √(2 θ/a) as that vanishes."""
    whole = course(scenario(start), 30)
    rate, first = (TORQUE - LOAD) / TOTAL, max(start, CREEP * SPEED)
    angle, time = whole["reference_angle"], whole["time"]
    expected = (np.sqrt(first**2 + 2.0 * rate * angle) - first) / rate
    np.testing.assert_allclose(time, expected, rtol=0.0, atol=1e-9 * time[-1])
    if start == 0.0:
        np.testing.assert_allclose(time, np.sqrt(2.0 * angle / rate), rtol=0.0, atol=1.0001 * first / rate)
    assert energy_left(whole) < 1e-10


def test_a_falling_torque_line_brings_it_to_speed():
    """ω = ω∞ (1 − exp(−t/τ)) with the motor's torque at rest T0 + g Ω."""
    fall = 0.5
    whole = course(scenario(0.0, speed_regulation=f"{fall} N*m*s/rad"), 60)
    final = SPEED + (TORQUE - LOAD) / fall
    time, speed = whole["time"], whole["speed"][:, 0]
    expected = final - (final - CREEP * SPEED) * np.exp(-time * fall / TOTAL)
    assert expected[-1] > 0.75 * final
    np.testing.assert_allclose(speed, expected, rtol=0.0, atol=1e-6 * final)


#: Torque over speed of an induction motor, rad/s and N m: pull-up, breakdown, no load.
INDUCTION = ([0.0, 40.0, 60.0, 85.0, 95.0, 100.0], [60.0, 52.0, 65.0, 110.0, 60.0, 0.0])


def curve_of(points: tuple[list[float], list[float]]) -> dict[str, Any]:
    """A motor's curve as TOML has it, in place of its torque."""
    speeds, torques = points
    columns = {"speed": {"unit": "rad/s", "values": speeds}, "torque": {"unit": "N*m", "values": torques}}
    return {"torque_speed_curve": columns, "input_torque": None}


@pytest.mark.parametrize("method", ["dopri5", "rodas4"])
def test_a_motor_with_a_torque_curve_is_a_drive_of_one_degree_of_freedom(method):
    """SciPy on J ω' = T(ω) − T_load, T by its own monotone interpolation."""
    whole = course(scenario(0.0, **curve_of(INDUCTION)), 40, method)
    line = PchipInterpolator(*INDUCTION)
    found = solve_ivp(
        lambda _, y: [(line(y[0]) - LOAD) / TOTAL],
        (0.0, whole["time"][-1]),
        [CREEP * SPEED],
        t_eval=whole["time"],
        rtol=1e-9,
        atol=1e-9,
    )
    assert found.y[0, -1] > 95.0
    np.testing.assert_allclose(whole["speed"][:, 0], found.y[0], rtol=0.0, atol=1e-5 * SPEED)
    assert energy_left(whole) < 1e-8


def test_a_curve_through_two_points_is_a_falling_line():
    line = course(scenario(0.0, speed_regulation="0.5 N*m*s/rad"), 20)
    points = [80.0, SPEED], [TORQUE + 10.0, TORQUE]
    curve = course(scenario(0.0, **curve_of(points)), 20)
    np.testing.assert_allclose(curve["speed"], line["speed"], rtol=1e-9)


@pytest.mark.parametrize(
    ("changed", "key"),
    [
        ({"input_torque": "10 N*m"}, "operating.input_torque"),
        ({"speed_regulation": "1 N*m*s/rad"}, "operating.speed_regulation"),
        ({"source": "speed", "start_speed": None}, "operating.torque_speed_curve"),
    ],
)
def test_a_torque_curve_is_not_said_twice(changed, key):
    made = scenario(0.0, **curve_of(INDUCTION) | changed)
    with pytest.raises(InputError) as refused:
        case_of_table(made)
    assert refused.value.key == key


def test_a_running_motor_launches_gears_that_stand():
    """Slip ends after J1 J2/(J1 + J2) Δω/M; the motor's torque is that of the load."""
    capacity, slip = 60.0, 80.0
    clutch = {"torque": f"{capacity} N*m", "slip": f"{slip} rad/s"}
    whole = course(scenario(0.0, clutch, input_torque="0 N*m", output_torque="1e-3 N*m"), 12)
    reduced = MOTOR * TOTAL / (MOTOR + TOTAL)
    time, slips = whole["time"], whole["clutch_slip"][:, 0]
    slipping = slips > 1.0
    slope, first = np.polyfit(time[slipping], slips[slipping], 1)
    assert -first / slope == pytest.approx(reduced * slip / capacity, rel=1e-4)
    inertia = {"b0": DRIVER, "b1": DRIVEN, "motor": MOTOR}
    momentum = whole["speed"] @ [inertia[name] for name in whole["names"].tolist()]
    np.testing.assert_allclose(momentum, MOTOR * slip, rtol=1e-3)
    assert np.max(np.abs(slips[-20:])) < 0.1
    assert whole["clutch_work"][-1, 0] == pytest.approx(0.5 * reduced * slip**2, rel=2e-3)


def test_a_motor_weaker_than_the_load_does_not_start():
    """It stalls where it stands, and says so."""
    model = spring_model(scenario(0.0, input_torque="10 N*m")).model
    *_, stop = transient(
        model, initial_state(model, "static"), TransientSettings("dopri5", 1e-6, 2, 10**6, 20)
    )
    assert isinstance(stop, Stop)
    assert "rest" in stop.reason


def test_a_prescribed_speed_has_no_other_start():
    made = scenario(5.0, source="speed")
    del made["operating"]["input_torque"]
    with pytest.raises(InputError) as refused:
        case_of_table(made)
    assert refused.value.key == "operating.start_speed"
