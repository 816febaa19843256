"""The table ``[temperature]``: of the teeth, or of a whole gearbox, from all losses."""

from collections.abc import Collection, Iterator
from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.input import units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import InUnit, Positive, Table, written
from tribodyn.input.tables.lubricant import Lubricant
from tribodyn.tribology.bulk_temperature import Lubrication, TemperatureData
from tribodyn.tribology.heat.data import CoolerData, GearboxHeatData, HousingHeat
from tribodyn.tribology.heat.parts import FILLING, HOUSING_MATERIALS, side_of_cube
from tribodyn.tribology.oil import TEMPERATURE_RANGE, ZERO_CELSIUS

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


Volume = Annotated[float, InUnit(units.positive(units.VOLUME), "12 l")]
WarmOrCold = Annotated[float, InUnit(units.TEMPERATURE_KIND, "25 degC")]


class HousingHeatTable(Table):
    """A housing as heat sees it."""

    area: Annotated[float, InUnit(units.positive(units.AREA))]
    height: Annotated[float, InUnit(units.positive(units.LENGTH), "400 mm")] | None = None
    air_speed: Annotated[float, InUnit(units.not_negative(units.VELOCITY), "1.4 m/s")] = written("0 m/s")
    emissivity: Annotated[float, Field(strict=True, gt=0, le=1)] = 0.9
    material: Literal["cast-iron", "aluminium", "steel"] = "cast-iron"
    wall: Annotated[float, InUnit(units.positive(units.LENGTH), "10 mm")] = written("10 mm")
    mass: Annotated[float, InUnit(units.positive(units.MASS), "60 kg")] | None = None
    coefficient: Annotated[float, InUnit(units.positive(units.HEAT_TRANSFER))] | None = None


class CoolerTable(Table):
    """A cooler of the oil."""

    conductance: Annotated[float, InUnit(units.positive(units.CONDUCTANCE), "150 W/K")]
    coolant_temperature: WarmOrCold = written("20 degC")


GearboxModel = Literal["oil", "iso", "network", "gearbox"]


class GearboxTemperatureTable(TemperatureTable):
    """Where temperatures of a gearbox come from: of its teeth, or of all of its parts."""

    model: GearboxModel = "oil"  # pyright: ignore[reportIncompatibleVariableOverride]
    housing: HousingHeatTable | None = None
    cooler: CoolerTable | None = None
    oil_volume: Volume | None = None
    sump: Literal["free", "held"] | None = None
    tooth_oil: dict[PartName, Annotated[float, InUnit(units.positive(units.CONDUCTANCE))]] = written({})
    sump_limit: WarmOrCold = written("95 degC")


#: Model of `GearboxTemperatureTable` for the whole gearbox, and keys of that model alone.
GEARBOX = "gearbox"
_OF_GEARBOX = ("housing", "cooler", "oil_volume", "sump", "tooth_oil")
#: Temperature at which oil is taken to be until its own has been found, K.
UNSETTLED = ZERO_CELSIUS + 60.0


def oil_temperature_of(scenario: Any) -> float | None:
    """The temperature, K, that [operating] gives the oil, or one to begin with where it is a result."""
    given = scenario.operating.oil_temperature
    table = getattr(scenario, "temperature", None)
    return UNSETTLED if given is None and table is not None and table.model == GEARBOX else given


def temperature_of(table: TemperatureTable | None) -> TemperatureData | None:
    """Return what a table asks for of a mesh alone; None: teeth as warm as the oil, or of all the gearbox."""
    if table is None or table.model in ("oil", GEARBOX):
        return None
    values = {name: getattr(table, name) for name in TemperatureTable.model_fields if name != "model"}
    settings = {name: value for name, value in values.items() if value is not None}
    return TemperatureData(table.model, **settings)


def gearbox_heat_of(
    table: Any, oil_temperature: float | None, oil_volume: float | None
) -> GearboxHeatData | None:
    """Return what a table asks for of a whole gearbox; None: nothing.

    `oil_temperature` is that of [operating], K, `oil_volume` that of [losses], m³; None: not given.
    """
    if table is None or table.model != GEARBOX:
        return None
    housing, material = table.housing, HOUSING_MATERIALS[table.housing.material]
    mass = housing.area * housing.wall * material.density if housing.mass is None else housing.mass
    surface = HousingHeat(
        housing.area,
        side_of_cube(housing.area) if housing.height is None else housing.height,
        housing.air_speed,
        housing.emissivity,
        housing.wall,
        material.conductivity,
        mass * material.specific_heat,
        housing.coefficient,
    )
    volume = table.oil_volume or oil_volume or FILLING * side_of_cube(housing.area) ** 3
    return GearboxHeatData(
        surface,
        table.ambient_temperature,
        volume,
        None if table.sump == "free" else oil_temperature,
        table.oil_flow or 0.0,
        table.cooler and CoolerData(table.cooler.conductance, table.cooler.coolant_temperature),
        dict(table.tooth_oil),
        table.sump_limit,
    )


def broken_temperature_rules(table: TemperatureTable | None, lubricant: Lubricant) -> Iterator[InputError]:
    """Go through the rules that the table breaks by itself or with the lubricant."""
    if table is None:
        return
    present = [name for name in (*_NETWORK[:-1], *_OF_GEARBOX) if getattr(table, name, None)]
    present += [name for name, default in _ESTIMATE.items() if getattr(table, name) != default]
    allowed = {
        "oil": (),
        "iso": tuple(_ESTIMATE),
        "network": _NETWORK,
        GEARBOX: (*_OF_GEARBOX, "oil_flow"),
    }[table.model]
    for name in present:
        if name not in allowed:
            choice = "iso" if name in _ESTIMATE else "network" if name in _NETWORK else GEARBOX
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


def broken_gearbox_heat(
    table: Any, oil_temperature: float | None, gears: Collection[str]
) -> Iterator[InputError]:
    """Go through the rules that a table for a whole gearbox breaks with its duty and the gears' names."""
    if table is None or table.model != GEARBOX:
        return
    if table.housing is None:
        rule, remedy = "missing: heat leaves by it", 'add [temperature.housing] with area = "0.8 m**2"'
        yield InputError("temperature.housing", None, rule, remedy)
    for name in table.tooth_oil:
        if name not in gears:
            yield unknown_name(f"temperature.tooth_oil.{name}", name, gears, "gear")
    if table.oil_flow is not None and oil_temperature is None:
        rule = "missing: temperature.oil_flow enters with it"
        yield InputError("operating.oil_temperature", None, rule, 'add oil_temperature = "50 degC"')
    if table.sump == "held" and oil_temperature is None:
        rule = 'missing: sump = "held" holds the oil there'
        yield InputError("operating.oil_temperature", None, rule, 'add oil_temperature = "60 degC"')
    if table.oil_flow is not None and table.sump is not None:
        rule = "has no effect: with an oil_flow the oil enters at operating.oil_temperature, and is free"
        yield InputError("temperature.sump", quoted(table.sump), rule, "leave it out")
    held = oil_temperature is not None and table.sump != "free"
    if table.cooler is not None and held and table.oil_flow is None:
        rule = "has no effect: the oil is held at operating.oil_temperature"
        yield InputError("temperature.cooler", None, rule, 'add sump = "free", or leave cooler out')
    given = {"ambient_temperature": table.ambient_temperature, "sump_limit": table.sump_limit}
    if table.cooler is not None:
        given["cooler.coolant_temperature"] = table.cooler.coolant_temperature
    low, high = (round(limit - ZERO_CELSIUS) for limit in TEMPERATURE_RANGE)
    for name, value in given.items():
        if not TEMPERATURE_RANGE[0] <= value <= TEMPERATURE_RANGE[1]:
            rule = f"outside {low} to {high} degC, in which the oil is known"
            remedy = f"write a temperature from {low} to {high} degC"
            yield InputError(f"temperature.{name}", f"{value - ZERO_CELSIUS:.6g} degC", rule, remedy)
    if table.sump_limit <= table.ambient_temperature:
        rule = "must be above ambient_temperature: heat flows there"
        written_as = f"{table.sump_limit - ZERO_CELSIUS:.6g} degC"
        yield InputError("temperature.sump_limit", written_as, rule, 'write "95 degC", or leave it out')


def _network(table: TemperatureTable) -> Iterator[InputError]:
    for name in ("pinion_oil", "gear_oil"):
        if not getattr(table, name):
            rule = "must be greater than zero" if getattr(table, name) == 0 else "missing"
            yield InputError(f"temperature.{name}", None, rule, f'a network needs it: {name} = "20 W/K"')
    if bool(table.oil_housing) != bool(table.housing_ambient):
        missing = "housing_ambient" if table.oil_housing else "oil_housing"
        rule, remedy = "missing: heat must enter the housing and leave it", f'add {missing} = "20 W/K"'
        yield InputError(f"temperature.{missing}", None, rule, f"{remedy}, or leave both out")
