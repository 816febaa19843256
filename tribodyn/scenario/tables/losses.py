"""The table ``[losses]``: losses that do not depend on the load, by named formulas, off unless asked for."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.scenario import units
from tribodyn.scenario.quantity import Count, InUnit, Positive, Table, written
from tribodyn.tribology.losses import DRAG_FACTORS, BearingDragData, LossData

Depth = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 mm")]
SIDES = ("pinion", "gear")


class BearingDrag(Table):
    """The bearings of a shaft, alike."""

    type: Literal[
        "deep-groove-ball", "angular-contact-ball", "cylindrical-roller", "tapered-roller", "needle-roller"
    ]
    mean_diameter: Annotated[float, InUnit(units.positive(units.LENGTH), "60 mm")] = Field(
        description="(bore + outside)/2"
    )
    drag_factor: Positive | None = Field(None, description="f_0; default: by type, in an oil bath (Harris)")
    count: Count = Field(2, description="bearings on the shaft")


class LossesTable(Table):
    """Which load-independent losses are added, and what their formulas need."""

    churning: Literal["changenet-velex", "iso-14179-1"] | None = Field(None, description="formula")
    windage: Literal["dawson", "anderson-loewenthal"] | None = Field(None, description="formula")
    bearings: Literal["palmgren"] | None = Field(None, description="formula")
    pinion_immersion: Depth = written("0 mm", description="of its tip circle below the oil's level")
    gear_immersion: Depth = written("0 mm", description="of its tip circle below the oil's level")
    oil_volume: Annotated[float, InUnit(units.positive(units.VOLUME))] | None = Field(
        None, description='in the sump, of churning = "changenet-velex"'
    )
    pinion_bearings: BearingDrag | None = Field(None, description="of the pinion's shaft")
    gear_bearings: BearingDrag | None = Field(None, description="of the gear's shaft")


def losses_of(table: LossesTable | None) -> LossData | None:
    """Return what a table asks for; None: no load-independent losses."""
    if table is None or not (table.churning or table.windage or table.bearings):
        return None
    drag = tuple(_drag(getattr(table, f"{side}_bearings")) for side in SIDES)
    return LossData(
        table.churning,
        table.windage,
        table.bearings,
        table.pinion_immersion,
        table.gear_immersion,
        table.oil_volume,
        (drag[0], drag[1]),
    )


def _drag(table: BearingDrag | None) -> BearingDragData | None:
    if table is None:
        return None
    factor = DRAG_FACTORS[table.type] if table.drag_factor is None else table.drag_factor
    return BearingDragData(table.mean_diameter, factor, table.count)


def broken_loss_rules(table: LossesTable | None) -> Iterator[InputError]:
    """Go through the rules that the table breaks: what a formula needs, and what none reads."""
    if table is None:
        return
    immersed = [f"{side}_immersion" for side in SIDES if getattr(table, f"{side}_immersion")]
    if table.churning is None:
        unread = [*immersed, *(["oil_volume"] if table.oil_volume is not None else [])]
        yield from (_unread(name, "churning", "iso-14179-1") for name in unread)
    else:
        if not immersed:
            yield InputError(
                "losses.gear_immersion",
                rule=f"missing: churning = {quoted(table.churning)} needs a gear that dips into the oil",
                remedy='add gear_immersion = "20 mm", or pinion_immersion',
            )
        if table.churning == "changenet-velex" and table.oil_volume is None:
            yield InputError(
                "losses.oil_volume",
                rule='missing: churning = "changenet-velex" needs it',
                remedy='add oil_volume = "2 l"',
            )
        if table.churning != "changenet-velex" and table.oil_volume is not None:
            yield _unread("oil_volume", "churning", "changenet-velex")
    shafts = [f"{side}_bearings" for side in SIDES if getattr(table, f"{side}_bearings") is not None]
    if table.bearings is None:
        yield from (_unread(name, "bearings", "palmgren") for name in shafts)
    elif not shafts:
        yield InputError(
            "losses.pinion_bearings",
            rule=f"missing: bearings = {quoted(table.bearings)} needs the bearings of a shaft",
            remedy='add [losses.pinion_bearings] with type = "deep-groove-ball" and mean_diameter = "60 mm"',
        )


def _unread(name: str, formula: str, choice: str) -> InputError:
    return InputError(
        f"losses.{name}",
        rule=f"has no effect: losses.{formula} does not ask for it",
        remedy=f'leave {name} out, or write {formula} = "{choice}"',
    )
