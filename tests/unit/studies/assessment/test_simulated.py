"""The simulation's values under the standards' names, from numbers that can be followed by hand."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.studies.assessment.simulated import simulated_part

PLACES, ZERO_CELSIUS = 7, 273.15


def part(**changes: Any) -> dict[str, Any]:
    """25 and 60 teeth, 96 N m on the gear, 100 rad/s: 4 kW; 40 mm wide, pressure angle 60°."""
    drive = SimpleNamespace(pinion=SimpleNamespace(teeth=25), gear=SimpleNamespace(teeth=60))
    films = SimpleNamespace(
        bulk_temperature=ZERO_CELSIUS + 90.0,
        film_thickness=np.linspace(1e-7, 7e-7, PLACES),
        specific_film=np.linspace(0.1, 0.7, PLACES),
        flash_rise=np.linspace(10.0, 70.0, PLACES),
    )
    local = SimpleNamespace(films=films, points=np.zeros(PLACES), at_points=lambda values: values)
    path = SimpleNamespace(pressure_angle=lambda roll: np.radians(60.0))
    figures = {
        "power_friction_mean": 60.0,
        "friction_coefficient_mean": 0.05,
        "stiffness_single_pair_at_pitch_point": 4e8,
        "mesh_stiffness_mean": 5e8,
        "dynamic_factor": 1.2,
        "face_load_factor": 1.1,
    }
    case: Any = SimpleNamespace(drive=drive, gear_torque=96.0, pinion_speed=100.0)
    assembly: Any = SimpleNamespace(common_width=0.04, path=path)
    return simulated_part(case, assembly, local, figures | changes, {})  # pyright: ignore[reportArgumentType]


def test_loss_factor_is_loss_over_power_and_friction():
    assert part()["H_v"] == pytest.approx(60.0 / (4000.0 * 0.05))
    assert np.isnan(part(friction_coefficient_mean=0.0)["H_v"])


def test_stiffnesses_are_per_width_along_the_line_of_action():
    found = part()
    assert found["c_prime"] == pytest.approx(1e10)
    assert found["c_gamma_alpha"] == pytest.approx(5e8 / 0.04 / 0.25)


def test_worst_values_are_thinnest_and_hottest():
    found = part()
    assert found["h_Y"]["worst"] == pytest.approx(1e-7)
    assert found["lambda_GF"]["worst"] == pytest.approx(0.1)
    assert found["theta_B"]["worst"] == pytest.approx(160.0)
    assert list(found["theta_M"].values()) == pytest.approx([90.0] * (1 + PLACES))
