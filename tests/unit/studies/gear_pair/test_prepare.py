"""What a case is made into: the numbers of its model, and enough sweeps over the coupled pairs."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.support.states import PAIR, PAIR_WITH_MOTOR, TURN_G
from tribodyn.dynamics import parameters
from tribodyn.dynamics.approach import ELASTIC_LOAD
from tribodyn.dynamics.data import BearingData, OperatingData
from tribodyn.dynamics.energy import strain_energy
from tribodyn.mesh.cycle import polynomials
from tribodyn.studies.gear_pair import prepare as preparing
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.gears.tabulated import tables
from tribodyn.train.links.chain import NoLinkParameters

PINION, GEAR = (1.7, 0.0021), (9.3, 0.047)
RADII = 0.031, 0.083


@pytest.mark.parametrize(("factor", "sweeps"), [(0.0, 1), (1.0, 4), (1.8, 8)])
def test_loads_settle_where_one_pair_separates(prepared, factor: float, sweeps: int):
    """Within 1e-4 of what a hundred sweeps give, with weaker and stronger coupling between the pairs."""
    given = prepared("crc-23-47")
    cycle = given.cycle._replace(coupling=given.cycle.coupling * factor)
    lifted = cycle._replace(gap=cycle.gap + np.array([0.0, 10e-6]))
    tabulated = tables(given.case)._replace(cycle=lifted, table=polynomials(lifted))
    model = prepare(given.case, tabulated).model
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


def described(**operating: Any) -> Any:
    """What a model takes from a case, but the tables and laws."""
    return SimpleNamespace(
        drive=SimpleNamespace(
            pinion=SimpleNamespace(teeth=21, face_width=0.02),
            gear=SimpleNamespace(face_width=0.02),
            helix_angle=0.0,
        ),
        operating=OperatingData(
            **{"source": "torque", "pinion_speed": 130.0, "gear_torque": 410.0} | operating
        ),
        bearings=(BearingData(3e8, 5e8, 0.02, 0.03), BearingData(7e8, 11e8, 0.05, 0.07)),
        teeth=((), ()),
        mesh=SimpleNamespace(damping_ratio=0.06, contact_width=2e-7, formulation="classical"),
        friction=SimpleNamespace(reversal_width=4e-5, sliding="dynamic"),
    )


def model_of(case: Any) -> parameters.Model:
    """The model of a case, of tables and laws only what its numbers need."""
    radii = {"pinion_pitch_radius": RADII[0], "gear_pitch_radius": RADII[1]}
    numbers = {
        "hertz_coefficient": 0.0,
        "pitch_point_length": 0.0,
        "coupling": 0.0,
        "compliance": 1e-9,
        "slices": 1,
    }
    senses = {"pinion_sense": 1.0, "gear_sense": 1.0, "speed_ratio": RADII[0] / RADII[1]}
    cycle = SimpleNamespace(**radii, **senses, **numbers)
    made: Any = SimpleNamespace(cycle=cycle, table=None, schedule=None)
    law = SimpleNamespace(functions=None, parameters=None)
    laws: Any = SimpleNamespace(surfaces=None, film=law, friction=law)
    return preparing._model(case, made, laws, (PINION, GEAR))


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


TABLE = (0.0, 0.2, 0.5, 0.6, 1.3), (0.0, 30.0, 90.0, 70.0, 75.0)
SHAFT = {"drive_inertia": 0.013, "shaft_stiffness": 4100.0, "shaft_damping": 0.9, "pinion_torque": 170.0}
RIGID = {"drive_inertia": 0.013, "speed_regulation": 0.3, "load_damping": 0.4, "load_inertia": 0.21}


@pytest.mark.parametrize(
    "operating",
    [SHAFT, RIGID | {"torque_table": TABLE, "torque_harmonics": ((11.0, 300.0, 0.4), (7.0, 900.0, -0.2))}],
    ids=["shaft", "rigid"],
)
def test_numbers_of_the_model(operating: dict[str, Any]):
    """Every one of them from what is given, the mass along the path from both inertias."""
    case = described(**operating)
    found = model_of(case)
    given = case.operating
    shaft = "shaft_stiffness" in operating
    mass = 1.0 / (RADII[0] ** 2 / PINION[1] + RADII[1] ** 2 / GEAR[1])
    harmonics = given.torque_harmonics
    times, torques = given.torque_table or ((), ())
    ratio = 0.031 / 0.083  # both forces along the path of contact are equal
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
            "pitch_angle": 2.0 * math.pi / 21,
            "drive_torque": 170.0 if shaft else 410.0 * ratio,
            "speed_regulation": 0.0 if shaft else 0.3,
            "contact_width": 2e-7,
            "reversal_width": 4e-5,
            "load_times": times,
            "load_torques": torques,
            "load_slopes": [] if shaft else slopes_by_hand(*map(list, TABLE)),
            "load_amplitudes": [harmonic[0] for harmonic in harmonics],
            "load_frequencies": [harmonic[1] for harmonic in harmonics],
            "load_phases": [harmonic[2] + 0.5 * math.pi for harmonic in harmonics],
        },
    }
    for part, numbers in expected.items():
        assert set(numbers) == set(getattr(found, part)._fields) - {
            "own",
            "stiffness_in_space",
            "damping_in_space",
            "lever",
            "offset",
            "carried",
            "frame_speed",
            "place",
        }
        for name, value in numbers.items():
            np.testing.assert_allclose(getattr(getattr(found, part), name), value, rtol=1e-12, err_msg=name)
    assert found.links.own == NoLinkParameters()
    # c = 2 ζ √(k m) of a stiffness k = 1
    assert found.meshes[0].damping == pytest.approx(2.0 * 0.06 * math.sqrt(mass), rel=1e-12)
    assert found.layout == (PAIR_WITH_MOTOR if shaft else PAIR)
