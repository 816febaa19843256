"""Which parts of a scenario are exported, and how exactly."""

from collections.abc import Mapping
from typing import Any

from tribodyn.drawing.shapes import PlacedPart
from tribodyn.errors import InputError, unknown_name
from tribodyn.exchange.format import TEXT, Exported, FormatChoice

#: Bounds of the distance from the exact surfaces, m.
_LEAST, _MOST = 1e-7, 1e-3

CHOICES = {
    "tolerance": FormatChoice("length", "distance from the exact surfaces at most"),
    "part": FormatChoice(TEXT, "one gear or shaft by its name, about its own axis"),
}


def tolerance_of(choices: Mapping[str, Any], usual: float) -> float:
    """The tolerance that is chosen, m; InputError where it is out of bounds."""
    tolerance = float(choices.get("tolerance", usual))
    if not _LEAST <= tolerance <= _MOST:
        rule = f"must be from {1e6 * _LEAST:g} um to {1e3 * _MOST:g} mm"
        raise InputError(
            "tolerance", f"{1e6 * tolerance:g} um", rule, f'write tolerance = "{1e6 * usual:g} um"'
        )
    return tolerance


def chosen_parts(exported: Exported, choices: Mapping[str, Any], tolerance: float) -> list[PlacedPart]:
    """The parts with chords so far off (m) at most; InputError where there are none."""
    parts = exported.parts(tolerance) if exported.parts is not None else None
    if not parts:
        raise exported.refused("describes no gears that could be drawn", "name a scenario of gears")
    name = choices.get("part")
    if name is None:
        return parts
    named = {part.name: part for part in parts}
    if name not in named:
        raise unknown_name("part", name, named, "gear or shaft")
    return [named[name]._replace(centre=(0.0, 0.0, 0.0), angle=0.0)]


def listed(parts: list[PlacedPart]) -> str:
    """The parts by their names, for people."""
    return f"{len(parts)} parts: {', '.join(part.name for part in parts)}"
