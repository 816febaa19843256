"""Files of REXS: XML (.rexs), JSON (.rexsj), or either in a ZIP (.rexsz); told apart by what they hold."""

import io
import json
import math
import re
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from tribodyn.errors import InputError, harmless, printable, quoted
from tribodyn.exchange.rexs.file.model import (
    FIRST,
    LAST,
    Attribute,
    Component,
    LoadCase,
    RelatedPart,
    Relation,
    RexsModel,
    Value,
)
from tribodyn.exchange.rexs.file.xml_file import decoded, read_xml
from tribodyn.exchange.xml_tree import MOST_BYTES, TOO_LARGE, bounded_content

#: Files in a ZIP.
MOST_PACKED = 1000
_VERSION = re.compile(r"(\d{1,3})\.(\d{1,3})(\.\d{1,3})*")


def read_model(path: Path) -> RexsModel:
    """The gearbox in a file; InputError where it is broken, hostile, of another schema, or no whole."""
    file = str(path)
    content = bounded_content(path)
    if content[:2] == b"PK":
        content = _unpacked(content, file)
    start = content.lstrip(b"\xef\xbb\xbf\xff\xfe\0 \t\r\n")[:1]
    if start == b"<":
        data = read_xml(content, file)
    elif start == b"{":
        data = _json(content, file)
    else:
        raise InputError("file", None, "neither XML nor JSON nor ZIP", "name a file of REXS", file)
    return _model(data, file)


def _unpacked(content: bytes, file: str) -> bytes:
    """The one model in a ZIP, read in memory: nothing is unpacked onto the disk."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            packed = archive.infolist()
            if len(packed) > MOST_PACKED:
                rule = f"a ZIP of {len(packed)} files, above {MOST_PACKED}"
                raise InputError("file", None, rule, "pack the model alone", file)
            for each in packed:
                _refuse_path(each.filename, file)
            models = [each for each in packed if each.filename.lower().endswith((".rexs", ".rexsj"))]
            if len(models) != 1:
                there = ", ".join(quoted(each.filename) for each in models or packed[:3]) or "nothing"
                rule = f"a ZIP with {'several models' if models else 'no model'}: {there}"
                raise InputError("file", None, rule, "pack one .rexs or .rexsj", file)
            if models[0].flag_bits & 1:
                raise InputError(models[0].filename, None, "is encrypted", "pack it without a password", file)
            with archive.open(models[0]) as stream:
                found = stream.read(MOST_BYTES + 1)
    except (zipfile.BadZipFile, zlib.error, OSError, EOFError, ValueError, NotImplementedError) as error:
        why = printable(" ".join(str(error).split()))[:200] or type(error).__name__
        raise InputError("file", None, f"a broken ZIP: {why}", "pack it again", file) from None
    if len(found) > MOST_BYTES:
        raise InputError(models[0].filename, None, f"unpacked {TOO_LARGE}", "leave results out of it", file)
    return found


def _refuse_path(name: str, file: str) -> None:
    windows = PureWindowsPath(name)
    if ".." in windows.parts or windows.drive or windows.root or PurePosixPath(name).is_absolute():
        rule = "a path that leads out of the ZIP"
        raise InputError("file", quoted(name), rule, "pack files with names of their own", file)


def _json(content: bytes, file: str) -> dict[str, Any]:
    try:
        data = json.loads(content.decode("utf-8-sig"))
    except RecursionError:
        raise InputError("file", None, "tables too deep inside each other", "write it again", file) from None
    except ValueError as error:
        raise InputError("file", None, f"not JSON: {error}", "write the file again", file) from None
    model = data.get("model") if isinstance(data, dict) else None
    if not isinstance(model, dict):
        raise InputError("model", None, "missing: no file of REXS", 'name a file that is {"model": …}', file)
    return model


def _model(data: Mapping[str, Any], file: str) -> RexsModel:
    version = str(data.get("version", ""))
    found = _VERSION.fullmatch(version)
    number = (int(found[1]), int(found[2])) if found else (0, 0)
    if not FIRST <= number <= LAST:
        rule = "another schema than REXS 1.0 to 2.0.0"
        raise InputError("model.version", quoted(version), rule, "write the file in one of these", file)
    parts: dict[int, Component] = {}
    for part in _parts(data.get("components"), "components", file):
        if part.number in parts:
            rule = f"the id {part.number} is that of {parts[part.number]} too"
            raise InputError(str(part), None, rule, "give each component an id of its own", file)
        parts[part.number] = part
    cases, accumulated = _cases(data.get("load_spectrum") or data.get("load_spectrums"), file)
    for part in (*(part for case in cases for part in case.parts), *accumulated):
        if part.number not in parts:
            raise InputError(str(part), None, "in a load case, but no component", "add the component", file)
    relations = tuple(_relations(data.get("relations"), parts, file))
    application = f"{data.get('applicationId', '')} {data.get('applicationVersion', '')}".strip()
    return RexsModel(version, printable(harmless(application)), parts, relations, cases, accumulated)


def _tables(data: Any, key: str, file: str) -> Iterator[Mapping[str, Any]]:
    data = [data] if isinstance(data, dict) else data or []
    if not isinstance(data, list) or not all(isinstance(each, dict) for each in data):
        raise InputError(key, None, "is no list of tables", "write the file again", file)
    yield from data


def _whole(table: Mapping[str, Any], key: str, where: str, file: str) -> int:
    value = table.get(key)
    try:
        return int(str(value), 10) if len(str(value)) < 20 else int("x")
    except ValueError:
        raise InputError(f"{where}.{key}", quoted(value), "is no whole number", "number it", file) from None


def _parts(data: Any, key: str, file: str, case: str = "") -> Iterator[Component]:
    for table in _tables(data, key, file):
        number = _whole(table, "id", key, file)
        name, sort = (printable(harmless(str(table.get(each) or ""))).strip() for each in ("name", "type"))
        part = Component(number, sort, name, {}, case)
        found: dict[str, Attribute] = {}
        for each in _tables(table.get("attributes"), str(part), file):
            attribute = _attribute(each)
            if attribute != found.setdefault(attribute.name, attribute):
                rule = f"has {attribute.name} twice, with different values"
                raise InputError(str(part), None, rule, "leave one of them out", file)
        yield Component(number, sort, name, found, case)


def _attribute(table: Mapping[str, Any]) -> Attribute:
    unit = table.get("unit")
    value = next((value for key, value in table.items() if key not in ("id", "unit")), None)
    if isinstance(value, dict):
        value = decoded(value.get("code"), value.get("value"))
    plain: Value = value if isinstance(value, (str, bool)) else None
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        plain = float(value) if abs(value) < 1e300 else math.inf
    elif isinstance(value, (list, tuple)) and all(isinstance(each, (str, int, float)) for each in value):
        plain = tuple(value)
    return Attribute(printable(str(table.get("id"))), None if unit is None else str(unit), plain)


def _relations(data: Any, parts: Mapping[int, Component], file: str) -> Iterator[Relation]:
    for table in _tables(data, "relations", file):
        number = _whole(table, "id", "relations", file)
        kind = printable(str(table.get("type", "")))
        refs: list[RelatedPart] = []
        for ref in _tables(table.get("refs"), f"relation {number}", file):
            part = _whole(ref, "id", f"relation {number}", file)
            if part not in parts:
                rule = f"names the component {part}, which is not in the file"
                raise InputError(f"relation {number} ({kind})", None, rule, "add the component", file)
            refs.append(RelatedPart(str(ref.get("role", "")), part))
        order = _whole(table, "order", f"relation {number}", file) if table.get("order") is not None else 0
        yield Relation(number, kind, tuple(refs), order)


def _cases(data: Any, file: str) -> tuple[tuple[LoadCase, ...], tuple[Component, ...]]:
    cases: list[LoadCase] = []
    accumulated: list[Component] = []
    for spectrum in _tables(data, "load_spectrum", file):
        for table in _tables(spectrum.get("load_cases"), "load_spectrum.load_cases", file):
            name = f"load case {printable(str(table.get('id', len(cases) + 1)))}"
            cases.append(LoadCase(name, tuple(_parts(table.get("components"), name, file, name))))
        for table in _tables(spectrum.get("accumulation"), "load_spectrum.accumulation", file):
            accumulated += _parts(table.get("components"), "accumulation", file, "accumulation")
    return tuple(cases), tuple(accumulated)
