"""Reading a REXS model by attributes: what was read is known, and so what was not."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from tribodyn.errors import InputError, cut, quoted
from tribodyn.exchange.rexs.file.attributes import RexsKey
from tribodyn.exchange.rexs.file.model import Attribute, Component, RexsModel
from tribodyn.exchange.rexs.file.units import RexsUnit, shown, unit_named

#: Numbers that a scenario takes.
_SMALLEST, _LARGEST = 1e-30, 1e30


class NotUsed(NamedTuple):
    """An attribute that no key of the scenario came from."""

    component: str
    type: str
    number: int
    attribute: str
    value: str
    unit: str
    why: str  # "" where nothing reads it


class Sheet:
    """A model, of which it is known what has been read."""

    def __init__(self, model: RexsModel, file: str) -> None:
        self.model, self.file = model, file
        self._read: set[tuple[str, int, str]] = set()
        self._why: dict[tuple[str, int, str], str] = {}

    def refused(self, part: Component | str, rule: str, remedy: str = "", name: str = "") -> InputError:
        """What to say of a part that cannot be taken."""
        key = f"{part}: {name}" if name else str(part)
        value = None
        if name and isinstance(part, Component) and name in part.attributes:
            value = _shown(part.attributes[name])
        return InputError(key, value, rule, remedy, self.file)

    def found(self, part: Component, key: RexsKey) -> Attribute | None:
        """The attribute under one of its names; it counts as read."""
        for name in (key.name, *key.older):
            attribute = part.attributes.get(name)
            if attribute is not None and attribute.value is not None and attribute.value != "":
                self._read.add((part.case, part.number, name))
                return attribute
        return None

    def alike(self, first: Component, other: Component) -> None:
        """Count what a component says as another one does as read: one stands for both."""
        for name, attribute in other.attributes.items():
            if first.attributes.get(name) == attribute and (first.case, first.number, name) in self._read:
                self._read.add((other.case, other.number, name))

    def leave(self, part: Component, key: RexsKey, why: str) -> None:
        """Count an attribute as not used, and say why."""
        for name in (key.name, *key.older):
            self._read.discard((part.case, part.number, name))
            self._why[part.case, part.number, name] = why

    def number(self, part: Component, key: RexsKey) -> tuple[float, RexsUnit] | None:
        """A number as the file has it, with its unit; None where there is none, or no number."""
        attribute = self.found(part, key)
        if attribute is None:
            return None
        unit = unit_named(attribute.unit) if attribute.unit else key.measured
        if unit is None or unit.quantity != key.measured.quantity:
            rule = f"in {quoted(attribute.unit)}, but it is a {key.measured.quantity}"
            raise self.refused(part, rule, f"write it in {key.unit}", attribute.name)
        try:
            told = attribute.value
            value = float(told) if isinstance(told, (str, float)) else math.nan
        except ValueError:
            value = math.nan
        if isinstance(attribute.value, bool):  # writers whose JSON lost the value
            self.leave(part, key, "no number")
            return None
        if not (value == 0 or _SMALLEST <= abs(value) <= _LARGEST):
            raise self.refused(part, "is no number that counts", f"write it in {key.unit}", attribute.name)
        return value, unit

    def si(self, part: Component, key: RexsKey) -> float | None:
        """A number in SI units, of a temperature in °C."""
        found = self.number(part, key)
        return None if found is None else found[0] * found[1].si

    def toml(self, part: Component, key: RexsKey) -> str | None:
        """A number as a scenario writes it."""
        found = self.number(part, key)
        return None if found is None else shown(*found)

    def whole(self, part: Component, key: RexsKey) -> int | None:
        """A whole number."""
        value = self.si(part, key)
        if value is not None and value != int(value):
            raise self.refused(part, "is no whole number", "", key.name)
        return None if value is None else int(value)

    def text(self, part: Component, key: RexsKey) -> str | None:
        """A text, or the name of a choice."""
        attribute = self.found(part, key)
        if attribute is None or isinstance(attribute.value, (str, int, float)) is False:
            return None
        if isinstance(attribute.value, bool):
            self.leave(part, key, "no text")
            return None
        return str(attribute.value)

    def truth(self, part: Component, key: RexsKey) -> bool | None:
        """True, false, or nothing said."""
        attribute = self.found(part, key)
        value = attribute.value if attribute is not None else None
        value = value[0] if isinstance(value, tuple) and value else value
        words = {"true": True, "false": False, "1": True, "0": False, "1.0": True, "0.0": False}
        return None if value is None else words.get(str(value).lower())

    def vector(self, part: Component, key: RexsKey) -> tuple[float, float, float] | None:
        """Three numbers, lengths in m; None where the file has not three."""
        attribute = self.found(part, key)
        if attribute is None:
            return None
        unit = unit_named(attribute.unit) if attribute.unit else key.measured
        try:
            values = tuple(map(float, attribute.value)) if isinstance(attribute.value, tuple) else ()
        except ValueError:
            values = ()
        if (
            len(values) != 3
            or unit is None
            or unit.quantity != "length"
            or not all(abs(each) <= _LARGEST for each in values)
        ):
            self.leave(part, key, "not three numbers")
            return None
        return values[0] * unit.si, values[1] * unit.si, values[2] * unit.si

    def not_used(self) -> Iterator[NotUsed]:
        """Go through what was not read, component by component."""
        parts = (*self.model.parts.values(), *(part for case in self.model.cases for part in case.parts))
        for part in (*parts, *self.model.accumulated):
            for name, attribute in part.attributes.items():
                if (part.case, part.number, name) not in self._read:
                    named = self.model.parts[part.number]
                    where = f"{named.name or named.type}{', ' if part.case else ''}{part.case}"
                    value, unit = _shown(attribute, plain=True), attribute.unit or ""
                    why = self._why.get((part.case, part.number, name), "")
                    yield NotUsed(where, named.type, part.number, name, value, unit, why)


def _shown(attribute: Attribute, *, plain: bool = False) -> str:
    value = attribute.value
    if isinstance(value, tuple):
        text = f"[{', '.join(map(str, value[:6]))}{', …' if len(value) > 6 else ''}]"
    else:
        text = "" if value is None else f"{value:g}" if isinstance(value, float) else str(value)
    return cut(text if plain or attribute.unit in (None, "", "none") else f"{text} {attribute.unit}", 80)
