"""A GDE file as a measured gear."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.errors import InputError, harmless, printable, quoted
from tribodyn.exchange.gde import words
from tribodyn.exchange.measured_gear import (
    DIAMETER,
    HELIX,
    LARGEST,
    PROFILE,
    ROLL_ANGLE,
    ROLL_LENGTH,
    FlankTrace,
    MeasuredGear,
    NominalGear,
    index_of_single,
)
from tribodyn.exchange.xml_tree import XmlElement, bounded_content, read_tree
from tribodyn.numerics.shapes import Array, Float

#: What the place of a trace is -> names and kind.
_PLACES = {
    PROFILE: (
        (ROLL_LENGTH, words.ROLL_LENGTHS, "length"),
        (ROLL_ANGLE, words.ROLL_ANGLES, "angle"),
        (DIAMETER, words.DIAMETERS, "length"),
    ),
    HELIX: (("", words.FACES, "length"),),
}
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_AT = {PROFILE: words.FACES, HELIX: words.DIAMETERS}
_CONTAINERS = {*words.GEARS, *words.GROUPS, *words.GEOMETRY, *words.INSPECTION}


def read(path: Path) -> MeasuredGear:
    """The gear in a file; InputError, naming the element, where something in it is not understood."""
    file = str(path)

    def fault(name: str, around: str) -> tuple[str, str] | None:
        if around or words.plain(name) in words.ROOTS:
            return None
        rule = f"its first element is {quoted(printable(name))}: no GDE that is known"
        return rule, f"name a file whose first element is one of {', '.join(words.ROOTS)}"

    return _Reading(file).gear(read_tree(bounded_content(path), file, fault, "GDE"))


class _Reading:
    """A file on the way."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.nominal: dict[str, Any] = {}
        self.traces: list[FlankTrace] = []
        self.index: dict[str, Float[Array, " tooth"]] = {}
        self.radial: Float[Array, " gap"] | None = None
        self.diameter: float | None = None
        self.name = ""
        self.not_used: list[str] = []
        self.gears = 0

    def bad(self, element: XmlElement, rule: str, remedy: str) -> InputError:
        """What is wrong with an element."""
        key = f"line {element.line}: <{printable(element.name)}>"
        return InputError(key, None, rule, remedy, self.file)

    def gear(self, root: XmlElement) -> MeasuredGear:
        """All that the file says."""
        self._walk(root)
        if not (self.traces or self.index or self.radial is not None):
            rule = "no profile, helix, pitch or runout measurement is in it"
            remedy = f"write one, such as <{words.PROFILES[0]}>"
            raise InputError("file", None, rule, remedy, self.file)
        remarks = tuple(f"not used: {each}" for each in dict.fromkeys(self.not_used))
        nominal = NominalGear(**self.nominal)
        return MeasuredGear(
            nominal, tuple(self.traces), self.index, self.radial, self.diameter, self.name, remarks
        )

    def _walk(self, element: XmlElement, measured: bool = False) -> None:
        name = words.plain(element.name)
        if name in words.GEARS and not any(words.plain(c.name) in words.GEARS for c in element.children):
            self.gears += 1
            self.name = printable(harmless(element.attributes.get("name", "")))
            if self.gears > 1:
                raise self.bad(element, "a second gear in the file", "write each gear into a file of its own")
        measured = measured or name in words.INSPECTION
        for child in element.children:
            of = words.plain(child.name)
            if of in words.PROFILES or of in words.HELICES:
                self.traces.append(self._trace(child, PROFILE if of in words.PROFILES else HELIX))
            elif of in words.PITCHES:
                self._pitch(child)
            elif of in words.RUNOUTS:
                self._runout(child)
            elif of in words.GEOMETRY:
                self._geometry(child)
            elif of in words.OTHERS:
                self.not_used.append(f"<{printable(child.name)}>")
            elif of in _CONTAINERS:
                self._walk(child, measured)
            elif measured:
                known = ", ".join(
                    names[0] for names in (words.PROFILES, words.HELICES, words.PITCHES, words.RUNOUTS)
                )
                raise self.bad(child, "no measurement that is known", f"one of {known}; or leave it out")
            else:
                self.not_used.append(f"<{printable(child.name)}>")

    def _geometry(self, element: XmlElement) -> None:
        for child in element.children:
            name = words.plain(child.name)
            if name in words.GEOMETRY:
                self._geometry(child)
                continue
            found = next((field for field, (names, _) in words.NOMINAL.items() if name in names), None)
            if found is None:
                self.not_used.append(f"<{printable(child.name)}>")
                continue
            value = self._nominal(child, words.NOMINAL[found][1])
            if self.nominal.setdefault(found, value) != value:
                raise self.bad(child, "stands twice, with different values", "leave one of them out")

    def _nominal(self, element: XmlElement, kind: str) -> Any:
        text = words.plain(element.text)
        if kind == "hand":
            if text not in words.HANDS:
                raise self.bad(element, f"{quoted(text)} is no hand", "write right, left or spur")
            return words.HANDS[text] or None
        if kind == "type":
            if text not in ("external", "internal"):
                raise self.bad(element, f"{quoted(text)} is no sort of gear", "write external or internal")
            return text == "internal"
        (value,) = self._numbers(element, kind, 1)
        if words.plain(element.name) not in words.NOMINAL["teeth"][0]:
            return value
        if value != round(value):
            raise self.bad(element, f"{value:g} is no whole number", "write the number of teeth")
        return round(value)

    def _trace(self, element: XmlElement, kind: str) -> FlankTrace:
        places = _PLACES[kind]
        known = [words.TOOTH, words.FLANK, words.DEVIATIONS, words.BEGIN, words.END, _AT[kind]]
        self._know(element, [*known, *(names for _, names, _ in places)])
        tooth = self._whole(element, words.TOOTH)
        points = [child for child in element.children if words.plain(child.name) in words.POINTS]
        there = ((o, unit, self._column(element, points, names, unit)) for o, names, unit in places)
        found = next(((o, unit, place) for o, unit, place in there if place is not None), None)
        if found is None:
            named = ", ".join(names[0] for _, names, _ in places)
            raise self.bad(element, "nothing says where its points are", f"add one of {named}")
        over, unit, place = found
        deviation = self._column(element, points, words.DEVIATIONS, "deviation")
        if deviation is None:
            raise self.bad(element, "it has no deviations", f"add <{words.DEVIATIONS[0]}>")
        if len(deviation) != len(place) or len(place) < 3:
            rule = f"{len(place)} places and {len(deviation)} deviations"
            raise self.bad(element, rule, "give each point both, three points at least")
        if not (np.all(np.diff(place) > 0.0) or np.all(np.diff(place) < 0.0)):
            raise self.bad(element, "its points go forth and back", "write them from one end to the other")
        at = self._one(element, _AT[kind], "length")
        begin, end = (self._one(element, names, unit) for names in (words.BEGIN, words.END))
        if (begin is None) != (end is None):
            raise self.bad(element, "one end of the evaluation range is missing", "give both, or neither")
        evaluated = None if begin is None or end is None else (begin, end)
        flank = self._flank(element)
        return FlankTrace(kind, tooth, flank, place, deviation, at, evaluated, over or ROLL_LENGTH)

    def _pitch(self, element: XmlElement) -> None:
        self._know(element, [words.FLANK, words.DIAMETERS, words.CUMULATIVE, words.SINGLE])
        flank = self._flank(element)
        found = self._column(element, [], words.CUMULATIVE, "deviation")
        if found is None:
            single = self._column(element, [], words.SINGLE, "deviation")
            if single is None:
                remedy = f"add <{words.CUMULATIVE[0]}> or <{words.SINGLE[0]}>"
                raise self.bad(element, "it has no deviations", remedy)
            found = index_of_single(single)
        if flank in self.index:
            raise self.bad(element, f"the {flank} flanks have two", "leave one of them out")
        self.index[flank] = found
        diameter = self._one(element, words.DIAMETERS, "length")
        if None not in (diameter, self.diameter) and diameter != self.diameter:
            raise self.bad(element, "measured on another circle than the other flanks", "measure on one")
        self.diameter = self.diameter if diameter is None else diameter

    def _runout(self, element: XmlElement) -> None:
        self._know(element, [words.RADIAL])
        if self.radial is not None:
            raise self.bad(element, "there are two", "leave one of them out")
        self.radial = self._column(element, [], words.RADIAL, "deviation")
        if self.radial is None:
            raise self.bad(element, "it has no readings", f"add <{words.RADIAL[0]}>")

    def _know(self, element: XmlElement, known: Sequence[Sequence[str]]) -> None:
        """Refuse what stands in an element and is not known there."""
        names = {name for each in known for name in each}
        for child in element.children:
            if words.plain(child.name) in words.POINTS:
                self._know(child, known)
            elif words.plain(child.name) not in names:
                rule = f"is not known in <{printable(element.name)}>"
                raise self.bad(child, rule, f"one of {', '.join(each[0] for each in known)}")
        for name in element.attributes:
            if words.plain(name) not in names | {"unit", "id", "name"}:
                rule = f"its attribute {quoted(printable(name))} is not known"
                raise self.bad(element, rule, f"one of {', '.join(each[0] for each in known)}")

    def _named(self, element: XmlElement, names: Sequence[str]) -> XmlElement | None:
        """The child of one of these names, or the attribute as if it were one."""
        found = [child for child in element.children if words.plain(child.name) in names]
        for name, value in element.attributes.items():
            if words.plain(name) in names:
                attribute = XmlElement(name, {}, element.line)
                attribute.pieces.append(value)
                found.append(attribute)
        if len(found) > 1:
            raise self.bad(found[1], "stands twice", "leave one of them out")
        return found[0] if found else None

    def _whole(self, element: XmlElement, names: Sequence[str]) -> int:
        child = self._named(element, names)
        if child is None or not (child.text.isascii() and child.text.isdigit() and len(child.text) < 7):
            at = element if child is None else child
            raise self.bad(at, f"no {names[0]} that is a whole number", f"add <{names[0]}>1</{names[0]}>")
        return int(child.text)

    def _flank(self, element: XmlElement) -> str:
        child = self._named(element, words.FLANK)
        found = None if child is None else words.SIDES.get(words.plain(child.text))
        if found is None:
            raise self.bad(child or element, "says no flank", "write <flank>left</flank>, or right")
        return found

    def _one(self, element: XmlElement, names: Sequence[str], kind: str) -> float | None:
        child = self._named(element, names)
        return None if child is None else self._numbers(child, kind, 1)[0]

    def _column(
        self, element: XmlElement, points: Sequence[XmlElement], names: Sequence[str], kind: str
    ) -> Float[Array, " point"] | None:
        """Numbers of a list, or of each point; None where there are none of this name."""
        if points:
            each = [self._named(point, names) for point in points]
            if any(each):
                if lacking := next((p for p, one in zip(points, each, strict=True) if one is None), None):
                    raise self.bad(lacking, f"has no {names[0]}", "give each point one")
                return np.array([self._numbers(one, kind, 1)[0] for one in each if one is not None])
        child = self._named(element, names)
        return None if child is None else np.array(self._numbers(child, kind))

    def _numbers(self, element: XmlElement, kind: str, count: int = 0) -> list[float]:
        """Numbers in SI units; `kind`: length (mm where no unit is said), angle (deg), deviation, number."""
        found = list(self._split(element))
        if not found or (count and len(found) != count):
            raise self.bad(element, f"{len(found)} numbers", "write one" if count else "write them")
        if kind == "number":
            return found
        said = element.attributes.get("unit")
        if said is None and kind == "deviation":
            raise self.bad(element, "its unit is not said", 'add unit="um" or unit="mm"')
        default = "deg" if kind == "angle" else "mm"
        unit = words.UNITS.get((said or default).strip().lower())
        due = "angle" if kind == "angle" else "length"
        if unit is None or unit.kind != due:
            raise self.bad(element, f"{quoted(said)} is no unit of {due} that is known", f'write "{default}"')
        if beyond := next((value for value in found if abs(value) * unit.si >= LARGEST), None):
            raise self.bad(element, f"{beyond:g} {said or default} is nothing of a gear", "check the unit")
        return [value * unit.si for value in found]

    def _split(self, element: XmlElement) -> Iterator[float]:
        for text in element.text.replace(";", " ").split():
            if not (_NUMBER.fullmatch(text) and abs(value := float(text)) < 1e12):
                raise self.bad(element, f"{quoted(text)} is no number", "write numbers with decimal points")
            yield value
