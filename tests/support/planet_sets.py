"""Scenarios of one planetary set with teeth: numbers of teeth and planets, what is held, input and output."""

from typing import Any

import numpy as np

from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs
from tribodyn.studies.motion.case import Gearbox

#: Teeth of sun, planet and ring, for three or four planets: all meshes in phase, or one after another.
IN_PHASE, SEQUENTIAL = (24, 30, 84), (25, 29, 83)
#: An assessment of a shipped set, made short; further tables may follow.
ASSESSED_SET = """
title = "A planetary set, assessed"
kind = "train-assessment"
[scenario]
like = "planetary-24-84"
quality = 6
[scenario.friction]
law = "coulomb"
coefficient = 0.05
sliding = "kinematic"
[scenario.solver]
cycles = 8
[scenario.output]
samples_per_cycle = 60
[assessment]
speed_range = [0.5, 1.0]
speeds = 2
samples = 2
"""


def planet_set(
    teeth: tuple[int, int, int] = IN_PHASE,
    planets: int = 3,
    held: str = "ring",
    ends: tuple[str, str] = ("sun", "carrier"),
    **changes: Any,
) -> dict[str, Any]:
    """A scenario; `changes` are of the stage, or of other tables by their names."""
    stage = {
        "type": "planetary",
        "name": "set",
        "sun": "sun",
        "planet": "planet",
        "ring": "ring",
        "carrier": "carrier",
        "planets": planets,
        "held": held,
        "module": "3 mm",
        "pressure_angle": "20 deg",
        "support_damping_ratio": 0.05,
    }
    width = {"face_width": "30 mm"}
    table: dict[str, Any] = {
        "kind": "gear-train",
        "title": "A planetary set",
        "material": "18CrNiMo7-6",
        "lubricant": "iso-vg-100-mineral",
        "mean_roughness": "0.5 um",
        "gear": {
            "sun": {"teeth": teeth[0], "bore_diameter": "40 mm", **width},
            "planet": {"teeth": teeth[1], "bore_diameter": "50 mm", **width},
            "ring": {"teeth": teeth[2], "internal": True, "addendum": 0.9, **width},
        },
        "stage": [stage],
        "body": [{"name": "carrier", "mass": "6 kg", "inertia": "0.04 kg*m**2"}],
        "bearings": {"default": {"stiffness_x": "3e8 N/m", "stiffness_y": "3e8 N/m", "damping_ratio": 0.05}},
        "operating": {
            "input": ends[0],
            "output": ends[1],
            "sense": "counter-clockwise",
            "input_speed": "900 rpm",
            "output_torque": "600 N*m",
            "oil_temperature": "70 degC",
        },
        "mesh": {"compliance": "constant", "stiffness": "3e8 N/m", "damping_ratio": 0.06},
        "friction": {"law": "coulomb", "coefficient": 0.05},
        "film": {"law": "dowson-higginson"},  # named: none is chosen by a solved contact
    }
    for name, value in changes.items():
        if name in ("solver", "load"):
            table[name] = value
        elif name in table:
            table[name] = table[name] | value
        else:
            stage[name] = value
    return table


def set_case(*given: Any, **changes: Any) -> Gearbox:
    """The case of `planet_set`."""
    return case_of_table(planet_set(*given, **changes))


#: Of all bearings of a helical set, N/m and N m/rad.
STIFFNESS, TILT = 3e8, 4e4
BEARING = {
    "stiffness_x": f"{STIFFNESS} N/m",
    "stiffness_y": f"{STIFFNESS} N/m",
    "stiffness_axial": f"{STIFFNESS} N/m",
    "stiffness_tilt": f"{TILT} N*m/rad",
    "damping_ratio": 0.05,
}
SMOOTH = {"coefficient": 0.0}


def helical_set(*given: Any, hand: str = "right", **changes: Any) -> dict[str, Any]:
    """A set at rest in every respect but its load: no friction, no frame forces."""
    changes = {"helix_angle": "15 deg", "frame_forces": False, "friction": SMOOTH, **changes}
    table = planet_set(*given, **{"mesh": {"slices": 7}, **changes})
    table["gear"]["sun"]["hand"] = hand
    table["bearings"] = {"default": BEARING, **changes.get("bearings", {})}
    return table


def tangent_loads(model: Model, state: np.ndarray) -> np.ndarray:
    """Force of every mesh along its pitch tangent, N."""
    samples = evaluated(np.array([0.0]), state[None], model)
    return np.array(
        [
            mesh_outputs(m, samples)["driven_torque"][0] / abs(float(mesh.driven_radius))
            for m, mesh in enumerate(model.meshes)
        ]
    )
