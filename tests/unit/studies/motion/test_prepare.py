"""What a case is made into: the numbers of its model, and enough sweeps over the coupled pairs."""

import math
from typing import Any

import numpy as np
import pytest

from tests.support.states import PAIR, PAIR_WITH_MOTOR, TURN_G
from tribodyn.dynamics.approach import ELASTIC_LOAD
from tribodyn.dynamics.energy import strain_energy
from tribodyn.dynamics.parameters import OutputDrive
from tribodyn.gears.tabulated import tables
from tribodyn.mesh.cycle import polynomials
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.links.chain import NO_PLAY

#: (kg, kg m²) of the gears; stiffness and damping ratio of their bearings in x and y.
MASSES = {"pinion": (1.7, 0.0021), "gear": (9.3, 0.047)}
BEARINGS = {
    "pinion": {"stiffness": ("3e8 N/m", "5e8 N/m"), "damping_ratio": (0.02, 0.03)},
    "gear": {"stiffness": ("7e8 N/m", "11e8 N/m"), "damping_ratio": (0.05, 0.07)},
}


@pytest.mark.parametrize(("factor", "sweeps"), [(0.0, 1), (1.0, 4), (1.8, 8)])
def test_loads_settle_where_one_pair_separates(prepared, factor: float, sweeps: int):
    """Within 1e-4 of what a hundred sweeps give, with weaker and stronger coupling between the pairs."""
    plain = prepared("crc-23-47")
    cycle = plain.cycle._replace(coupling=plain.cycle.coupling * factor)
    lifted = cycle._replace(gap=cycle.gap + np.array([0.0, 10e-6]))
    tabulated = tables(plain.warm_pairs[0])._replace(cycle=lifted, table=polynomials(lifted))
    model = prepare(plain.case, (tabulated,)).model
    assert model.options.sweeps == sweeps
    (mesh,) = model.meshes
    y = np.zeros(PAIR.states)
    separated = 0
    for y[TURN_G] in -np.linspace(2e-6, 30e-6, 29) / mesh.driven_radius:
        loads = []
        for count in (sweeps, 100):
            work: dict = {}
            exact = model._replace(options=model.options._replace(sweeps=count))
            strain_energy(0.5 * mesh.table.boundary[1], 0, 0, 0, y, exact, work)
            loads.append([work[ELASTIC_LOAD, i] for i in range(2)])
        separated += min(loads[1]) == 0.0 < max(loads[1])
        np.testing.assert_allclose(loads[0], loads[1], rtol=0, atol=1e-4 * max(loads[1]))
    assert separated > 2


def given(**operating: Any) -> dict[str, Any]:
    """Keys of a pair of gears whose masses, bearings, drive and load are all of their own."""
    bearings = {
        side: {
            f"{name}_{axis}": value
            for name, both in of.items()
            for axis, value in zip("xy", both, strict=True)
        }
        for side, of in BEARINGS.items()
    }
    masses = {
        f"drive.{side}.{name}": value
        for side, (mass, inertia) in MASSES.items()
        for name, value in (("mass", f"{mass} kg"), ("inertia", f"{inertia} kg*m**2"))
    }
    return {
        **masses,
        "bearings": bearings,
        "mesh.damping_ratio": 0.06,
        "mesh.contact_width": "0.2 um",
        "friction.reversal_width": "40 um",
        "operating": {"source": "torque", "pinion_speed": "130 rad/s", "gear_torque": "410 N*m", **operating},
    }


def slopes_by_hand(times: list[float], values: list[float]) -> list[float]:
    """Fritsch and Butland's weighted harmonic means, 0 at extremes and at the ends of a table."""
    slopes = [0.0]
    for before, here, after, a, b, c in zip(
        times, times[1:], times[2:], values, values[1:], values[2:], strict=False
    ):
        left, right = (b - a) / (here - before), (c - b) / (after - here)
        near, far = 2.0 * (after - here) + (here - before), (after - here) + 2.0 * (here - before)
        slopes.append((near + far) / (near / left + far / right) if left * right > 0.0 else 0.0)
    return [*slopes, 0.0]


TABLE = [0.0, 0.2, 0.5, 0.6, 1.3], [0.0, 30.0, 90.0, 70.0, 75.0]
SHAFT = {
    "drive_inertia": "0.013 kg*m**2",
    "shaft_stiffness": "4100 N*m/rad",
    "shaft_damping": "0.9 N*m*s/rad",
    "pinion_torque": "170 N*m",
}
RIGID = {
    "drive_inertia": "0.013 kg*m**2",
    "speed_regulation": "0.3 N*m*s/rad",
    "load_damping": "0.4 N*m*s/rad",
    "load_inertia": "0.21 kg*m**2",
    "gear_torque_table": {
        "time": {"unit": "s", "values": TABLE[0]},
        "torque": {"unit": "N*m", "values": TABLE[1]},
    },
    "gear_torque_harmonics": [
        {"amplitude": "11 N*m", "frequency": "300 rad/s", "phase": "0.4 rad"},
        {"amplitude": "7 N*m", "frequency": "900 rad/s", "phase": "-0.2 rad"},
    ],
}


@pytest.mark.parametrize("operating", [SHAFT, RIGID], ids=["shaft", "rigid"])
def test_numbers_of_the_model(operating: dict[str, Any]):
    """Every one of them from what is given, the mass along the path from both inertias."""
    prepared = prepare(load_scenario("crc-23-47", given(**operating)))
    found, cycle = prepared.model, prepared.cycle
    shaft = "shaft_stiffness" in operating
    radii = float(cycle.pinion_pitch_radius), float(cycle.gear_pitch_radius)
    mass = 1.0 / (radii[0] ** 2 / 0.0021 + radii[1] ** 2 / 0.047)
    ratio = 23 / 47
    # (ratio, stiffness, mass) of every direction
    damped = (0.02, 3e8, 1.7), (0.03, 5e8, 1.7), (0.05, 7e8, 9.3), (0.07, 11e8, 9.3)
    first_x, first_y, *second = (2.0 * share * math.sqrt(k * m) for share, k, m in damped)
    expected = {
        "bodies": {
            "mass": [1.7, 9.3],
            "inertia": [0.0021, 0.047, 0.013] if shaft else [0.0021 + 0.013, 0.047 + 0.21],
            "ratio": [1.0, ratio, 1.0] if shaft else [1.0, ratio],
            "load": [0.0, 410.0, 0.0] if shaft else [0.0, 410.0],
            "load_damping": [0.0, 0.0, 0.0] if shaft else [0.0, 0.4],
            "tilting": [],
            "hoop": [],
        },
        "links": {
            "stiffness": [[3e8, 5e8, 0], [7e8, 11e8, 0], *([[0, 0, 4100.0]] if shaft else [])],
            "damping": [[first_x, first_y, 0], [*second, 0], *([[0, 0, 0.9]] if shaft else [])],
        },
        "operation": {
            "nominal_speed": 130.0,
            "pitch_angle": 2.0 * math.pi / 23,
            "drive_torque": 170.0 if shaft else 410.0 * ratio,
            "speed_regulation": 0.0 if shaft else 0.3,
            "contact_width": 2e-7,
            "reversal_width": 4e-5,
            "load_times": [] if shaft else TABLE[0],
            "load_torques": [] if shaft else TABLE[1],
            "load_slopes": [] if shaft else slopes_by_hand(*TABLE),
            "load_amplitudes": [] if shaft else [11.0, 7.0],
            "load_frequencies": [] if shaft else [300.0, 900.0],
            "load_phases": [] if shaft else [0.4 + 0.5 * math.pi, -0.2 + 0.5 * math.pi],
            **dict.fromkeys(("start_slip", "acceleration", "output_torque"), 0.0),
            "output_drive": [0.0] * len(OutputDrive()),
            **{name: [] for name in ("motor_speeds", "motor_torques", "motor_slopes")},
        },
    }
    empty = {
        "own",
        "coupled",
        "lever",
        "offset",
        "stiffness_in_space",
        "damping_in_space",
        "carried",
        "frame_speed",
        "place",
        "bearings",
        "clutches",
    }
    for part, numbers in expected.items():
        assert set(numbers) == set(getattr(found, part)._fields) - empty
        for name, value in numbers.items():
            np.testing.assert_allclose(getattr(getattr(found, part), name), value, rtol=1e-12, err_msg=name)
    assert found.links.own is NO_PLAY
    # c = 2 ζ √(k m) of a stiffness k = 1
    assert found.meshes[0].damping == pytest.approx(2.0 * 0.06 * math.sqrt(mass), rel=1e-12)
    assert found.layout == (PAIR_WITH_MOTOR if shaft else PAIR)
