"""One clear line for every mistake: pydantic's findings, gears that are not modelled, where it stands."""

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from copy import copy
from math import isclose
from typing import Any

from pydantic import BaseModel, ValidationError

from tribodyn.errors import InputError, InputErrors, near_name, printable, quoted
from tribodyn.input.names import OF_PAIR, speaks_of_pair, worded
from tribodyn.input.quantity import Reference, meaning
from tribodyn.input.schema import fields_of, holds_by_name, inner_tables, table_at
from tribodyn.input.unit_grammar import range_for_one
from tribodyn.input.units import base_units

INTERNAL, STAGES, HELIX, PLANETS = "internal gears", "several stages", "a helix", "planetary gears"
#: What is asked for -> the keys and names that ask for it, and what to do about it.
_OUTSIDE = {
    "double helical gears": (r"herringbone|double_?heli", "describe one half of it, with helix_angle"),
    HELIX: (
        r"helix|helical|^beta(_|$)",
        'write helix_angle = "20 deg" in [drive] of a gear pair, and hand = "left" of a left-hand pinion',
    ),
    INTERNAL: (
        r"^internal(_(gears?|teeth|mesh))?$|annulus|^ring(_|$)",
        "write internal = true in [drive.gear], and all numbers of teeth and lengths without sign",
    ),
    PLANETS: (
        r"planet|epicyclic|^(sun|carrier)s?(_|$)",
        'write a [[stage]] of type = "planetary" in a scenario of the kind for trains (tribodyn list kinds)',
    ),
    STAGES: (
        r"multi_?stage|^((n|number_of)_)?(stage|shaft|gearbox|gear_?train|train|idler|gears|mesh(es)?|"
        r"((pinion|gear|wheel)_?\d+))(e?s)?(_?\d+)?$",
        "write [gear.NAME] and [[stage]] in a scenario of the kind for trains (tribodyn list kinds), "
        "or describe one stage as [drive.pinion] and [drive.gear]",
    ),
    "bevel, worm and hypoid gears": (r"bevel|worm|hypoid|(cone|shaft|spiral)_angle", "omit it"),
}
#: What to do about a helix in a scenario that has several stages.
_STAGED_HELIX = 'write helix_angle = "20 deg" in its [[stage]], and hand = "left" in a left-hand [gear.NAME]'


def outside(error: InputError, *names: str, remedy: str = "", but: tuple[str, ...] = ()) -> InputError | None:
    """What to say in place of an unknown key or name that asks for other gears; None where it does not.

    `names` are the key's last part, or the name, and others that may ask for them; `but` is what the scenario
    may ask for.
    """
    plain = [re.sub(r"[\s-]+", "_", name.strip().lower()) for name in names]
    for what, (pattern, _) in _OUTSIDE.items():
        if what not in but and any(re.search(pattern, name) for name in plain):
            helix = _STAGED_HELIX if STAGES in but else _OUTSIDE[HELIX][1]
            return refusal(error, what, helix if what == HELIX else remedy)
    return None


#: What to say of gears that are modelled, but not there or not by that name; of others that they are not.
_RULES = {
    STAGES: f"{STAGES} are of another kind of study",
    HELIX: "the key of a helix is helix_angle, of both gears together",
    INTERNAL: "the key of an internal gear is internal, of the gear that it is",
    PLANETS: f"{PLANETS} are a stage of a train",
}


def refusal(error: InputError, what: str, remedy: str = "") -> InputError:
    """What to say, in place of an error, of a value that asks for gears which its kind of study has not."""
    rule = _RULES.get(what, f"{what} are not modelled: this version computes spur and helical gears")
    if what in (STAGES, INTERNAL, PLANETS) or not (remedy or what == HELIX):
        remedy = _OUTSIDE[what][1]
    parts = error.key.split(".")
    if what == INTERNAL and len(parts) > 2 and parts[-3] == "gear":  # of a train
        remedy = remedy.replace("[drive.gear]", f"[{'.'.join(parts[:-1])}]")
    return InputError(error.key, error.value, rule, remedy, error.file)


def names_gears(name: str, value: Any) -> bool:
    """Whether an unknown key is a table of a train: [gear.NAME], [[body]], [[link]] or [[clutch]]."""
    if name == "gear":
        return isinstance(value, dict) and bool(value) and all(isinstance(v, dict) for v in value.values())
    return name in ("body", "link", "clutch") and isinstance(value, list)


Key = tuple[str | int, ...]
#: What is wrong with a key that a table does not know; its remedy has the name that was nearly written.
_UNKNOWN = "unknown key"
#: By how much rounding changes a value that is shown with three digits.
_ROUNDED = 5e-3


class Origins:
    """Which file each part of a scenario came from: the longest known prefix of its key decides."""

    def __init__(self, file: str):  # the scenario's own
        self._files: dict[Key, str] = {(): file}
        self._data: Mapping[str, Any] = {}

    def over(self, data: Mapping[str, Any]) -> "Origins":
        """The same, with the data whose values messages show as they are written there."""
        origins = copy(self)
        origins._data = data
        return origins

    def put(self, key: Key, file: str) -> None:
        """Remember that what stands at and below `key` came from `file`, whatever was known before."""
        for other in [other for other in self._files if other[: len(key)] == key]:
            del self._files[other]
        self._files[key] = file

    def of(self, key: Key) -> str:
        """Return the file that `key` came from."""
        return next(self._files[key[:n]] for n in range(len(key), -1, -1) if key[:n] in self._files)

    @property
    def files(self) -> set[str]:
        """All files that parts of the scenario came from."""
        return set(self._files.values())

    def locate(self, error: InputError) -> InputError:
        """Return the error with its file and its value in the unit that was typed, if it had no file."""
        if isinstance(error, InputErrors):
            return InputErrors([self.locate(mistake) for mistake in error.errors])
        if error.file:
            return error
        if self._data and error.rule != _UNKNOWN:
            names = speaks_of_pair(self._scenario_of(error.key))
            texts = (worded(text, names) for text in (error.key, error.rule, error.remedy))
            error = InputError(next(texts), error.value, *texts)
        key = tuple(int(part) if part.isdecimal() else part for part in error.key.split("."))
        typed = value_at(self._data, key)
        rule, value = _ranges_as_typed(error.rule, typed), _as_typed(error.value, typed)
        remedy = error.remedy + self._which_table(key)  # parts of a key may have dots
        above = [one for one in self._files if f"{error.key}.".startswith(".".join((*map(str, one), "")))]
        of = self._files[max(above, key=len)]
        return InputError(error.key, _ranges_as_typed(value, typed), rule, remedy, of)

    def _scenario_of(self, key: str) -> Mapping[str, Any]:
        """The scenario that a key is of: within one of a search this one."""
        inner = self._data.get(key.partition(".")[0])
        return inner if isinstance(inner, Mapping) and "operating" in inner else self._data

    def _which_table(self, key: Key) -> str:
        """Which table of a list, counted from one, a key stands in: keys count from zero."""
        for depth, part in enumerate(key[:-1]):
            if isinstance(part, int) and isinstance(value_at(self._data, key[:depth]), list):
                list_name = ".".join(map(str, key[:depth]))
                return f" ({list_name}.{part} is {_ordinal(part + 1)} [[{list_name}]])"
        return ""

    @contextmanager
    def naming(self) -> Iterator[None]:
        """Put the file into the errors that the physics raises inside the block."""
        try:
            yield
        except InputError as error:
            # a key without a point, such as "output", is an option of the command and not a key of a file
            if error.file or "." not in error.key:
                raise
            raise self.locate(error) from None


def _as_typed(shown: object, typed: object) -> object:
    """What a message shows of a quantity; as it was typed, where it is the same in another unit."""
    if not (isinstance(shown, str) and isinstance(typed, str)) or shown.split()[1:] == typed.split()[1:]:
        return shown
    ours, theirs = base_units(shown), base_units(typed)
    if ours is None or theirs is None or ours[1] != theirs[1]:
        return shown
    return quoted(typed)[1:-1] if isclose(ours[0], theirs[0], rel_tol=_ROUNDED) else shown


_NUMBER = r"[+-]?\d[\d.]*(?:e[+-]?\d+)?"
_RADIANS = re.compile(rf"({_NUMBER}) (…|to) ({_NUMBER}) rad\b")


def _ranges_as_typed(text: Any, typed: object) -> Any:
    """A text whose ranges of an angle are in the unit of the table that was typed, where it has another."""
    columns = typed.values() if isinstance(typed, Mapping) else ()
    units = [str(column["unit"]) for column in columns if isinstance(column, Mapping) and "unit" in column]
    angular = [(unit, base) for unit in units if (base := base_units(f"1 {unit}")) and base[1] == "rad"]
    if not angular or not isinstance(text, str):
        return text
    (unit, (factor, _)), *_ = angular

    def converted(match: re.Match[str]) -> str:
        first, last = (f"{float(match[place]) / factor:.6g}" for place in (1, 3))
        return f"{first} {match[2]} {last} {unit}"

    return _RADIANS.sub(converted, text)


def _ordinal(number: int) -> str:
    words = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")
    return f"the {words[number - 1]}" if number <= len(words) else f"number {number}"


def value_at(data: Any, key: Iterable[str | int]) -> Any:
    """Return what stands at `key`, or None."""
    for part in key:
        if isinstance(data, list) and isinstance(part, int):
            data = data[part] if part < len(data) else None
        else:
            data = data.get(part) if isinstance(data, dict) else None
    return data


def explain(error: ValidationError, model: type[BaseModel]) -> list[InputError]:
    """Return what pydantic found as our errors, in the order of the file.

    Of a file that describes gears which its kind of study has not only that is said, once.
    """
    problems = [one for one in map(dict, error.errors(include_url=False)) if not _said_elsewhere(one)]
    errors = [_explain_one(one, model) for one in problems]
    several = "stage" in model.model_fields
    refused = (_outside(one, error, several) for one, error in zip(problems, errors, strict=True))
    first = next(filter(None, refused), None)
    return errors if first is None else [first]


def _said_elsewhere(detail: dict[str, Any]) -> bool:
    """Of a text that is no Unicode its bounds are complained of; a list is short for values refused in it."""
    short = detail["type"] == "too_short" and len(detail["input"]) >= detail["ctx"]["min_length"]
    return short or detail["type"] == "string_unicode"


def _outside(detail: dict[str, Any], error: InputError, several: bool) -> InputError | None:
    """What to say of a key that describes gears which the kind of study has not; None where it does not.

    `several` says whether the scenario may have several stages.
    """
    name, value = str(detail["loc"][-1]), detail["input"]
    if detail["type"] == "extra_forbidden":
        named = value if isinstance(value, str) and len(value.split()) < 3 else ""  # type = "planetary"
        if not several and names_gears(name, value):
            return refusal(error, STAGES)
        stage = (PLANETS,) if detail["loc"][0] == "stage" else ()
        return outside(error, name, named, but=(STAGES, *stage) if several else ())
    fewest = detail.get("ctx", {}).get("ge")
    # a number of teeth that only the sign of internal gears excludes
    if name == "teeth" and fewest is not None and value <= -fewest:
        return refusal(error, INTERNAL)
    return None


def _explain_one(detail: dict[str, Any], model: type[BaseModel]) -> InputError:
    # pydantic names the branch of a union that it took; ours stand in parentheses
    key: Key = tuple(part for part in detail["loc"] if not str(part).startswith("("))
    dotted = printable(".".join(map(str, key)))
    context = detail.get("ctx", {})
    text = quoted(detail["input"])
    match detail["type"]:
        case "rule":
            absent = detail["input"] is None
            return InputError(dotted, None if absent else text, context["rule"], context["remedy"])
        case "missing":
            return InputError(dotted, None, "missing", _how_to_write(model, detail["loc"]))
        case "extra_forbidden" if key[-1] in OF_PAIR and key[-1] in fields_of(table_at(model, key[:-1])):
            rule = f"is {OF_PAIR[str(key[-1])]} by another name, and both are given"
            return InputError(dotted, text, rule, "leave one of them out")
        case "extra_forbidden":
            return InputError(dotted, text, _UNKNOWN, _near_key(model, detail["loc"]))
        case "literal_error":
            expected = context["expected"].replace("'", '"')
            choices = expected.replace('"', "").replace(" or ", ", ").split(", ")
            near = near_name(str(detail["input"]), choices)
            mean = f'did you mean "{near}"? ' if near else ""
            return InputError(dotted, text, "not one of the choices", f"{mean}write {expected}")
        case "model_type" if key[-1] in fields_of(table_at(model, key)):  # held by name, written without one
            of, pair = dotted.rpartition(".")[0], key[0] == "bearings" and "stage" not in model.model_fields
            where = f"[{of}.pinion] and [{of}.gear]" if pair else f"[{of}.NAME]"
            return InputError(dotted, text, f"outside of a table of {of} by name", f"write it in {where}")
        case "float_type" | "int_type" if isinstance(detail["input"], str) and range_for_one(detail["input"]):
            return InputError(dotted, text, *(range_for_one(detail["input"]) or ()))
        case "string_pattern_mismatch":
            more = "digits, space, - _ and ." if " " in context["pattern"] else "digits, - and _"
            return InputError(dotted, text, "a character that is not allowed here", f"use letters, {more}")
        case "finite_number":
            return InputError(dotted, text, "not a finite number", "write a plain number, such as 1.0")
    rule, remedy = _PLAIN.get(detail["type"].replace("dict_", "model_"), (detail["msg"].lower(), ""))
    return InputError(dotted, text, rule.format(**context), remedy.format(**context))


_PLAIN = {
    "float_type": ("not a plain number", "write a number without quotes and unit, such as 1.0"),
    "int_type": ("not a whole number", "write a whole number without quotes and point, such as 20"),
    "int_from_float": ("not a whole number", "write a whole number, such as 20"),
    "bool_type": ("not true or false", "write true or false, without quotes"),
    "string_type": ("not text", "write text in quotes"),
    "model_type": ("not a table", "write a table, or see the keys with: tribodyn schema"),
    "tuple_type": ("not a list", "write a list: [ … ]"),
    "too_long": ("more than {max_length} values", "write fewer"),
    "too_short": ("fewer than {min_length} values", "write at least {min_length}"),
    "greater_than": ("must be greater than {gt:g}", "write a larger number"),
    "greater_than_equal": ("must be at least {ge:g}", "write {ge:g} or more"),
    "less_than": ("must be less than {lt:g}", "write a smaller number"),
    "less_than_equal": ("must be at most {le:g}", "write {le:g} or less"),
}


def keys_in(model: type[BaseModel], key: Iterable[str]) -> list[str]:
    """Return the keys of the table that `key` leads to, dotted and whole; those of tables end in a dot."""
    above = tuple(key)
    table = None if above and holds_by_name(model, above) else table_at(model, above)
    fields = fields_of(table)
    return [
        ".".join((*above, name)) + ("." if any(inner_tables(field.annotation)) else "")
        for name, field in fields.items()
    ]


def _near_key(model: type[BaseModel], key: Key) -> str:
    table = table_at(model, key[:-1])
    descriptions = {name: meaning(table, name) if table else "" for name in fields_of(table)}
    # a symbol as on a drawing, with which a description begins: "A_sne, upper deviation …"
    of_symbol = (name for name, text in descriptions.items() if text.startswith(f"{key[-1]},"))
    near = next(of_symbol, None) or near_name(str(key[-1]), descriptions)
    return f'did you mean "{near}"?' if near else f"known keys: {', '.join(descriptions)}"


def _how_to_write(model: type[BaseModel], key: Key) -> str:
    """Return how to write the missing `key`, from its example in the schema."""
    table = table_at(model, key[:-1])
    field = table.model_fields.get(str(key[-1])) if table else None
    if table is None or field is None:
        return "write it"
    named = any(isinstance(mark, Reference) for mark in field.metadata)
    if any(inner_tables(field.annotation)) and not named:
        named_parts = (str(part) for part in key if not str(part).startswith("("))
        return f"add the table [{'.'.join(named_parts)}]"
    shape = table.model_json_schema()["properties"][str(key[-1])]
    if named:
        return f"give the {shape['anyOf'][0]['description']}"
    example, choices = shape.get("examples", [None])[0], ", ".join(map(quoted, shape.get("enum", ())))
    wanted = {"integer": "a whole number", "number": "a number", "string": "text", "array": "a list"}
    text = f"one of {choices}" if choices else wanted.get(shape.get("type", ""), "…")
    return f"add {key[-1]} = {quoted(example) if example else text}"
