"""The table ``[temperature]``: bulk temperature of the teeth, from all losses."""

from collections.abc import Iterator
from typing import Annotated, Literal

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.quantity import InUnit, Positive, Table, written
from tribodyn.input.tables.lubricant import Lubricant
from tribodyn.tribology.bulk_temperature import Lubrication, TemperatureData

Conductance = Annotated[float, InUnit(units.not_negative(units.CONDUCTANCE))]
_NETWORK = ("pinion_oil", "gear_oil", "oil_flow", "oil_housing", "housing_ambient", "ambient_temperature")
_ESTIMATE = {"lubrication": "dip", "tip_relief_factor": 1.0}


class TemperatureTable(Table):
    """Where the bulk temperature of the teeth comes from."""

    model: Literal["oil", "iso", "network"] = "oil"
    lubrication: Lubrication = "dip"
    tip_relief_factor: Positive = 1.0
    pinion_oil: Conductance | None = None
    gear_oil: Conductance | None = None
    oil_flow: Annotated[float, InUnit(units.positive(units.VOLUME_FLOW))] | None = None
    oil_housing: Conductance | None = None
    housing_ambient: Conductance | None = None
    ambient_temperature: Annotated[float, InUnit(units.TEMPERATURE_KIND, "25 degC")] = written("20 degC")


def temperature_of(table: TemperatureTable | None) -> TemperatureData | None:
    """Return what a table asks for; None: teeth as warm as the oil."""
    if table is None or table.model == "oil":
        return None
    values = table.model_dump(exclude={"model"})
    settings = {name: value for name, value in values.items() if value is not None}
    return TemperatureData(table.model, **settings)


def broken_temperature_rules(table: TemperatureTable | None, lubricant: Lubricant) -> Iterator[InputError]:
    """Go through the rules that the table breaks by itself or with the lubricant."""
    if table is None:
        return
    present = [name for name in _NETWORK[:-1] if getattr(table, name) is not None]
    present += [name for name, default in _ESTIMATE.items() if getattr(table, name) != default]
    allowed = {"oil": (), "iso": tuple(_ESTIMATE), "network": _NETWORK}[table.model]
    for name in present:
        if name not in allowed:
            choice = "iso" if name in _ESTIMATE else "network"
            rule = f'has no effect with model = "{table.model}"'
            remedy = f'leave {name} out, or write model = "{choice}"'
            yield InputError(f"temperature.{name}", None, rule, remedy)
    if table.model == "oil":
        return
    if lubricant.viscosity_40 is None:
        yield InputError(
            "temperature.model",
            quoted(table.model),
            "needs the oil at other temperatures, and the lubricant is given at one",
            "give its data sheet: type, viscosity_40, viscosity_100 and density_15",
        )
    if table.model == "network":
        yield from _network(table)


def _network(table: TemperatureTable) -> Iterator[InputError]:
    for name in ("pinion_oil", "gear_oil"):
        if not getattr(table, name):
            rule = "must be greater than zero" if getattr(table, name) == 0 else "missing"
            yield InputError(f"temperature.{name}", None, rule, f'a network needs it: {name} = "20 W/K"')
    if bool(table.oil_housing) != bool(table.housing_ambient):
        missing = "housing_ambient" if table.oil_housing else "oil_housing"
        rule, remedy = "missing: heat must enter the housing and leave it", f'add {missing} = "20 W/K"'
        yield InputError(f"temperature.{missing}", None, rule, f"{remedy}, or leave both out")
