"""A gearbox whose losses are closed-form functions, offered as a study offers its own.

Two stages with a mesh loss linear in the torque, a bearing loss with a power of the speed, and oil that
gets thinner with the temperature.
"""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from tribodyn.cases.loss_part import (
    GearboxLosses,
    LossesOver,
    LossSource,
    NominalPoint,
    OperatingPoints,
    Statics,
)
from tribodyn.input.messages import Origins
from tribodyn.studies.map.case import MapCase
from tribodyn.studies.protocol.load import Loaded
from tribodyn.studies.protocol.study import Study

RATIO, TORQUE, SPEED, OIL = -0.2, 100.0, 150.0, 350.0
MESHES = ("high", "low")
SOURCES = (
    LossSource("P_VZP", "high", "mesh", "linear"),
    LossSource("P_VL0", "bearing 1", "bearing", "power"),
)
#: Share of the torque lost in the mesh; drag of the bearing at 100 rad/s and 300 K, N m; its power of the
#: speed; how fast it falls with the temperature, K.
LOST, BEARING, POWER, THINNER = 0.01, 0.5, 2.0, 40.0


def drag(torque: Any, speed: Any, oil: Any) -> np.ndarray:
    """Drag torques (source, …) in closed form, N m."""
    speed = np.abs(np.asarray(speed, float))
    bearing = BEARING * (0.2 + (speed / 100.0) ** POWER) * np.exp(-(np.asarray(oil) - 300.0) / THINNER)
    return np.stack(np.broadcast_arrays(LOST * abs(RATIO) * np.abs(torque), bearing))


def _at(_case: Any, points: OperatingPoints) -> LossesOver:
    torque = TORQUE * np.asarray(points.load)
    values = drag(torque, points.speed, points.oil_temperature)
    two = np.ones((len(torque), 2))
    meshes = {
        "film_min": 1e-7 * np.sqrt(np.abs(points.speed) + 1.0)[:, None] * two,
        "film_parameter_min": np.sqrt(np.abs(points.speed) + 1.0)[:, None] * two,
        "friction_coefficient_mean": 0.05 * two,
        "bulk_temperature": np.asarray(points.oil_temperature)[:, None] * two,
        "hertz_pressure_max": 1e8 * np.sqrt(np.abs(torque))[:, None] * two,
    }
    return LossesOver(SOURCES, values.T, ((), ("fast",)), meshes)


def _statics(_case: Any, loads: Any) -> Statics:
    count = len(loads)
    mean, harmonic = np.full((count, 2), 3e8), np.full((count, 2, 3), 1e7)
    return Statics(
        stiffness_mean=mean,
        stiffness_harmonic=harmonic,
        transmission_error_mean=1e-14 * mean,
        transmission_error_harmonic=1e-13 * harmonic,
        transmission_error_phase=0.0 * harmonic,
        mesh_order=np.array([20.0, 6.0]),
        error_at_output=np.array([2.0, 10.0]),
        stiffness_total=np.full(count, 2e5),
        backlash=1e-3,
    )


LOSSES = GearboxLosses(
    lambda case: MESHES,
    _at,
    lambda case: NominalPoint(TORQUE, TORQUE * abs(RATIO), SPEED, OIL, RATIO, 0.02),
    _statics,
)
STUDY = Study("closed-form", "losses in closed form", __name__, "losses")


def map_case(
    torque: Any = None,
    speed: Any = None,
    oil: Any = None,
    *,
    directions: str = "forward",
    accuracy: float = 0.01,
) -> MapCase:
    """The case of a map of that gearbox; axes in SI units."""
    asked = tuple(None if axis is None else tuple(map(float, axis)) for axis in (torque, speed, oil))
    return MapCase(
        title="Closed forms",
        name="closed",
        kind="map",
        toml='title = "Closed forms"\nkind = "map"\n[scenario]\nkind = "closed-form"\n',
        sha256="0",
        subject=Loaded(SimpleNamespace(chosen=dict), STUDY, Path("closed.toml"), Origins("closed.toml")),
        asked=asked,
        directions=directions,
        accuracy=accuracy,
        most_points=20_000,
    )
