"""Pairs whose teeth differ, in slow rotation."""

from typing import Any

import numpy as np

import tribodyn as td
from tribodyn.dynamics.parameters import Model, frictionless
from tribodyn.solve.initial import static_equilibrium
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import rotational_error


def made(name: str, changes: dict[str, Any]) -> PreparedGearbox:
    """A pair prepared for a hunting period."""
    return prepare(td.scenario(name, {"solver.cycles": 1081} | changes))


def errors(model: Model, at: np.ndarray) -> np.ndarray:
    """Rotational transmission error at rest, without friction, after so many mesh cycles, m."""
    still = frictionless(model)
    still = still._replace(operation=still.operation._replace(nominal_speed=1e-3))
    _, phases, intervals = interval_of(at, still.schedule)
    states = [static_equilibrium(still, float(p), int(i)) for p, i in zip(phases, intervals, strict=True)]
    return rotational_error(np.array(states), 0, still)
