"""The scenario of ``kind = "drive-cycle"``: the scenario of a gearbox, and its duty over time."""

import tomllib
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Annotated, Any, Literal

from pydantic import Field, create_model

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import Column, CurveTable, InUnit, Table, csv_file, scenario_file
from tribodyn.studies import study_of
from tribodyn.studies.drive_cycle.case import CycleData, DriveCycleCase
from tribodyn.studies.protocol.load import broken_rules as rules_broken_by
from tribodyn.studies.protocol.load import load_data, schema_inside
from tribodyn.tribology.oil import TEMPERATURE_RANGE, ZERO_CELSIUS

KIND = "drive-cycle"


class LoadOverTime(CurveTable):
    """Speed and multiple of the scenario's loads over time."""

    time: Annotated[Column, units.TIME]
    speed: Annotated[Column, units.ANGULAR_SPEED]
    load: Annotated[Column, units.NUMBER]


class TorqueOverTime(CurveTable):
    """Speed and torque at the output over time."""

    time: Annotated[Column, units.TIME]
    speed: Annotated[Column, units.ANGULAR_SPEED]
    torque: Annotated[Column, units.TORQUE]


class CycleTable(Table):
    """The duty over time."""

    table: Annotated[LoadOverTime, csv_file("time", "speed", "load")] | None = None
    torque_table: Annotated[TorqueOverTime, csv_file("time", "speed", "torque")] | None = None
    repeat: Annotated[int, Field(strict=True, ge=1, le=1000)] = 1
    step: Annotated[float, InUnit(units.positive(units.TIME), "10 s")] | None = None
    start_temperature: Annotated[float, InUnit(units.TEMPERATURE_KIND, "20 degC")] | None = None
    tolerance: Annotated[float, Field(strict=True, ge=1e-10, le=1e-2)] = 1e-6


class DriveCycleScenario(ScenarioHead):
    """A scenario file of a drive cycle."""

    kind: Literal["drive-cycle"]
    scenario: Annotated[dict[str, Any], scenario_file()]
    cycle: CycleTable


def table_for(data: Mapping[str, Any]) -> type[Table]:
    """Return the schema for data: of a gearbox, where it is opened, by its kind."""
    return _around(schema_inside(data.get("scenario"), KIND))


@lru_cache(maxsize=16)
def _around(base: type[Table] | None) -> type[Table]:
    if base is None:
        return DriveCycleScenario
    field: Any = (Annotated[base, scenario_file()], ...)
    about = DriveCycleScenario.__doc__
    return create_model("DriveCycleScenario", __base__=DriveCycleScenario, __doc__=about, scenario=field)


def case_of(scenario: Any, toml: str, sha256: str) -> DriveCycleCase:
    """Return the case of a scenario that has passed schema and rules."""
    inner, cycle = tomllib.loads(toml)["scenario"], scenario.cycle
    table = cycle.table or cycle.torque_table
    time, speed, third = (tuple(column.tolist()) for column in table.in_si())
    load, torque = (third, None) if cycle.table is not None else (None, third)
    return DriveCycleCase(
        **head_of(scenario, toml, sha256),
        subject=load_data(inner, str(inner.get("name") or "gearbox")),
        cycle=CycleData(
            time, speed, load, torque, cycle.repeat, cycle.step, cycle.start_temperature, cycle.tolerance
        ),
    )


def broken_rules(scenario: Any) -> Iterator[InputError]:
    """Go through the rules that such a scenario breaks, those of the gearbox included."""
    inner, cycle = scenario.scenario, scenario.cycle
    kind = inner.get("kind") if isinstance(inner, dict) else inner.kind
    study = study_of({"kind": kind})
    if not isinstance(inner, Table) or study.losses() is None or study.heat() is None:
        rule = "is no gearbox with losses and temperatures of its parts"
        yield InputError("scenario.kind", quoted(kind), rule, "name a scenario of a gear pair or a train")
        return
    for error in rules_broken_by(study, inner):
        yield InputError(f"scenario.{error.key}", error.value, error.rule, error.remedy, error.file)
    temperature: Any = getattr(inner, "temperature", None)
    if temperature is None or temperature.model != "gearbox":
        rule = "missing: a drive cycle needs the heat of the whole gearbox"
        remedy = 'add [scenario.temperature] with model = "gearbox" and housing = { area = "0.8 m**2" }'
        yield InputError("scenario.temperature.model", None, rule, remedy)
    given = [name for name in ("table", "torque_table") if getattr(cycle, name) is not None]
    if len(given) != 1:
        rule = "contradicts torque_table" if given else "missing: the duty over time"
        remedy = "leave one of the two out" if given else 'add table = "cycle.csv" with time, speed and load'
        yield InputError("cycle.table", None, rule, remedy)
    start = cycle.start_temperature
    if start is not None and not TEMPERATURE_RANGE[0] <= start <= TEMPERATURE_RANGE[1]:
        low, high = (round(limit - ZERO_CELSIUS) for limit in TEMPERATURE_RANGE)
        rule, remedy = f"outside {low} to {high} degC, in which the oil is known", "write one of these"
        yield InputError("cycle.start_temperature", f"{start - ZERO_CELSIUS:.6g} degC", rule, remedy)
