"""A REXS model being made: components, relations and load cases, and its text."""

from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any
from xml.sax.saxutils import escape, quoteattr

from tribodyn import __version__
from tribodyn.errors import harmless, printable
from tribodyn.exchange.rexs.file.attributes import FRAME, ORIGIN, U_AXIS, W_AXIS, RexsKey

#: Schema that is written.
VERSION = "2.0.0"


def value_in(value: Any, key: RexsKey) -> Any:
    """A value of a scenario in the unit of an attribute, with its digits where the unit is the same."""
    if not isinstance(value, str):
        number = value
    else:
        text, _, unit = value.strip().partition(" ")
        if unit == key.measured.toml and key.measured.factor == 1.0:
            return float(text)
        number = _converted(text, unit, key.measured.toml)
    return number if key.measured.factor == 1.0 else float(f"{number / key.measured.factor:.12g}")


@cache
def _units() -> Any:
    import pint

    return pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


def _converted(text: str, unit: str, wanted: str) -> float:
    registry = _units()
    return float(f"{registry.Quantity(float(text), unit).to(wanted or 'dimensionless').magnitude:.14g}")


def si(value: Any, unit: str = "m") -> float:
    """A quantity of a scenario in a unit."""
    text, _, own = str(value).strip().partition(" ")
    return float(text) if own == unit else _converted(text, own, unit)


class ModelText:
    """Components by id, relations, load cases."""

    def __init__(self) -> None:
        self._components: list[tuple[int, str, str, dict[str, tuple[Any, str]]]] = []
        self._relations: list[tuple[str, int | None, dict[str, int]]] = []
        self._cases: list[dict[int, dict[str, tuple[Any, str]]]] = []

    def add(self, sort: str, name: str = "", values: Mapping[RexsKey, Any] | None = None) -> int:
        """Add a component with the values that there are; its id."""
        number = len(self._components) + 1
        self._components.append((number, sort, name, {}))
        for key, value in (values or {}).items():
            self.put(number, key, value)
        return number

    def put(self, number: int, key: RexsKey, value: Any) -> None:
        """Give a component an attribute, if there is a value of it."""
        if value is not None:
            self._components[number - 1][3][key.name] = value, key.unit

    def place(self, number: int, origin: Iterable[float]) -> None:
        """Put a component at a place, m; its axes are those of the gear unit, the first component."""
        vectors = {ORIGIN: [round(1e3 * each, 9) + 0.0 for each in origin]}
        for key, vector in {**vectors, U_AXIS: [1, 0, 0], W_AXIS: [0, 0, 1]}.items():
            self.put(number, key, vector)
        self.put(number, FRAME, 1)

    def relate(self, sort: str, order: int | None = None, **roles: int) -> None:
        """Add a relation."""
        self._relations.append((sort, order, roles))

    def case(self, values: Mapping[int, Mapping[RexsKey, Any]]) -> None:
        """Add a load case."""
        told = {
            number: {key.name: (value, key.unit) for key, value in each.items()}
            for number, each in values.items()
        }
        self._cases.append(told)

    def xml(self, date: str) -> str:
        """The file."""
        made = f'applicationId="tribodyn" applicationVersion={_quoted(__version__)} date={_quoted(date)}'
        lines = [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<model version="{VERSION}" {made}>',
            "  <relations>",
        ]
        types = {number: sort for number, sort, _, _ in self._components}
        for number, (sort, order, roles) in enumerate(self._relations, start=1):
            ordered = "" if order is None else f' order="{order}"'
            lines.append(f'    <relation id="{number}" type="{sort}"{ordered}>')
            lines += [
                f'      <ref id="{part}" role="{role}" hint="{types[part]}"/>' for role, part in roles.items()
            ]
            lines.append("    </relation>")
        lines += ["  </relations>", "  <components>"]
        for number, sort, name, values in self._components:
            lines += _component(number, sort, values, name, "    ")
        lines.append("  </components>")
        if self._cases:
            lines.append('  <load_spectrum id="1">')
            for number, case in enumerate(self._cases, start=1):
                lines.append(f'    <load_case id="{number}">')
                for part, values in case.items():
                    lines += _component(part, types[part], values, "", "      ")
                lines.append("    </load_case>")
            lines.append("  </load_spectrum>")
        return "\n".join([*lines, "</model>", ""])


def _component(
    number: int, sort: str, values: Mapping[str, tuple[Any, str]], name: str, indent: str
) -> list[str]:
    named = f" name={_quoted(name)}" if name else ""
    lines = [f'{indent}<component id="{number}" type="{sort}"{named}>']
    for key, (value, unit) in values.items():
        if isinstance(value, (list, tuple)):
            cells = "".join(f"<c>{_text(each)}</c>" for each in value)
            shown = f"<array>{cells}</array>"
        else:
            shown = _text(value)
        lines.append(f"{indent}  <attribute id={_quoted(key)} unit={_quoted(unit)}>{shown}</attribute>")
    return [*lines, f"{indent}</component>"]


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
    return escape(printable(harmless(str(value))))


def _quoted(value: str) -> str:
    return quoteattr(printable(harmless(value)))
