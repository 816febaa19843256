"""The table ``[losses]``: those besides the loaded meshes."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.geometry.drive import SIDES
from tribodyn.input import units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import InUnit, Table
from tribodyn.input.tables.drawn_bearings import BearingOfShaft, Size
from tribodyn.input.tables.loss_elements import (
    BearingDrag,
    CarrierDrum,
    Depth,
    MeshSpray,
    OilPump,
    ShaftSeal,
    broken_bearing_drag,
    broken_drawn_bearing,
)
from tribodyn.tribology.losses.loss import Sump
from tribodyn.tribology.losses.pair import LossData, ShaftLosses, Spray


class LossesTable(Table):
    """Which losses are added, and what their formulas need of gears and shafts by name.

    Of gears named pinion and gear each key of theirs may stand by itself in place of an entry by name.
    """

    mesh: Literal["iso-14179-2", "iso-14179-1", "iso-15144", "schlenk", "fernandes"] | None = None
    churning: Literal["changenet-velex", "iso-14179-1", "iso-14179-2"] | None = None
    windage: Literal["dawson", "anderson-loewenthal"] | None = None
    squeezing: Literal["mauz"] | None = None
    bearings: Literal["palmgren", "iso-14179-1", "iso-14179-2", "skf"] | None = None
    seals: Literal["iso-14179-1", "iso-14179-2"] | None = None
    carrier: Literal["enclosed-drum", "changenet-velex"] | None = None
    oil_volume: Annotated[float, InUnit(units.positive(units.VOLUME))] | None = None
    hydraulic_length: Size | None = None
    immersion: dict[PartName, Depth] = Field({})
    spray: MeshSpray | None = None
    shaft_bearings: dict[PartName, BearingDrag] = Field({})
    shaft_seals: dict[PartName, ShaftSeal] = Field({})
    pump: OilPump | None = None
    carriers: dict[PartName, CarrierDrum] = Field({})
    pinion_immersion: Depth | None = None
    gear_immersion: Depth | None = None
    pinion_bearings: BearingDrag | None = None
    gear_bearings: BearingDrag | None = None

    @property
    def any(self) -> bool:
        """Whether there is one."""
        methods = self.churning, self.windage, self.squeezing, self.bearings, self.seals, self.carrier
        return any(methods) or self.mesh is not None or self.pump is not None

    def immersions(self) -> dict[str, float]:
        """Depth (m) of tip circles below the oil's level at rest, by gear."""
        return self.immersion | _given(self, "immersion")

    def drags(self) -> dict[str, BearingDrag]:
        """Bearings of shafts, by the gear, the shaft or the body that they carry."""
        return self.shaft_bearings | _given(self, "bearings")

    def shafts(self) -> dict[str, ShaftLosses]:
        """What shafts turn against oil and seals, by their names."""
        drags = self.drags() if self.bearings is not None else {}
        pumps = {self.pump.shaft: self.pump} if self.pump is not None else {}
        names = dict.fromkeys((*drags, *self.shaft_seals, *pumps, *self.carriers))
        return {
            name: ShaftLosses(
                name,
                bearings=(drags[name].data(f"bearings of {name}"),) if name in drags else (),
                seals=self.shaft_seals[name].data() if name in self.shaft_seals else None,
                pump=pumps[name].data() if name in pumps else None,
                carrier=self.carriers[name].data() if name in self.carriers else None,
            )
            for name in names
        }

    def data(self, driver: str, driven: str) -> LossData:
        """The formulas for the gears of a mesh, by their names, and their depths in the oil."""
        depths = self.immersions()
        return LossData(
            self.churning,
            self.windage,
            self.bearings,
            depths.get(driver, 0.0),
            depths.get(driven, 0.0),
            Sump(self.oil_volume or 0.0, self.hydraulic_length or 0.0),
            squeezing=self.squeezing,
            spray=Spray() if self.spray is None else self.spray.data(),
            seals=self.seals,
            carrier=self.carrier,
            mesh=self.mesh,
        )


def _given(table: LossesTable, what: str) -> dict[str, Any]:
    """What the keys of pinion and gear give."""
    values = {side: getattr(table, f"{side}_{what}") for side in SIDES}
    return {side: value for side, value in values.items() if value is not None}


def losses_of(table: LossesTable | None) -> LossData | None:
    """Return what a table asks for of a pair of gears, but for drawn bearings; None: no losses."""
    if table is None or not table.any:
        return None
    return replace(table.data(*SIDES), shafts=tuple(table.shafts().values()))


def broken_mesh_method(table: LossesTable | None, families: Iterable[str | None]) -> Iterator[InputError]:
    """Refuse a formula of involutes for the loss of meshes of other families; None: meshes without teeth."""
    other = next((family for family in families if family != "involute"), "involute")
    if table is None or table.mesh is None or other == "involute":
        return
    of_which = "meshes without teeth" if other is None else f"teeth of the family {quoted(other)}"
    rule = f"is a formula of involutes, and there are {of_which}"
    yield InputError(
        "losses.mesh", quoted(table.mesh), rule, "leave it out: film and friction laws then count"
    )


#: Bearings of drawn shafts with their keys, by the names of all that a shaft carries.
Drawn = Mapping[str, Sequence[tuple[str, BearingOfShaft]]]


def broken_losses(
    table: LossesTable | None,
    gears: Sequence[str] = SIDES,
    bodies: Sequence[str] = SIDES,
    carried: Collection[str] = (),
    carriers: Sequence[str] = (),
    drawn: Drawn | None = None,
) -> Iterator[InputError]:
    """Go through the rules that the table breaks: names, what a formula needs, and what none reads.

    `gears` and `bodies` are all names that it may use, `carried` those of gears of planetary stages,
    `carriers` those of planet carriers.
    """
    if table is None:
        return
    drawn = drawn or {}
    for name in table.immersions():
        key = _key(table, "immersion", name)
        if name not in gears:
            yield unknown_name(key, name, gears, "gear")
        elif name in carried:
            rule = "is in a planetary stage, and the formulas are of gears on fixed axes"
            yield InputError(key, None, rule, "leave it out; its carrier may dip: [losses.carriers]")
    named = [(_key(table, "bearings", name), name) for name in table.drags()]
    named += [(f"losses.shaft_seals.{name}", name) for name in table.shaft_seals]
    named += [("losses.pump.shaft", table.pump.shaft)] if table.pump is not None else []
    for key, name in named:
        if name not in bodies:
            yield unknown_name(key, name, list(dict.fromkeys(bodies)), "gear, shaft or body")
    for name in table.carriers:
        if not carriers:
            rule, remedy = "there is no planetary stage", "leave it out"
            yield InputError(f"losses.carriers.{name}", None, rule, remedy)
        elif name not in carriers:
            yield unknown_name(f"losses.carriers.{name}", name, carriers, "planet carrier")
    for what, by_name in (("immersion", table.immersion), ("bearings", table.shaft_bearings)):
        for side in sorted(_given(table, what).keys() & by_name.keys()):
            rule = f"gives the same as {side}_{what} does"
            yield InputError(f"losses.{_BY_NAME[what]}.{side}", None, rule, "leave one of them out")
    yield from _broken_churning(table, gears)
    yield from _broken_bearings(table, gears, bodies, drawn)
    yield from _broken_elements(table, bodies, carriers)


#: Tables by name of what the keys of pinion and gear give.
_BY_NAME = {"immersion": "immersion", "bearings": "shaft_bearings"}


def _key(table: LossesTable, what: str, name: str) -> str:
    """The key that gives something of a gear or shaft."""
    return f"losses.{name}_{what}" if name in _given(table, what) else f"losses.{_BY_NAME[what]}.{name}"


def _broken_churning(table: LossesTable, gears: Sequence[str]) -> Iterator[InputError]:
    """Go through what the formulas of gears in oil need, and what none reads."""
    immersed = [_key(table, "immersion", name) for name, depth in table.immersions().items() if depth]
    of_volume = "changenet-velex" in (table.churning, table.carrier)
    if table.churning is None:
        yield from (_unread(key, "churning", "iso-14179-1") for key in immersed)
    elif not immersed:
        key, remedy = "losses.immersion", f'add [losses.immersion] with {gears[-1]} = "20 mm"'
        if tuple(gears) == SIDES:
            key, remedy = "losses.gear_immersion", 'add gear_immersion = "20 mm", or pinion_immersion'
        rule = f"missing: churning = {quoted(table.churning)} needs a gear that dips into the oil"
        yield InputError(key, rule=rule, remedy=remedy)
    if of_volume and table.oil_volume is None:
        asking = "churning" if table.churning == "changenet-velex" else "carrier"
        rule, remedy = f'missing: {asking} = "changenet-velex" needs it', 'add oil_volume = "2 l"'
        yield InputError("losses.oil_volume", rule=rule, remedy=remedy)
    if not of_volume and table.oil_volume is not None:
        yield _unread("losses.oil_volume", "churning", "changenet-velex")
    if table.churning == "iso-14179-2" and table.hydraulic_length is None:
        rule, remedy = 'missing: churning = "iso-14179-2" needs it', 'add hydraulic_length = "300 mm"'
        yield InputError("losses.hydraulic_length", rule=rule, remedy=remedy)
    if table.churning != "iso-14179-2" and table.hydraulic_length is not None:
        yield _unread("losses.hydraulic_length", "churning", "iso-14179-2")
    if table.squeezing is None and table.spray is not None:
        yield _unread("losses.spray", "squeezing", "mauz")
    if table.squeezing is not None and table.spray is None:
        rule, remedy = f"missing: squeezing = {quoted(table.squeezing)} needs it", 'add flow = "2 l/min"'
        yield InputError("losses.spray.flow", rule=rule, remedy=f"{remedy} in [losses.spray]")


def _broken_bearings(
    table: LossesTable, gears: Sequence[str], bodies: Sequence[str], drawn: Drawn
) -> Iterator[InputError]:
    """Go through what the method of bearings needs of those of the table and of drawn shafts."""
    drags = {_key(table, "bearings", name): name for name in table.drags()}
    if table.bearings is None:
        yield from (_unread(key, "bearings", "palmgren") for key in drags)
        return
    if not drags and not drawn:
        key, held = "losses.shaft_bearings", f"shaft_bearings.{bodies[0]}"
        if tuple(gears) == SIDES:
            key, held = "losses.pinion_bearings", "pinion_bearings"
        rule = f"missing: bearings = {quoted(table.bearings)} needs the bearings of a shaft"
        remedy = f'add [losses.{held}] with type = "deep-groove-ball" and mean_diameter = "60 mm"'
        yield InputError(key, rule=rule, remedy=remedy)
    for key, name in drags.items():
        if name in drawn:
            rule = "has the bearings of its drawn shaft already"
            yield InputError(key, None, rule, "leave them out here")
        else:
            yield from broken_bearing_drag(key, table.drags()[name], table.bearings)
    for key, bearing in dict(one for each in drawn.values() for one in each).items():
        yield from broken_drawn_bearing(key, bearing, table.bearings)


def _broken_elements(
    table: LossesTable, bodies: Sequence[str], carriers: Sequence[str]
) -> Iterator[InputError]:
    """Go through what the methods of seals, carriers and the pump need, and what none reads."""
    if table.seals is None:
        keys = [f"losses.shaft_seals.{name}" for name in table.shaft_seals]
        yield from (_unread(key, "seals", "iso-14179-2") for key in keys)
    elif not table.shaft_seals:
        rule = f"missing: seals = {quoted(table.seals)} needs the seals of a shaft"
        remedy = f'add [losses.shaft_seals.{bodies[0]}] with diameter = "40 mm"'
        yield InputError("losses.shaft_seals", rule=rule, remedy=remedy)
    if table.seals == "iso-14179-2":
        for name, seal in table.shaft_seals.items():
            if seal.material != "nbr":
                key = f"losses.shaft_seals.{name}.material"
                rule = 'has no effect: seals = "iso-14179-2" does not distinguish materials'
                remedy = 'leave it out, or write seals = "iso-14179-1"'
                yield InputError(key, quoted(seal.material), rule, remedy)
    if (pump := table.pump) is not None and (pump.flow is None) == (pump.displacement is None):
        rule = "missing: a pump needs it, or displacement"
        remedy = 'add flow = "10 l/min", or displacement = "20 ml" of a revolution'
        if pump.flow is not None:
            rule, remedy = "gives the same as displacement", "leave one of them out"
        yield InputError("losses.pump.flow", rule=rule, remedy=remedy)
    if table.carrier is None:
        yield from (_unread(f"losses.carriers.{name}", "carrier", "enclosed-drum") for name in table.carriers)
    elif not table.carriers:
        held = carriers[0] if carriers else "NAME"
        rule = f"missing: carrier = {quoted(table.carrier)} needs a planet carrier that dips into the oil"
        remedy = f"add [losses.carriers.{held}] with diameter, width, immersion and clearance"
        if not carriers:
            rule, remedy = "there is no planetary stage", "leave it out"
        yield InputError("losses.carriers" if carriers else "losses.carrier", rule=rule, remedy=remedy)
    for name, carrier in table.carriers.items():
        key = f"losses.carriers.{name}.clearance"
        if table.carrier == "enclosed-drum" and carrier.clearance is None:
            rule, remedy = 'missing: carrier = "enclosed-drum" needs it', 'add clearance = "10 mm"'
            yield InputError(key, rule=rule, remedy=remedy)
        if table.carrier == "changenet-velex" and carrier.clearance is not None:
            yield _unread(key, "carrier", "enclosed-drum")


def _unread(key: str, formula: str, choice: str) -> InputError:
    rule, name = f"has no effect: losses.{formula} does not ask for it", key.removeprefix("losses.")
    return InputError(key, None, rule, f'leave {name} out, or write {formula} = "{choice}"')
