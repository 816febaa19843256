"""The course of a run whose speed changes: against signals of which everything is known in closed form."""

import math
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tribodyn.dynamics.recorded.outputs import Sampled
from tribodyn.gears.motion.course import RunCourse
from tribodyn.post.verdict import of_gears, over_course

SAMPLES, CYCLES, PITCH = 40, 200, 2.0 * math.pi / 27.0
RESONANCE = 150.0  # rad/s


def run_up(first: float, last: float) -> Sampled:
    """From one speed to another at an even rate per cycle; load and error swing in order 3 at a resonance.

    The mean torque grows as well, as that which accelerates does, and contact is lost for one cycle.
    """
    cycles = np.arange(CYCLES * SAMPLES + 1) / SAMPLES
    speed = first + (last - first) * cycles / CYCLES
    steps = PITCH / SAMPLES / ((speed[1:] + speed[:-1]) / 2.0)
    time = np.concatenate([[0.0], np.cumsum(steps)])
    near = np.exp(-(((speed - RESONANCE) / 10.0) ** 2))
    torque = (100.0 + cycles) * (1.0 + 0.5 * near * np.cos(2.0 * math.pi * 3.0 * cycles))
    error = 1e-6 * (5.0 + 0.1 * cycles) + 2e-6 * near * np.sin(2.0 * math.pi * 2.0 * cycles)
    load = np.where((cycles >= 30.0) & (cycles < 31.0), 0.0, 1.0)[:, None]
    mesh = {"driven_torque": torque, "transmission_error_rotational": error, "normal_load": load}
    return Sampled(cycles, {"time": time}, [mesh])


def course(block: Sampled, part: int = 70) -> dict[str, Any]:
    found = RunCourse([1.0], SAMPLES, PITCH)
    for first in range(0, len(block.cycles), part):
        found.add(block.part(slice(first, first + part)))
    return found.summary(0)


def test_what_is_largest_is_said_with_its_speed_and_order():
    found = course(run_up(50.0, 250.0))["course"]
    assert found["first_speed"] == pytest.approx(50.0, abs=2.0)
    assert found["last_speed"] == pytest.approx(250.0, abs=2.0)
    factor, swing = found["dynamic_factor"], found["transmission_error_peak_to_peak"]
    assert factor["value"] == pytest.approx(1.5, rel=0.02)  # of its own mean, not that of the end
    assert swing["value"] == pytest.approx(4e-6, rel=0.02)  # without its straight course
    assert factor["speed"] == pytest.approx(RESONANCE, rel=0.02)
    assert (factor["order"], swing["order"]) == (pytest.approx(3.0), pytest.approx(2.0))
    lost = found["contact_loss_fraction"]
    assert lost["value"] == pytest.approx(0.5)  # a cycle of two
    assert lost["speed"] == pytest.approx(50.0 + 200.0 * 31.0 / CYCLES, rel=0.03)


def test_it_does_not_depend_on_the_blocks_in_which_it_arrives():
    block = run_up(50.0, 250.0)
    assert course(block, 7) == course(block, 10_000)


def test_a_run_at_one_speed_has_no_course():
    assert course(run_up(100.0, 102.0)) == {}


def test_a_slower_mesh_has_orders_of_its_own():
    block = run_up(50.0, 250.0)
    found = RunCourse([1.0, 0.25], SAMPLES, PITCH)
    found.add(block._replace(meshes=block.meshes * 2))
    assert found.summary(1)["course"]["dynamic_factor"]["order"] == pytest.approx(12.0)


def test_the_verdict_speaks_of_the_course_and_not_of_the_end():
    summary = course(run_up(50.0, 250.0)) | {
        "transmission_error_peak_to_peak": 99e-6,
        "dynamic_factor": 7.77,
        "contact_loss_fraction": 0.0,
        "hertz_pressure_max": 1e9,
        "extremes": {"run": {"hertz_pressure_max": {"value": 2e9}}},
        "power_in_mean": 40e3,
        "power_friction_mean": 200.0,
    }
    text = "\n".join(of_gears(cast(Any, SimpleNamespace(summary=summary))))
    assert "99 µm" not in text
    assert "7.77" not in text
    assert "to 1.50 times their mean at 14" in text
    assert "mesh order 3" in text
    assert text.startswith("On the way from 487 rpm to 23")
    assert "press with up to 2 GPa" in text
    assert "over the last cycles" in text
    assert over_course({"dynamic_factor": 1.1}) == {"dynamic_factor": 1.1}
