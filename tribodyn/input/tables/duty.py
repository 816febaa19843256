"""What a gearbox has to do: speed and load, each at either end, the load also as power; load spectra."""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Any, NamedTuple

from pydantic import Field, model_validator

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.fields import ScenarioHead, Temperature, Torque
from tribodyn.input.names import OF_PAIR, under_one_name
from tribodyn.input.quantity import InUnit, Positive, Table, Weighed, csv_tables
from tribodyn.input.schema import fields_of

Speed = Annotated[float, InUnit(units.positive(units.ANGULAR_SPEED))]
Power = Annotated[float, InUnit(units.POWER)]

SPEEDS = ("input_speed", "output_speed")
LOADS = ("output_torque", "input_torque", "power")
_SPEED_REMEDY = 'add input_speed = "1500 rpm", or output_speed'
_LOAD_REMEDY = 'add output_torque = "500 N*m", input_torque or power'


class Duty(NamedTuple):
    """Speed of the pinion, rad/s, NaN where none is given, and torque on the gear, N m."""

    pinion_speed: float
    gear_torque: float


class DutyTable(Table):
    """Speed and load, each given once: at the input or at the output, the load also as power.

    The input of a pair of gears is its pinion, the output its gear.
    """

    other_names = OF_PAIR

    @model_validator(mode="before")
    @classmethod
    def _under_one_name(cls, data: Any) -> Any:
        return under_one_name(data) if isinstance(data, dict) else data

    input_speed: Speed | None = None
    output_speed: Speed | None = None
    output_torque: Torque | None = None
    input_torque: Torque | None = None
    power: Power | None = None


def given_twice(table: DutyTable, key: str) -> Iterator[InputError]:
    """Go through what gives the speed or the load of the table at a key once more."""
    for what, names in (("the speed", SPEEDS), ("the load", LOADS)):
        first, *others = [name for name in names if getattr(table, name) is not None] or [""]
        for name in others:
            rule = f"gives {what}, as {first} does"
            yield InputError(f"{key}.{name}", None, rule, "leave one of them out")


def broken_duty_rules(
    table: DutyTable, *, speed_needed: bool = True, load_needed: bool = True
) -> list[InputError]:
    """Return what is missing or given more than once in the speed and load of [operating].

    A speed may be needed even where no power is given.
    """
    speeds, loads = (
        [name for name in names if getattr(table, name) is not None] for names in (SPEEDS, LOADS)
    )
    errors = [*given_twice(table, "operating")]
    if load_needed and not loads:
        errors.append(InputError("operating.output_torque", rule="missing: the load", remedy=_LOAD_REMEDY))
    if not speeds and "power" in loads:
        shown = quoted(f"{table.power:g} W")
        errors.append(InputError("operating.power", shown, "gives no torque without a speed", _SPEED_REMEDY))
    elif not speeds and speed_needed:
        errors.append(InputError("operating.input_speed", rule="missing: the speed", remedy=_SPEED_REMEDY))
    return errors


def broken_driving_rules(
    table: DutyTable,
    teeth: tuple[float, float],
    why: str = "the driving flanks carry the load",
    remedy: str = "",
    *,
    speed_needed: bool = True,
) -> list[InputError]:
    """Return as `broken_duty_rules` does, and a load by which the pinion does not drive; `teeth` of both.

    The study says why it needs a driving pinion, and what else helps than a positive torque, as the end of a
    sentence.
    """
    broken = broken_duty_rules(table, speed_needed=speed_needed)
    if broken or (torque := duty_of(table, *teeth).gear_torque) > 0.0:
        return broken
    rule, remedy = f"must be greater than zero: {why}", f'write a torque such as "500 N*m"{remedy}'
    return [InputError("operating.output_torque", f"{torque:g} N*m", rule, remedy)]


def duty_of(table: DutyTable, pinion_teeth: float, gear_teeth: float) -> Duty:
    """Return pinion speed and gear torque of a table that breaks no rule.

    T_g = P/ω_g and T_g = T_p z_g/z_p without losses, which add to what the driving shaft puts in.
    """
    ratio = gear_teeth / pinion_teeth
    speed = math.nan  # one object, so that equal cases are equal
    if table.input_speed is not None:
        speed = table.input_speed
    elif table.output_speed is not None:
        speed = table.output_speed * ratio
    if table.output_torque is not None:
        return Duty(speed, table.output_torque)
    if table.input_torque is not None:
        return Duty(speed, table.input_torque * ratio)
    return Duty(speed, (table.power or 0.0) * ratio / speed)


#: Duties of a spectrum.
MOST_DUTIES = 1000


class SpectrumDuty(DutyTable):
    """One duty of a load spectrum; what it does not give is that of [operating]."""

    share: Positive
    oil_temperature: Temperature | None = None


class OperatingTable(DutyTable):
    """Speed and load, and which duty of a spectrum takes their place."""

    duty: Annotated[int, Field(strict=True, ge=1, le=MOST_DUTIES), Weighed("duty", "share")] | None = None


class OiledOperatingTable(OperatingTable):
    """Constant speed and load, and the oil's temperature."""

    oil_temperature: Temperature | None = None


class SpectrumScenario(ScenarioHead):
    """A scenario that may have a load spectrum."""

    duty: Annotated[
        tuple[SpectrumDuty, ...],
        csv_tables(
            "CSV file with a row for each duty: share [1], output_torque [N*m], …", "share", "output_torque"
        ),
    ] = Field((), max_length=MOST_DUTIES)


def spectrum_of(scenario: Any) -> list[tuple[float, Any]]:
    """Return share of time, their sum 1, and scenario of every duty; empty where there is no spectrum."""
    duties: Sequence[SpectrumDuty] = getattr(scenario, "duty", ())
    total = sum(duty.share for duty in duties)
    return [(duty.share / total, _with(scenario, number)) for number, duty in enumerate(duties, start=1)]


def in_force(scenario: Any) -> Any:
    """Return the scenario with the duty in force, the first where none is named; without a spectrum as is."""
    duties = getattr(scenario, "duty", ())
    if not duties:
        return scenario
    number = scenario.operating.duty
    of_duty = _with(scenario, number or 1)
    kept = of_duty.operating.model_copy(update={"duty": number})
    return of_duty.model_copy(update={"operating": kept})


def broken_spectrum_rules(scenario: Any) -> Iterator[InputError]:
    """Go through what is wrong with the duties alone: two speeds or loads in one, a number without a duty."""
    duties: Sequence[SpectrumDuty] = getattr(scenario, "duty", ())
    number = getattr(getattr(scenario, "operating", None), "duty", None)
    if number is not None and number > len(duties):
        has = f"the load spectrum has {len(duties)}" if duties else "there is no load spectrum"
        yield InputError("operating.duty", number, has, "add [[duty]] tables, or name another")
    for place, duty in enumerate(duties):
        yield from given_twice(duty, f"duty.{place}")


def unnamed_duty(scenario: Any) -> Iterator[InputError]:
    """Refuse a spectrum in a study that runs one duty at a time, where it is not said which."""
    count = len(scenario.duty)
    if count > 1 and scenario.operating.duty is None:
        rule = f"missing: this kind of study runs one duty of the {count} at a time"
        remedy = f"add duty = 1, or sweep operating.duty over 1:{count}:1"
        yield InputError("operating.duty", None, rule, remedy)


def of_duty(error: InputError, number: int, scenario: Any) -> InputError:
    """Name a duty as where a mistake stands that the scenario with it has in [operating]."""
    table, _, name = error.key.partition(".")
    fields = fields_of(type(scenario.duty[number - 1]))
    key = f"duty.{number - 1}.{name}" if table == "operating" and name in fields else error.key
    return InputError(key, error.value, error.rule, error.remedy, error.file)


def _with(scenario: Any, number: int) -> Any:
    """The scenario with the keys of one of its duties in [operating]; its duties say all of theirs."""
    duties = tuple(_completed(duty, scenario.operating) for duty in scenario.duty)
    names = *SPEEDS, *LOADS, "oil_temperature"
    keys = {name for name in names if hasattr(scenario.operating, name)}
    update = {name: getattr(duties[number - 1], name) for name in keys} | {"duty": number}
    operating = scenario.operating.model_copy(update=update)
    return scenario.model_copy(update={"operating": operating, "duty": duties})


def _completed(duty: SpectrumDuty, operating: Any) -> SpectrumDuty:
    """A duty with what it does not give from [operating]."""
    missing: dict[str, Any] = {}
    for names in (SPEEDS, LOADS, ("oil_temperature",)):
        if all(getattr(duty, name) is None for name in names):
            missing |= {name: getattr(operating, name, None) for name in names}
    return duty.model_copy(update=missing)
