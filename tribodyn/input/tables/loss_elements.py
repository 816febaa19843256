"""What turns in oil, tables in ``[losses]``: bearings, seals, an oil pump, planet carriers, sprayed oil."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import Count, InUnit, Positive, Table, written
from tribodyn.input.tables.drawn_bearings import BearingOfShaft, DrawnType, Series, Size, friction_data
from tribodyn.standards.rolling_bearings import static_factors
from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.carriers import CarrierInOil
from tribodyn.tribology.losses.methods import BEARING_METHODS
from tribodyn.tribology.losses.pair import LoadedBearings, Spray
from tribodyn.tribology.losses.pump import PumpData
from tribodyn.tribology.losses.seals import SealData
from tribodyn.tribology.losses.skf_constants import SEALS

Depth = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 mm")]
Force = Annotated[float, InUnit(units.not_negative(units.FORCE), "2 kN")]

#: Types whose factors hold for a contact angle, and of them those that are without results at 0.
_ANGULAR = ("angular-contact-ball", "four-point-contact-ball")
_SLOPED = ("tapered-roller", "spherical-roller", "self-aligning-ball")


class BearingDrag(Table):
    """The bearings of a shaft, alike."""

    type: DrawnType
    mean_diameter: Annotated[float, InUnit(units.positive(units.LENGTH), "60 mm")] | None = None
    drag_factor: Positive | None = None
    count: Count = 2
    series: Series | None = None
    bore: Size | None = None
    outside_diameter: Size | None = None
    width: Size | None = None
    contact_angle: Annotated[float, InUnit(units.positive(units.ANGLE_KIND), "14 deg")] | None = None
    static_rating: Annotated[float, InUnit(units.positive(units.FORCE), "30 kN")] | None = None
    load: Literal["given", "meshes"] = "given"
    radial_load: Force = written("0 N")
    axial_load: Force = written("0 N")
    oil_level: Depth = written("0 mm")
    bath_factor: Annotated[float, Field(strict=True, ge=0, le=0.1)] = 0.0
    seal: Literal["RSL", "RSH", "RS1", "LS", "CS"] | None = None
    seal_diameter: Size | None = None

    def data(self, name: str) -> LoadedBearings:
        """A bearing that breaks no rule, as the formulas take it, with its nominal load."""
        sizes = (self.bore or 0.0) + (self.outside_diameter or 0.0)
        angle = self.contact_angle or 0.0
        sloped = not self.contact_angle and self.type in _SLOPED
        bearing = BearingInOil(
            self.type,
            0.5 * sizes if self.mean_diameter is None else self.mean_diameter,
            self.count,
            contact_angle=0.25 if sloped else angle,  # read under load alone, which asks for it
            static_rating=self.static_rating,
            static_factors=(1.0, 0.0) if sloped else static_factors(self.type, contact_angle=angle),
            drag_factor=self.drag_factor,
            series=self.series or "",
            bore=self.bore,
            outside_diameter=self.outside_diameter,
            width=self.width,
            oil_level=self.oil_level,
            bath_factor=self.bath_factor,
            seal=self.seal or "",
            seal_diameter=self.seal_diameter or 0.0,
        )
        return LoadedBearings(name, bearing, self.radial_load, self.axial_load, self.load == "meshes")


class ShaftSeal(Table):
    """Radial lip seals of a shaft, alike."""

    diameter: Size
    count: Count = 1
    material: Literal["nbr", "fkm"] = "nbr"

    def data(self) -> SealData:
        """As the formulas take them."""
        return SealData(self.diameter, self.count, self.material)


class OilPump(Table):
    """A pump that a shaft drives."""

    shaft: PartName
    pressure: Annotated[float, InUnit(units.positive(units.PRESSURE), "5 bar")]
    displacement: Annotated[float, InUnit(units.positive(units.VOLUME), "20 ml")] | None = None
    flow: Annotated[float, InUnit(units.positive(units.VOLUME_FLOW), "10 l/min")] | None = None
    efficiency: Annotated[float, Field(strict=True, gt=0, le=1)] = 0.8
    ratio: Positive = 1.0

    def data(self) -> PumpData:
        """As the formula takes it."""
        return PumpData(self.pressure, self.displacement, self.flow, self.efficiency, self.ratio)


class CarrierDrum(Table):
    """A planet carrier with its planets as a drum that dips into the oil."""

    diameter: Size
    width: Size
    immersion: Depth
    clearance: Size | None = None

    def data(self) -> CarrierInOil:
        """As the formulas take it."""
        return CarrierInOil(self.diameter, self.width, self.immersion, self.clearance or 0.0)


class MeshSpray(Table):
    """Oil sprayed into each mesh."""

    flow: Annotated[float, InUnit(units.positive(units.VOLUME_FLOW), "2 l/min")]
    speed: Annotated[float, InUnit(units.not_negative(units.VELOCITY), "20 m/s")] = written("0 m/s")
    side: Literal["into", "out-of"] = "into"

    def data(self) -> Spray:
        """As the formulas take it."""
        return Spray(self.flow, self.speed, self.side == "into")


def broken_bearing_drag(key: str, table: BearingDrag, method: str) -> Iterator[InputError]:
    """Go through what a method misses of the bearings of a shaft."""
    known = BEARING_METHODS[method]
    needs = f"bearings = {quoted(method)} needs it"
    if table.type not in known.series:
        yield _unknown_type(f"{key}.type", table.type, method)
        return
    sizes = [name for name in known.sizes if getattr(table, name) is None]
    both = table.bore is not None and table.outside_diameter is not None
    if table.mean_diameter is None and not both and not sizes:
        rule, remedy = "missing", 'add mean_diameter = "60 mm", or bore and outside_diameter'
        yield InputError(f"{key}.mean_diameter", rule=rule, remedy=remedy)
    for name in sizes:
        yield InputError(f"{key}.{name}", rule=f"missing: {needs}", remedy=f'add {name} = "40 mm"')
    if table.bore and table.outside_diameter and table.bore >= table.outside_diameter:
        value = f"{1e3 * table.bore:g} mm"
        rule = f"must be below outside_diameter, {1e3 * table.outside_diameter:g} mm"
        yield InputError(f"{key}.bore", value, rule, "take both from the catalogue")
    if table.series is not None and table.series not in known.series[table.type]:
        yield _unknown_series(f"{key}.series", table.series, table.type, method)
    loaded = table.radial_load or table.axial_load or table.load == "meshes"
    for name in ("radial_load", "axial_load") if table.load == "meshes" else ():
        if getattr(table, name):
            rule, remedy = 'contradicts load = "meshes", of which it follows', "leave one of them out"
            yield InputError(f"{key}.{name}", None, rule, remedy)
    if loaded and table.type in known.rated and table.static_rating is None:
        rule = f"missing: {needs} under load"
        yield InputError(f"{key}.static_rating", rule=rule, remedy='add C_0: static_rating = "30 kN"')
    if loaded and table.type in (*_SLOPED, *_ANGULAR) and table.contact_angle is None:
        rule, remedy = "missing: the load acts along it", 'add contact_angle = "14 deg"'
        yield InputError(f"{key}.contact_angle", rule=rule, remedy=remedy)
    yield from _broken_options(key, table, method)


def _broken_options(key: str, table: BearingDrag, method: str) -> Iterator[InputError]:
    """Go through what only SKF's model reads."""
    given = {"oil_level": table.oil_level, "seal": table.seal}
    for name in (name for name, value in given.items() if value):
        if method != "skf":
            rule, remedy = 'has no effect: of bearings = "skf" alone', f"leave {name} out"
            yield InputError(f"{key}.{name}", None, rule, remedy)
    if table.bath_factor and not table.oil_level:
        yield InputError(f"{key}.bath_factor", None, "has no effect without oil_level", "leave it out")
    if table.oil_level and table.width is None and table.type.endswith("roller"):
        rule = "missing: rollers push oil over it"
        yield InputError(f"{key}.width", rule=rule, remedy='add width = "20 mm"')
    if table.seal and table.seal_diameter is None:
        rule, remedy = f"missing: seal = {quoted(table.seal)} needs it", 'add seal_diameter = "50 mm"'
        yield InputError(f"{key}.seal_diameter", rule=rule, remedy=remedy)
    most = SEALS[table.seal][-1][0] if table.seal else 0.0
    if table.seal and table.outside_diameter and 1e3 * table.outside_diameter > most:
        rule = f"is known up to an outside diameter of {most:g} mm"
        yield InputError(f"{key}.seal", quoted(table.seal), rule, "leave it out")


def broken_drawn_bearing(key: str, table: BearingOfShaft, method: str) -> Iterator[InputError]:
    """Go through what a method misses of a bearing of a drawn shaft."""
    bearing = friction_data(table)
    if bearing is None:
        return
    known = BEARING_METHODS[method]
    if bearing.type not in known.series:
        yield _unknown_type(f"{key}.type", bearing.type, method)
    elif table.series is not None and table.series not in known.series[bearing.type]:
        yield _unknown_series(f"{key}.series", table.series, bearing.type, method)


def _unknown_type(key: str, kind: str, method: str) -> InputError:
    others = [quoted(name) for name, known in BEARING_METHODS.items() if kind in known.series]
    rule = f"is not known to bearings = {quoted(method)}"
    return InputError(key, quoted(kind), rule, f"write bearings = {' or '.join(others)}")


def _unknown_series(key: str, series: str, kind: str, method: str) -> InputError:
    known = BEARING_METHODS[method].series[kind]
    if not known:
        rule = f"has no effect: bearings = {quoted(method)} does not distinguish series of this type"
        return InputError(key, quoted(series), rule, "leave it out")
    return InputError(key, quoted(series), "no such series", f"there is: {', '.join(known)}")
