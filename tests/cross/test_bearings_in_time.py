"""Gears on bearings whose forces are evaluated in time: equilibrium, small vibrations, energy, compilers."""

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import root

import tribodyn as td
from tests.support.bearings_in_time import alone, on_bearings, shafts_of
from tests.support.drawn_shafts import BALL, ROLLER
from tests.support.plain_kernels import interpreted
from tests.support.right_hand_sides import assert_right_hand_sides_agree
from tests.support.states import random_place, random_state
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.modes import linearised, modes
from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.dynamics.recorded.outputs import evaluated, sampled
from tribodyn.errors import InputError
from tribodyn.interface.scenario import scenario
from tribodyn.kernels.native.arguments import packed
from tribodyn.record.reader import Record
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.march.by_time import begun_clock, time_buffer, time_control
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import Place
from tribodyn.solve.march.time_outputs import outputs, time_outputs
from tribodyn.solve.right_hand_side import contacts_of, rhs, work_array
from tribodyn.studies import STUDIES
from tribodyn.studies.motion.prepare import PreparedGearbox, prepare
from tribodyn.train.bearing_forces import IN_TIME
from tribodyn.train.elastic.rolling_bearing import BallRow
from tribodyn.train.layout import displacements, velocities

FLOATING = BALL | {"locating": False}
PLAIN = {"friction.law": "none"}


@cache
def prepared(kind: str, force: str) -> PreparedGearbox:
    second = {"ball": FLOATING, "roller": ROLLER}[kind]
    return prepare(scenario("involute-23-47", PLAIN | {"shaft": shafts_of(second, force)}))


@pytest.mark.parametrize("kind", ["ball", "roller"])
def test_equilibrium_is_that_of_matrices_about_the_mean_load(kind: str):
    """Where cages stand as the statics have them gears and their loads are the same."""
    linear, in_time = (static_equilibrium(prepared(kind, force).model) for force in ("linear", "in-time"))
    places = [prepared(kind, force).model.layout for force in ("linear", "in-time")]
    assert places[1].modes == 4 * 5
    found, expected = in_time[: places[0].half], linear[: places[0].half]
    assert np.abs(expected[:2]).max() > 1e-5
    assert found == pytest.approx(expected, rel=2e-4, abs=2e-4 * np.abs(expected[:5]).max())


@pytest.mark.parametrize("kind", ["ball", "roller"])
def test_small_vibrations_are_those_of_the_matrix(kind: str):
    """Where cages stand still: the slopes of the accelerations differ by the stiffness of the mesh alone.

    By differences of the equations of motion, over the mean stiffness that modes are of.
    """
    gearbox = prepared(kind, "in-time")
    model = gearbox.model
    state = static_equilibrium(model)
    mass, stiffness = linearised(model, [])
    unknown, equation = displacements(model.layout), velocities(model.layout)
    steps = np.zeros((len(unknown), model.layout.states))
    steps[range(len(unknown)), unknown] = 1e-10
    ahead, behind = (accelerations(state + sign * steps, 0.0, 0, model)[:, equation] for sign in (1.0, -1.0))
    rate = float(model.operation.pitch_angle) / float(model.operation.nominal_speed)  # s per cycle
    kept = np.ix_(unknown, unknown)
    slopes = -mass[kept] @ (ahead - behind).T / 2e-10 / rate
    of_bearings = slice(-model.layout.modes, None)  # no mesh acts on these
    expected = stiffness[kept][of_bearings, of_bearings]
    # elements beside the loaded ones are about to touch
    assert slopes[of_bearings, of_bearings] == pytest.approx(expected, abs=3e-3 * np.abs(expected).max())


def test_frequencies_are_those_of_the_matrix():
    """The lowest ones, which the inertia of the shafts' ends has little part in."""
    found, expected = (
        modes(prepared("ball", force).model, [one.cycle for one in prepared("ball", force).tables]).frequency
        for force in ("in-time", "linear")
    )
    assert found[:6] == pytest.approx(expected[:6], rel=0.015)


@pytest.mark.slow
@pytest.mark.parametrize("formulation", ["classical", "energy-consistent"])
def test_energy_balances_with_the_cages_power(formulation: str, tmp_path):
    """Of all works and energies, 1e-6 of the work; a smaller tolerance changes nothing."""
    changes: dict[str, Any] = PLAIN | {
        "shaft": {"pinion": on_bearings(BALL, FLOATING)},
        "operating.pinion_speed": "300 rad/s",
        "mesh.formulation": formulation,
        "solver.method": "dopri5",
        "solver.cycles": 4,
    }
    fine = changes | {"solver.rtol": 1e-9}
    runs = [
        td.run("involute-23-47", one, output=tmp_path / f"{n}.h5") for n, one in enumerate((changes, fine))
    ]
    assert all(abs(run.summary["energy_residual"]) < 1e-6 for run in runs)
    forces = []
    for run in runs:
        with Record(run.path) as record:
            assert np.ptp(np.asarray(record["power_cages"])) > 0.01
            forces.append(np.asarray(record["bearing_force_y"]))
            assert list(record["bearing"])[-2:] == ["pinion-1", "pinion-2"]
    assert forces[0] == pytest.approx(forces[1], abs=1e-4 * np.abs(forces[1]).max())


@pytest.mark.slow
def test_passing_balls_move_the_shaft_as_the_statics_have_it(tmp_path):
    """Far below all modes: both bearings under half the load each, at every angle of their cages.

    Balls pass 3.6 times in a turn; the amplitude there, in x and y.
    """
    changes: dict[str, Any] = PLAIN | {
        "shaft": {"pinion": on_bearings(BALL, FLOATING)},
        "operating.pinion_speed": "60 rad/s",
        "solver.method": "dopri5",
        "solver.cycles": 115,
        "output.samples_per_cycle": 20,
    }
    run = td.run("involute-23-47", changes, output=tmp_path / "slow.h5")
    with Record(run.path) as record:
        names, moved = list(record["dof"]), np.asarray(record["displacement"])
        turns = np.asarray(record["pinion_angle"])
        load = np.array([np.mean(np.asarray(record[f"bearing_force_{d}"])[:, -2:]) for d in "xy"])
    wave = np.exp(-3.6j * turns)[:-1]
    found = np.array([2.0 * np.mean(moved[:-1, names.index(name)] * wave) for name in ("x_p", "y_p")])
    row = BallRow(9, 12e-3, 60e-3, clearance=10e-6)
    angles = 2.0 * np.pi / 9 * np.arange(24) / 24
    path, at = [], load / np.linalg.norm(load) * 30e-6

    def left(u: np.ndarray, angle: float) -> np.ndarray:
        return np.array(alone(row, np.array([*u, 0.0, 0.0, 0.0]), angle)[:2]) - load

    for angle in angles:
        at = root(
            lambda u, a=angle: np.array(alone(row, np.array([*u, 0, 0, 0]), a)[:2]) - load, at, tol=1e-12
        ).x
        path.append(at)
    expected = np.abs(2.0 * np.mean(np.array(path) * np.exp(-9j * angles)[:, None], axis=0))
    assert np.max(expected) > 1e-7
    assert np.abs(found) == pytest.approx(expected, rel=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("formulation", ["classical", "energy-consistent"])
def test_jacobian_is_the_slope_of_the_equations(formulation: str, rng: np.random.Generator):
    changes = PLAIN | {"shaft": {"pinion": on_bearings(BALL, ROLLER)}, "mesh.formulation": formulation}
    model = prepare(scenario("involute-23-47", changes)).model
    states, works = model.layout.states, model.layout.mechanical
    y, (phase, interval) = random_state(rng, model), random_place(rng, model.schedule, 0)[:2]
    f, work = np.zeros(states), work_array(model)
    native = with_shared_code(model)
    interpreted(rhs)(phase, 3.0, interval, y, native, work, f)
    into = Differences(np.zeros(states), np.zeros((states, states)), np.zeros(states))
    scale = np.full(states, 1e-5)
    end = float(model.schedule.end[interval])
    interpreted(differentiate)(Place(phase, 3.0, interval, end), y, f, scale, native, work, into)
    for j in displacements(model.layout):
        step = 1e-9 * np.eye(states)[j]
        ahead, behind = (_rates(model, y + sign * step, phase, interval) for sign in (1.0, -1.0))
        expected = (ahead - behind) / 2e-9
        for rows in (slice(works), slice(works, states)):
            size = 2e-4 * max(np.abs(expected[rows]).max(), 1e-12)
            np.testing.assert_allclose(into.jacobian[rows, j], expected[rows], atol=size)


def _rates(model: Model, y: np.ndarray, phase: float, interval: int) -> np.ndarray:
    plain: dict[int, Any] = {}
    derivatives(phase, 3.0, interval, y, model, contacts_of(model), plain)
    return np.array([plain[i] for i in range(model.layout.states)])


@pytest.mark.slow
def test_every_compiler_makes_the_same(rng: np.random.Generator):
    changes = PLAIN | {"shaft": {"pinion": on_bearings(BALL, ROLLER)}}
    model = prepare(scenario("involute-23-47", changes)).model
    assert_right_hand_sides_agree([model], rng, rtol=1e-9)


def test_frequencies_and_lines_of_a_bearing():
    """Nine balls of 12 mm on 60 mm: the cage turns at 0.4, balls pass at 3.6 and 5.4 of the shaft."""
    case = scenario("involute-23-47", PLAIN | {"shaft": {"gear": on_bearings(BALL, ROLLER)}})
    found = STUDIES[case.kind].check(case)
    shaft = 10.0 / (2.0 * np.pi) * 23.0 / 47.0
    of = found.data["bearing_frequencies"]["gear-1"]
    assert of["cage"] == pytest.approx(0.4 * shaft)
    assert of["outer_pass"] == pytest.approx(3.6 * shaft)
    assert of["inner_pass"] == pytest.approx(5.4 * shaft)
    assert any("Bearings in time" in table.title for table in found.tables)


def test_numbers_are_not_compiled_in():
    """Clearance, sizes, how many balls: the same machine code, which linear bearings have nothing of."""
    other = BALL | {"elements": 8, "clearance": "20 um", "element_diameter": "13 mm", "force": "in-time"}
    shafts = shafts_of(FLOATING)
    shafts["gear"]["bearing"][0] |= other
    changed = prepare(scenario("involute-23-47", PLAIN | {"shaft": shafts})).model
    model, linear = prepared("ball", "in-time").model, prepared("ball", "linear").model
    assert packed(changed).layout is packed(model).layout
    assert IN_TIME.act not in linear.options.bearings


def test_it_is_refused_where_it_means_nothing(tmp_path):
    springs = {"stiffness_x": "1e9 N/m", "stiffness_y": "1e9 N/m", "stiffness_axial": "1e8 N/m"}
    shaft = {"pinion": on_bearings(BALL, springs)}
    with pytest.raises(InputError, match="that of rolling elements, and type is missing") as refused:
        scenario("involute-23-47", {"shaft": shaft})
    assert refused.value.key == "shaft.pinion.bearing.1.force"
    vary = {"operating.pinion_speed": ["10 rad/s", "20 rad/s"]}
    with pytest.raises(InputError, match="nothing repeats"):
        td.sweep("involute-23-47", vary, {"shaft": shafts_of()}, output=tmp_path / "s.h5")


def test_energy_stored_at_a_moment_counts_the_bearings():
    """What a march by time gives, run as Python, and what a record has."""
    model = prepared("ball", "in-time").model
    y = static_equilibrium(model)
    control = time_control(model, y, 1e-6, 10**6)
    clock, out = begun_clock(model, y, control), np.zeros(len(time_outputs(model)))
    outputs.function(model, y, clock, work_array(model), time_buffer(model.layout), out)
    whole = sampled(evaluated(np.zeros(1), y[None], model)).whole
    names = [one.name for one in time_outputs(model)]
    for name in ("stored_energy", "power_in", "power_out"):
        assert out[names.index(name)] == pytest.approx(float(whole[name][0]), rel=1e-9), name
