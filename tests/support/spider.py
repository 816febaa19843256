"""A carrier of a rigid hub and pins on springs, as a super-element of which everything is known."""

from typing import Any

import numpy as np

from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.superelement import rigid_motions

MASS, INERTIA = 6.0, 0.04
#: kg, of a seat; of its rotations kg m².
PIN_MASS, PIN_INERTIA = 0.2, 1e-5
RADIUS = 81e-3  # of 24/30/84 teeth of 3 mm


def around(count: int, radius: float = RADIUS) -> Any:
    """Places evenly around the axis, m."""
    angles = 2.0 * np.pi * np.arange(count) / count
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def spider(
    arms: list[float],
    tilt: float = 1e12,
    hub: float = MASS - 3 * PIN_MASS,
    mode: float = 0.0,
    at: Any = None,
) -> dict[str, Any]:
    """The table ``flexible_carrier``: pins on springs of so many N/m in x, y and z, and N m/rad.

    Their masses and the `hub`'s make those of the body in `planet_set`, of three pins. A `mode` is of that
    frequency, Hz, and moves nothing. `at` are the places of the pins, m; absent: of its planets.
    """
    count = len(arms)
    seats = np.zeros((count + 1, 3))
    seats[1:, :2] = around(count) if at is None else at
    size = SIX * (count + 1) + (mode > 0.0)
    mass, stiffness = np.zeros((2, size, size))
    inertia = INERTIA - count * PIN_INERTIA - PIN_MASS * np.sum(seats**2)
    mass[range(SIX), range(SIX)] = [hub, hub, hub, inertia / 2.0, inertia / 2.0, inertia]
    for number, arm in enumerate(arms, start=1):
        own = slice(SIX * number, SIX * (number + 1))
        mass[own, own] = np.diag([PIN_MASS] * 3 + [PIN_INERTIA] * 3)
        apart = np.zeros((SIX, size))
        apart[:, own] = np.eye(SIX)
        # what the pin's place moves by with the hub
        moved = rigid_motions(seats[number][None], 0, about=seats[0])
        apart[:, :SIX] = -moved
        stiffness += apart.T @ np.diag([arm] * 3 + [tilt] * 3) @ apart
    if mode:
        mass[-1, -1], stiffness[-1, -1] = 1.0, (2.0 * np.pi * mode) ** 2
    names = ["hub", *(f"P{number}" for number in range(1, count + 1))]
    matrices = {"mass": mass.tolist(), "stiffness": stiffness.tolist(), "places": seats.tolist()}
    return {
        "matrices": matrices | {"units": "m, kg, s", "seats": names},
        "hub": "hub",
        "pins": names[1:],
    }
