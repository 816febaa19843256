"""Field types of the scenario's tables: quantities with units, numbers, columns; what every key means.

The types here speak pydantic; what a unit is stands in `units`. Of numbers as they are printed it is known by
how much the rounding to their last digit may have moved them.
"""

import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple, cast, get_args, get_origin

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field
from pydantic_core import PydanticCustomError, core_schema

from tribodyn.errors import quoted
from tribodyn.input.names import named_in, worded
from tribodyn.input.units import Kind, NotAQuantity, factor_to_si, to_si


def meaning(table: type, key: str) -> str:
    """The meaning of a key of a table, or of a table from which it is made; "" where it is not known."""
    known = meanings()
    return next(
        (known[each.__name__][key] for each in table.__mro__ if key in known.get(each.__name__, {})), ""
    )


@cache
def meanings() -> dict[str, dict[str, str]]:
    """All meanings, by table and key."""
    return tomllib.loads(resources.files(__package__ or "").joinpath("keys.toml").read_text(encoding="utf-8"))


class Table(BaseModel):
    """A TOML table: frozen, no unknown keys, defaults validated by the same rules as what the user writes."""

    # deferred: of all tables only those that a file is validated against are built
    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True, defer_build=True)
    #: further names of fields in a file, see `names`; a table that has some puts its data `under_one_name`
    other_names: ClassVar[Mapping[str, str]] = {}

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: Any) -> dict[str, Any]:
        found = handler(schema)
        keys = handler.resolve_ref_schema(found).get("properties", {})
        for key, schema_of_key in keys.items():
            if text := meaning(cls, key):
                schema_of_key["description"] = text
        for other, name in cls.other_names.items():
            if name in keys:
                keys[other] = {**keys[name], "description": f"{name}, as of a pair of gears"}
        return found


class InUnit:
    """Marks a field as written with a unit: ``Annotated[float, InUnit(LENGTH)]`` reads "3 mm" as 0.003."""

    def __init__(self, kind: Kind, example: str = ""):
        self.kind = kind._replace(example=example) if example else kind

    def __get_pydantic_core_schema__(self, _source: Any, _handler: Any) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, _schema: Any, _handler: Any) -> dict[str, Any]:
        sign = "" if self.kind.allowed == "any" else f", {self.kind.allowed}"
        return {
            "type": "string",
            "description": f"a quantity with a unit of {self.kind.name}{sign}",
            "examples": [self.kind.example],
        }

    def read(self, value: Any) -> float:
        """Convert what stands in TOML to SI."""
        try:
            return to_si(value, self.kind)
        except NotAQuantity as error:
            raise broken(error.rule, error.remedy) from None


RecordReader = Callable[[Path, str], dict[str, Any]]
"""Takes columns, as a scenario writes them out, from a record; the text is the key, for messages."""


#: In the table of a model: the name of a file that says everything which the table does not.
LIKE = "like"


class Reference:
    """Marks a field that may name a file instead of being written out; the loader puts the content in."""

    def __init__(
        self,
        what: str,
        folder: str = "",
        columns: tuple[str, ...] = (),
        as_list: bool = False,
        record: RecordReader | None = None,
        as_tables: tuple[str, ...] = (),
        reader: RecordReader | None = None,
    ) -> None:
        self.what = what  # what the name stands for
        self.folder = folder  # of `models/`, whose files may be named; empty for CSV files
        self.columns = columns  # that a CSV file must have
        self.as_list = as_list  # whether the one column of a CSV file stands for a list of quantities
        #: columns, for example, of a CSV file each row of which is a table of a list; (): of another kind
        self.as_tables = as_tables
        self.reader = reader  # reads files of another format whole
        self.record = record  # reads the columns of files that end in .h5

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        like = {"type": "string", "description": f"{self.what}: says what this table does not"}
        table = {"type": "object", "properties": {LIKE: like}, "required": [LIKE]}
        several = [{"type": "string", "description": self.what}, handler(schema)]
        return {"anyOf": [*several, table] if self.folder else several}


def model_file(folder: str) -> Reference:
    """A field that may name a file of a folder of `models/`."""
    return Reference(f"name of a file in models/{folder}, or a path", folder)


def scenario_file() -> Reference:
    """A field that may name a scenario: a shipped one, or a file beside this one."""
    return Reference("name of a scenario, or a path", "scenarios")


def csv_tables(what: str, *columns: str) -> Reference:
    """A list of tables that may name a CSV file: a row for each; its columns, for example these, are keys."""
    return Reference(what, as_tables=columns)


def csv_file(*columns: str, as_list: bool = False, record: RecordReader | None = None) -> Reference:
    """A field that may name a CSV file with these columns, or a record that `record` takes them from."""
    counted = ("columns " if len(columns) > 1 else "a column ") + " and ".join(columns)
    what = f"CSV file with {counted}{', or a record' if record else ''}"
    return Reference(what, columns=columns, as_list=as_list, record=record)


class FamilyShape:
    """Marks a field with what the family of teeth named beside it needs: its points may name a file."""


class Draws:
    """Marks a field that numbers samples drawn at random: over many of them quantities have a scatter."""


class Weighed:
    """Marks a field that numbers the tables of a list, each of which has a weight: quantities have a mean."""

    def __init__(self, tables: str, weight: str) -> None:
        self.tables = tables  # key of the list in a scenario
        self.weight = weight  # key in its tables


class Names:
    """Marks a text that must be one of some names, for the schema; that it is one of them is a rule."""

    def __init__(self, names: Iterable[str]) -> None:
        self.known = names  # looked through only when a schema is made

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        return {**handler(schema), "enum": list(self.known)}


def written(default: Any, description: str | None = None) -> Any:
    """Return a field whose default stands as it would be written in TOML and is read like it."""
    if isinstance(default, dict):
        return Field(default_factory=default.copy, description=description)
    return Field(default, description=description)


def broken(rule: str, remedy: str) -> PydanticCustomError:
    """Return the error that a validator raises for a broken rule; the braces of a template are escaped."""
    return PydanticCustomError("rule", "{rule}; {remedy}", {"rule": rule, "remedy": remedy})


Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
"""A plain number without a unit."""
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0)]
Count = Annotated[int, Field(strict=True, gt=0)]
Switch = Annotated[bool, Field(strict=True)]
Text = Annotated[str, Field(strict=True)]


class Column(Table):
    """One column of a table of numbers, with its unit."""

    unit: Text = Field(examples=["s"])
    values: tuple[Number, ...] = Field(min_length=2)

    def in_si(self, kind: Kind) -> NDArray[np.float64]:
        """Return the values in the SI unit of `kind`."""
        return np.array(self.values, dtype=float) * factor_to_si(self.unit, kind)


class Columns(Table):
    """Columns of numbers, of one length; a scenario names a CSV file instead, with names and units on top.

    Fields are annotated with the kind of quantity: ``Annotated[Column, LENGTH]``.
    """

    def in_si(self) -> tuple[Any, ...]:
        """Return all columns in SI units."""
        return tuple(
            getattr(self, name).in_si(field.metadata[0]) for name, field in type(self).model_fields.items()
        )

    def model_post_init(self, _: Any) -> None:
        """Check units and lengths."""
        columns: dict[str, Column] = {name: getattr(self, name) for name in type(self).model_fields}
        for name, field in type(self).model_fields.items():
            try:
                factor_to_si(columns[name].unit, field.metadata[0])
            except NotAQuantity as error:
                rule = f"{name} is in {quoted(columns[name].unit)}: {error.rule}"
                raise broken(rule, error.remedy) from None
        (first, x), *others = columns.items()
        for other, column in others:
            if len(x.values) != len(column.values):
                rule = f"{len(x.values)} values of {first} and {len(column.values)} of {other}"
                raise broken(rule, "write as many of each")


class CurveTable(Columns):
    """Functions given by points: the first field is the abscissa, which must increase."""

    def model_post_init(self, _: Any) -> None:
        """Check units, lengths and order."""
        super().model_post_init(_)
        first = next(iter(type(self).model_fields))
        abscissae = np.array(getattr(self, first).values)
        rising = abscissae[1:] > abscissae[:-1]
        if not rising.all():
            row = int(np.argmin(rising)) + 2
            raise broken(f"{first} does not increase at point {row}", f"sort the points by {first}")


def defaults_written_out(raw: dict[str, Any], table: type[Table]) -> dict[str, Any]:
    """Return the TOML data `raw` with every default of the schema written where a key is missing.

    Keys that the schema does not know stay as they are, for the validation to name; so does a table that is
    like a model, or that a key (of the schema's `COMPLETED_BY`) completes: these come before the defaults.
    """
    if LIKE in raw:
        return raw
    full = dict(raw)
    later = [
        name for key, names in getattr(table, "COMPLETED_BY", {}).items() if key in raw for name in names
    ]
    of_pair = bool(table.other_names.keys() & raw.keys())
    for name, field in table.model_fields.items():
        key = named_in(raw, worded(name, of_pair))
        if key in later:
            continue
        if key not in full and not field.is_required():
            default = field.get_default(call_default_factory=True)
            if default is not None:
                full[key] = list(default) if isinstance(default, tuple) else default
        inner = field.annotation
        if isinstance(inner, type) and issubclass(inner, Table) and isinstance(full.get(key), dict):
            full[key] = defaults_written_out(full[key], inner)
        elif (held := _held_by_name(inner)) and isinstance(full.get(key), dict):
            full[key] = {
                name: defaults_written_out(value, held) if isinstance(value, dict) else value
                for name, value in full[key].items()
            }
    return full


def _held_by_name(annotation: Any) -> type[Table] | None:
    """The table that a dictionary of tables holds; None for what is no such dictionary."""
    held = get_args(annotation)[1] if get_origin(annotation) is dict else None
    return held if isinstance(held, type) and issubclass(held, Table) else None


_DIGITS = re.compile(r"\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?)", re.ASCII)
#: Rounding of a profile shift, at most: of two decimals. A number in TOML has lost the zeros at its end, so
#: that fewer decimals do not say how many were printed.
COARSEST_SHIFT = 0.005


class Printed(NamedTuple):
    """A quantity, and half a unit of the last digit that it is written with; both SI."""

    value: float
    rounding: float


class PrintedQuantity(InUnit):
    """Marks a field as written with a unit, whose digits count: "91.50 mm" is 91.5 ± 0.005 mm."""

    def read(self, value: Any) -> Any:
        """Convert what stands in TOML to a `Printed`."""
        magnitude = super().read(value)
        number = cast(re.Match[str], _DIGITS.match(value))[1]  # else it had been refused
        return Printed(magnitude, magnitude / float(number) * half_unit(number))


def half_unit(number: str) -> float:
    """Half a unit of the last digit of a number: 0.005 of "91.50", 0.5 of "584", 50 of "1.2e3"."""
    return float(Decimal(5).scaleb(cast(int, Decimal(number).as_tuple().exponent) - 1))


def shift_rounding(shift: float) -> float:
    """Half a unit of the last decimal of a profile shift, at most `COARSEST_SHIFT`; 0 of a whole number."""
    exact = float(shift).is_integer()
    return 0.0 if exact else min(half_unit(repr(float(shift))), COARSEST_SHIFT)
