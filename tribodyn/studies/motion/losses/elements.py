"""Drags without load, element by element: of which body they are, and their torques there."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.cases.loss_part import LossSource
from tribodyn.gears.prepare import wheels_of
from tribodyn.gears.tabulated import Tabulated
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox
from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.churning import CHURNING
from tribodyn.tribology.losses.loss import OilState, Sump, Torque, Wheel
from tribodyn.tribology.losses.methods import BEARING_METHODS
from tribodyn.tribology.losses.windage import WINDAGE


class Drag(NamedTuple):
    """A drag of a body against the housing."""

    source: LossSource
    body: int
    torque: Callable[[Float[Array, " point"], OilState], Torque]  # of the body's speed, rad/s, and the oil


def drags_of(case: Gearbox, tables: Sequence[Tabulated]) -> list[Drag]:
    """Drags that a scenario's [losses] asks for, of gears and of bearings."""
    drags = list[Drag]()
    for mesh, tabulated in zip(case.meshes, tables, strict=True):
        data = mesh.pair.losses
        if data is None:
            continue
        wheels = wheels_of(mesh.pair, tabulated.assembly)
        for number, wheel, counted in zip(mesh.gears, wheels, data.counted, strict=True):
            gear = case.gears[number]
            if data.churning is not None and wheel.immersion > 0.0:
                source = LossSource("P_VZ0", gear.name, "gear", data.churning)
                sump = Sump(data.oil_volume or 0.0)
                drags.append(Drag(source, gear.body, _churning(data.churning, wheel, sump)))
            if data.windage is not None and counted:
                source = LossSource("P_VZ0", gear.name, "gear", data.windage)
                drags.append(Drag(source, gear.body, _windage(data.windage, wheel)))
        for bearing, speed in data.further if data.bearings is not None else ():
            body = _turning(case, speed)
            source = LossSource("P_VL0", case.bodies[body].name, "bearing", data.bearings)
            drags.append(Drag(source, body, _bearing(data.bearings, bearing)))
    return drags


def _churning(method: str, wheel: Wheel, sump: Sump) -> Callable[..., Torque]:
    return lambda speed, oil: CHURNING[method](wheel, speed, oil, sump)


def _windage(method: str, wheel: Wheel) -> Callable[..., Torque]:
    return lambda speed, _: WINDAGE[method](wheel, speed)


def _bearing(method: str, bearing: BearingInOil) -> Callable[..., Torque]:
    def torque(speed: Float[Array, " point"], oil: OilState) -> Torque:
        found = BEARING_METHODS[method].formula(bearing, speed, oil, 0.0, 0.0)
        return Torque(found.idle, found.exceeded)

    return torque


def _turning(case: Gearbox, speed: float) -> int:
    """The body that turns at a speed, rad/s."""
    reference = case.source.speed / float(case.bodies[case.source.body].ratio)
    return int(np.argmin([abs(abs(float(body.ratio)) * reference - speed) for body in case.bodies]))
