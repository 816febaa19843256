"""The tables ``[losses]``, load-independent ones, and ``[temperature]``, of the teeth, from all losses."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal, NamedTuple

from tribodyn.errors import InputError, quoted
from tribodyn.geometry.drive import SIDES
from tribodyn.input import units
from tribodyn.input.quantity import Count, InUnit, Positive, Table, written
from tribodyn.input.tables.oil.lubricant import Lubricant
from tribodyn.tribology.bulk_temperature import Lubrication, TemperatureData
from tribodyn.tribology.losses import DRAG_FACTORS, BearingDragData, LossData

Depth = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 mm")]


class BearingDrag(Table):
    """The bearings of a shaft, alike."""

    type: Literal[
        "deep-groove-ball", "angular-contact-ball", "cylindrical-roller", "tapered-roller", "needle-roller"
    ]
    mean_diameter: Annotated[float, InUnit(units.positive(units.LENGTH), "60 mm")]
    drag_factor: Positive | None = None
    count: Count = 2


class LossFormulas(Table):
    """Which load-independent losses are added."""

    churning: Literal["changenet-velex", "iso-14179-1"] | None = None
    windage: Literal["dawson", "anderson-loewenthal"] | None = None
    bearings: Literal["palmgren"] | None = None
    oil_volume: Annotated[float, InUnit(units.positive(units.VOLUME))] | None = None

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return bool(self.churning or self.windage or self.bearings)


class LossesTable(LossFormulas):
    """Which load-independent losses are added, and what their formulas need."""

    pinion_immersion: Depth = written("0 mm")
    gear_immersion: Depth = written("0 mm")
    pinion_bearings: BearingDrag | None = None
    gear_bearings: BearingDrag | None = None


def losses_of(table: LossesTable | None) -> LossData | None:
    """Return what a table asks for; None: no load-independent losses."""
    if table is None or not table.any:
        return None
    numbers = table.model_dump(exclude={"pinion_bearings", "gear_bearings"})
    return LossData(**numbers, drag=(drag_of(table.pinion_bearings), drag_of(table.gear_bearings)))


def drag_of(table: BearingDrag | None) -> BearingDragData | None:
    """Return what a table says of the bearings of a shaft; None: nothing."""
    if table is None:
        return None
    factor = DRAG_FACTORS[table.type] if table.drag_factor is None else table.drag_factor
    return BearingDragData(table.mean_diameter, factor, table.count)


class LossKeys(NamedTuple):
    """Keys of a table of losses, and examples of a missing one: (key, remedy)."""

    immersed: Sequence[str]
    drags: Sequence[str]
    immersion: tuple[str, str]
    bearings: tuple[str, str]


def broken_loss_rules(table: LossesTable | None) -> Iterator[InputError]:
    """Go through the rules that the table breaks: what a formula needs, and what none reads."""
    if table is None:
        return
    keys = LossKeys(
        [f"{side}_immersion" for side in SIDES if getattr(table, f"{side}_immersion")],
        [f"{side}_bearings" for side in SIDES if getattr(table, f"{side}_bearings") is not None],
        ("gear_immersion", 'add gear_immersion = "20 mm", or pinion_immersion'),
        (
            "pinion_bearings",
            'add [losses.pinion_bearings] with type = "deep-groove-ball" and mean_diameter = "60 mm"',
        ),
    )
    yield from broken_formulas(table, keys)


def broken_formulas(table: LossFormulas, keys: LossKeys) -> Iterator[InputError]:
    """Go through what the formulas of a table need, and what none reads."""
    if table.churning is None:
        unread = [*keys.immersed, *(["oil_volume"] if table.oil_volume is not None else [])]
        yield from (_unread(name, "churning", "iso-14179-1") for name in unread)
    else:
        if not keys.immersed:
            (name, remedy), formula = keys.immersion, quoted(table.churning)
            rule = f"missing: churning = {formula} needs a gear that dips into the oil"
            yield InputError(f"losses.{name}", rule=rule, remedy=remedy)
        if table.churning == "changenet-velex" and table.oil_volume is None:
            rule, remedy = 'missing: churning = "changenet-velex" needs it', 'add oil_volume = "2 l"'
            yield InputError("losses.oil_volume", rule=rule, remedy=remedy)
        if table.churning != "changenet-velex" and table.oil_volume is not None:
            yield _unread("oil_volume", "churning", "changenet-velex")
    if table.bearings is None:
        yield from (_unread(name, "bearings", "palmgren") for name in keys.drags)
    elif not keys.drags:
        (name, remedy), formula = keys.bearings, quoted(table.bearings)
        rule = f"missing: bearings = {formula} needs the bearings of a shaft"
        yield InputError(f"losses.{name}", rule=rule, remedy=remedy)


def _unread(name: str, formula: str, choice: str) -> InputError:
    rule = f"has no effect: losses.{formula} does not ask for it"
    return InputError(f"losses.{name}", None, rule, f'leave {name} out, or write {formula} = "{choice}"')


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
