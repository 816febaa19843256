"""XML of other programs, read without entities, document types and anything outside the text."""

from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.parsers import expat

from tribodyn.errors import InputError

#: Elements of a file, and inside each other.
MOST_ELEMENTS, DEEPEST = 2_000_000, 12
#: Bytes of a file, also when unpacked.
MOST_BYTES = 64 * 2**20
TOO_LARGE = f"larger than {MOST_BYTES >> 20} MiB"


class XmlElement:
    """An element: its name, attributes, text, what stands in it, and the line in which it begins."""

    __slots__ = ("attributes", "children", "line", "name", "pieces")

    def __init__(self, name: str, attributes: dict[str, str], line: int = 0) -> None:
        self.name, self.attributes, self.line = name, attributes, line
        self.pieces: list[str] = []
        self.children: list[XmlElement] = []

    @property
    def text(self) -> str:
        """Its own, without what stands in it."""
        return "".join(self.pieces).strip()

    def of(self, name: str) -> list["XmlElement"]:
        """What stands in it under a name."""
        return [child for child in self.children if child.name == name]


#: Says what is wrong with an element (name, name of the one around it, "" of the first): a rule and a remedy.
Fault = Callable[[str, str], tuple[str, str] | None]


def bounded_content(path: Path) -> bytes:
    """The bytes of a file; InputError where it cannot be read, or is too large."""
    file = str(path)
    try:
        if not path.is_file():
            raise InputError("file", None, "no such file", "check the path", file)
        with path.open("rb") as stream:
            content = stream.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError("file", None, f"cannot be read: {reason.lower()}", "", file) from None
    if len(content) > MOST_BYTES:
        raise InputError("file", None, TOO_LARGE, "leave results out of the file", file)
    return content


def read_tree(content: bytes, file: str, fault: Fault, what: str) -> XmlElement:
    """The first element of a file of `what`, with all in it; InputError where it is no XML, or `fault`."""
    parser = expat.ParserCreate()
    top = XmlElement("", {})
    above = [top]
    count = 0

    def refuse(rule: str, remedy: str) -> None:
        raise InputError(f"line {parser.CurrentLineNumber}", None, rule, remedy, file)

    def begin(name: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if wrong := fault(name, above[-1].name):
            refuse(*wrong)
        if count > MOST_ELEMENTS:
            refuse(f"more than {MOST_ELEMENTS} elements", "leave results out of the file")
        if len(above) > DEEPEST:
            refuse(f"more than {DEEPEST} elements inside each other", "write the file again")
        element = XmlElement(name, attributes, parser.CurrentLineNumber)
        above[-1].children.append(element)
        above.append(element)

    def end(_: str) -> None:
        above.pop()

    def text(data: str) -> None:
        above[-1].pieces.append(data)

    def declared(*_: Any) -> None:
        refuse(f"declares a document type or entities, which {what} has not", "take <!DOCTYPE …> out")

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
