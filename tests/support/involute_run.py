"""A short run of the involute drive that Liu & Ni compare, and its path of contact in closed form."""

from pathlib import Path

import numpy as np

from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

MODULE, TEETH, PRESSURE_ANGLE = 3e-3, (23, 47), np.radians(20.0)
PITCH_RADII = tuple(MODULE * teeth / 2 for teeth in TEETH)
PITCH_ANGLE = 2 * np.pi / TEETH[0]
KEYS = {
    "mesh.compliance": "constant",
    "mesh.stiffness": "3.2e8 N/m",
    "friction.law": "coulomb",
    "friction.coefficient": 0.05,
    "film.law": "dowson-higginson",
    "solver.cycles": 4,
    "output.samples_per_cycle": 100,
}


def involute_run(path: Path) -> Path:
    """Run it; its pairs have one stiffness, its record goes to the path."""
    return run(load_scenario("involute-23-47", KEYS), path).path


def approach_and_recess() -> tuple[float, float]:
    """Roll angles of first and last contact from the pitch point, rad."""
    lengths = [
        np.sqrt((pitch + MODULE) ** 2 - (pitch * np.cos(PRESSURE_ANGLE)) ** 2)
        - pitch * np.sin(PRESSURE_ANGLE)
        for pitch in PITCH_RADII
    ]
    base = PITCH_RADII[0] * np.cos(PRESSURE_ANGLE)
    return -lengths[1] / base, lengths[0] / base
