"""The text of a C file: structs, tables, functions, in an order in which each knows what it needs."""

import re
from collections.abc import Iterable, Iterator

from tribodyn.kernels.c.body.intrinsics import HELPERS
from tribodyn.kernels.c.data import field_lines, needed_by, table
from tribodyn.kernels.c.lines import folded, names_in
from tribodyn.kernels.c.types import (
    CArray,
    CNumber,
    CPointer,
    CRecord,
    CSeveral,
    CTuple,
    CType,
    declared,
    takes_place,
    tuple_name,
)
from tribodyn.kernels.c.unit import CFunction, Unit, definitions

_FIELD = re.compile(r"(?:\.|->)([A-Za-z_]\w*)")
_CALL = re.compile(r"(?<!\.)(?<!->)\b([A-Za-z_]\w*)\(")
_OPENING = """/* {title} */
#ifndef {guard}
#define {guard}

#include <stdint.h>
"""


def struct_lines(kinds: Iterable[CType]) -> Iterator[str]:
    """Definitions of all structs that some types need, each after those in it."""
    done: set[str] = set()

    def defined(kind: CType) -> Iterator[str]:
        if isinstance(kind, CArray) and not kind.is_pointer and kind.struct not in done:
            done.add(kind.struct)
            yield "typedef struct {"
            yield f"    const {kind.item.name} *data;"
            yield f"    int64_t shape[{len(kind.shape)}];"
            yield f"}} {kind.struct};\n"
        for inner in needed_by(kind):
            yield from defined(inner)
        name = (
            kind.name if isinstance(kind, CRecord) else tuple_name(kind) if isinstance(kind, CTuple) else ""
        )
        if not name or name in done or not takes_place(kind):
            return
        done.add(name)
        if isinstance(kind, CRecord):
            fields = list(kind.stored.items())
            if kind.about:
                yield from comment(kind.about)
        else:
            assert isinstance(kind, CTuple)
            fields = [(f"v{i}", item) for i, item in enumerate(filter(takes_place, kind.items))]
        yield "typedef struct {"
        yield from field_lines(fields)
        yield f"}} {name};\n"

    for kind in kinds:
        yield from defined(kind)


def comment(text: str) -> Iterator[str]:
    """A comment."""
    rows = list(folded(text.replace("*/", "* /").strip(), 0)) if len(text) < 104 else _wrapped(text)
    yield f"/* {rows[0]}" + (" */" if len(rows) == 1 else "")
    for row in rows[1:]:
        yield f" * {row.strip()}" + (" */" if row is rows[-1] else "")


def _wrapped(text: str) -> list[str]:
    rows = [""]
    for word in text.replace("*/", "* /").split():
        if len(rows[-1]) + len(word) > 100:
            rows.append("")
        rows[-1] = f"{rows[-1]} {word}".strip()
    return rows


def signature(function: CFunction) -> str:
    """The first line of a function."""
    result = function.result if function.result is not None and takes_place(function.result) else None
    parameters = ", ".join(_parameter(name, kind) for name, kind in function.parameters) or "void"
    whole = (
        declared(result, f"{function.name}({parameters})")
        if result
        else f"void {function.name}({parameters})"
    )
    return whole if function.exported else f"static inline {whole}"


def _parameter(name: str, kind: CType) -> str:
    return declared(CPointer(kind.record) if isinstance(kind, CSeveral) else kind, name)


def function_lines(function: CFunction) -> Iterator[str]:
    """A function."""
    if function.about:
        yield from comment(function.about)
    yield from folded(signature(function), 0)
    yield "{"
    yield from function.lines
    yield "}\n"


def leave_out_unread(unit: Unit, called: list[CFunction]) -> None:
    """Take arrays out of structs that no function reads, and structs of nothing else."""
    read = {name for function in called for row in function.lines for name in _FIELD.findall(row)}
    for record in unit.structs.records.values():  # those in others come first
        for name, kind in list(record.fields.items()):
            is_read = name in read or isinstance(kind, CNumber)
            if not is_read and (isinstance(kind, CArray) or not takes_place(kind)):
                del record.fields[name]


def written(
    unit: Unit, title: str, called: list[CFunction], data: dict[str, tuple[CType, str]]
) -> tuple[str, str]:
    """Source and header."""
    exported = [function for function in called if function.exported]
    types: list[CType] = [kind for kind, _ in data.values()]
    for function in exported:
        types += [kind for _, kind in function.parameters]
        types += [function.result] if function.result is not None else []
    guard = f"{title.upper()}_H"
    public = list(struct_lines(types))
    names = "\n".join(f"extern const {declared(kind, name)};" for name, (kind, _) in data.items())
    prototypes = "\n\n".join(
        "\n".join([*comment(function.about or function.name), *folded(f"{signature(function)};", 0)])
        for function in exported
    )
    opening = _OPENING.format(title=title, guard=guard)
    header = "\n".join([opening, *public, f"{prototypes}\n", *([f"{names}\n"] if names else []), "#endif\n"])
    inner = [kind for function in called for kind in _types_of(function)]
    inner += list(unit.structs.records.values())
    bodies = "\n".join(row for function in called for row in function_lines(function))
    values = "\n".join(f"const {declared(kind, name)} = {text};\n" for name, (kind, text) in data.items())
    mentioned = names_in(bodies) | names_in(values)
    private = list(struct_lines([*types, *_mentioned(inner, mentioned)]))[len(public) :]
    constants = definitions({name: value for name, value in unit.constants.items() if name in mentioned})
    tables = [
        row
        for name, numbers in unit.tables.arrays.items()
        if name in mentioned
        for row in (*table(name, numbers), "")
    ]
    source = [
        header,
        "#include <math.h>\n",
        *private,
        *constants,
        *_helpers(mentioned),
        *tables,
        values,
        bodies,
    ]
    return "\n".join(source), header


def _types_of(function: CFunction) -> list[CType]:
    kinds = [kind for _, kind in function.parameters]
    return kinds + ([function.result] if function.result is not None else [])


def _mentioned(kinds: Iterable[CType], names: set[str]) -> Iterator[CType]:
    for kind in kinds:
        name = kind.name if isinstance(kind, CRecord) else ""
        if name in names or not isinstance(kind, CRecord):
            yield kind


def reached(unit: Unit) -> list[CFunction]:
    """The exported functions and all that they call, each after what it calls."""
    by_name = {function.name: function for function in unit.functions.values()}
    order: dict[str, CFunction] = {}

    def reach(function: CFunction) -> None:
        if function.name in order:
            return
        for name in sorted(set(_CALL.findall("\n".join(function.lines))) & by_name.keys()):
            if name != function.name:
                reach(by_name[name])
        order[function.name] = function

    for function in unit.functions.values():
        if function.exported:
            reach(function)
    return list(order.values())


def _helpers(mentioned: set[str]) -> list[str]:
    """Those of `HELPERS` that are called."""
    parts = [f"/*{part}" for part in HELPERS.split("/*") if part.strip()]
    needed = set(mentioned)
    left = []
    for part in reversed(parts):
        name = part.partition("(")[0].split()[-1] if "(" in part else ""
        name = part.split("*/")[1].partition("(")[0].split()[-1]
        if name in needed:
            needed |= names_in(part.split("*/")[1])
            left.insert(0, part.rstrip() + "\n")
    return left
