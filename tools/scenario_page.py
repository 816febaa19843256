"""The tables of keys in docs/scenario.md, from the schema of scenarios; the text around them is by hand.

::

    python -m tools.scenario_page           # print the page
    python -m tools.scenario_page --write   # into docs/scenario.md

A key's meaning stands in tribodyn/input/keys.toml. What the schema does not know is in scenario_page.toml:
where more is said of a key, where phrases lead to, and examples of keys whose default or unit gives none.
"""

import json
import re
import sys
import tomllib
import typing
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import UnionType
from typing import Any, Literal, NamedTuple, Union, get_args, get_origin

import tomli_w
from pydantic.fields import FieldInfo

from tools.marked_block import DOCS, table
from tribodyn.input.quantity import Column, InUnit, Reference, Table, meaning
from tribodyn.input.units import Kind
from tribodyn.studies import STUDIES

PAGE = DOCS / "scenario.md"
MARKER = re.compile(r"<!-- keys of (\w+) -->\n(?:\|.*\n)+")
HEAD = ("key", "meaning", "value", "default", "example")
PLURAL = {"text": "texts", "number": "numbers", "whole number": "whole numbers", "table": "tables"}


class Beside(NamedTuple):
    """What the schema does not know, by "Table.key": further links, phrase -> address, example."""

    see: dict[str, str]
    links: dict[str, dict[str, str]]
    examples: dict[str, Any]


def beside() -> Beside:
    """Read scenario_page.toml."""
    return Beside(**tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")))


def parts(annotation: Any) -> Iterator[Any]:
    """Everything that stands in an annotation, its own metadata included."""
    yield annotation
    for inner in (*get_args(annotation), *getattr(annotation, "__metadata__", ())):
        yield from parts(inner)


def inside(field: FieldInfo, kind: Any) -> list[Any]:
    """What of a kind stands in a field's annotation and metadata."""
    return [part for part in (*field.metadata, *parts(field.annotation)) if isinstance(part, kind)]


def tables_in(annotation: Any) -> list[type[Table]]:
    """Tables that an annotation names."""
    return [
        part
        for part in parts(annotation)
        if isinstance(part, type) and issubclass(part, Table) and part is not Column
    ]


def tables(top: type[Table]) -> dict[str, type[Table]]:
    """A table and all below it, by name."""
    found = {top.__name__: top}
    of_any_name = top.__annotations__.get("__pydantic_extra__")
    for annotation in (*(field.annotation for field in top.model_fields.values()), of_any_name):
        for part in tables_in(annotation):
            found |= tables(part)
    return found


def every_table() -> dict[str, type[Table]]:
    """Tables of all kinds of study, by name."""
    return {name: each for _, study in STUDIES.items() for name, each in tables(study.table()).items()}


def value_of(field: FieldInfo) -> str:
    """What a key takes: kind of quantity, type of a bare value, a table, a reference."""
    annotation = _without_none(field.annotation)
    if get_origin(annotation) is tuple and tables_in(annotation):
        return "CSV or list of tables" if inside(field, Reference) else "list of tables"
    if annotation is Column:
        return f"column of {inside(field, Kind)[0].name}" if inside(field, Kind) else "column of numbers"
    if any(each.reader for each in inside(field, Reference)):
        return "file or table"
    if inside(field, Reference):
        return "reference" if any(each.folder for each in inside(field, Reference)) else "CSV"
    if get_origin(annotation) is dict:
        units = inside(field, InUnit)
        return f"{units[0].kind.name} by name" if units and not tables_in(annotation) else "table"
    if tables_in(annotation):
        return "table"
    kinds = [quantity.kind.name for quantity in inside(field, InUnit)]
    if kinds:
        return f"list of {kinds[0]}s" if get_origin(annotation) is tuple else kinds[0]
    return _plain(annotation, field.metadata)


def _without_none(annotation: Any) -> Any:
    """The annotation of a key that may be absent, as where it is given."""
    while get_origin(annotation) in (Union, UnionType):
        members = [member for member in get_args(annotation) if member is not type(None)]
        if len(members) != 1:
            break
        annotation = members[0]
    return annotation


def _plain(annotation: Any, metadata: list[Any]) -> str:
    """Type of a bare value, with its range."""
    if get_origin(annotation) is typing.Annotated:
        inner, *more = get_args(annotation)
        return _plain(inner, [*more, *(each for m in more for each in getattr(m, "metadata", ()))])
    if get_origin(annotation) is Literal:
        return "one of " + ", ".join(f"`{_toml(each)}`" for each in get_args(annotation))
    if get_origin(annotation) is tuple:
        inner = _plain(get_args(annotation)[0], [])
        first, *limits = inner.split(" ", 1) if inner not in PLURAL else (inner,)
        return " ".join([f"list of {PLURAL.get(inner, PLURAL.get(first, inner))}", *limits])
    if annotation == str | float:
        return "number or text"
    names = {str: "text", bool: "true or false", int: "whole number", float: "number"}
    if annotation not in names:
        return "see there"
    ends = {
        name: getattr(each, name)
        for each in metadata
        for name in ("gt", "ge", "le", "lt")
        if getattr(each, name, None) is not None
    }
    signs = {"gt": ">", "ge": "≥", "lt": "<", "le": "≤"}
    limits = ", ".join(f"{signs[name]} {end}" for name, end in ends.items())
    return f"{names[annotation]} {limits}".strip()


def _toml(value: Any) -> str:
    """A value as TOML writes it in one line."""
    if isinstance(value, dict) and value:
        return "{ " + ", ".join(f"{_key(name)} = {_toml(each)}" for name, each in value.items()) + " }"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_toml, value))}]"
    return tomli_w.dumps({"v": value}).removeprefix("v = ").strip() if value != {} else "{}"


def _key(name: str) -> str:
    return name if re.fullmatch(r"[\w-]+", name, re.ASCII) else json.dumps(name, ensure_ascii=False)


def default_of(field: FieldInfo) -> str:
    """A key's default as a cell."""
    if field.is_required():
        return "required"
    default = field.get_default(call_default_factory=True)
    return "–" if default is None else f"`{_toml(default)}`"


def listed(known: Mapping[str, Any], table: type[Table], key: str) -> Any:
    """What is listed of a key of a table, or of a table from which it is made; None: nothing."""
    names = (f"{each.__name__}.{key}" for each in table.__mro__)
    return next((known[name] for name in names if name in known), None)


def example_of(table: type[Table], key: str, field: FieldInfo, examples: dict[str, Any]) -> str:
    """An example as a cell: as it is listed, or of the unit, or the first of the values; else the default."""
    if (example := listed(examples, table, key)) is not None:
        return f"`{_toml(example)}`"
    annotation = _without_none(field.annotation)
    if get_origin(annotation) is Literal:
        return f"`{_toml(get_args(annotation)[-1])}`"
    if annotation is bool:
        return f"`{_toml(not field.get_default())}`"
    if not (units := inside(field, InUnit)) or get_origin(annotation) in (tuple, dict):
        raise SystemExit(f"{table.__name__}.{key} needs an example in scenario_page.toml")
    return f"`{_toml(units[0].kind.example)}`"


class Section(NamedTuple):
    """A section of the page."""

    heading: str
    address: str


def sections_in(text: str) -> dict[str, Section]:
    """Name of a table -> the section in which it stands."""
    found, here = {}, Section("", "")
    for line in text.splitlines():
        if line.startswith("#"):
            heading = line.lstrip("# ").replace("`", "").strip("[]")
            words = re.sub(r"[^\w -]", "", heading.lower()).strip()
            here = Section(heading, "#" + words.replace(" ", "-"))
        elif marked := re.match(r"<!-- keys of (\w+) -->", line):
            found[marked[1]] = here
    return found


def meaning_of(
    table: type[Table], key: str, field: FieldInfo, sections: dict[str, Section], known: Beside
) -> str:
    """A key's meaning as a cell: with links, and the section of a table that stands elsewhere."""
    text = (meaning(table, key) or field.description or "").replace("|", "\\|")
    for phrase, address in (listed(known.links, table, key) or {}).items():
        text = text.replace(phrase, f"[{phrase}]({address})", 1)
    if link := listed(known.see, table, key):
        text += f" ({link})"
    here = sections.get(table.__name__)
    places = {sections[each.__name__] for each in tables_in(field.annotation) if each.__name__ in sections}
    further = [place for place in places if place != here and f"({place.address})" not in text]
    if len(further) == 1 and len(places) == 1:
        text += f"; see [{further[0].heading}]({further[0].address})"
    return text


def rows_of(name: str, every: Mapping[str, type[Table]], sections: dict[str, Section], known: Beside) -> str:
    """The table in Markdown of a table's keys."""
    schema = every[name]
    rows = [
        (
            f"`{field.alias or key}`",
            meaning_of(schema, field.alias or key, field, sections, known),
            value_of(field).replace("|", "\\|"),
            default_of(field).replace("|", "\\|"),
            example_of(schema, field.alias or key, field, known.examples).replace("|", "\\|"),
        )
        for key, field in own_keys(schema, every).items()
    ]
    for base in parents(schema, every)[:1]:
        section = sections[base.__name__]
        rows.append(("…", f"and the keys of [{section.heading}]({section.address})", "", "", ""))
    return table(HEAD, rows)


def parents(schema: type[Table], every: Mapping[str, type[Table]]) -> list[type[Table]]:
    """Tables of the page of which this one is made, the nearest first."""
    return [base for base in schema.__mro__[1:] if every.get(base.__name__) is base]


def own_keys(schema: type[Table], every: Mapping[str, type[Table]]) -> dict[str, FieldInfo]:
    """Keys of a table that it does not have from another table of the page."""
    above = {key for base in parents(schema, every) for key in base.model_fields}
    return {
        key: field
        for key, field in schema.model_fields.items()
        if key not in above or key in schema.__annotations__
    }


def page(text: str) -> str:
    """The page with the tables of its markers made anew."""
    every, known, sections = every_table(), beside(), sections_in(text)
    if missing := set(every) - set(sections):
        raise SystemExit(f"{PAGE}: no <!-- keys of {', '.join(sorted(missing))} -->")

    def made(marker: re.Match[str]) -> str:
        return f"<!-- keys of {marker[1]} -->\n{rows_of(marker[1], every, sections, known)}\n"

    return MARKER.sub(made, text)


if __name__ == "__main__":
    made = page(PAGE.read_text(encoding="utf-8"))
    if "--write" in sys.argv:
        PAGE.write_text(made, encoding="utf-8")
    else:
        sys.stdout.write(made)
