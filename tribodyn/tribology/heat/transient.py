"""A thermal network over time, by an implicit method for stiff systems, with its heat counted."""

from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.heat.network import HeatNetwork

#: (number of a time, share of the way to the next one, temperatures K) -> heat that arises in each free node,
#: W, and behind those, where any does, in each node of given temperature; of all points together.
HeatOverTime = Callable[[int, float, Float[Array, "point node"]], Float[Array, "point node"]]
#: (number of a time, share of the way to the next one) -> speed of the input, rad/s.
SpeedOverTime = Callable[[int, float], float]


#: Step of the difference quotients, K.
_DIFFERENCE = 1e-4


class HeatHistory(NamedTuple):
    """A network over time; energies are from the first time on."""

    times: Float[Array, " time"]  # s
    temperatures: Float[Array, "time node"]  # K
    made: Float[Array, " time"]  # heat that has arisen, J
    given_off: Float[Array, "time held"]  # heat that has left to each node of given temperature, J
    stored: Float[Array, " time"]  # in all nodes, J

    @property
    def balance(self) -> float:
        """Heat that has arisen and is neither stored nor gone, at worst, as a share of all that arose."""
        missing = self.made - self.given_off.sum(axis=1) - self.stored
        size = max(np.abs(self.made).max(), np.abs(self.stored).max(), 1e-300)
        return float(np.abs(missing).max() / size)


def heat_over_time(
    network: HeatNetwork,
    heat: HeatOverTime,
    speed: SpeedOverTime,
    start: Float[Array, " node"],
    times: Float[Array, " time"],
    tolerance: float = 1e-6,
    progress: Callable[[int], None] | None = None,
) -> HeatHistory:
    """Integrate a network from its temperatures at the first time, K, to each of the times, s.

    Radau IIA of order 5 (Hairer & Wanner), begun anew at every time, where heat and speed may jump or turn.
    What arises and what leaves are unknowns of the same system, so that the method keeps the balance to
    rounding. `tolerance` is relative, and of 1 K. Raises SimulationError where the integration fails.
    """
    carried, leaving = network.incidence(), network.leaving()
    capacities = np.array(list(network.capacities.values()))
    nodes, held = len(capacities), leaving.shape[1]

    def rates(number: int, share: float, state: np.ndarray) -> np.ndarray:
        points = state[:nodes].T
        made = np.asarray(heat(number, share, points))
        flows = network.flows(points, speed(number, share))
        left = flows @ leaving
        left[:, : made.shape[1] - nodes] += made[:, nodes:]
        into = made[:, :nodes] + flows @ carried
        return np.hstack([into / capacities, made.sum(axis=1, keepdims=True), left]).T

    def slopes(number: int, share: float, state: np.ndarray) -> np.ndarray:
        """By differences for the temperatures; nothing depends on energies."""
        moved = np.repeat(state[:, None], 2 * nodes, axis=1)
        moved[:nodes] += np.hstack([np.eye(nodes), -np.eye(nodes)]) * _DIFFERENCE
        values = rates(number, share, moved)
        matrix = np.zeros((len(state), len(state)))
        matrix[:, :nodes] = (values[:, :nodes] - values[:, nodes:]) / (2.0 * _DIFFERENCE)
        return matrix

    state = np.concatenate([start, np.zeros(1 + held)])
    states, warmest = [state], tolerance * capacities.sum()
    atol = np.concatenate([np.full(nodes, tolerance), np.full(1 + held, warmest)])
    for number, (begin, end) in enumerate(pairwise(np.asarray(times, dtype=float).tolist())):
        if end > begin:
            state = _integrated(partial(rates, number), partial(slopes, number), state, begin, end, atol)
        states.append(state)
        if progress is not None:
            progress(number + 1)
    every = np.array(states)
    temperatures = every[:, :nodes]
    return HeatHistory(
        np.asarray(times, dtype=float),
        temperatures,
        every[:, nodes],
        every[:, nodes + 1 :],
        (temperatures - temperatures[0]) @ capacities,
    )


def _integrated(
    rates: Callable[[float, np.ndarray], np.ndarray],
    slopes: Callable[[float, np.ndarray], np.ndarray],
    state: np.ndarray,
    begin: float,
    end: float,
    atol: np.ndarray,
) -> np.ndarray:
    """The state at the end of an interval."""
    found = solve_ivp(
        lambda time, at: rates((time - begin) / (end - begin), at[:, None])[:, 0],
        (begin, end),
        state,
        method="Radau",
        first_step=end - begin,
        jac=lambda time, at: slopes((time - begin) / (end - begin), at),
        rtol=float(atol[0]),
        atol=atol,
    )
    if not found.success:
        raise SimulationError(f"the temperatures cannot be followed beyond {found.t[-1]:g} s")
    return found.y[:, -1]
