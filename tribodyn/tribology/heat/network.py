"""A thermal network: nodes that store heat, paths that carry it, and nodes of given temperature.

C_i dT_i/dt = P_i(T) + Σ_j G_ij (T_j − T_i). Temperatures in K, P in W, G in W/K, C in J/K. Arrays of
temperatures have a row for every point and a column for every free node, in the order of `capacities`.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Temperatures of both ends, K (arrays alike), and the input's speed, rad/s -> W/K.
ConductanceLaw = Callable[[Float[Array, " point"], Float[Array, " point"], float], Float[Array, " point"]]


class HeatPath(NamedTuple):
    """A path between two nodes, by name."""

    one: str
    two: str
    conductance: float | ConductanceLaw  # W/K, ≥ 0
    what: str = ""  # formula and source, in words


class HeatNetwork(NamedTuple):
    """Nodes and paths."""

    capacities: Mapping[str, float]  # of the free nodes, J/K, > 0
    held: Mapping[str, float]  # nodes of given temperature, K
    paths: Sequence[HeatPath]

    @property
    def nodes(self) -> tuple[str, ...]:
        """Names of the free nodes."""
        return tuple(self.capacities)

    def flows(self, temperatures: Float[Array, "point node"], speed: float) -> Float[Array, "point path"]:
        """Heat that each path carries from its first end to its second, W."""
        columns = {name: temperatures[:, number] for number, name in enumerate(self.nodes)}
        columns |= {name: np.full(len(temperatures), value) for name, value in self.held.items()}
        flows = np.zeros((len(temperatures), len(self.paths)))
        for number, path in enumerate(self.paths):
            one, two = columns[path.one], columns[path.two]
            law = path.conductance
            flows[:, number] = (law(one, two, speed) if callable(law) else law) * (one - two)
        return flows

    def incidence(self) -> Float[Array, "path node"]:
        """−1 where a path begins, +1 where it ends; of the free nodes."""
        return self._ends(self.nodes)

    def leaving(self) -> Float[Array, "path held"]:
        """The same of the nodes of given temperature."""
        return self._ends(tuple(self.held))

    def _ends(self, names: Sequence[str]) -> Float[Array, "path name"]:
        begin = [[path.one == name for name in names] for path in self.paths]
        end = [[path.two == name for name in names] for path in self.paths]
        shape = len(self.paths), len(names)
        return np.reshape(end, shape).astype(float) - np.reshape(begin, shape)

    def isolated(self) -> tuple[str, ...]:
        """Free nodes from which no path leads to a node of given temperature: their heat cannot leave."""
        reached, grown = set(self.held), True
        while grown:
            ends = [{path.one, path.two} for path in self.paths]
            further = set().union(*(pair for pair in ends if pair & reached)) if ends else set()
            grown = not further <= reached
            reached |= further
        return tuple(name for name in self.nodes if name not in reached)
