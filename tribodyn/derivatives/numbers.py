"""The numbers of a case by which its figures can be differentiated: their keys, units, and places."""

import tomllib
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from pydantic import BaseModel

from tribodyn.geometry.drive import SIDES, Side, body_of
from tribodyn.geometry.families import family
from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.parameter import Parameter
from tribodyn.scenario.own_keys import si_unit
from tribodyn.scenario.units import Kind
from tribodyn.scenario.vary import kind_at
from tribodyn.tribology.closure import laws_of
from tribodyn.tribology.lubricant import lubricant_at, lubricant_from
from tribodyn.tribology.oil import UNITS, OilSheet

_OF_BODY = ("profile_shift", "addendum", "dedendum", "fillet_radius", "face_width", "bore_radius")
_OF_MATERIAL = (
    "youngs_modulus",
    "poisson_ratio",
    "density",
    "thermal_conductivity",
    "specific_heat",
    "hardness",
)


class Number(NamedTuple):
    """A number of a case.

    Parameters
    ----------
    value : SI
    unit : SI unit, "1" for plain numbers
    put : (case, value) -> the case with another value, which may be traced
    """

    value: float
    unit: str
    put: Callable[[Any, Any], Any]


def numbers_of(case: Any, schema: type[BaseModel]) -> dict[str, Number]:
    """Numbers of a case with gears by their dotted keys, as overrides have them; `schema` of its scenario."""
    table = tomllib.loads(case.toml)

    def numbers() -> Iterator[tuple[str, Number]]:
        yield from _of_drive(case)
        yield from _of_materials(case, table)
        if hasattr(case, "roughness"):
            yield from _of_roughness(case, table)
        for name in ("lubricant", "operating", "film", "friction"):
            if hasattr(case, name):
                yield from _LISTED[name](case)

    found = {}
    for key, number in numbers():
        kind = kind_at(schema, key)
        unit = number.unit or (kind.si if isinstance(kind, Kind) else "1")
        found[key] = number._replace(unit=unit.replace("**", "").replace("*", " "))
    return found


def _of_drive(case: Any) -> Iterator[tuple[str, Number]]:
    drive, teeth = case.drive, family(case.family)

    def on_drive(name: str) -> Callable[[Any, Any], Any]:
        return lambda case, value: replace(case, drive=case.drive._replace(**{name: value}))

    def on_body(side: Side, name: str) -> Callable[[Any, Any], Any]:
        def put(case: Any, value: Any) -> Any:
            body = body_of(case.drive, side)._replace(**{name: value})
            return replace(case, drive=case.drive._replace(**{side: body}))

        return put

    def on_shape(name: str) -> Callable[[Any, Any], Any]:
        def put(case: Any, value: Any) -> Any:
            shape = case.drive.shape._replace(**{name: value})
            return replace(case, drive=case.drive._replace(shape=shape))

        return put

    yield "drive.module", Number(drive.module, "", on_drive("module"))
    if teeth.pressure_angle:
        yield "drive.pressure_angle", Number(drive.pressure_angle, "", on_drive("pressure_angle"))
    if drive.centre_distance is not None:
        yield "drive.centre_distance", Number(drive.centre_distance, "", on_drive("centre_distance"))
    for one in teeth.parameters:
        value = getattr(drive.shape, one.name, None)
        if one.kind == "path" or one.fixed or value is None:
            continue
        if one.listed:
            for place, item in enumerate(value):
                put = _on_entry(one.name, place)
                yield f"drive.shape.{one.name}.{place}", Number(item, si_unit(one), put)
        else:
            yield f"drive.shape.{one.name}", Number(value, si_unit(one), on_shape(one.name))
    for side in SIDES:
        body = body_of(drive, side)
        names = [name for name in _OF_BODY if name != "profile_shift" or teeth.shiftable]
        if body.tip_radius is not None:  # takes the place of the addendum
            names = ["tip_radius" if name == "addendum" else name for name in names]
        for name in names:
            yield f"drive.{side}.{name}", Number(getattr(body, name), "", on_body(side, name))


def _on_entry(name: str, place: int) -> Callable[[Any, Any], Any]:
    def put(case: Any, value: Any) -> Any:
        values = getattr(case.drive.shape, name)
        xp = namespace(values, value)
        changed = xp.where(np.arange(len(values)) == place, value, values)
        return replace(case, drive=case.drive._replace(shape=case.drive.shape._replace(**{name: changed})))

    return put


def _of_materials(case: Any, table: dict[str, Any]) -> Iterator[tuple[str, Number]]:
    own = {side: bool(table["drive"][side].get("material")) for side in SIDES}
    groups: list[tuple[str, tuple[Side, ...]]] = []
    for side in SIDES:
        if own[side]:
            groups.append((f"drive.{side}.material", (side,)))
    shared: tuple[Side, ...] = tuple(side for side in SIDES if not own[side])
    if shared:
        groups.append(("drive.material", shared))
    for key, sides in groups:
        for name in _OF_MATERIAL:
            places = tuple(SIDES.index(side) for side in sides)
            value = getattr(case.materials[places[0]], name)
            yield f"{key}.{name}", Number(value, "", _on_materials(places, name))


def _on_materials(places: tuple[int, ...], name: str) -> Callable[[Any, Any], Any]:
    def put(case: Any, value: Any) -> Any:
        changed = tuple(
            replace(one, **{name: value}) if place in places else one
            for place, one in enumerate(case.materials)
        )
        return replace(case, materials=changed)

    return put


def _of_roughness(case: Any, table: dict[str, Any]) -> Iterator[tuple[str, Number]]:
    drive = table["drive"]
    if drive.get("roughness") is None:
        yield from _of_mean_roughness(case, drive)
        return
    given = drive.get("mean_roughness") is not None
    share = case.mean_roughness / case.roughness

    def put(case: Any, value: Any) -> Any:
        mean = case.mean_roughness if given else share * value
        return replace(case, roughness=value, mean_roughness=mean)

    yield "drive.roughness", Number(case.roughness, "", put)
    if given:
        on_mean = _on("mean_roughness")
        yield "drive.mean_roughness", Number(case.mean_roughness, "", on_mean)


def _of_mean_roughness(case: Any, drive: dict[str, Any]) -> Iterator[tuple[str, Number]]:
    """Ra of both flanks where the composite roughness follows from it; none where each gear has its own."""
    if any(drive[side].get("mean_roughness") is not None for side in SIDES):
        return
    share = case.roughness / case.mean_roughness

    def put(case: Any, value: Any) -> Any:
        return replace(case, mean_roughness=value, roughness=share * value)

    yield "drive.mean_roughness", Number(case.mean_roughness, "", put)


def _on(name: str, within: str = "") -> Callable[[Any, Any], Any]:
    def put(case: Any, value: Any) -> Any:
        if not within:
            return replace(case, **{name: value})
        return replace(case, **{within: replace(getattr(case, within), **{name: value})})

    return put


def _of_lubricant(case: Any) -> Iterator[tuple[str, Number]]:
    sheet = case.lubricant.sheet
    if sheet is None:
        for name in UNITS:
            yield f"lubricant.{name}", Number(getattr(case.lubricant, name), "", _on(name, "lubricant"))
        return

    def on_sheet(change: Callable[[OilSheet, Any], OilSheet]) -> Callable[[Any, Any], Any]:
        def put(case: Any, value: Any) -> Any:
            oil = case.lubricant
            return replace(case, lubricant=lubricant_from(change(oil.sheet, value), oil.temperature, oil.fzg))

        return put

    for name in ("viscosity_40", "viscosity_100", "density_15"):
        put = on_sheet(lambda sheet, value, name=name: replace(sheet, **{name: value}))
        yield f"lubricant.{name}", Number(getattr(sheet, name), "", put)
    for name, value in sheet.given.items():
        put = on_sheet(lambda sheet, value, name=name: replace(sheet, given={**sheet.given, name: value}))
        yield f"lubricant.{name}", Number(value, "", put)

    def put_temperature(case: Any, value: Any) -> Any:
        return replace(case, lubricant=lubricant_at(case.lubricant, value))

    yield "operating.oil_temperature", Number(case.lubricant.temperature, "", put_temperature)


def _of_operating(case: Any) -> Iterator[tuple[str, Number]]:
    for name in ("pinion_speed", "gear_torque"):
        yield f"operating.{name}", Number(getattr(case.operating, name), "", _on(name, "operating"))


def _of_law(table: str) -> Callable[[Any], Iterator[tuple[str, Number]]]:
    def numbers(case: Any) -> Iterator[tuple[str, Number]]:
        film, friction = laws_of(case)
        keys: tuple[Parameter, ...] = (film if table == "film" else friction).keys
        given = getattr(case, table).values
        # of a film law that no table names, nothing stands in the scenario
        named = table == "friction" or case.film.law is not None
        for one in keys if named else ():
            value = given.get(one.name, one.default)
            if one.kind != "path" and value is not None:
                yield f"{table}.{one.name}", Number(value, si_unit(one), _on_law(table, one.name))

    return numbers


def _on_law(table: str, name: str) -> Callable[[Any, Any], Any]:
    def put(case: Any, value: Any) -> Any:
        data = getattr(case, table)
        return replace(case, **{table: replace(data, values={**data.values, name: value})})

    return put


_LISTED: dict[str, Callable[[Any], Iterator[tuple[str, Number]]]] = {
    "lubricant": _of_lubricant,
    "operating": _of_operating,
    "film": _of_law("film"),
    "friction": _of_law("friction"),
}
