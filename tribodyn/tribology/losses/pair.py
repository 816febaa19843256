"""Which losses a case requests besides those of its loaded meshes, and their torques, element by element."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

import numpy as np

from tribodyn.geometry.drive import SIDES
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.carriers import CARRIERS, CarrierInOil
from tribodyn.tribology.losses.churning import CHURNING
from tribodyn.tribology.losses.loss import Loss, OilState, Sump, Torque, Wheel
from tribodyn.tribology.losses.meshes import MESHES, MeshInOil
from tribodyn.tribology.losses.methods import BEARING_METHODS
from tribodyn.tribology.losses.pump import PumpData, pump_torque
from tribodyn.tribology.losses.seals import SEALS, SealData
from tribodyn.tribology.losses.windage import WINDAGE

#: Names of the losses that `losses_of_pair` has.
LOSSES = (
    *("churning", "windage", "squeezing", "bearings", "seals", "carriers", "pump"),
    "bearings_under_load",
)


class LoadedBearings(NamedTuple):
    """Bearings alike with the force on each at the nominal load, N."""

    name: str
    bearing: BearingInOil
    radial: float = 0.0
    axial: float = 0.0
    of_meshes: bool = False  # whether the forces are to be those of the meshes, shared by all bearings


@dataclass(frozen=True)
class ShaftLosses:
    """What a shaft, a gear or another body turns against oil and seals."""

    name: str  # as the scenario names it
    #: nominal speed, rad/s; None: that of the gear of this name of a pair
    speed: float | None = None
    body: int | None = None  # its number in a train
    bearings: tuple[LoadedBearings, ...] = ()
    seals: SealData | None = None
    pump: PumpData | None = None
    carrier: CarrierInOil | None = None


class Spray(NamedTuple):
    """Oil that is sprayed into every mesh."""

    flow: float = 0.0  # m³/s, each
    speed: float = 0.0  # m/s
    into_mesh: bool = True  # where teeth come into mesh, else where they leave it


@dataclass(frozen=True)
class LossData:
    """Which losses a mesh's case requests by which method; None: not requested."""

    churning: str | None = None  # of CHURNING, or of MESHES for a whole stage
    windage: str | None = None  # of WINDAGE
    bearings: str | None = None  # of BEARING_METHODS
    #: pinion_immersion, gear_immersion: depth of each tip circle's lowest point below the oil's level, m
    pinion_immersion: float = 0.0
    gear_immersion: float = 0.0
    sump: Sump = field(default_factory=Sump)
    #: of a mesh of several: which of both gears it counts
    counted: tuple[bool, bool] = (True, True)
    shafts: tuple[ShaftLosses, ...] = ()
    squeezing: str | None = None  # of MESHES: oil that is sprayed
    spray: Spray = field(default_factory=Spray)
    seals: str | None = None  # of SEALS
    carrier: str | None = None  # of CARRIERS
    #: of the meshes under load by a standard's formula; None: by film and friction laws
    mesh: str | None = None

    @property
    def of_stage(self) -> bool:
        """Whether gears churn as a stage together."""
        return self.churning in MESHES


class ElementTorque(NamedTuple):
    """One loss of one element: a torque at its own shaft, or at the driver of its mesh, N m."""

    term: Literal["P_VZ0", "P_VLP", "P_VL0", "P_VD", "P_VST", "P_VX"]
    element: str
    sort: Literal["mesh", "gear", "bearing", "seal", "carrier", "pump"]
    method: str
    loss: str  # its name among the sums of a pair
    torque: Torque


def shaft_torques(
    data: LossData,
    shaft: ShaftLosses,
    speed: Float[Array, "..."],
    oil: OilState,
    load: Float[Array, "..."] = 1.0,
    nominal: float | None = None,
) -> Iterator[ElementTorque]:
    """Go through the losses of a shaft at its speed (rad/s, at least 0) and multiples of the nominal load.

    `nominal` is the nominal speed of a shaft that does not know its own.
    """
    if data.bearings is not None:
        for name, bearing, radial, axial, _ in shaft.bearings:
            forces = np.abs(load) * radial, np.abs(load) * axial
            found = BEARING_METHODS[data.bearings].formula(bearing, speed, oil, *forces)
            element = name, "bearing", data.bearings
            yield ElementTorque("P_VL0", *element, "bearings", Torque(found.idle))
            if radial > 0.0 or axial > 0.0:
                loaded = Torque(found.loaded, found.exceeded)
                yield ElementTorque("P_VLP", *element, "bearings_under_load", loaded)
    if data.seals is not None and shaft.seals is not None:
        torque = _everywhere(SEALS[data.seals](shaft.seals, oil), speed)
        yield ElementTorque("P_VD", f"seals of {shaft.name}", "seal", data.seals, "seals", torque)
    if data.carrier is not None and shaft.carrier is not None:
        torque = CARRIERS[data.carrier](shaft.carrier, speed, oil, data.sump)
        yield ElementTorque("P_VST", shaft.name, "carrier", data.carrier, "carriers", torque)
    if shaft.pump is not None:
        torque = pump_torque(shaft.pump, nominal or shaft.speed or 0.0)
        yield ElementTorque("P_VX", "pump", "pump", "displacement", "pump", _everywhere(torque, speed))


def wheel_torques(
    data: LossData, name: str, wheel: Wheel, counted: bool, speed: Float[Array, "..."], oil: OilState
) -> Iterator[ElementTorque]:
    """Go through the losses of a gear, at its speed, that are its own; `counted`: also where it dips not."""
    if data.churning in CHURNING and wheel.immersion > 0.0:
        torque = CHURNING[data.churning](wheel, speed, oil, data.sump)
        yield ElementTorque("P_VZ0", name, "gear", data.churning, "churning", torque)
    if data.windage is not None and counted:
        torque = WINDAGE[data.windage](wheel, speed, oil)
        yield ElementTorque("P_VZ0", name, "gear", data.windage, "windage", torque)


def mesh_torques(
    data: LossData,
    name: str,
    wheels: tuple[Wheel, Wheel],
    normal_module: float,
    speed: Float[Array, "..."],
    oil: OilState,
) -> Iterator[ElementTorque]:
    """Go through the losses without load of a mesh, at its driver's speed, rad/s."""
    mesh = MeshInOil(*wheels, normal_module, *data.spray)
    if data.churning in MESHES and any(wheel.immersion > 0.0 for wheel in wheels):
        torque = MESHES[data.churning](mesh, speed, oil, data.sump)
        yield ElementTorque("P_VZ0", name, "mesh", data.churning, "churning", torque)
    if data.squeezing is not None:
        torque = MESHES[data.squeezing](mesh, speed, oil, data.sump)
        yield ElementTorque("P_VZ0", name, "mesh", data.squeezing, "squeezing", torque)


def losses_of_pair(
    data: LossData,
    wheels: tuple[Wheel, Wheel],
    speeds: tuple[float, float],
    oil: OilState,
    normal_module: float = 0.0,
) -> dict[str, Loss]:
    """Return the requested losses of a mesh by name, at the nominal load.

    `churning`, `windage`, `squeezing`, `bearings`, `bearings_under_load`, `seals`, `carriers`, `pump`. Speeds
    are those of the gears, rad/s, the driver's first; the oil is that which surrounds them.
    """
    names = ["churning"] * (data.churning is not None) + ["windage"] * (data.windage is not None)
    names += ["bearings"] * (data.bearings is not None)
    found: dict[str, list[tuple[Torque, float]]] = {name: [] for name in names}

    def add(parts: Iterable[ElementTorque], speed: float) -> None:
        for part in parts:
            found.setdefault(part.loss, []).append((part.torque, speed))

    for side, wheel, counted, speed in zip(SIDES, wheels, data.counted, speeds, strict=True):
        add(wheel_torques(data, side, wheel, counted, speed, oil), speed)
    add(mesh_torques(data, "mesh", wheels, normal_module, speeds[0], oil), speeds[0])
    for shaft in data.shafts:
        speed = speeds[SIDES.index(shaft.name)] if shaft.speed is None else shaft.speed
        add(shaft_torques(data, shaft, speed, oil, nominal=speed), speed)
    return {name: _sum(parts) for name, parts in found.items()}


def _everywhere(torque: Torque, speed: Float[Array, "..."]) -> Torque:
    """A torque that does not depend on the speed, at all speeds."""
    return torque._replace(torque=torque.torque + np.zeros(np.shape(speed)))


def _sum(parts: Iterable[tuple[Torque, float]]) -> Loss:
    """Sum of the powers of torques at their speeds, rad/s."""
    every = list(parts)
    exceeded = dict.fromkeys(limit for torque, _ in every for limit in torque.exceeded)
    return Loss(float(sum(torque.torque * speed for torque, speed in every)), tuple(exceeded))
