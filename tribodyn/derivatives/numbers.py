"""The numbers of a case by which its quantities can be differentiated: their keys, units, and places."""

import tomllib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from pydantic import BaseModel

from tribodyn.geometry.drive import SIDES, Drive, GearBody, Side, body_of, internal_side
from tribodyn.geometry.families import Family, family
from tribodyn.geometry.families.involute import tight_centre_distance
from tribodyn.geometry.helix import as_written, from_written
from tribodyn.input.specific_keys import si_unit
from tribodyn.input.tables.gears.drive_data import rounded_distance_of
from tribodyn.input.tables.gears.tooth_data import USUAL_BORE, rim_radius
from tribodyn.input.units import Kind
from tribodyn.input.vary import kind_at
from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.closure import laws_of
from tribodyn.tribology.oil import UNITS, lubricant_at, lubricant_from

_OF_BODY = ("profile_shift", "addendum", "dedendum", "fillet_radius", "face_width", "thickness_allowance")
_OF_MATERIAL = (
    "youngs_modulus",
    "poisson_ratio",
    "density",
    "thermal_conductivity",
    "specific_heat",
    "hardness",
)


class Number(NamedTuple):
    """A number of a case."""

    value: float  # SI
    unit: str  # SI unit, "1" for plain numbers
    put: Callable[[Any, Any], Any]  # (case, value) -> the case with another value, which may be traced


def numbers_of(
    case: Any, schema: type[BaseModel], asked: Callable[[str], bool] = lambda _: False
) -> dict[str, Number]:
    """Numbers of a case with gears by their dotted keys, as overrides have them; `schema` of its scenario.

    A bore or rim that the scenario does not give follows from module and teeth, and is no number of its own
    unless it is `asked` for by its key.
    """
    numbers = {}
    for key, number in _numbers(case, tomllib.loads(case.toml)["drive"], asked):
        numbers[key] = number._replace(unit=unit_at(schema, key, number.unit))
    return numbers


def unit_at(schema: type[BaseModel], key: str, explicit: str = "") -> str:
    """SI unit of a key as it is shown: its `explicit`, else as the schema has it."""
    kind = kind_at(schema, key)
    unit = explicit or (kind.si if isinstance(kind, Kind) else "1")
    return unit.replace("**", "").replace("*", " ")


def _numbers(case: Any, drive: dict[str, Any], asked: Callable[[str], bool]) -> Iterator[tuple[str, Number]]:
    """Numbers by their keys, their unit "" where the schema has it; `drive` is that table of the scenario."""
    yield from _of_drive(case, drive, asked)
    yield from _of_materials(case, drive)
    if hasattr(case, "roughness"):
        yield from _of_roughness(case, drive)
    if hasattr(case, "lubricant"):
        yield from _of_lubricant(case)
    if hasattr(case, "operating"):
        for name in ("pinion_speed", "gear_torque"):
            yield f"operating.{name}", Number(getattr(case.operating, name), "", _on("operating", name))
    if hasattr(case, "film") and hasattr(case, "friction"):
        film, friction = laws_of(case)
        # of a film law that no table names, nothing stands in the scenario
        yield from _of_law(case, "film", film.keys if case.film.law is not None else ())
        yield from _of_law(case, "friction", friction.keys)


def _on(*path: str | int) -> Callable[[Any, Any], Any]:
    """Puts a value at the end of a path of fields, keys and places."""
    return lambda whole, value: _put(whole, path, value)


def _put(whole: Any, path: tuple[str | int, ...], value: Any) -> Any:
    first, rest = path[0], path[1:]
    if isinstance(first, int):
        if rest:
            return tuple(_put(item, rest, value) if i == first else item for i, item in enumerate(whole))
        return namespace(whole, value).where(np.arange(len(whole)) == first, value, whole)
    if isinstance(whole, dict):
        return {**whole, first: value}
    changed = {first: _put(getattr(whole, first), rest, value) if rest else value}
    return whole._replace(**changed) if hasattr(whole, "_replace") else replace(whole, **changed)


def _of_drive(case: Any, table: dict[str, Any], asked: Callable[[str], bool]) -> Iterator[tuple[str, Number]]:
    teeth, helix = family(case.family), case.drive.helix_angle
    drive = as_written(teeth, case.drive)
    bores = {side: _bore_key(table[side], drive, side) for side in SIDES}
    rims: tuple[Side, ...] = tuple(
        side for side in SIDES if not bores[side][1] and not asked(f"drive.{side}.{bores[side][0]}")
    )
    rounded = drive.centre_distance is not None and rounded_distance_of(table) is not None
    write = partial(_write, _Following(rims, rounded))
    if helix:
        hand = np.sign(helix)
        yield "drive.helix_angle", Number(abs(helix), "", partial(write, ("helix_angle",), hand))
    for name in ("module", "pressure_angle") if teeth.pressure_angle else ("module",):
        yield f"drive.{name}", Number(getattr(drive, name), "", partial(write, (name,), 1.0))
    if drive.centre_distance is not None and not rounded:
        sign = -1.0 if internal_side(drive) else 1.0  # ISO 21771
        number = Number(sign * drive.centre_distance, "", partial(write, ("centre_distance",), sign))
        yield "drive.centre_distance", number
    for parameter in teeth.parameters:
        name = parameter.name
        value = getattr(drive.shape, name, None)
        if parameter.kind == "path" or parameter.fixed or value is None:
            continue
        unit = si_unit(parameter)
        if parameter.listed:
            for place, item in enumerate(value):
                put = _on("drive", "shape", name, place)
                yield f"drive.shape.{name}.{place}", Number(item, unit, put)
        else:
            yield f"drive.shape.{name}", Number(value, unit, _on("drive", "shape", name))
    for side in SIDES:
        names = _names_of_body(teeth, table[side], body_of(drive, side))
        if side not in rims:
            names |= {bores[side][0]: "bore_radius"}
        for key, name in names.items():
            scale = _scale(key, table[side])
            value = getattr(body_of(drive, side), name) / scale
            yield f"drive.{side}.{key}", Number(value, "", partial(write, (side, name), scale))


class _Following(NamedTuple):
    """What a scenario does not give of its drive, and follows from the numbers that it gives."""

    rims: tuple[Side, ...]  # gears without a bore, or an outer diameter
    tight: bool  # whether the centre distance is that without backlash, within the rounding of its digits


def _bore_key(gear: dict[str, Any], drive: Drive, side: Side) -> tuple[str, bool]:
    """Key of a gear's bore, of an internal one its outside, and whether the scenario gives it."""
    keys = ("outer_diameter",) if body_of(drive, side).teeth < 0 else ("bore_radius", "bore_diameter")
    given = [key for key in keys if gear.get(key) is not None]
    return (given or keys)[0], bool(given)


def _names_of_body(teeth: Family, gear: dict[str, Any], body: GearBody) -> dict[str, str]:
    """Keys of a gear and the fields of its body that they give."""
    names = {name: name for name in _OF_BODY}
    if not teeth.shiftable:
        del names["profile_shift"]
    if body.tip_radius is not None:  # takes the place of the addendum
        del names["addendum"]
        names["tip_diameter" if gear.get("tip_diameter") is not None else "tip_radius"] = "tip_radius"
    if body.teeth < 0:
        names["cutter_profile_shift"] = "cutter_shift"
        if body.cutter_addendum is not None:
            names["cutter_addendum"] = "cutter_addendum"
        if gear.get("cutter_rounding") is not None:
            del names["fillet_radius"]
            names["cutter_rounding"] = "fillet_radius"
    if any(
        gear.get(name) is not None for name in ("thickness_code", "thickness_tolerance", "span", "over_pins")
    ):
        del names["thickness_allowance"]
    return names


def _scale(key: str, gear: dict[str, Any]) -> float:
    """A body's number over that of the key, which is written without the signs of an internal gear."""
    internal = bool(gear.get("internal"))
    if key.endswith("_diameter"):
        return -0.5 if internal else 0.5
    reversed_shift = key == "profile_shift" and gear.get("profile_shift_of") == "gap"
    return -1.0 if (internal and key == "tip_radius") or reversed_shift else 1.0


def _write(following: _Following, path: tuple[str, ...], scale: float, case: Any, value: Any) -> Any:
    """Put a number of a drive's keys, which of helical involutes are those of the normal section."""
    teeth = family(case.family)
    drive = from_written(teeth, _put(as_written(teeth, case.drive), path, scale * value))
    for side in following.rims:
        body = body_of(drive, side)
        bore = (
            rim_radius(body, drive.module) if body.teeth < 0 else USUAL_BORE * drive.module * body.teeth / 2
        )
        drive = drive._replace(**{side: body._replace(bore_radius=bore)})
    if following.tight:
        drive = drive._replace(centre_distance=tight_centre_distance(drive))
    return replace(case, drive=drive)


def _of_materials(case: Any, drive: dict[str, Any]) -> Iterator[tuple[str, Number]]:
    with_material = [place for place, side in enumerate(SIDES) if drive[side].get("material")]
    groups = {f"drive.{SIDES[place]}.material": [place] for place in with_material}
    groups["drive.material"] = [place for place in range(len(SIDES)) if place not in with_material]

    def put(places: list[int], name: str, case: Any, value: Any) -> Any:
        for place in places:
            case = _put(case, ("materials", place, name), value)
        return case

    for key, places in groups.items():
        for name in _OF_MATERIAL if places else ():
            value = getattr(case.materials[places[0]], name)
            yield f"{key}.{name}", Number(value, "", partial(put, places, name))


def _of_roughness(case: Any, drive: dict[str, Any]) -> Iterator[tuple[str, Number]]:
    """Composite roughness and mean Ra, the one that is given or both; none where each gear has its own Ra."""
    stated = [name for name in ("roughness", "mean_roughness") if drive.get(name) is not None]
    if len(stated) == 2:
        for name in stated:
            yield f"drive.{name}", Number(getattr(case, name), "", _on(name))
        return
    name, other = (
        ("roughness", "mean_roughness") if "roughness" in stated else ("mean_roughness", "roughness")
    )
    if name == "mean_roughness" and any(drive[side].get(name) is not None for side in SIDES):
        return
    share = getattr(case, other) / getattr(case, name)

    def put(case: Any, value: Any) -> Any:
        return replace(case, **{name: value, other: share * value})

    yield f"drive.{name}", Number(getattr(case, name), "", put)


def _of_lubricant(case: Any) -> Iterator[tuple[str, Number]]:
    sheet = case.lubricant.sheet
    if sheet is None:
        for name in UNITS:
            yield f"lubricant.{name}", Number(getattr(case.lubricant, name), "", _on("lubricant", name))
        return

    def put(path: tuple[str, ...], case: Any, value: Any) -> Any:
        oil = case.lubricant
        sheet = _put(oil.sheet, path, value)
        return replace(case, lubricant=lubricant_from(sheet, oil.temperature, oil.fzg))

    for name in ("viscosity_40", "viscosity_100", "density_15"):
        yield f"lubricant.{name}", Number(getattr(sheet, name), "", partial(put, (name,)))
    for name, value in sheet.given.items():
        yield f"lubricant.{name}", Number(value, "", partial(put, ("given", name)))

    def put_temperature(case: Any, value: Any) -> Any:
        return replace(case, lubricant=lubricant_at(case.lubricant, value))

    yield "operating.oil_temperature", Number(case.lubricant.temperature, "", put_temperature)


def _of_law(case: Any, table: str, keys: Iterable[Parameter]) -> Iterator[tuple[str, Number]]:
    law_values = getattr(case, table).values
    for parameter in keys:
        name = parameter.name
        value = law_values.get(name, parameter.default)
        if parameter.kind != "path" and value is not None:
            yield f"{table}.{name}", Number(value, si_unit(parameter), _on(table, "values", name))
