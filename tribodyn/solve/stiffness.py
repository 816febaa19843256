"""Explicit or stiff: an estimate of what stability would cost an explicit method, and the choice by it."""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import MECHANICAL, SLIDING_DYNAMIC, SLIDING_KINEMATIC, STATES, XI, Model
from tribodyn.solve.engine import absolute_tolerances
from tribodyn.solve.initial import accelerations

EXPLICIT, STIFF = "dopri5", "rodas4"
#: Methods that run through JAX.
THROUGH_JAX = ("tsit5", "dopri8", "kvaerno5")

#: Explicit steps per mesh cycle, by stability alone, above which the stiff solver is the cheaper one, with
#: the nominal sliding velocity and with the vibration's. Measured on the CRC drive at rtol 1e-6: the native
#: solvers cost the same at 1 rad/s (estimate 4100) and between 10 (700) and 30 rad/s (150). With the
#: vibration's sliding the estimate is too low: flanks stick for longer than the state at the start can tell.
STIFF_ABOVE = {SLIDING_KINEMATIC: 5000, SLIDING_DYNAMIC: 500}
#: Stability limit of Dormand-Prince 5(4) on the negative real axis.
REAL_STABILITY = 3.3


#: Phases in each segment at which the Jacobian is looked at.
PHASES = 9


class Choice(NamedTuple):
    """A method and the reason for it."""

    method: str
    reason: str


def stability_steps(model: Model, state: np.ndarray) -> float:
    """Steps per mesh cycle that an explicit method needs for stability.

    The spectral radius of the mechanics' Jacobian (central differences) over the stability limit, integrated
    over the phase; it is sampled finely where a pair's friction reverses, a short and possibly stiff stretch.
    """
    phases, segments = _places(model)
    scale = absolute_tolerances(model, 1.0, max(abs(state[XI]), 1e-9))[:MECHANICAL]
    shift = np.zeros((MECHANICAL, STATES))
    shift[:, :MECHANICAL] = 1e-4 * np.diag(scale)
    shape = (len(phases), MECHANICAL, STATES)
    up, down = (
        accelerations(np.broadcast_to(state + sign * shift, shape), phases[:, None], segments[:, None], model)
        for sign in (1, -1)
    )
    jacobians = np.swapaxes((up - down)[..., :MECHANICAL] / (2e-4 * scale[:, None]), 1, 2)
    radius = np.max(np.abs(np.linalg.eigvals(jacobians)), axis=1)
    width = np.diff(phases)
    return float(np.sum(0.5 * width * (radius[1:] + radius[:-1]))) / REAL_STABILITY


def _places(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Phases, in order, and their segments."""
    table = model.table
    boundary = np.asarray(table.boundary)
    channel = np.asarray(table.channel)
    phases, segments = [], []
    for segment in range(len(boundary) - 1):
        start, end = boundary[segment], boundary[segment + 1]
        found = list(np.linspace(start, end, PHASES))
        distance = channel[segment, :, :, 1, 0]
        nodes = np.linspace(start, end, distance.shape[0] + 1)[:-1]
        for slot in np.flatnonzero(np.asarray(table.in_contact)[segment]):
            low, high = sorted((0, -1), key=lambda i, slot=slot: distance[i, slot])
            if distance[low, slot] <= 0.0 <= distance[high, slot]:
                order = np.argsort(distance[:, slot])
                pitch_point = np.interp(0.0, distance[order, slot], nodes[order])
                slope = abs(distance[-1, slot] - distance[0, slot]) / (nodes[-1] - nodes[0])
                width = float(model.mechanics.reversal_width) / slope
                found += list(np.clip(pitch_point + width * np.linspace(-1.5, 1.5, 13), start, end))
        phases += sorted(found)
        segments += [segment] * len(found)
    return np.array(phases), np.array(segments)


def choose(method: str, model: Model, state: np.ndarray) -> Choice:
    """The method to use: the user's, or explicit unless stability makes it dear."""
    if method != "auto":
        return Choice(method, "chosen in the scenario")
    steps, most = stability_steps(model, state), STIFF_ABOVE[model.options.sliding]
    if steps > most:
        return Choice(
            STIFF, f"stiff: stability would ask {steps:.0f} explicit steps a mesh cycle, above {most}"
        )
    return Choice(
        EXPLICIT, f"not stiff: stability asks {steps:.0f} explicit steps a mesh cycle, below {most}"
    )
