"""Clutches and brakes: closed forms, SciPy on equations of the test's own, every compiler, bad input."""

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

from tests.support.plain_kernels import interpreted
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.spring_trains import Gears, scenario_of, spring_model
from tests.support.states import sampled
from tests.support.train_matrices import Body, Mesh, Shaft, Train
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.parameters import with_shared_code
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs, train_outputs
from tribodyn.errors import InputError
from tribodyn.solve.initial import initial_state
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import Place
from tribodyn.solve.right_hand_side import rhs, work_array
from tribodyn.solve.tolerances import state_scales
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.train.structure import turn_of

#: Inertias of motor with driver, driven gear, flywheel, kg m²; stiffness of the mesh, N/m.
MOTOR, GEAR, FLYWHEEL, MESH = 2e-2, 4e-3, 3e-2, 3e8
TEETH, RADIUS, ALPHA, SPEED = 30, 0.045, np.radians(20.0), 100.0
TORQUE, SLIP = 60.0, 40.0  # of the clutch, N m; of the flywheel behind the gear at the start, rad/s
LOAD = 100.0
CYCLE = 2.0 * np.pi / (TEETH * SPEED)


def scenario(clutch: dict[str, Any], motor: bool = True, swapped: bool = False) -> dict[str, Any]:
    """Driver, gear, and a flywheel that a clutch joins to the gear; no losses but in the clutch.

    A load on the gear, which the motor balances, keeps its driving flanks in contact.
    """
    bodies = (Body(1.0, MOTOR), Body(1.0, GEAR), Body(1.0, FLYWHEEL))
    mesh = Mesh((0, 1), (RADIUS, RADIUS), 0.0, ALPHA, -1, MESH)
    drive = {"source": "torque"} if motor else {}
    duty = {"input_speed": f"{SPEED} rad/s", "output_torque": "0 N*m", **drive}
    made = scenario_of(Train(bodies, (), (), (mesh,)), [Gears((TEETH, TEETH), 3e-3)], 0.0, duty)
    ends = ["b2", "b1"] if swapped else ["b1", "b2"]
    made["clutch"] = [{"name": "main", "ends": ends, "reversal_speed": "0.1 rad/s", **clutch}]
    made["load"] = [{"at": "b1", "torque": f"{LOAD} N*m"}]
    return made


def constant(slip: float = SLIP, **keys: Any) -> dict[str, Any]:
    return {"torque": f"{TORQUE} N*m", "slip": f"{slip} rad/s", **keys}


def course(prepared: PreparedGearbox, cycles: int) -> dict[str, Any]:
    """What is recorded of a run."""
    settings = TransientSettings("dopri5", 1e-9, cycles, 10**6, 50)
    seen = evaluated(*sampled(prepared.model, settings), prepared.model)
    return train_outputs(seen, mesh_outputs(0, seen)["sliding_loss"])


def imbalance(whole: dict[str, Any]) -> float:
    """What is left of the energy balance over the work that went into the clutches."""
    change = {name: whole[name][-1] - whole[name][0] for name in whole if "work_" in name or "_work" in name}
    left = change["work_in"] + change["work_parametric"] - change["work_out"] - change["work_friction"]
    left -= change["work_damping"] + float(np.sum(change["clutch_work"]))
    stored = whole["stored_energy"][-1] - whole["stored_energy"][0]
    return abs(left - stored) / float(np.sum(change["clutch_work"]))


@cache
def locked(swapped: bool, sign: float, reversal_speed: float) -> dict[str, Any]:
    clutch = constant(sign * SLIP * (-1.0 if swapped else 1.0), reversal_speed=f"{reversal_speed} rad/s")
    return course(spring_model(scenario(clutch, swapped=swapped)), 12)


def end_of_slip(whole: dict[str, Any]) -> float:
    """Time at which the slip would vanish, by its course while the clutch slips."""
    time, slip = whole["time"], whole["clutch_slip"][:, 0]
    slipping = np.abs(slip) > 1.0
    slope, at_start = np.polyfit(time[slipping], slip[slipping], 1)
    return -at_start / slope


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_two_inertias_lock_up(sign):
    """T = J1 J2/(J1 + J2) Δω/M, heat ½ J1 J2/(J1 + J2) Δω²; both move as one afterwards."""
    whole = locked(False, sign, 0.1)
    first = MOTOR + GEAR
    reduced = first * FLYWHEEL / (first + FLYWHEEL)
    assert end_of_slip(whole) == pytest.approx(reduced * SLIP / TORQUE, rel=1e-8)
    assert whole["clutch_work"][-1, 0] == pytest.approx(0.5 * reduced * SLIP**2, rel=1e-3)
    assert np.max(np.abs(whole["clutch_slip"][-50:])) < 0.1
    speed = (first * SPEED + FLYWHEEL * (SPEED - sign * SLIP)) / (first + FLYWHEEL)
    np.testing.assert_allclose(np.mean(whole["speed"][-50:], axis=0), speed, rtol=2e-3)
    assert imbalance(whole) < 1e-8


def test_its_ends_may_stand_in_either_order():
    one, two = locked(False, 1.0, 0.1), locked(True, 1.0, 0.1)
    for name in ("clutch_slip", "clutch_torque"):
        scale = np.max(np.abs(one[name]))
        np.testing.assert_allclose(two[name], -one[name], rtol=0.0, atol=1e-6 * scale)
    np.testing.assert_allclose(two["clutch_work"], one["clutch_work"], rtol=1e-7, atol=1e-6)


def test_the_end_of_slip_converges_as_the_reversal_speed_shrinks():
    """Where a sharp clutch would have stopped slipping: in proportion to the reversal speed."""
    left = []
    for width in (0.8, 0.4, 0.2):
        whole = locked(False, 1.0, width)
        left.append(np.interp(end_of_slip(whole), whole["time"], whole["clutch_slip"][:, 0]))
        assert 0.0 < left[-1] < width
    assert left[2] < 0.65 * left[1] < 0.65**2 * left[0]


#: Of a clutch that closes over time and holds more at rest, and a brake on the flywheel.
POINTS, CLOSING = np.array([0.0, 3e-3, 9e-3]), np.array([0.0, 20.0, TORQUE])
RATIO, FALL, WIDTH, BRAKE, BEGIN = 1.3, 3.0, 0.5, 15.0, 15.0


def closing(**keys: Any) -> dict[str, Any]:
    """At a prescribed speed; the flywheel is slower at the start."""
    table = {
        "time": {"unit": "s", "values": POINTS.tolist()},
        "normal_force": {"unit": "N", "values": (CLOSING / (0.1 * 0.05 * 4)).tolist()},
    }
    friction = {"friction_coefficient": 0.1, "effective_radius": "50 mm", "faces": 4}
    friction |= {"static_ratio": RATIO, "static_speed": f"{FALL} rad/s", "reversal_speed": f"{WIDTH} rad/s"}
    made = scenario({"normal_force_table": table, "slip": f"{BEGIN} rad/s", **friction} | keys, motor=False)
    brake = {"ends": ["ground", "b2"], "torque": f"{BRAKE} N*m", "reversal_speed": f"{WIDTH} rad/s"}
    made["clutch"].append({"name": "brake", **brake})
    return made


def rubbing(slip: float) -> float:
    """Sign of a slip over the width of reversal."""
    share = np.clip(slip / WIDTH, -1.0, 1.0)
    return float(1.5 * share - 0.5 * share**3)


def by_scipy(times: np.ndarray) -> np.ndarray:
    """Twist of the gear, its rate, and speed of the flywheel (time, 3), the driver turning evenly."""
    capacity = PchipInterpolator(POINTS, CLOSING)
    flat = CubicHermiteSpline(POINTS, CLOSING, [0.0, float(capacity(POINTS[1], 1)), 0.0])
    mesh = MESH * (RADIUS * np.cos(ALPHA)) ** 2

    def rates(t: float, state: np.ndarray) -> list[float]:
        twist, rate, speed = state
        slip = SPEED + rate - speed
        torque = float(flat(min(t, POINTS[-1]))) * (1.0 + (RATIO - 1.0) * np.exp(-((slip / FALL) ** 2)))
        torque *= rubbing(slip)
        return [rate, (-mesh * twist - torque - LOAD) / GEAR, (torque - BRAKE * rubbing(speed)) / FLYWHEEL]

    start = [-LOAD / mesh, 0.0, SPEED - BEGIN]
    return solve_ivp(rates, (0.0, times[-1]), start, "Radau", times, rtol=1e-9, atol=1e-12, max_step=1e-4).y.T


@cache
def closed_by_scipy() -> tuple[np.ndarray, np.ndarray]:
    times = np.arange(15 * 50 + 1) * CYCLE / 50
    return times, by_scipy(times)


@pytest.mark.parametrize(
    "method",
    ["dopri5", "rodas4", *(pytest.param(name, marks=pytest.mark.soak) for name in ("tsit5", "radau"))],
)
def test_gear_and_flywheel_move_as_scipy_finds(method):
    prepared = spring_model(closing())
    model, names = prepared.model, prepared.names
    cycles, states = sampled(model, TransientSettings(method, 1e-9, 15, 10**6, 50))
    times, expected = closed_by_scipy()
    layout = model.layout
    gear, wheel = (turn_of(names.index(name), layout) for name in ("b1", "b2"))
    found = states[:, [gear, layout.half + gear, layout.half + wheel]] + [0.0, 0.0, SPEED]
    np.testing.assert_allclose(cycles * CYCLE, times[: len(cycles)], rtol=0.0, atol=1e-12)
    expected = expected[: len(cycles)]
    assert expected[-1, 2] == pytest.approx(SPEED, abs=WIDTH)  # the flywheel has come to speed
    off = np.max(np.abs(found - expected), axis=0) / np.ptp(expected, axis=0)
    np.testing.assert_array_less(off, 1e-5)


def test_energy_balances_with_clutch_and_brake():
    whole = course(spring_model(closing()), 15)
    assert np.all(np.diff(whole["clutch_work"], axis=0) >= 0.0)
    assert np.all(whole["clutch_work"][-1] > 1.0)
    assert imbalance(whole) < 1e-6


#: Behind a motor; and behind a prescribed speed, with a brake.
either = pytest.mark.parametrize(
    "made",
    [pytest.param(scenario(constant(static_ratio=1.2)), marks=pytest.mark.soak), closing()],
    ids=["motor", "brake"],
)


@either
def test_every_compiler_makes_the_same_of_a_clutch(made, rng):
    assert_right_hand_sides_agree(at_several_conditions(spring_model(made).model, 3), rng, rtol=1e-9)


@pytest.mark.parametrize("slip", [0.02, 0.3, -20.0])
@either
def test_jacobian_is_that_of_the_right_hand_side(made, slip):
    """By central differences in every coordinate, where the clutch creeps and where it slips."""
    model = with_shared_code(spring_model(made).model)
    layout = model.layout
    y = initial_state(model, "static")
    y[layout.half + turn_of(layout.clutch_second[0], layout)] -= slip
    place, work = Place(0.4, 2.0, 0, 1.0), work_array(model)
    f, trial = np.zeros((2, layout.states))
    rhs(place.phase, place.cycle, place.interval, y, model, work, f)
    into = Differences(
        np.zeros(layout.states), np.zeros((layout.states, layout.states)), np.zeros(layout.states)
    )
    scale = state_scales(model, y)
    interpreted(differentiate, rhs)(place, y, f, scale, model, work, into)
    reference = layout.half + layout.lag
    for j in range(layout.mechanical):
        if j == reference and not model.options.drive:
            continue  # its speed is prescribed
        ends = []
        for way in (1.0, -1.0):
            moved = y.copy()
            moved[j] += way * 1e-3 * scale[j]
            rhs(place.phase, place.cycle, place.interval, moved, model, work, trial)
            ends.append(trial.copy())
        expected = (ends[0] - ends[1]) / (2e-3 * scale[j])
        size = np.max(np.abs(expected)) + 1e-12
        np.testing.assert_allclose(into.jacobian[:, j], expected, rtol=0.0, atol=2e-5 * size, err_msg=str(j))


def test_a_clutch_that_holds_the_load_is_closed_at_the_start():
    """It creeps as 2 w sin(arcsin(T/C)/3), and nothing accelerates; one that does not hold it slips."""
    made = scenario({"torque": "60 N*m", "reversal_speed": f"{WIDTH} rad/s"}, motor=False)
    made["operating"]["output_torque"] = "40 N*m"
    whole = course(spring_model(made), 2)
    np.testing.assert_allclose(whole["clutch_torque"], 40.0, rtol=1e-9)
    np.testing.assert_allclose(
        whole["clutch_slip"], 2.0 * WIDTH * np.sin(np.arcsin(40.0 / 60.0) / 3.0), rtol=1e-9
    )
    made["clutch"][0]["torque"] = "30 N*m"
    whole = course(spring_model(made), 2)
    rate = (30.0 - 40.0) / FLYWHEEL
    np.testing.assert_allclose(whole["clutch_slip"][:, 0], WIDTH - rate * whole["time"], rtol=1e-6)


@pytest.mark.parametrize(
    ("clutch", "key", "rule"),
    [
        ({}, "clutch.0.torque", "missing"),
        ({"torque": "5 N*m", "normal_force": "3 N"}, "clutch.0.normal_force", "contradicts torque"),
        (
            {"torque": "5 N*m", "friction_coefficient": 0.1},
            "clutch.0.friction_coefficient",
            "contradicts torque",
        ),
        ({"normal_force": "3 N", "friction_coefficient": 0.1}, "clutch.0.effective_radius", "needs it"),
        ({"torque": "-5 N*m"}, "clutch.0.torque", ""),
        ({"torque": "5 N*m", "static_ratio": 0.9}, "clutch.0.static_ratio", ""),
        ({"torque": "5 N*m", "reversal_speed": "0 rad/s"}, "clutch.0.reversal_speed", ""),
        ({"torque": "5 N*m", "static_speed": "0.01 rad/s"}, "clutch.0.static_speed", "below reversal_speed"),
        ({"torque": "5 N*m", "ends": ["b1", "b7"]}, "clutch.0.ends.1", ""),
        ({"torque": "5 N*m", "ends": ["ground", "b2"], "slip": "1 rad/s"}, "clutch.0.slip", "brake"),
    ],
)
def test_bad_input_is_refused(clutch, key, rule):
    made = scenario({})
    made["clutch"][0] |= clutch
    if "ground" in made["clutch"][0]["ends"]:
        made["link"] = [{"ends": ["b1", "b2"], "stiffness": "1e4 N*m/rad"}]
    with pytest.raises(InputError) as refused:
        case_of_table(made)
    errors = getattr(refused.value, "errors", (refused.value,))
    assert any(error.key == key and rule in error.rule for error in errors), str(refused.value)


def test_a_negative_capacity_over_time_is_refused():
    table = {"time": {"unit": "s", "values": [0.0, 1.0]}, "torque": {"unit": "N*m", "values": [1.0, -2.0]}}
    with pytest.raises(InputError, match="cannot be negative"):
        case_of_table(scenario({"torque_table": table}))


def two_stages(ends: list[str], **operating: Any) -> dict[str, Any]:
    """Two pairs of gears, joined by a clutch or by a shaft."""
    bodies = tuple(Body(1.0, GEAR) for _ in range(5))
    meshes = (
        Mesh((0, 1), (RADIUS, RADIUS), 0.0, ALPHA, -1, MESH),
        Mesh((2, 3), (RADIUS,) * 2, 0.0, ALPHA, 1, MESH),
    )
    duty = {"input_speed": f"{SPEED} rad/s", "output_torque": "5 N*m"}
    shafts = (Shaft((1, 2), 1e4),) if ends != ["b1", "b2"] else ()
    made = scenario_of(Train(bodies, (), shafts, meshes), [Gears((TEETH, TEETH), 3e-3)] * 2, 0.0, duty)
    made["clutch"] = [{"ends": ends, "torque": "20 N*m"}]
    made["operating"] |= operating
    return made


@pytest.mark.parametrize(
    ("made", "key", "rule"),
    [
        (two_stages(["b1", "b2"], output="b3"), "clutch.0.ends", "parts the meshes"),
        (two_stages(["b4", "b0"], input="b4", output="b3"), "operating.source", "parts these from the input"),
    ],
    ids=["teeth on both sides", "prescribed speed beyond"],
)
def test_what_a_clutch_must_not_part_is_refused(made, key, rule):
    if "b4" not in made["clutch"][0]["ends"]:
        made["body"] = [body for body in made["body"] if body["name"] != "b4"]
    with pytest.raises(InputError) as refused:
        case_of_table(made)
    assert (refused.value.key, rule in refused.value.rule) == (key, True), str(refused.value)
