"""Bulk temperature of the teeth: heat of a lumped network of gears, oil and housing, and the fixed point.

The estimate of ISO/TR 15144-1 is `tribodyn.standards.micropitting.bulk_rise`. Temperatures in K.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.tribology.losses.loss import Loss

#: Change from which a fixed point counts as found, K: a tenth of what is promised.
TOLERANCE = 0.01
#: Steps at most, the farthest that one goes, K, and the smallest share of the way that is taken.
STEPS, FARTHEST, LEAST_WEIGHT = 100, 40.0, 0.02

#: Share of the heat of tooth friction that either gear takes.
SHARE = 0.5

#: Losses whose heat enters the housing, where there is one; that of others the oil.
IN_HOUSING = ("bearings", "bearings_under_load", "seals")

Lubrication = Literal["dip", "spray", "submerged"]


@dataclass(frozen=True)
class TemperatureData:
    """How a case finds the bulk temperature of its teeth."""

    model: Literal["iso", "network"]  # estimate of ISO/TR 15144-1, or a lumped network
    lubrication: Lubrication = "dip"  # how the oil reaches the mesh, for the estimate
    tip_relief_factor: float = 1.0  # X_Ca of the estimate
    #: conductances of the network, W/K, but for `oil_flow`: volume flow of the oil carried through, m³/s
    pinion_oil: float = 0.0
    gear_oil: float = 0.0
    oil_flow: float = 0.0
    oil_housing: float = 0.0
    housing_ambient: float = 0.0
    ambient_temperature: float = 293.15  # K
    #: mean loss to tooth friction, W, where it is known from the motion; None: quasi-static
    mesh_loss: float | None = None
    #: what other meshes, and bearings that are counted with them, give to the same oil and housing, W
    other_heat: float = 0.0
    other_housing_heat: float = 0.0


class Heat(NamedTuple):
    """Heat that arises in the parts of a gearbox, W; that of the housing in the oil where there is none."""

    pinion: float
    gear: float
    oil: float = 0.0
    housing: float = 0.0

    @property
    def total(self) -> float:
        """Sum of all, W."""
        return sum(self)


def heat_partition(mesh_loss: float, losses: Mapping[str, Loss], *, housing: bool) -> Heat:
    """Heat by where it arises: half of tooth friction (W) in either gear, that of bearings in the `housing`.

    Without a housing of its own, bearings heat the oil, as churning and windage do.
    """
    bearings = sum(loss.power for name, loss in losses.items() if name in IN_HOUSING)
    in_oil = sum(loss.power for name, loss in losses.items() if name not in IN_HOUSING)
    to_oil, to_housing = (in_oil, bearings) if housing else (in_oil + bearings, 0.0)
    return Heat(SHARE * mesh_loss, (1.0 - SHARE) * mesh_loss, to_oil, to_housing)


def heat_of_other_meshes(
    friction: Sequence[float], idle: Sequence[Mapping[str, Loss]]
) -> list[tuple[float, float]]:
    """What all other meshes give to the oil and housing that each shares with them, W, and of that bearings.

    `friction` are the mean losses of the meshes to tooth friction, W, `idle` their load-independent ones.
    """
    bearings = [sum(loss.power for name, loss in losses.items() if name in IN_HOUSING) for losses in idle]
    power = [sum(loss.power for loss in losses.values()) for losses in idle]
    return [
        (sum(friction) - lost + sum(power) - own, sum(bearings) - turning)
        for lost, own, turning in zip(friction, power, bearings, strict=True)
    ]


class Network(NamedTuple):
    """How heat leaves the gears."""

    #: pinion_oil, gear_oil: conductance from the teeth to the oil, W/K, > 0
    pinion_oil: float
    gear_oil: float
    oil_flow: float = 0.0  # heat capacity flow ρ c Q of the oil that is carried through, W/K; 0: none
    #: oil_housing, housing_ambient: W/K, both or neither; 0: none
    oil_housing: float = 0.0
    housing_ambient: float = 0.0
    ambient_temperature: float = 293.15  # K; read where there is a housing

    @property
    def holds_oil(self) -> bool:
        """Whether the oil is held at its temperature: nothing is given that carries its heat away."""
        return bool(np.all(self.oil_flow == 0.0)) and self.housing_ambient == 0.0


class Temperatures(NamedTuple):
    """Temperatures of the parts, K."""

    #: pinion, gear: bulk, of the teeth
    pinion: float
    gear: float
    oil: float  # that surrounds the gears
    housing: float  # that of the oil where the network has none

    @property
    def bulk(self) -> float:
        """Mean of both gears, at which the oil enters the contact (ISO/TR 15144-1)."""
        return (self.pinion + self.gear) / 2.0


def network_temperatures(network: Network, heat: Heat, oil_temperature: float) -> Temperatures:
    """Temperatures at which all heat leaves; the oil's is that which enters, or of all where it is held."""
    oil = oil_temperature
    entering = heat.pinion + heat.gear + heat.oil
    share = 1.0
    if network.housing_ambient > 0.0:
        share = network.oil_housing / (network.oil_housing + network.housing_ambient)
    if not network.holds_oil:
        to_ambient = share * network.housing_ambient
        # the housing's own heat reaches the oil by the share that does not go to ambient
        flow = network.oil_flow * oil_temperature + to_ambient * network.ambient_temperature
        oil = (entering + share * heat.housing + flow) / (network.oil_flow + to_ambient)
    housing = oil
    if network.housing_ambient > 0.0:
        supplied = network.oil_housing * oil + network.housing_ambient * network.ambient_temperature
        housing = (heat.housing + supplied) / (network.oil_housing + network.housing_ambient)
    return Temperatures(
        oil + heat.pinion / network.pinion_oil, oil + heat.gear / network.gear_oil, oil, housing
    )


def heat_given_off(network: Network, at: Temperatures, oil_temperature: float) -> float:
    """Heat that leaves with the oil flow and to ambient, W; where the oil is held, what the gears give it."""
    if network.holds_oil:
        return network.pinion_oil * (at.pinion - at.oil) + network.gear_oil * (at.gear - at.oil)
    carried = network.oil_flow * (at.oil - oil_temperature)
    return carried + network.housing_ambient * (at.housing - network.ambient_temperature)


def fixed_point(
    step: Callable[[tuple[float, float]], tuple[float, float]],
    start: tuple[float, float],
    bounds: tuple[float, float] = (0.0, float("inf")),
) -> tuple[float, float]:
    """Return the temperatures (bulk, oil) that a step maps to themselves, within `TOLERANCE`.

    By successive substitution, relaxed by Aitken's rule (Irons & Tuck 1969): thick oil that churns itself
    warm would else swing between cold and hot. Where the way turns back, the next step is half as long. The
    step is called within the bounds (of both, K) only; where it leads out of them from their edge, its result
    is returned as it is. Raises SimulationError if there are none: the loss grows with the temperature faster
    than the heat leaves.
    """
    here, last, worst = start, (0.0, 0.0), 0.0
    # share of a change that is taken, and how far at most, K
    weight, reach = 1.0, FARTHEST
    for number in range(STEPS):
        there = step(here)
        change = (there[0] - here[0], there[1] - here[1])
        worst = max(map(abs, change))
        if worst < TOLERANCE:
            return there
        if number:
            turned = (change[0] - last[0], change[1] - last[1])
            length = turned[0] ** 2 + turned[1] ** 2
            along = last[0] * turned[0] + last[1] * turned[1]
            back = change[0] * last[0] + change[1] * last[1] < 0.0
            reach = 0.5 * reach if back else min(1.5 * reach, FARTHEST)
            weight = min(max(-weight * along / length, LEAST_WEIGHT), 1.0) if length else 1.0
        bulk, oil = (
            min(max(old + min(max(weight * by, -reach), reach), bounds[0]), bounds[1])
            for old, by in zip(here, change, strict=True)
        )
        if max(abs(bulk - here[0]), abs(oil - here[1])) < LEAST_WEIGHT * TOLERANCE:
            return there  # held by a bound
        here, last = (bulk, oil), change
    raise SimulationError(f"the bulk temperature does not settle: still moving by {worst:.2g} K")
