"""Which parts of a scenario are exported, and how exactly."""

from collections.abc import Mapping
from typing import Any

from tribodyn.drawing.shapes import PlacedPart
from tribodyn.errors import InputError, unknown_name
from tribodyn.exchange.format import TEXT, Exported, FormatChoice

#: Distance of chords from the exact surfaces unless it is set, and the bounds of it, m.
_TOLERANCE, _LEAST, _MOST = 5e-6, 1e-7, 1e-3

CHOICES = {
    "tolerance": FormatChoice("length", "distance of chords from the exact surfaces at most"),
    "part": FormatChoice(TEXT, "one gear or shaft by its name, about its own axis"),
}


def chosen_parts(exported: Exported, choices: Mapping[str, Any]) -> tuple[list[PlacedPart], tuple[str, ...]]:
    """The parts, and what is to be said of them; InputError where there are none."""
    tolerance = float(choices.get("tolerance", _TOLERANCE))
    if not _LEAST <= tolerance <= _MOST:
        rule = f"must be from {1e6 * _LEAST:g} um to {1e3 * _MOST:g} mm"
        raise InputError("tolerance", f"{1e6 * tolerance:g} um", rule, 'write tolerance = "5 um"')
    parts = exported.parts(tolerance) if exported.parts is not None else None
    if not parts:
        raise exported.refused("describes no gears that could be drawn", "name a scenario of gears")
    name = choices.get("part")
    if name is not None:
        named = {part.name: part for part in parts}
        if name not in named:
            raise unknown_name("part", name, named, "gear or shaft")
        parts = [named[name]._replace(centre=(0.0, 0.0, 0.0), angle=0.0)]
    remark = (
        f"{len(parts)} parts: {', '.join(part.name for part in parts)}; chords within {1e6 * tolerance:g} um"
    )
    return parts, (remark,)
