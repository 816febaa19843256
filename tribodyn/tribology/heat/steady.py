"""Temperatures at which all heat of a network leaves, with heat that depends on them: Newton's method."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.heat.network import HeatNetwork

#: Temperatures -> heat that arises in each free node, W, and behind those, where any does, in each node of
#: given temperature; of all points together.
HeatSources = Callable[[Float[Array, "point node"]], Float[Array, "point node"]]

#: Residual heat of a node, as a share of all heat, from which a state counts as steady.
BALANCED = 1e-8
#: Step of the difference quotients and the farthest step of Newton's method, K; steps and halvings at most.
_DIFFERENCE, _FARTHEST, _STEPS, _HALVINGS = 1e-3, 40.0, 30, 8


class SteadyHeat(NamedTuple):
    """A network at rest."""

    temperatures: dict[str, float]  # of the free nodes, K
    heat: float  # that arises, W
    given_off: dict[str, float]  # to each node of given temperature, W

    @property
    def balance(self) -> float:
        """Heat that arises and does not leave, as a share of the heat that arises."""
        return abs(self.heat - sum(self.given_off.values())) / max(abs(self.heat), 1e-300)


def steady_heat(
    network: HeatNetwork,
    heat: HeatSources,
    speed: float,
    start: Sequence[float],
    reads: Sequence[str] = (),
    bounds: tuple[float, float] = (0.0, np.inf),
) -> SteadyHeat:
    """Return the steady state of a network.

    `heat` may depend on the temperatures of the nodes that it `reads` and is called within the `bounds`
    (K) only; beyond, it is that of the bound, so that who calls can see a temperature out of range. `speed`
    is the input's, rad/s; `start` are temperatures to begin at, K. Raises SimulationError where heat cannot
    leave a node, or arises faster with temperature than it leaves.
    """
    if isolated := network.isolated():
        raise SimulationError(f"no path leads heat away from {', '.join(isolated)}")
    carried, names = network.incidence(), network.nodes
    capacities = np.array(list(network.capacities.values()))
    moved = [names.index(name) for name in dict.fromkeys(reads)]

    def residual(points: Float[Array, "point node"], made: Float[Array, "point node"]) -> np.ndarray:
        return made[:, : len(names)] + network.flows(points, speed) @ carried

    here = np.asarray(start, dtype=float)
    for _ in range(_STEPS):
        points = np.vstack([here, *(here + _DIFFERENCE * np.eye(len(here))[moved])])
        made = np.asarray(heat(np.clip(points, *bounds)), dtype=float)
        left = residual(here[None], made[:1])[0]
        size = max(float(np.abs(made[0]).sum()), 1e-9)
        slopes = _flow_slopes(network, here, speed, carried)
        slopes[:, moved] += (made[1:] - made[0]).T[: len(names)] / _DIFFERENCE
        # a flow over a large conductance is known to the last digit of its temperatures alone
        rounding = 4.0 * np.finfo(float).eps * float(np.abs(slopes).max() * np.abs(here).max())
        if np.abs(left).max() <= BALANCED * size + rounding:
            if np.linalg.eigvals(slopes / capacities[:, None]).real.max() > 0.0:
                break  # the least change would grow
            given = network.flows(here[None], speed)[0] @ network.leaving()
            given[: made.shape[1] - len(names)] += made[0, len(names) :]
            return SteadyHeat(
                dict(zip(names, here.tolist(), strict=True)),
                float(made[0].sum()),
                dict(zip(network.held, given.tolist(), strict=True)),
            )
        step = np.linalg.solve(slopes, -left)
        if np.all((bounds[0] <= here) & (here <= bounds[1])):  # beyond, losses no longer change
            step *= min(1.0, _FARTHEST / max(float(np.abs(step).max()), 1e-300))
        here = _descend(here, step, float(np.abs(left).max()), heat, residual, bounds)
    raise SimulationError("the temperatures do not settle: losses grow faster with them than heat leaves")


def _flow_slopes(network: HeatNetwork, here: np.ndarray, speed: float, carried: np.ndarray) -> np.ndarray:
    """Change of the heat that enters each node by paths over each node's temperature, W/K."""
    points = here + np.vstack([np.eye(len(here)), -np.eye(len(here))]) * _DIFFERENCE
    entering = network.flows(points, speed) @ carried
    return (entering[: len(here)] - entering[len(here) :]).T / (2.0 * _DIFFERENCE)


def _descend(
    here: np.ndarray,
    step: np.ndarray,
    worst: float,
    heat: HeatSources,
    residual: Callable[[np.ndarray, np.ndarray], np.ndarray],
    bounds: tuple[float, float],
) -> np.ndarray:
    """The end of a step that lessens the residual, halved until it does; the shortest one where none does."""
    there = here + step
    for _ in range(_HALVINGS):
        left = residual(there[None], np.asarray(heat(np.clip(there[None], *bounds))))
        if np.abs(left).max() < worst:
            break
        step = 0.5 * step
        there = here + step
    return there
