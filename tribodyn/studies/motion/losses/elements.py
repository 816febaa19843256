"""Losses besides the loaded meshes, element by element: whose they are, and their torques."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import NamedTuple

from tribodyn.cases.loss_part import LossSource
from tribodyn.gears.prepare import normal_module, wheels_of
from tribodyn.gears.tabulated import Tabulated
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox
from tribodyn.tribology.losses.loss import OilState, Torque, Wheel, oil_state
from tribodyn.tribology.losses.pair import (
    ElementTorque,
    LossData,
    ShaftLosses,
    mesh_torques,
    shaft_torques,
    wheel_torques,
)

#: Of speed (rad/s) of what is braked, oil, and multiples of the nominal load.
Torques = Callable[[Float[Array, " point"], OilState, Float[Array, " point"]], Iterable[ElementTorque]]


class Drag(NamedTuple):
    """Losses that brake one shaft."""

    sources: tuple[LossSource, ...]
    body: int
    turn: float  # nominal speed of what is braked, of a planet against its carrier, rad/s
    torques: Torques  # in the order of the sources


def drags_of(case: Gearbox, tables: Sequence[Tabulated]) -> list[Drag]:
    """Losses that a scenario's [losses] asks for: of gears, meshes, and what shafts carry."""
    drags = list[Drag]()
    reference = case.source.speed / float(case.bodies[case.source.body].ratio)
    state = oil_state(case.pair.lubricant)

    def add(body: int, turn: float, torques: Torques) -> None:
        found = list(torques(turn, state, 1.0))
        sources = tuple(LossSource(part.term, part.element, part.sort, part.method) for part in found)
        if sources:
            drags.append(Drag(sources, body, turn, torques))

    for mesh, tabulated in zip(case.meshes, tables, strict=True):
        data = mesh.pair.losses
        if data is None:
            continue
        wheels = wheels_of(mesh.pair, tabulated.assembly)
        for number, wheel, counted in zip(mesh.gears, wheels, data.counted, strict=True):
            gear = case.gears[number]
            speed = abs(float(case.bodies[gear.body].ratio)) * reference
            add(gear.body, speed, partial(_of_wheel, data, gear.name, wheel, counted))
        of_mesh = partial(_of_mesh, data, mesh.name, wheels, normal_module(mesh.pair))
        add(mesh.driver, abs(mesh.pair.operating.pinion_speed), of_mesh)
        for shaft in data.shafts:
            if shaft.body is not None and shaft.speed:
                add(shaft.body, shaft.speed, partial(_of_shaft, data, shaft))
    return drags


def _of_wheel(
    data: LossData, name: str, wheel: Wheel, counted: bool, speed: Array, oil: OilState, load: Array
) -> Iterable[ElementTorque]:
    return wheel_torques(data, name, wheel, counted, speed, oil)


def _of_mesh(
    data: LossData,
    name: str,
    wheels: tuple[Wheel, Wheel],
    module: float,
    speed: Array,
    oil: OilState,
    load: Array,
) -> Iterable[ElementTorque]:
    return mesh_torques(data, name, wheels, module, speed, oil)


def _of_shaft(
    data: LossData, shaft: ShaftLosses, speed: Array, oil: OilState, load: Array
) -> Iterable[ElementTorque]:
    return shaft_torques(data, shaft, speed, oil, load)


def torques_at(
    drags: Sequence[Drag],
    over_nominal: Float[Array, " point"],
    oil: OilState,
    load: Float[Array, " point"],
) -> list[Torque]:
    """Torques of all sources in their order, at speeds and loads as multiples of the nominal ones."""
    found = [part.torque for drag in drags for part in drag.torques(over_nominal * drag.turn, oil, load)]
    zero = 0.0 * over_nominal
    return [each._replace(torque=each.torque + zero) for each in found]
