"""What `--vary` says: a key of the scenario and its values, as a range or a list.

``start:stop:step`` goes from start to stop in steps, ``start:stop/count`` divides the way evenly, and
``value,value,…`` lists. A unit stands once, at the end, and holds for every number before it.
"""

import math
import re
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any, NamedTuple

from pydantic import BaseModel

from tribodyn.errors import InputError, quoted
from tribodyn.input.bounds import LONGEST_KEY, broken_bounds
from tribodyn.input.names import named_in, same_key
from tribodyn.input.quantity import Draws, InUnit, Reference, Weighed
from tribodyn.input.resolve import toml_value
from tribodyn.input.schema import fields_of, parts_of, table_at
from tribodyn.input.unit_grammar import two_ends
from tribodyn.input.units import FREQUENCY, Kind, NotAQuantity, base_units, to_si

VARY = "--vary"
#: Values of one axis; beyond, a range was surely mistyped, and the values alone would fill the memory.
MOST_VALUES = 100_000
#: Varied keys: a dataset's dimensions are limited, and their values multiply.
MOST_AXES = 12
#: Value of an axis that picks tables: none of them.
NO_TABLE = "none"
GRAMMAR = "write start:stop:step, start:stop/count or value,value,… with the unit once, at the end"

# of bounded length, because ranges are worked out in whole decimals
_NUMBER = r"[+-]?(?:\d{1,40}\.?\d{0,40}|\.\d{1,40})(?:[eE][+-]?\d{1,2})?"
_COUNT = r"\d{1,9}"
#: Characters of a range; what is longer is a list.
_LONGEST_RANGE = 250
_STEPS = re.compile(rf"\s*({_NUMBER})\s*:\s*({_NUMBER})\s*:\s*({_NUMBER})\s*([^\d\s:.].*|1\s*/.*)?", re.ASCII)
_COUNTS = (
    re.compile(rf"\s*({_NUMBER})\s*:\s*({_NUMBER})\s*/\s*({_COUNT})\s*([^\d\s:./].*)?", re.ASCII),
    re.compile(rf"\s*({_NUMBER})\s*:\s*({_NUMBER})\s*([^\d\s:./].*?)\s*/\s*({_COUNT})\s*()", re.ASCII),
)
_BARE = re.compile(rf"\s*{_NUMBER}\s*", re.ASCII)


class Axis(NamedTuple):
    """One varied parameter."""

    key: str  # its dotted key in the scenario
    #: the last part of the key, or as much of it as distinguishes the axes; names the record's dimension
    name: str
    written: tuple[Any, ...]  # the values as TOML would hold them
    values: tuple[float, ...] | tuple[str, ...]  # the values in SI, or the texts where they are no numbers
    units: str  # SI unit, "1" for plain numbers, "" for texts
    drawn: bool = False  # whether the values number samples drawn at random
    weighed: Weighed | None = None  # where the weights stand of tables that the values number
    picks: bool = False  # whether the values are numbers of tables in a list, of which a case has one or none

    @property
    def numeric(self) -> bool:
        """Whether the values are numbers."""
        return bool(self.units)


def axes_of(options: list[str], table: type[BaseModel]) -> list[Axis]:
    """Read all `--vary` options of a command; `table` is the schema of the scenario.

    Raises InputError if there is none, a key comes twice, or an option cannot be read; a key that the schema
    does not know is left to the reading of the scenario, which suggests another.
    """
    if not options:
        remedy = f"add {VARY} operating.pinion_speed=100:6000:200rpm"
        raise InputError(VARY, None, "nothing is varied", remedy)
    if len(options) > MOST_AXES:
        raise InputError(VARY, len(options), "too many keys at once", f"vary at most {MOST_AXES}")
    axes: list[Axis] = []
    for option in options:
        axis = _axis(option, table)
        if any(same_key(axis.key) == same_key(other.key) for other in axes):
            raise _refusal(option, f"{axis.key} is varied twice", "list all its values at once")
        axes.append(axis)
    return _named_apart(axes)


def _axis(option: str, table: type[BaseModel]) -> Axis:
    key, equals, text = option.partition("=")
    key, text = key.strip(), text.strip()
    if not equals or not text or len(key) > LONGEST_KEY or not all(key.split(".")):
        raise _refusal(option, "not KEY=VALUES", GRAMMAR)
    leaf = kind_at(table, key)
    if key in ("title", "name", "kind") or key.startswith("output."):
        raise _refusal(option, f"{key} cannot be varied", "vary what the physics depends on")
    if _is_table(leaf) and _is_list(table, key):
        values = tuple(value.strip() for value in text.split(","))
        if len(set(values)) < len(values):
            raise _refusal(option, "a value comes twice", "list every value once")
        return Axis(key, key, values, values, "", picks=True)
    if _is_table(leaf):
        first = next(iter(leaf.model_fields))
        raise _refusal(option, f"{key} is a table", f"vary a key in it, such as {key}.{first}")
    texts = _values(option, text, leaf)
    written = tuple(value if isinstance(leaf, Kind) else toml_value(value) for value in texts)
    for error in broken_bounds(list(written)):
        raise _refusal(option, error.rule, error.remedy)
    values, units = _in_si(option, key, written, leaf)
    if len(set(values)) < len(values):
        raise _refusal(option, "a value comes twice", "list every value once")
    weighed = next((mark for mark in _marks(table, key) if isinstance(mark, Weighed)), None)
    return Axis(key, key.rpartition(".")[2], written, values, units, is_drawn(table, key), weighed)


def _values(option: str, text: str, leaf: Any) -> list[str]:
    """Split into values, each with the unit."""
    if match := len(text) <= _LONGEST_RANGE and _STEPS.fullmatch(text):
        start, stop, step, unit = match.groups()
        return _with_unit(_by_step(option, *map(Decimal, (start, stop, step))), unit)
    for pattern, order in zip(_COUNTS, ((1, 2, 3, 4), (1, 2, 4, 3)), strict=True):
        if match := len(text) <= _LONGEST_RANGE and pattern.fullmatch(text):
            start, stop, count, unit = (match[i] for i in order)
            return _with_unit(_by_count(option, Fraction(start), Fraction(stop), int(count)), unit)
    if (ends := two_ends(text)) and not isinstance(leaf, Reference):
        first, last, unit = ends
        remedy = f"write {first}:{last}/20{unit} for 20 values, or start:stop:step"
        raise _refusal(option, "a range without a number of values or a step", remedy)
    if re.match(rf"\s*{_NUMBER}[^,]*:", text) and not isinstance(leaf, Reference):
        raise _refusal(option, "neither a range nor a list", GRAMMAR)
    values = [value.strip() for value in text.split(",")]
    if not all(values):
        raise _refusal(option, "an empty value", "leave out the comma that has nothing beside it")
    unit = re.sub(rf"^\s*{_NUMBER}\s*", "", values[-1], flags=re.ASCII) if isinstance(leaf, Kind) else ""
    return [f"{value} {unit}" if unit and _BARE.fullmatch(value) else value for value in values]


def _with_unit(numbers: list[str], unit: str | None) -> list[str]:
    return [f"{number} {unit.strip()}" for number in numbers] if unit else numbers


def _by_step(option: str, start: Decimal, stop: Decimal, step: Decimal) -> list[str]:
    """Decimal arithmetic: 0.1:0.3:0.1 are the numbers 0.1, 0.2 and 0.3 to the last digit."""
    if step == 0:
        raise _refusal(option, "the step is zero", "write a step, or a list of values")
    if (stop - start) * step < 0:
        remedy = f"write {start}:{stop}:{-step} or swap the ends"
        raise _refusal(option, f"the step {step} leads away from {stop}", remedy)
    count = int((stop - start) / step) + 1
    _not_too_many(option, count)
    return [f"{(start + i * step).normalize():f}" for i in range(count)]


def _by_count(option: str, start: Fraction, stop: Fraction, count: int) -> list[str]:
    if count < 2 or start == stop:
        raise _refusal(option, "an empty range", "write two different ends and a count of at least 2")
    _not_too_many(option, count)
    numbers = [start + (stop - start) * i / (count - 1) for i in range(count)]
    return [str(n.numerator) if n.denominator == 1 else repr(float(n)) for n in numbers]


def _not_too_many(option: str, count: int) -> None:
    if count > MOST_VALUES:
        remedy = f"at most {MOST_VALUES} of one key; choose a larger step"
        raise _refusal(option, f"{count:.3g} values", remedy)


def _in_si(
    option: str, key: str, written: tuple[Any, ...], leaf: Any
) -> tuple[tuple[float, ...] | tuple[str, ...], str]:
    if isinstance(leaf, Kind):
        try:
            values = tuple(to_si(value, leaf) for value in written)
        except NotAQuantity as error:
            raise InputError(key, quoted(option.partition("=")[2]), error.rule, error.remedy, VARY) from None
        if leaf.name == FREQUENCY:  # of an axis in hertz, not in the radians of the equations
            return tuple(float(f"{value / math.tau:.12g}") for value in values), "Hz"
        return values, leaf.si.replace("**", "")
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in written):
        return tuple(float(value) for value in written), "1"
    if any(isinstance(value, (dict, list)) for value in written):
        raise _refusal(option, "tables and lists cannot be varied", "vary one number in them")
    quantities = [base for base in map(base_units, written) if base]
    if len(quantities) == len(written) and len({unit for _, unit in quantities}) == 1:  # of a family's shape
        return tuple(magnitude for magnitude, _ in quantities), quantities[0][1]
    return tuple(str(value).lower() if isinstance(value, bool) else str(value) for value in written), ""


def in_si(value: float, units: str) -> float | str:
    """A value of an axis as TOML holds it, from its SI magnitude and the axis's units."""
    return value if units == "1" else f"{value!r} {re.sub(r'(?<=[A-Za-z])(?=[0-9])', '**', units)}"


def is_drawn(table: type[BaseModel], key: str) -> bool:
    """Whether the field at a key is marked as numbering samples."""
    return any(isinstance(mark, Draws) for mark in _marks(table, key))


def is_whole(table: type[BaseModel], key: str) -> bool:
    """Whether a whole number is due at a key."""
    return int in _marks(table, key)


def kind_at(table: type[BaseModel], key: str) -> Any:
    """What stands at a key: a `Kind` of quantity, a `Reference` or a table; None for anything else."""
    marks = _marks(table, key)
    inside_list = key.rpartition(".")[2].isdecimal()
    references = [mark for mark in marks if isinstance(mark, Reference) and not inside_list]
    kinds = [mark.kind for mark in marks if isinstance(mark, InUnit)]
    return next(iter(references or kinds or filter(_is_table, marks)), None)


def given_at(data: Any, key: str) -> Any:
    """What a scenario's data have at a dotted key; None where nothing stands there."""
    for part in key.split("."):
        if isinstance(data, Mapping):
            data = data.get(named_in(data, part))
        elif isinstance(data, (list, tuple)) and part.isdecimal() and int(part) < len(data):
            data = data[int(part)]
        else:
            return None
    return data


def _marks(table: type[BaseModel], key: str) -> list[Any]:
    """Everything that stands in the annotation of the field at a key, or of the list whose place it is."""
    parts = [int(part) if part.isdecimal() else part for part in key.split(".")]
    named = [place for place, part in enumerate(parts) if isinstance(part, str)]
    if not named:
        return []
    holder = table_at(table, parts[: named[-1]], parts[named[-1]])
    field = fields_of(holder).get(str(parts[named[-1]]))
    return list(parts_of(field)) if field else []


def _is_list(table: type[BaseModel], key: str) -> bool:
    """Whether a list of tables stands at a key of the scenario."""
    field = table.model_fields.get(key)
    return field is not None and "tuple[" in str(field.annotation)


def _is_table(mark: Any) -> bool:
    return isinstance(mark, type) and issubclass(mark, BaseModel)


def _named_apart(axes: list[Axis]) -> list[Axis]:
    """Lengthen names that two axes share: pinion_profile_shift and gear_profile_shift."""
    names = [axis.name for axis in axes]
    named = []
    for axis in axes:
        parts = axis.key.split(".")
        reserved = names.count(axis.name) > 1 or axis.name in RESERVED or axis.name.isdecimal()
        named.append(axis._replace(name="_".join(parts[-2:] if reserved else parts[-1:])))
    if len({axis.name for axis in named}) < len(named):
        named = [axis._replace(name=axis.key.replace(".", "_")) for axis in axes]
    return named


#: Names of the record's own dimensions, which no axis may take.
RESERVED = ("direction", "sample", "cycle", "mode", "state_variable", "status", "message", "state")


def _refusal(option: str, rule: str, remedy: str) -> InputError:
    return InputError(VARY, quoted(option), rule, remedy)
