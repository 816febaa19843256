"""The table ``[losses]``: load-independent ones."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.geometry.drive import SIDES
from tribodyn.input import units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import Count, InUnit, Positive, Table
from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.pair import LossData

Depth = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 mm")]


class BearingDrag(Table):
    """The bearings of a shaft, alike."""

    type: Literal[
        "deep-groove-ball",
        "angular-contact-ball",
        "cylindrical-roller",
        "tapered-roller",
        "needle-roller",
        "self-aligning-ball",
        "spherical-roller",
        "four-point-contact-ball",
    ]
    mean_diameter: Annotated[float, InUnit(units.positive(units.LENGTH), "60 mm")]
    drag_factor: Positive | None = None
    count: Count = 2


class LossesTable(Table):
    """Which load-independent losses are added, and what their formulas need of gears and shafts by name.

    Of gears named pinion and gear each key of theirs may stand by itself in place of an entry by name.
    """

    churning: Literal["changenet-velex", "iso-14179-1"] | None = None
    windage: Literal["dawson", "anderson-loewenthal"] | None = None
    bearings: Literal["palmgren"] | None = None
    oil_volume: Annotated[float, InUnit(units.positive(units.VOLUME))] | None = None
    immersion: dict[PartName, Depth] = Field({})
    shaft_bearings: dict[PartName, BearingDrag] = Field({})
    pinion_immersion: Depth | None = None
    gear_immersion: Depth | None = None
    pinion_bearings: BearingDrag | None = None
    gear_bearings: BearingDrag | None = None

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return bool(self.churning or self.windage or self.bearings)

    def immersions(self) -> dict[str, float]:
        """Depth (m) of tip circles below the oil's level at rest, by gear."""
        return self.immersion | _given(self, "immersion")

    def drags(self) -> dict[str, BearingInOil]:
        """Bearings of shafts, by the gear, the shaft or the body that they carry."""
        every: dict[str, BearingDrag] = self.shaft_bearings | _given(self, "bearings")
        return {name: _drag_of(bearing) for name, bearing in every.items()}

    def data(self, driver: str, driven: str) -> LossData:
        """The formulas for the gears of a mesh, by their names, and their depths in the oil."""
        depths = self.immersions()
        return LossData(
            self.churning,
            self.windage,
            self.bearings,
            depths.get(driver, 0.0),
            depths.get(driven, 0.0),
            self.oil_volume,
        )


def _given(table: LossesTable, what: str) -> dict[str, Any]:
    """What the keys of pinion and gear give."""
    values = {side: getattr(table, f"{side}_{what}") for side in SIDES}
    return {side: value for side, value in values.items() if value is not None}


def _drag_of(table: BearingDrag) -> BearingInOil:
    return BearingInOil(table.type, table.mean_diameter, table.count, drag_factor=table.drag_factor)


def losses_of(table: LossesTable | None) -> LossData | None:
    """Return what a table asks for of a pair of gears; None: no load-independent losses."""
    if table is None or not table.any:
        return None
    drags = table.drags()
    return replace(table.data(*SIDES), drag=(drags.get("pinion"), drags.get("gear")))


def broken_losses(
    table: LossesTable | None,
    gears: Sequence[str] = SIDES,
    bodies: Sequence[str] = SIDES,
    carried: Collection[str] = (),
) -> Iterator[InputError]:
    """Go through the rules that the table breaks: names, what a formula needs, and what none reads.

    `gears` and `bodies` are all names that it may use, `carried` those of gears of planetary stages.
    """
    if table is None:
        return
    for name in table.immersions():
        key = _key(table, "immersion", name)
        if name not in gears:
            yield unknown_name(key, name, gears, "gear")
        elif name in carried:
            rule = "is in a planetary stage, and the formulas are of gears on fixed axes"
            yield InputError(key, None, rule, "leave it out")
    for name in table.drags():
        if name not in bodies:
            yield unknown_name(_key(table, "bearings", name), name, bodies, "gear, shaft or body")
    for what, by_name in (("immersion", table.immersion), ("bearings", table.shaft_bearings)):
        for side in sorted(_given(table, what).keys() & by_name.keys()):
            rule = f"gives the same as {side}_{what} does"
            yield InputError(f"losses.{_BY_NAME[what]}.{side}", None, rule, "leave one of them out")
    yield from _broken_formulas(table, gears, bodies)


#: Tables by name of what the keys of pinion and gear give.
_BY_NAME = {"immersion": "immersion", "bearings": "shaft_bearings"}


def _key(table: LossesTable, what: str, name: str) -> str:
    """The key that gives something of a gear or shaft."""
    return f"losses.{name}_{what}" if name in _given(table, what) else f"losses.{_BY_NAME[what]}.{name}"


def _broken_formulas(table: LossesTable, gears: Sequence[str], bodies: Sequence[str]) -> Iterator[InputError]:
    """Go through what the formulas of a table need, and what none reads."""
    immersed = [_key(table, "immersion", name) for name, depth in table.immersions().items() if depth]
    if table.churning is None:
        unread = [*immersed, *(["losses.oil_volume"] if table.oil_volume is not None else [])]
        yield from (_unread(key, "churning", "iso-14179-1") for key in unread)
    else:
        if not immersed:
            key, remedy = "losses.immersion", f'add [losses.immersion] with {gears[-1]} = "20 mm"'
            if tuple(gears) == SIDES:
                key, remedy = "losses.gear_immersion", 'add gear_immersion = "20 mm", or pinion_immersion'
            rule = f"missing: churning = {quoted(table.churning)} needs a gear that dips into the oil"
            yield InputError(key, rule=rule, remedy=remedy)
        if table.churning == "changenet-velex" and table.oil_volume is None:
            rule, remedy = 'missing: churning = "changenet-velex" needs it', 'add oil_volume = "2 l"'
            yield InputError("losses.oil_volume", rule=rule, remedy=remedy)
        if table.churning != "changenet-velex" and table.oil_volume is not None:
            yield _unread("losses.oil_volume", "churning", "changenet-velex")
    drags = [_key(table, "bearings", name) for name in table.drags()]
    if table.bearings is None:
        yield from (_unread(key, "bearings", "palmgren") for key in drags)
    elif not drags:
        key, held = "losses.shaft_bearings", f"shaft_bearings.{bodies[0]}"
        if tuple(gears) == SIDES:
            key, held = "losses.pinion_bearings", "pinion_bearings"
        rule = f"missing: bearings = {quoted(table.bearings)} needs the bearings of a shaft"
        remedy = f'add [losses.{held}] with type = "deep-groove-ball" and mean_diameter = "60 mm"'
        yield InputError(key, rule=rule, remedy=remedy)


def _unread(key: str, formula: str, choice: str) -> InputError:
    rule, name = f"has no effect: losses.{formula} does not ask for it", key.removeprefix("losses.")
    return InputError(key, None, rule, f'leave {name} out, or write {formula} = "{choice}"')
