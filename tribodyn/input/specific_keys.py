"""Values of the keys that a tooth family or a law has of its own: what is due, and in which unit."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from pydantic import ValidationError

from tribodyn.errors import InputError, near_name, quoted
from tribodyn.input import units
from tribodyn.input.quantity import Column
from tribodyn.numerics.parameter import Parameter


class Owner(NamedTuple):
    """Whose keys they are, and where they stand."""

    table: str  # dotted key of the table: "drive.shape"
    what: str  # for messages: "family", "law"
    parameters: tuple[Parameter, ...]  # the keys
    others: tuple[str, ...] = ()  # keys of the same table that are not the owner's


def own_values(owner: Owner, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of the keys that are given, in SI units; raises the first of `own_key_errors`."""
    for error in own_key_errors(owner, values):
        raise error
    parameters = {parameter.name: parameter for parameter in owner.parameters}
    return {name: value_in_si(parameters[name], value) for name, value in values.items()}


def own_key_errors(owner: Owner, values: Mapping[str, Any]) -> list[InputError]:
    """Return what is wrong with the keys: unknown, missing, of a wrong unit or sign."""
    errors = []
    parameters = {parameter.name: parameter for parameter in owner.parameters}
    there = (*parameters, *owner.others)
    for name in (name for name in values if name not in parameters):
        near = near_name(name, there)
        remedy = f"keys of this {owner.what}: {', '.join(there) or 'none'}"
        remedy = f'did you mean "{near}"?' if near else remedy
        errors.append(InputError(f"{owner.table}.{name}", quoted(values[name]), "unknown key", remedy))
    for name, parameter in parameters.items():
        key = f"{owner.table}.{name}"
        if name in values:
            try:
                value_in_si(parameter, values[name], key)
            except InputError as error:
                errors.append(error)
        elif parameter.default is None and not parameter.optional:
            remedy = f"add {name} = {example_of(parameter)} to [{owner.table.removeprefix('drive.')}]"
            errors.append(InputError(key, None, f"missing: {parameter.about}", remedy))
    return errors


def key_schema(parameter: Parameter) -> dict[str, Any]:
    """Return the JSON schema of a key's value."""
    about = parameter.about
    if parameter.default is not None:
        source = f" ({parameter.source})" if parameter.source else ""
        about += f"; default: {parameter.default:g} in SI units{source}"
    if parameter.listed:
        return {"type": "array", "description": about, "items": key_schema(_of_list(parameter))}
    if parameter.kind == "number":
        lowest = {"not negative": {"minimum": 0}, "positive": {"exclusiveMinimum": 0}}
        return {"type": "number", "description": about, **lowest.get(parameter.allowed, {})}
    if parameter.kind == "path":
        return {"type": "string", "description": f"{about}; name of a CSV file"}
    kind = _kind(parameter)
    return {
        "type": "string",
        "description": f"{about}; a quantity with a unit of {kind.name}",
        "examples": [parameter.example or kind.example],
    }


def value_in_si(parameter: Parameter, value: Any, key: str = "") -> Any:
    """Return a value as the scenario has it in SI units; a list as an array, points as (n, 2)."""
    if parameter.kind == "path":
        return _points(value, key)
    if parameter.listed:
        if not isinstance(value, (list, tuple)) or not value:
            raise InputError(key, quoted(value), "not a list", f"write {example_of(parameter)}")
        single = _of_list(parameter)
        return np.array([value_in_si(single, item, f"{key}.{place}") for place, item in enumerate(value)])
    if parameter.kind == "number":
        return _number(parameter, value, key)
    try:
        return units.to_si(value, _kind(parameter))
    except units.NotAQuantity as error:
        raise InputError(key, quoted(value), error.rule, error.remedy) from None


def in_toml(parameter: Parameter, value: Any) -> Any:
    """Return a number in SI units, or a list of them, as the scenario gives it."""
    if parameter.listed:
        return [in_toml(_of_list(parameter), item) for item in value]
    return float(value) if parameter.kind == "number" else f"{float(value)!r} {_kind(parameter).si}"


def si_unit(parameter: Parameter) -> str:
    """Return the SI unit of a key's number; "1" of a plain one."""
    return "1" if parameter.kind == "number" else _kind(parameter).si


def _of_list(parameter: Parameter) -> Parameter:
    """What stands at one place of a list."""
    return parameter._replace(listed=False, example="")


def _kind(parameter: Parameter) -> units.Kind:
    signed = parameter.kind.startswith("signed ")
    kind = units.QUANTITIES[parameter.kind.removeprefix("signed ")]
    return kind._replace(allowed=parameter.allowed or ("any" if signed else "positive"))


def example_of(parameter: Parameter) -> str:
    """Return a sensible value as TOML writes it."""
    plain = {"number": "0.3", "path": '"path.csv"', "length": '"12 mm"', "signed length": '"12 mm"'}
    return parameter.example or plain.get(parameter.kind) or quoted(_kind(parameter).example)


def _number(parameter: Parameter, value: Any, key: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
        example = parameter.example or "0.3"
        raise InputError(key, quoted(value), "not a plain number", f"write a number such as {example}")
    if parameter.allowed == "not negative" and value < 0:
        raise InputError(key, quoted(value), "must be at least 0", "write 0 or more")
    if parameter.allowed == "positive" and value <= 0:
        raise InputError(key, quoted(value), "must be greater than 0", "write a larger number")
    return float(value)


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
            column = quoted(value[name])
            raise InputError(f"{key}.{name}", column, "not a column of numbers", remedy) from None
        except units.NotAQuantity as error:
            raise InputError(f"{key}.{name}", None, error.rule, error.remedy) from None
    if len(columns[0]) != len(columns[1]):
        counts = f"{len(columns[0])} values of x and {len(columns[1])} of y"
        raise InputError(key, None, counts, "write as many of each")
    return np.stack(columns, axis=-1)
