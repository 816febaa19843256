"""What a drive has to do: speed of either shaft, torque of either shaft or power."""

import math
from collections.abc import Iterator
from typing import Annotated, NamedTuple

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.scenario import units
from tribodyn.scenario.common import Torque
from tribodyn.scenario.quantity import Quantity, Table

Speed = Annotated[float, Quantity(units.positive(units.ANGULAR_SPEED))]
Power = Annotated[float, Quantity(units.POWER)]

SPEEDS = ("pinion_speed", "gear_speed")
LOADS = ("gear_torque", "pinion_torque", "power")
_SPEED_REMEDY = 'add pinion_speed = "1500 rpm", or gear_speed'
_LOAD_REMEDY = 'add gear_torque = "500 N*m", pinion_torque or power'


class Duty(NamedTuple):
    """Speed of the pinion, rad/s, NaN where none is given, and torque on the gear, N m."""

    pinion_speed: float
    gear_torque: float


class DutyTable(Table):
    """Speed and load, each given once: on either shaft, the load also as power."""

    pinion_speed: Speed | None = Field(None, description="of the pinion")
    gear_speed: Speed | None = Field(None, description="of the gear, in place of the pinion's")
    gear_torque: Torque | None = Field(
        None, description="against the gear's motion; negative where the gear drives"
    )
    pinion_torque: Torque | None = Field(None, description="on the pinion, in place of the gear's")
    power: Power | None = Field(None, description="transmitted, in place of a torque")


def broken_duty_rules(
    table: DutyTable, key: str = "operating", speed_needed: bool = True
) -> list[InputError]:
    """Return what is missing or given more than once in the speed and load of a table.

    Parameters
    ----------
    table : DutyTable
    key : str
        Where it stands.
    speed_needed : bool
        Whether the study needs a speed even where no power is given.
    """
    speeds, loads = _given(table, SPEEDS), _given(table, LOADS)
    errors = [*_several(key, "the speed", speeds), *_several(key, "the load", loads)]
    if not loads:
        errors.append(InputError(f"{key}.gear_torque", rule="missing: the load", remedy=_LOAD_REMEDY))
    if not speeds and "power" in loads:
        shown = quoted(f"{table.power:g} W")
        errors.append(InputError(f"{key}.power", shown, "gives no torque without a speed", _SPEED_REMEDY))
    elif not speeds and speed_needed:
        errors.append(InputError(f"{key}.pinion_speed", rule="missing: the speed", remedy=_SPEED_REMEDY))
    return errors


def broken_driving_rules(
    table: DutyTable,
    teeth: tuple[float, float],
    why: str = "the driving flanks carry the load",
    remedy: str = "",
    *,
    speed_needed: bool = True,
) -> list[InputError]:
    """Return as `broken_duty_rules` does, and a load by which the pinion does not drive.

    Parameters
    ----------
    table : DutyTable
    teeth : (float, float)
        Of pinion and gear.
    why : str
        Why the study needs a driving pinion.
    remedy : str
        What else than a positive torque helps, as the end of a sentence.
    speed_needed : bool
    """
    broken = broken_duty_rules(table, speed_needed=speed_needed)
    if broken or (torque := duty_of(table, *teeth).gear_torque) > 0.0:
        return broken
    rule = f"must be greater than zero: {why}"
    return [
        InputError(
            "operating.gear_torque", f"{torque:g} N*m", rule, f'write a torque such as "500 N*m"{remedy}'
        )
    ]


def duty_of(table: DutyTable, pinion_teeth: float, gear_teeth: float) -> Duty:
    """Return pinion speed and gear torque of a table that breaks no rule.

    T_g = P/ω_g and T_g = T_p z_g/z_p without losses, which add to what the driving shaft puts in.
    """
    ratio = gear_teeth / pinion_teeth
    speed = math.nan  # one object, so that equal cases are equal
    if table.pinion_speed is not None:
        speed = table.pinion_speed
    elif table.gear_speed is not None:
        speed = table.gear_speed * ratio
    if table.gear_torque is not None:
        return Duty(speed, table.gear_torque)
    if table.pinion_torque is not None:
        return Duty(speed, table.pinion_torque * ratio)
    return Duty(speed, (table.power or 0.0) * ratio / speed)


def _given(table: DutyTable, names: tuple[str, ...]) -> list[str]:
    return [name for name in names if getattr(table, name) is not None]


def _several(key: str, what: str, names: list[str]) -> Iterator[InputError]:
    for name in names[1:]:
        yield InputError(f"{key}.{name}", None, f"gives {what}, as {names[0]} does", "leave one of them out")
