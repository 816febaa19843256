"""REXS as XML, read without entities, document types and anything outside the text."""

import base64
import binascii
import struct
from typing import Any
from xml.parsers import expat

from tribodyn.errors import InputError, quoted

#: Elements of a file, and inside each other.
MOST_ELEMENTS, DEEPEST = 2_000_000, 12
#: Element -> those that it may stand in.
_PLACES = {
    "model": {""},
    "relations": {"model"},
    "relation": {"relations"},
    "ref": {"relation"},
    "components": {"model"},
    "component": {"components", "load_case", "accumulation"},
    "attribute": {"component"},
    "array": {"attribute", "array_of_arrays"},
    "matrix": {"attribute"},
    "array_of_arrays": {"attribute"},
    "r": {"matrix"},
    "c": {"array", "r"},
    "load_spectrum": {"model"},
    "load_case": {"load_spectrum"},
    "accumulation": {"load_spectrum"},
}
#: How arrays are packed.
_CODES = {"int32": "i", "float32": "f", "float64": "d"}


class XmlElement:
    """An element: its name, attributes, text, and what stands in it."""

    __slots__ = ("attributes", "children", "name", "pieces")

    def __init__(self, name: str, attributes: dict[str, str]) -> None:
        self.name, self.attributes = name, attributes
        self.pieces: list[str] = []
        self.children: list[XmlElement] = []

    @property
    def text(self) -> str:
        """Its own, without what stands in it."""
        return "".join(self.pieces).strip()

    def of(self, name: str) -> list["XmlElement"]:
        """What stands in it under a name."""
        return [child for child in self.children if child.name == name]


def read_xml(content: bytes, file: str) -> dict[str, Any]:
    """The `model` of a file as its JSON would have it; InputError where it is no REXS."""
    return _model(_tree(content, file))


def _tree(content: bytes, file: str) -> XmlElement:
    parser = expat.ParserCreate()
    top = XmlElement("", {})
    above = [top]
    count = 0

    def refuse(rule: str, remedy: str) -> None:
        raise InputError(f"line {parser.CurrentLineNumber}", None, rule, remedy, file)

    def begin(name: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if count == 1 and name != "model":
            what = "the schema, not a gearbox" if name == "rexsSchema" else "no file of REXS"
            refuse(
                f"its first element is {quoted(name)}: {what}", "name a file whose first element is <model>"
            )
        if name not in _PLACES or above[-1].name not in _PLACES[name]:
            where = f"<{above[-1].name}>" if above[-1].name else "the file"
            refuse(f"<{name}> does not belong in {where}", "write it again as REXS 1.0 to 2.0.0")
        if count > MOST_ELEMENTS or len(above) > DEEPEST:
            refuse(f"more than {MOST_ELEMENTS} elements", "leave results out of the file")
        element = XmlElement(name, attributes)
        above[-1].children.append(element)
        above.append(element)

    def end(_: str) -> None:
        above.pop()

    def text(data: str) -> None:
        above[-1].pieces.append(data)

    def declared(*_: Any) -> None:
        refuse("declares a document type or entities, which REXS has not", "take <!DOCTYPE …> out")

    parser.buffer_text = True
    parser.StartElementHandler, parser.EndElementHandler = begin, end
    parser.CharacterDataHandler = text
    parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = declared
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        rule = f"not XML: {expat.ErrorString(error.code)}"
        raise InputError(f"line {error.lineno}", None, rule, "write the file again", file) from None
    except (LookupError, ValueError) as error:  # an encoding that nobody knows
        raise InputError("file", None, f"not XML: {error}", "write the file as UTF-8", file) from None
    return top.children[0]


def _model(element: XmlElement) -> dict[str, Any]:
    components = [part for each in element.of("components") for part in each.of("component")]
    return {
        **element.attributes,
        "components": list(map(_part, components)),
        "relations": [
            {**each.attributes, "refs": [ref.attributes for ref in each.of("ref")]}
            for relations in element.of("relations")
            for each in relations.of("relation")
        ],
        "load_spectrum": [
            {
                **spectrum.attributes,
                "load_cases": [_case(case) for case in spectrum.of("load_case")],
                "accumulation": {
                    "components": [
                        p for each in spectrum.of("accumulation") for p in _case(each)["components"]
                    ]
                },
            }
            for spectrum in element.of("load_spectrum")
        ],
    }


def _case(element: XmlElement) -> dict[str, Any]:
    return {**element.attributes, "components": list(map(_part, element.of("component")))}


def _part(element: XmlElement) -> dict[str, Any]:
    return {**element.attributes, "attributes": [_attribute(each) for each in element.of("attribute")]}


def _attribute(element: XmlElement) -> dict[str, Any]:
    named = {"id": element.attributes.get("id"), "unit": element.attributes.get("unit")}
    for array in element.of("array"):
        code = array.attributes.get("code")
        if code is not None:
            return {**named, "floating_point_array_coded": {"code": code, "value": array.text}}
        return {**named, "string_array": [each.text for each in array.of("c")]}
    if element.children:
        return {**named, "matrix": None}
    return {**named, "string": element.text}


def decoded(code: Any, value: Any) -> tuple[float, ...] | None:
    """Numbers of a packed array; None where they cannot be read."""
    letter = _CODES.get(str(code))
    try:
        content = base64.b64decode(str(value) + "=" * (-len(str(value)) % 4), validate=True)
        return (
            None
            if letter is None
            else struct.unpack(f"<{len(content) // struct.calcsize(letter)}{letter}", content)
        )
    except (binascii.Error, struct.error, ValueError):
        return None
