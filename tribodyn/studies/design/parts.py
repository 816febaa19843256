"""From the table `[design]` to free keys, objectives, constraints, duties and tolerances."""

import re
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from math import isfinite
from typing import Any, NamedTuple

from tribodyn.errors import InputError, quoted
from tribodyn.input.names import same_key
from tribodyn.input.resolve import toml_value
from tribodyn.input.units import Kind, NotAQuantity, base_units, factor_to_si, to_si, to_si_at
from tribodyn.input.vary import is_drawn, is_whole, kind_at
from tribodyn.studies.design import case
from tribodyn.studies.design.candidates.candidates import PITCH_ERRORS, PROFILE_ERROR
from tribodyn.studies.design.candidates.sources import (
    Sources,
    quantity_name,
    refused,
    require_key,
    units_by_name,
)
from tribodyn.studies.protocol.study import Study

_CONSTRAINT = re.compile(r"\s*([A-Za-z][\w.-]*)\s*(<=|>=|≤|≥|<|>)\s*(\S.*?)\s*$")


def parts_of_design(table: Any, sources: Sources) -> tuple[dict[str, Any], list[InputError]]:
    """Fields of a `DesignCase` that the table `[design]` says, and what is wrong with it."""
    errors: list[InputError] = []
    studies = {name: source.study for name, source in sources.items()}

    def collect(place: str, some: Sequence[Any], read: Callable[..., Any], *more: Any) -> list[Any]:
        entries = []
        for number, entry in enumerate(some):
            try:
                entries.append(read(f"{place}.{number}", entry, *more))
            except InputError as error:
                errors.append(error)
        return entries

    free = collect("design.free", table.free, _free, sources)
    if not table.free:
        rule, remedy = "nothing is free", 'add { key = "…", from = "…", to = "…" }'
        errors.append(InputError("design.free", "[]", rule, remedy))
    errors += _twice(free)
    objectives = collect("design", [table], _objectives, studies)
    constraints = collect("design.subject_to", table.subject_to, _constraint, studies)
    errors += _contradictions(constraints)
    duties = collect("design.duty", table.duty, _duty, free, sources)
    tolerances = collect("design.tolerance", table.tolerance, _tolerance, sources)
    collect("", list(case.flat(table.confirm)), lambda _, key: require_key("design.confirm", key, sources))
    key_names = case.apart([case.naming_key(entry.keys) for entry in free])
    names = case.apart([tolerance.key for tolerance in tolerances])
    fields = {
        "free": tuple(key._replace(name=name) for key, name in zip(free, key_names, strict=True)),
        "objectives": objectives[0] if objectives else (),
        "constraints": tuple(constraints),
        "duties": tuple(duties) or (case.WeightedDuty(1.0, {}, ""),),
        "tolerances": tuple(entry._replace(name=name) for entry, name in zip(tolerances, names, strict=True)),
    }
    return fields, errors


def _free(place: str, table: Any, sources: Sources) -> case.Free:
    keys = (table.key,) if isinstance(table.key, str) else table.key
    if not isinstance(keys, (list, tuple)) or not keys or not all(isinstance(key, str) for key in keys):
        raise InputError(f"{place}.key", quoted(table.key), "not a key", 'write key = "drive.module"')
    for key in keys:
        _varied(f"{place}.key", key, sources)
    (_, schema), key = require_key(f"{place}.key", keys[0], sources)
    low, high = getattr(table, "from"), table.to
    if table.choices is not None:
        if low is not None or high is not None:
            raise InputError(place, None, "has both choices and from or to", "give one of them")
        if len(table.choices) < 2:
            raise InputError(f"{place}.choices", quoted(list(table.choices)), "nothing to choose", "give two")
        for number, value in enumerate(table.choices):
            if value in table.choices[:number]:
                raise InputError(f"{place}.choices.{number}", quoted(value), "is there twice", "remove one")
            _require(f"{place}.choices.{number}", keys, (value,), sources)
        return case.Free(tuple(keys), "", 0.0, len(table.choices) - 1.0, choices=tuple(table.choices))
    for name, value in (("from", low), ("to", high)):
        if value is None:
            raise InputError(f"{place}.{name}", None, "missing", f'add {name} = "…" with its unit')
    kind = kind_at(schema, key)
    kind = kind if isinstance(kind, Kind) else None
    first, last = _number(f"{place}.from", low, kind), _number(f"{place}.to", high, kind)
    if first.units != last.units:
        rule = f"not of the same kind as {quoted(low)}"
        raise InputError(f"{place}.to", quoted(high), rule, "use one unit")
    if first.value >= last.value:
        is_more = first.value > last.value
        rule = "the bounds are reversed" if is_more else "the bounds are equal: nothing is free"
        raise InputError(place, f"{quoted(low)} … {quoted(high)}", rule, "let from be less than to")
    _require(f"{place}.to", keys, (high, low), sources)
    whole = is_whole(schema, key)
    if whole and not all(isinstance(value, int) for value in (low, high)):
        raise InputError(place, f"{quoted(low)} … {quoted(high)}", "not whole numbers", "write such as 17")
    low, high = first.value / last.si, last.value / last.si
    return case.Free(tuple(keys), "", low, high, last.unit, last.si, last.units, whole)


def _varied(place: str, key: str, sources: Sources) -> None:
    """Raise InputError for a key that cannot be varied."""
    parts = key.split(".")
    if key in ("title", "name", "kind") or "output" in parts[:-1] or not all(parts):
        raise InputError(place, quoted(key), "cannot be free", "name a key that the physics depends on")
    require_key(place, key, sources)


def _require(place: str, keys: Sequence[str], values: Sequence[Any], sources: Sources) -> None:
    """Raise InputError where a key takes none of the values."""
    for key in keys:
        source, rest = require_key(place, key, sources)
        errors = [refused(place, rest, value, source) for value in values]
        if all(errors) and (first := errors[0]):
            raise first


class _Number(NamedTuple):
    """A number as it is written."""

    value: float  # SI
    unit: str = ""  # as it is written
    units: str = "1"  # SI unit
    si: float = 1.0  # factor from the one unit to the other


def _number(place: str, value: Any, kind: Kind | None) -> _Number:
    if kind is not None:
        number, unit = to_si_at(place, value, kind), case.unit_of(value) or ""
        amount = _Number(number, unit, kind.si.replace("**", ""), factor_to_si(unit, kind) if unit else 1.0)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        amount = _Number(float(value))
    elif (base := base_units(value)) is not None:
        unit = case.unit_of(str(value)) or ""
        single = base_units(f"1 {unit}")
        amount = _Number(base[0], unit, base[1], single[0] if single else 1.0)
    else:
        raise InputError(place, quoted(value), "neither a number nor a quantity", 'write 0.3 or "3 mm"')
    if not isfinite(amount.value):
        raise InputError(place, quoted(value), "not a finite number", 'write such as 0.3 or "3 mm"')
    return amount


def _twice(free: Sequence[case.Free]) -> list[InputError]:
    seen: set[str] = set()
    errors = []
    for number, entry in enumerate(free):
        for key in entry.keys:
            if same_key(key) in seen:
                place = f"design.free.{number}.key"
                errors.append(InputError(place, quoted(key), "is free twice", "give it once"))
            seen.add(same_key(key))
    return errors


def _objectives(_place: str, table: Any, studies: Mapping[str, Study]) -> tuple[case.Objective, ...]:
    if (table.minimise is None) == (table.maximise is None):
        rule = "missing" if table.minimise is None else "contradicts maximise"
        remedy = (
            'add minimise = "…", the name of a quantity' if table.minimise is None else "give one of them"
        )
        raise InputError("design.minimise", None, rule, remedy)
    if table.maximise is not None:
        name = quantity_name("design.maximise", table.maximise, studies)
        return (case.Objective(f"-{name}", ((name, -1.0),)),)
    wanted = table.minimise
    if not isinstance(wanted, (str, list, tuple)) or wanted in ([], ()):
        remedy = 'write minimise = "peak_to_peak", a list of two, or [{ quantity = "…", weight = 1.0 }, …]'
        raise InputError("design.minimise", quoted(wanted), "not the name of a quantity", remedy)
    if not isinstance(wanted, str) and not all(isinstance(name, str) for name in wanted):
        return (_weighted(wanted, studies),)
    places = {"design.minimise": wanted}
    if not isinstance(wanted, str):
        places = {f"design.minimise.{number}": name for number, name in enumerate(wanted)}
    if len(places) > 2:
        rule = f"{len(places)} objectives; a front has two"
        raise InputError("design.minimise", quoted(list(wanted)), rule, "bound the others: subject_to")
    names = [quantity_name(place, name, studies) for place, name in places.items()]
    if len(set(names)) < len(names):
        raise InputError("design.minimise", quoted(list(wanted)), "the same twice", "name another quantity")
    return tuple(case.Objective(name, ((name, 1.0),)) for name in names)


def _weighted(entries: Sequence[Any], studies: Mapping[str, Study]) -> case.Objective:
    terms = []
    for number, entry in enumerate(entries):
        place = f"design.minimise.{number}"
        if not isinstance(entry, Mapping) or set(entry) - {"quantity", "weight"} or "quantity" not in entry:
            remedy = 'write { quantity = "peak_to_peak", weight = 0.5 }'
            raise InputError(place, quoted(entry), "not a quantity and its weight", remedy)
        weight = entry.get("weight", 1.0)
        number = isinstance(weight, (int, float)) and not isinstance(weight, bool)
        if not number or not isfinite(weight) or not weight:
            raise InputError(f"{place}.weight", quoted(weight), "not a weight", "write a number such as 0.5")
        terms.append((quantity_name(f"{place}.quantity", entry["quantity"], studies), float(weight)))
    return case.Objective(" + ".join(f"{weight:g} {name}" for name, weight in terms), tuple(terms))


def _constraint(place: str, text: str, studies: Mapping[str, Study]) -> case.Constraint:
    match = _CONSTRAINT.match(text)
    if match is None:
        remedy = 'write "contact_ratio >= 1.3" or "hertz_pressure_max <= 1.5 GPa"'
        raise InputError(place, quoted(text), "not QUANTITY <= LIMIT or QUANTITY >= LIMIT", remedy)
    name = quantity_name(place, match[1], studies)
    sign = 1.0 if match[2] in ("<=", "≤", "<") else -1.0
    if match[3] == case.START:
        return case.Constraint(text, name, sign, case.START)
    unit = units_by_name(studies)[name]
    value = toml_value(match[3])
    if isinstance(value, float) and not isfinite(value):
        raise InputError(place, quoted(text), "not a finite limit", "write a number, with its unit if any")
    if unit == "1":
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise InputError(place, quoted(text), f"{name} is a plain number", "write the limit without unit")
        return case.Constraint(text, name, sign, float(value))
    kind = Kind(f"{name} ({unit})", unit, f"1 {unit}")
    try:
        return case.Constraint(text, name, sign, to_si(value, kind))
    except NotAQuantity as error:
        raise InputError(
            place, quoted(text), error.rule, f"write the limit in {unit} or a multiple"
        ) from None


def _contradictions(constraints: Sequence[case.Constraint]) -> list[InputError]:
    numbers = [constraint for constraint in constraints if not isinstance(constraint.limit, str)]
    return [
        InputError(
            "design.subject_to",
            None,
            f"contradict each other: {quoted(lower.text)} and {quoted(upper.text)}",
            "remove one, or move its limit",
        )
        for lower, upper in product(numbers, numbers)
        if lower.quantity == upper.quantity
        and lower.sign < 0 < upper.sign
        and float(lower.limit) > float(upper.limit)
    ]


def _duty(place: str, table: Any, free: Sequence[case.Free], sources: Sources) -> case.WeightedDuty:
    keys = case.flat(table.set)
    for key in keys:
        _require(f"{place}.set", (key,), (keys[key],), sources)
        if any(same_key(key) in map(same_key, other.keys) for other in free):
            raise InputError(f"{place}.set", quoted(key), "is free too", "choose one of them")
    name = ", ".join(f"{key.rpartition('.')[2]} {value}" for key, value in keys.items())
    return case.WeightedDuty(table.weight, keys, name)


def _tolerance(place: str, table: Any, sources: Sources) -> case.Tolerance:
    _varied(f"{place}.key", table.key, sources)
    (_, schema), key = require_key(f"{place}.key", table.key, sources)
    if is_drawn(schema, key):
        if table.plus_minus is not None:
            raise InputError(f"{place}.plus_minus", quoted(table.plus_minus), "counts samples", "omit it")
        return case.Tolerance(table.key, "", 0.0, "", case.DRAWN)
    if table.plus_minus is None:
        raise InputError(f"{place}.plus_minus", None, "missing", 'add plus_minus = "…" with its unit')
    kind = kind_at(schema, key)
    kind = kind._replace(allowed="any") if isinstance(kind, Kind) else None
    is_curve = table.key.endswith((PITCH_ERRORS, PROFILE_ERROR))
    if kind is None and not is_curve:
        _require(f"{place}.key", (table.key,), (table.plus_minus,), sources)
    size, written = _number(f"{place}.plus_minus", table.plus_minus, kind), quoted(table.plus_minus)
    if is_curve and size.units != "m":
        raise InputError(f"{place}.plus_minus", written, "not a length", "write such as 3 um")
    if size.value <= 0:
        raise InputError(f"{place}.plus_minus", written, "not positive", "write such as 1 um")
    return case.Tolerance(table.key, "", size.value / size.si, size.unit, table.distribution)
