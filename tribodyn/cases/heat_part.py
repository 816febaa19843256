"""The heat of a gearbox: its thermal network, where its losses enter it, and where both settle."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.loss_part import LossesOver, LossSource, OperatingPoints
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.heat.network import HeatNetwork
from tribodyn.tribology.heat.steady import SteadyHeat, steady_heat
from tribodyn.tribology.oil import TEMPERATURE_RANGE

#: Names of nodes that every gearbox has.
OIL, HOUSING, AMBIENT = "oil", "housing", "ambient"


class GearboxHeat(NamedTuple):
    """The thermal network of a gearbox: nodes `OIL` and `HOUSING`, gears, shafts, bearings; held: `AMBIENT`.

    The oil is among the held nodes where its temperature is given and nothing carries its heat away.
    """

    network: HeatNetwork
    meshes: tuple[tuple[str, str], ...]  # nodes of the driving and the driven gear of every mesh
    bearings: Mapping[str, str]  # nodes of bearings by the names that sources of losses have

    def entering(self, sources: Sequence[LossSource], meshes: Sequence[str]) -> Float[Array, "source node"]:
        """Share of each source's heat that each node takes, the held ones last; `meshes` are their names.

        Half of a mesh's in either gear, bearings' in the bearing, else in the housing, as that of seals; all
        else in the oil.
        """
        every = (*self.network.nodes, *self.network.held)
        place = {name: number for number, name in enumerate(every)}
        shares = np.zeros((len(sources), len(place)))
        gears_of = dict(zip(meshes, self.meshes, strict=True))
        for row, source in enumerate(sources):
            nodes: Sequence[str] = (OIL,)
            if source.sort == "mesh" and source.term == "P_VZP":
                nodes = gears_of[source.element]
            elif source.sort == "bearing":
                nodes = (self.bearings.get(source.element, HOUSING),)
            elif source.sort == "seal":
                nodes = (HOUSING,)
            for node in nodes:
                shares[row, place[node]] += 1.0 / len(nodes)
        return shares

    def at_meshes(
        self, temperatures: Float[Array, "point node"]
    ) -> tuple[Float[Array, " point"], Float[Array, "point mesh"]]:
        """Temperature of the oil, and bulk temperature of each mesh: the mean of both gears (K)."""
        place = {name: number for number, name in enumerate(self.network.nodes)}
        held = self.network.held
        oil = temperatures[:, place[OIL]] if OIL in place else np.full(len(temperatures), held[OIL])
        bulk = [0.5 * (temperatures[:, place[one]] + temperatures[:, place[two]]) for one, two in self.meshes]
        return oil, np.stack(bulk, axis=1)

    @property
    def reads(self) -> tuple[str, ...]:
        """Nodes whose temperatures the losses depend on."""
        nodes = self.network.nodes
        return tuple(name for name in dict.fromkeys([OIL, *sum(self.meshes, ())]) if name in nodes)


class SettledHeat(NamedTuple):
    """A gearbox in its thermal steady state."""

    steady: SteadyHeat
    losses: LossesOver  # of one point
    power: Float[Array, " source"]  # W
    oil_temperature: float  # K
    bulk_temperature: tuple[float, ...]  # of every mesh, K

    def temperatures(self, heat: GearboxHeat) -> dict[str, float]:
        """Of all nodes, K."""
        return {**self.steady.temperatures, **heat.network.held}


def settle(
    heat: GearboxHeat,
    losses_at: Callable[[OperatingPoints], LossesOver],
    meshes: Sequence[str],
    load: float,
    speed: float,
    mesh_losses: Mapping[str, float] | None = None,
) -> SettledHeat:
    """Settle temperatures and losses at a load, a multiple of the scenario's, and a speed, rad/s, not 0.

    `mesh_losses` are losses to tooth friction (W) of meshes by name that take the place of those by
    `losses_at`. Raises SimulationError as `steady_heat`.
    """

    def lost(points: Float[Array, "point node"]) -> tuple[LossesOver, Float[Array, "point source"]]:
        oil, bulk = heat.at_meshes(points)
        count = len(points)
        losses = losses_at(OperatingPoints(np.full(count, load), np.full(count, speed), oil, bulk))
        power = losses.power(np.full(count, speed))
        for column, source in enumerate(losses.sources):
            if source.term == "P_VZP" and source.element in (mesh_losses or {}):
                power[:, column] = (mesh_losses or {})[source.element]
        return losses, power

    def sources(points: Float[Array, "point node"]) -> Any:
        losses, power = lost(points)
        return power @ heat.entering(losses.sources, meshes)

    network = heat.network
    begin = network.held.get(OIL, network.held[AMBIENT] + 30.0)
    start = [begin] * len(network.nodes)
    steady = steady_heat(network, sources, speed, start, heat.reads, TEMPERATURE_RANGE)
    here = np.array([list(steady.temperatures.values())])
    losses, power = lost(np.clip(here, *TEMPERATURE_RANGE))
    oil, bulk = heat.at_meshes(here)
    return SettledHeat(steady, losses, power[0], float(oil[0]), tuple(bulk[0].tolist()))
