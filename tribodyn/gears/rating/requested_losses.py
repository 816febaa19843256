"""Losses that a pair of gears asks for, with the bearings of its drawn shafts under their mean loads."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from tribodyn.gears.rating.mesh_forces import forces_on_pair, shared_by_bearings
from tribodyn.gears.supports import BearingUnderLoad, supports_of
from tribodyn.geometry.drive import SIDES
from tribodyn.input.tables.drawn_bearings import friction_data
from tribodyn.input.tables.duty import duty_of
from tribodyn.input.tables.gears.drive_data import drive_of
from tribodyn.input.tables.losses import Drawn, losses_of
from tribodyn.input.tables.shafts import drawn_shafts
from tribodyn.tribology.losses.pair import LoadedBearings, LossData, ShaftLosses


def requested_losses(scenario: Any) -> LossData | None:
    """What a scenario of a pair that breaks no rule asks for; None: nothing."""
    data = losses_of(getattr(scenario, "losses", None))
    if data is None or data.bearings is None:
        return data
    if any(held.of_meshes for shaft in data.shafts for held in shaft.bearings):
        drive = scenario.drive
        duty = duty_of(scenario.operating, drive.pinion.teeth, drive.gear.teeth)
        forces = forces_on_pair(drive.family, drive_of(drive), duty.gear_torque)
        data = shared_by_bearings(data, forces)
    held = zip(SIDES, supports_of(scenario)[:2], strict=True)
    drawn = [
        ShaftLosses(side, bearings=loaded_bearings(side, support.bearings))
        for side, support in held
        if support is not None and support.bearings
    ]
    return replace(data, shafts=(*data.shafts, *drawn))


def loaded_bearings(shaft: str, bearings: Sequence[BearingUnderLoad]) -> tuple[LoadedBearings, ...]:
    """Rolling bearings of a drawn shaft as the formulas take them."""
    return tuple(
        LoadedBearings(f"{shaft}-{number}", bearing, math.hypot(*held.force[:2]), abs(held.force[2]))
        for number, held in enumerate(bearings, start=1)
        if (bearing := friction_data(held.table)) is not None
    )


def drawn_of_pair(scenario: Any) -> Drawn:
    """Bearings of drawn shafts with their keys, by side."""
    drawn = drawn_shafts(getattr(scenario, "shaft", None))
    return {
        side: [(f"{key}.bearing.{number}", table) for number, table in enumerate(shaft.bearing)]
        for side, (key, shaft) in drawn.items()
    }
