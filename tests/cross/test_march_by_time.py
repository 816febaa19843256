"""The native march by time: against SciPy, over communication steps, and with inputs that change."""

from functools import cache

import jax
import numpy as np
import pytest

import tribodyn as td
from tests.support.time_runs import DRIVEN, LOAD, RADIUS, SPEED, TOTAL, Walker, pair, run, springs, train
from tribodyn.dynamics.parameters import BY_TIME, DRIVE_SPEED, Model
from tribodyn.solve.tolerances import output_shaft
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare

#: The shipped pair is turned back, once with the sliding of the vibration and once with the nominal one.
BACK = {"operating.pinion_torque": "20 N*m", "operating.start_speed": "6 rad/s"}
CASES = ("dynamic", "kinematic", "backlash", "two-stage-reducer", "planetary-24-84")


@cache
def case(name: str) -> PreparedGearbox:
    if name in ("dynamic", "kinematic"):
        return pair(BACK | {"friction.sliding": name}, "40 ms")
    if name == "backlash":  # the load turns round, and the teeth fly through the backlash
        return pair({**BACK, "mesh.backlash": "0.1 mm", "operating.gear_torque": "-30 N*m"}, "15 ms")
    return train(name)


def rigid(speed: float = SPEED) -> Model:
    """Two gears on a spring whose reference has a prescribed speed."""
    model = springs("20 ms", start_speed=f"{speed} rad/s", input_torque=f"{LOAD} N*m").model
    return model._replace(options=model.options._replace(drive=DRIVE_SPEED, variable=BY_TIME))


@pytest.mark.parametrize("name", CASES)
def test_it_is_the_motion_of_scipy(name):
    """Speeds and losses of all bodies and meshes, and the balance of energy."""
    ours, theirs = (run(case(name), method, rtol=1e-8) for method in ("dopri5", "dop853"))
    assert abs(ours.residual) < 2e-6
    assert np.ptp(ours["speed"][:, 0]) > 1.0
    for quantity, share in (("speed", 1e-5), ("angle", 1e-6), ("work_friction", 1e-4), ("work_out", 1e-6)):
        there = theirs[quantity]
        size = np.max(np.abs(there)) or 1.0
        np.testing.assert_allclose(
            ours[quantity] / size, there / size, rtol=0.0, atol=share, err_msg=quantity
        )


@pytest.mark.parametrize("name", ["dynamic", "kinematic"])
def test_a_finer_tolerance_is_more_exact(name):
    """From rest, or turned back: the error falls with the tolerance."""
    exact = run(case(name), "dopri5", rtol=1e-11)["speed"]
    errors = []
    for rtol in (1e-5, 1e-7, 1e-9):
        errors.append(np.max(np.abs(run(case(name), "dopri5", rtol=rtol)["speed"] - exact)))
    assert errors[0] < 1e-2 * np.ptp(exact)
    assert errors[1] < 0.1 * errors[0]
    assert errors[2] < 0.1 * errors[1]


def test_it_leaves_a_bound_whose_sides_drive_it_against_each_other():
    """At rest where a loaded pair leaves, while the load drives it back: time goes on in short steps."""
    loads = {"operating.pinion_torque": "26 N*m", "operating.gear_torque": "56 N*m"}
    prepared = pair(loads | {"mesh.backlash": "0.2 mm"}, "8 ms")
    ours, theirs = (run(prepared, method, rtol=1e-7) for method in ("dopri5", "lsoda"))
    assert ours["reference_angle"][-1] < -1e-3
    for name in ("angle", "speed"):
        difference = np.max(np.abs(ours[name] - theirs[name]))
        assert difference < 2e-3 * np.max(np.abs(theirs[name])), name


def test_communication_steps_do_not_change_the_motion():
    whole, parts = (Walker.begun(case("two-stage-reducer").model, 1e-9) for _ in range(2))
    at_once = whole.to(0.01)
    for number in range(1, 101):
        by_steps = parts.to(number * 1e-4)
    for name, value in at_once.items():
        assert by_steps[name] == pytest.approx(value, rel=1e-5, abs=1e-9), name


def test_state_and_clock_say_all():
    """Going back to a state kept before, the same bits come again."""
    walker = Walker.begun(case("two-stage-reducer").model)
    walker.to(0.01)
    kept = walker.y.copy(), walker.clock.copy()
    once = walker.to(0.012, drive_torque=50.0)
    walker.to(0.02)
    walker.y[:], walker.clock[:] = kept
    assert walker.to(0.012, drive_torque=50.0) == once


def test_a_step_of_the_torque_on_the_output():
    """J ω' = T − T_load − T_step: all speeds and works follow, and the mesh carries what it must."""
    walker = Walker.begun(springs("20 ms", input_torque=f"{LOAD} N*m").model, 1e-9)
    walker.to(0.005)
    step, drive = 30.0, 110.0
    for time in (0.01, 0.03, 0.08):
        at = walker.to(time, output_torque=step, drive_torque=drive)
        speed = (drive - LOAD - step) / TOTAL * (time - 0.005)
        assert at["input_speed"] == pytest.approx(speed, abs=2e-3 * SPEED)
        assert at["output_torque"] == LOAD + step
    load = at["normal_load.0"] * RADIUS * np.cos(np.radians(20.0))
    assert load == pytest.approx(LOAD + step + DRIVEN * (drive - LOAD - step) / TOTAL, rel=2e-2)


def test_a_ramp_of_the_prescribed_speed():
    """ω = ω0 + a t to rounding, also backwards; the drive gives J a beside the load, on the mean."""
    slope, walker = -4e3, Walker.begun(rigid(), 1e-9)
    torques, times = [], np.linspace(0.0, 0.05, 501)[1:]
    for time in times:
        at = walker.to(float(time), acceleration=slope)
        torques.append(at["input_torque"])
        assert at["input_speed"] == pytest.approx(SPEED + slope * time, abs=1e-9 * SPEED)
        assert at["input_angle"] == pytest.approx(SPEED * time + slope * time**2 / 2.0, abs=1e-9)
    assert at["input_speed"] < -0.9 * SPEED
    expected = LOAD + TOTAL * slope
    assert np.mean(torques[100:]) == pytest.approx(expected, rel=1e-2)


def balance(before: dict[str, float], after: dict[str, float], works: np.ndarray) -> float:
    """What work in, out, to damping, parametric and to friction leave of the energy stored."""
    put_in, taken_out, damping, parametric, friction = works[:5]
    stored = after["stored_energy"] - before["stored_energy"]
    return float(put_in + parametric - taken_out - damping - friction - stored)


def test_the_shaft_beside_the_output_holds_its_speed():
    """A motor without a load against a shaft of a speed of its own: what one gives the other takes."""
    model = springs("20 ms", input_torque="0 N*m", start_speed=f"{SPEED} rad/s").model
    model = model._replace(bodies=model.bodies._replace(load=0.0 * np.asarray(model.bodies.load)))
    walker, drive = Walker.begun(model, 1e-9), 25.0
    before = walker.to(1e-6)
    begun = walker.y[model.layout.mechanical :].copy()
    shaft = output_shaft(model)._replace(slip=-20.0)
    after = walker.to(0.1, output_drive=shaft, drive_torque=drive)
    assert after["output_speed"] == pytest.approx(SPEED - 20.0, rel=1e-4)
    assert after["output_torque"] == pytest.approx(drive, rel=1e-3)
    lead = after["output_angle"] - (SPEED - 20.0) * 0.1
    assert lead == pytest.approx(drive / shaft.stiffness, rel=2e-2)
    works = walker.y[model.layout.mechanical :] - begun
    assert abs(balance(before, after, works)) < 1e-6 * abs(works[0])


def test_outputs_are_those_of_a_record():
    """Recomputed by the code that records a run, at the end of one."""
    prepared = train(start_speed="100 rad/s")
    found = run(prepared, "dopri5", rtol=1e-9)
    at = Walker.begun(prepared.model, 1e-9).to(float(found["time"][-1]))
    whole, (mesh, *_) = found.seen.whole, found.seen.meshes
    film = np.nanmin(mesh["central_film_thickness"][-1])
    expected = {
        "input_angle": whole["angle"][-1, 0],
        "output_speed": whole["speed"][-1, prepared.names.index("wheel-2")],
        "friction_loss": whole["power_friction"][-1],
        "stored_energy": whole["stored_energy"][-1],
        "power_in": whole["power_in"][-1],
        "transmission_error.0": mesh["transmission_error_rotational"][-1],
        "normal_load.0": np.sum(mesh["normal_load"][-1]),
        "film_min.0": film,
        "lambda_min.0": np.nanmin(mesh["film_parameter"][-1]),
        "friction_loss.0": mesh["mesh_power_friction"][-1],
    }
    for name, value in expected.items():
        assert at[name] == pytest.approx(float(value), rel=1e-4), name


def test_the_oil_temperature_is_in_surfaces_and_laws_alone():
    """What an exported model replaces by temperature: of the same laws nothing else differs."""
    laws = {"film.law": "masjedi-khonsari", "friction.law": "masjedi-khonsari"}
    still = {"stage.0.frame_forces": False} | laws
    cold, hot = (
        prepare(td.scenario("planetary-24-84", still | {"operating.oil_temperature": f"{value} degC"})).model
        for value in (60, 90)
    )
    assert cold.options == hot.options
    meshes = []
    for one, other in zip(cold.meshes, hot.meshes, strict=True):
        assert one.surfaces != other.surfaces
        meshes.append(other._replace(surfaces=one.surfaces, film=one.film, friction=one.friction))
    other = hot._replace(meshes=tuple(meshes))
    for numbers in zip(*(jax.tree.leaves(model.numbers) for model in (cold, other)), strict=True):
        np.testing.assert_array_equal(*numbers)
