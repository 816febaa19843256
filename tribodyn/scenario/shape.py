"""The numbers that a drive's family has of its own, ``[drive.shape]``: what is due, and in which unit."""

from typing import Any

import numpy as np
from pydantic import ValidationError

from tribodyn.errors import InputError, near_name, quoted
from tribodyn.geometry.family import Family, Parameter
from tribodyn.scenario import units
from tribodyn.scenario.model_files import DriveTable
from tribodyn.scenario.quantity import Column

_LENGTHS = {"length": units.positive(units.LENGTH), "signed length": units.LENGTH}


def shape_of(drive: DriveTable, family: Family) -> Any:
    """Return the family's shape in SI units; raises the first of `shape_errors`."""
    given = drive.shape or {}
    if family.shape is None:
        return ()
    return family.shape(**{one.name: _value(one, given[one.name]) for one in family.parameters})


def shape_errors(drive: DriveTable, family: Family) -> list[InputError]:
    """Return what is wrong with the keys that depend on the family: ``pressure_angle`` and ``shape``."""
    errors = []
    if family.pressure_angle and drive.pressure_angle is None:
        errors.append(InputError("drive.pressure_angle", None, "missing", 'add pressure_angle = "20 deg"'))
    if not family.pressure_angle and drive.pressure_angle is not None:
        rule = f'contradicts family = "{family.name}", whose shape alone gives the pressure angle'
        shown = f"{np.degrees(drive.pressure_angle):.4g} deg"
        errors.append(InputError("drive.pressure_angle", shown, rule, "leave it out"))
    given, known = drive.shape or {}, {one.name: one for one in family.parameters}
    for name, value in given.items():
        if name not in known:
            near = near_name(name, known)
            there = ", ".join(known) or "none"
            remedy = f'did you mean "{near}"?' if near else f"keys of this family: {there}"
            errors.append(InputError(f"drive.shape.{name}", quoted(value), "unknown key", remedy))
    for name, parameter in known.items():
        key = f"drive.shape.{name}"
        if name not in given:
            errors.append(InputError(key, None, f"missing: {parameter.about}", _example(parameter)))
            continue
        try:
            _value(parameter, given[name], key)
        except InputError as error:
            errors.append(error)
    return errors


def _example(parameter: Parameter) -> str:
    value = {"number": "0.3", "path": '"path.csv"'}.get(parameter.kind, '"12 mm"')
    return f"add {parameter.name} = {value} to [shape]"


def _value(parameter: Parameter, value: Any, key: str = "drive.shape") -> Any:
    if parameter.kind == "path":
        return _points(value, key)
    if parameter.kind == "number":
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
            raise InputError(key, quoted(value), "not a plain number", "write a number such as 0.3")
        return float(value)
    try:
        return units.to_si(value, _LENGTHS[parameter.kind])
    except units.NotAQuantity as error:
        raise InputError(key, quoted(value), error.rule, error.remedy) from None


def _points(value: Any, key: str) -> np.ndarray:
    """Points (n, 2) of a path, m."""
    remedy = (
        'name a CSV file that begins with x [mm],y [mm], or write {x = {unit = "mm", values = […]}, y = …}'
    )
    if not isinstance(value, dict) or set(value) != {"x", "y"}:
        raise InputError(key, quoted(value), "not the points of a path", remedy)
    columns = []
    for name in ("x", "y"):
        try:
            columns.append(Column.model_validate(value[name]).in_si(units.LENGTH))
        except ValidationError:
            raise InputError(
                f"{key}.{name}", quoted(value[name]), "not a column of numbers", remedy
            ) from None
        except units.NotAQuantity as error:
            raise InputError(f"{key}.{name}", None, error.rule, error.remedy) from None
    if len(columns[0]) != len(columns[1]):
        counts = f"{len(columns[0])} values of x and {len(columns[1])} of y"
        raise InputError(key, None, counts, "write as many of each")
    return np.stack(columns, axis=-1)
