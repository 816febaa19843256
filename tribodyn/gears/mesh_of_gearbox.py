"""A mesh of a gearbox in place of a drive: its pair of gears, at the duty that the gearbox gives it."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from tribodyn.cases.assessment_part import WholeDrive, shared_names
from tribodyn.errors import InputError, quoted
from tribodyn.geometry.drive import SIDES
from tribodyn.input.names import OF_PAIR, under_one_name
from tribodyn.input.quantity import Table
from tribodyn.input.schema import fields_of
from tribodyn.input.sources import SCENARIOS, find_model
from tribodyn.input.tables.duty import LOADS, SPEEDS
from tribodyn.input.tables.gears.model_files import GearboxTable

#: A scenario's file -> its study, and what makes its case.
Opened = Callable[[Path], tuple[Any, Callable[[], Any]]]


class _Asked(Table):
    """The part of a scenario that is read before the rest."""

    gearbox: GearboxTable


def with_pair(
    data: Mapping[str, Any], schema: type[BaseModel], referring: Path, opened: Opened
) -> dict[str, Any]:
    """A scenario's data with its `gearbox` replaced by the tables that the pair of gears of its mesh has.

    What the data say themselves holds. `referring` is the file, `opened` opens a scenario.
    InputError where there is no such gearbox or mesh, and ValidationError of pydantic where `gearbox` is
    no such table.
    """
    mesh, whole, case = _gearbox_of(data, referring, opened)
    return _with_mesh(data, schema, whole, case, mesh)


def with_every_pair(
    data: Mapping[str, Any],
    schema: type[BaseModel],
    referring: Path,
    opened: Opened,
    *,
    driven_rings: bool,
    driving_rings: bool,
) -> dict[str, dict[str, Any] | None]:
    """The data as `with_pair` gives them for every mesh by name, where there are several and none is named.

    Meshes that differ by their planet alone count once. Those with an internal gear that is driven, or
    that drives, are None unless the study is said to know these, or there is no other. Raises as `with_pair`.
    """
    mesh, whole, case = _gearbox_of(data, referring, opened)
    names = [] if mesh else list(dict.fromkeys(shared_names(whole.meshes(case))))
    if len(names) < 2:
        return {}
    every = {name: _with_mesh(data, schema, whole, case, name) for name in names}
    unknown = {
        name
        for name, each in every.items()
        if any(each["drive"][side].get("internal") for side in SIDES)
        and not (driving_rings if _ring_drives(each) else driven_rings)
    }
    if unknown == set(every):
        return dict(every)
    return {name: None if name in unknown else each for name, each in every.items()}


def _ring_drives(data: Mapping[str, Any]) -> bool:
    """Whether the load of a pair turns its ring forwards."""
    operating = under_one_name(data["operating"])
    return any(str(operating[key]).startswith("-") for key in LOADS if key in operating)


def _gearbox_of(data: Mapping[str, Any], referring: Path, opened: Opened) -> tuple[str, WholeDrive, Any]:
    """The mesh that is named, or "", what the study of the gearbox says of its meshes, and its case."""
    asked = _Asked.model_validate({"gearbox": data["gearbox"]}).gearbox
    name = asked.scenario
    if isinstance(drive := data.get("drive"), Mapping) and "family" in drive:
        rule = "contradicts drive, which is a pair of gears too"
        raise InputError("gearbox", None, rule, "leave the one or the other out")
    path = find_model(name, SCENARIOS, "gearbox.scenario", referring)
    study, case = opened(path)
    whole = study.whole()
    if whole is None:
        rule = f"is no gearbox of several meshes, but {study.about}"
        raise InputError("gearbox.scenario", quoted(name), rule, "name its drive: drive = …")
    return asked.mesh, whole, case()


def _with_mesh(
    data: Mapping[str, Any], schema: type[BaseModel], whole: WholeDrive, case: Any, mesh: str
) -> dict[str, Any]:
    try:
        tables = whole.pair(case, mesh)
    except InputError as error:
        remedy = error.remedy if mesh else f"{error.remedy}; all of them: tribodyn run, tribodyn.run_meshes"
        raise InputError(f"gearbox.{error.key}", error.value, error.rule, remedy) from None
    return _put({key: value for key, value in data.items() if key != "gearbox"}, tables, schema)


def _put(data: dict[str, Any], tables: Mapping[str, Any], schema: type[BaseModel]) -> dict[str, Any]:
    """The data over the tables, of which those keys are taken that the schema has."""
    merged = dict(data)
    for name, table in tables.items():
        if name not in schema.model_fields:
            continue
        in_data = data.get(name)
        if not isinstance(table, Mapping) or not (in_data is None or isinstance(in_data, Mapping)):
            merged.setdefault(name, table)
            continue
        written = dict(in_data or {})
        kept = {key: value for key, value in table.items() if _has(schema, name, key)}
        for group in (SPEEDS, LOADS):
            if name == "operating" and set(group) & set(under_one_name(written)):
                kept = {key: value for key, value in kept.items() if OF_PAIR.get(key, key) not in group}
        if "law" in written:  # and its own keys
            kept = {}
        merged[name] = kept | written
    return merged


def _has(schema: type[BaseModel], name: str, key: str) -> bool:
    """Whether the schema's table of a name knows a key; of a drive or an oil, and of laws, all."""
    annotation = schema.model_fields[name].annotation
    kinds = [annotation, *getattr(annotation, "__args__", ())]
    tables = [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, BaseModel)]
    if not tables or name in ("drive", "lubricant"):
        return True
    fields = {field for table in tables for field in fields_of(table)}
    laws = name in ("film", "friction") and key not in ("sliding", "reversal_width")  # of motions alone
    return laws or key in fields
