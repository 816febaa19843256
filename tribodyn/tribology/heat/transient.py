"""A thermal network over time, by an implicit method for stiff systems, with its heat counted."""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.heat.network import HeatNetwork

#: (time s, temperatures K) -> heat that arises in each free node, W; of all points at one time together.
HeatOverTime = Callable[[float, Float[Array, "point node"]], Float[Array, "point node"]]


class HeatHistory(NamedTuple):
    """A network over time; energies are from the first time on."""

    times: Float[Array, " time"]  # s
    temperatures: Float[Array, "time node"]  # K
    made: Float[Array, "time node"]  # heat that has arisen in each free node, J
    given_off: Float[Array, "time held"]  # heat that has left to each node of given temperature, J
    stored: Float[Array, " time"]  # in all nodes, J

    @property
    def balance(self) -> float:
        """Heat that has arisen and is neither stored nor gone, at worst, as a share of all that arose."""
        missing = self.made.sum(axis=1) - self.given_off.sum(axis=1) - self.stored
        return float(np.abs(missing).max() / max(np.abs(self.made[-1]).sum(), 1e-300))


def heat_over_time(
    network: HeatNetwork,
    heat: HeatOverTime,
    speed: Callable[[float], float],
    start: Float[Array, " node"],
    times: Float[Array, " time"],
    tolerance: float = 1e-6,
    progress: Callable[[int], None] | None = None,
) -> HeatHistory:
    """Integrate a network from its temperatures at the first time, K, to each of the times, s.

    Between times heat and speed (rad/s) are smooth. Radau IIA of order 5 (Hairer & Wanner), whose steps
    end at each time: what is made, given off and stored are unknowns of the same system, and the method
    keeps their sum to rounding. `tolerance` is relative, of a rise of 1 K too. Raises SimulationError where
    the integration fails.
    """
    carried, leaving = network.incidence(), network.leaving()
    capacities = np.array(list(network.capacities.values()))
    nodes, held = len(capacities), leaving.shape[1]

    def rates(time: float, state: np.ndarray) -> np.ndarray:
        points = state[:nodes].T
        made = heat(time, points)
        flows = network.flows(points, speed(time))
        return np.hstack([(made + flows @ carried) / capacities, made, flows @ leaving]).T

    def jacobian(time: float, state: np.ndarray) -> np.ndarray:
        """Nothing depends on the energies; difference quotients for the temperatures alone."""
        step = 1e-4
        moved = np.repeat(state[:, None], 2 * nodes, axis=1)
        moved[:nodes] += np.hstack([np.eye(nodes), -np.eye(nodes)]) * step
        values = rates(time, moved)
        matrix = np.zeros((len(state), len(state)))
        matrix[:, :nodes] = (values[:, :nodes] - values[:, nodes:]) / (2.0 * step)
        return matrix

    state = np.concatenate([start, np.zeros(nodes + held)])
    states = [state]
    atol = np.concatenate([np.full(nodes, tolerance), np.full(nodes + held, tolerance * capacities.sum())])
    for number, (begin, end) in enumerate(pairwise(np.asarray(times, dtype=float).tolist())):
        found = solve_ivp(
            lambda time, at: rates(time, at[:, None])[:, 0] if at.ndim == 1 else rates(time, at),
            (begin, end),
            state,
            method="Radau",
            jac=jacobian,
            rtol=tolerance,
            atol=atol,
        )
        if not found.success:
            raise SimulationError(f"the temperatures cannot be followed beyond {found.t[-1]:g} s")
        state = found.y[:, -1]
        states.append(state)
        if progress is not None:
            progress(number + 1)
    every = np.array(states)
    temperatures = every[:, :nodes]
    return HeatHistory(
        np.asarray(times, dtype=float),
        temperatures,
        every[:, nodes : 2 * nodes],
        every[:, 2 * nodes :],
        (temperatures - temperatures[0]) @ capacities,
    )
