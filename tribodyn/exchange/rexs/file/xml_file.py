"""REXS as XML: its elements, and how arrays are packed."""

import base64
import binascii
import struct
from typing import Any

from tribodyn.errors import quoted
from tribodyn.exchange.xml_tree import XmlElement, read_tree

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


def read_xml(content: bytes, file: str) -> dict[str, Any]:
    """The `model` of a file as its JSON would have it; InputError where it is no REXS."""
    return _model(read_tree(content, file, _fault, "REXS"))


def _fault(name: str, around: str) -> tuple[str, str] | None:
    """What is wrong with where an element stands."""
    if not around and name != "model":
        what = "the schema, not a gearbox" if name == "rexsSchema" else "no file of REXS"
        return f"its first element is {quoted(name)}: {what}", "name a file whose first element is <model>"
    if name not in _PLACES or around not in _PLACES[name]:
        where = f"<{around}>" if around else "the file"
        return f"<{name}> does not belong in {where}", "write it again as REXS 1.0 to 2.0.0"
    return None


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
