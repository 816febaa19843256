"""The form as the browser draws it: structure, which changes seldom, values and ranges of sliders."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import Any

from tribodyn.app.core.fields import converted
from tribodyn.app.core.form import FormField, FormGroup
from tribodyn.errors import InputError

#: Groups that are open at first, by the end of their path.
_OPEN = ("operating", "modification")
#: Texts about a model that a designer does not change at first.
_QUIET = ("title", "name", "source", "assumptions")
#: Key -> ends of its slider where no usual range is known, in a unit. They limit nothing that is typed.
_SLIDERS: dict[str, tuple[float, float, str]] = {
    "tip_relief": (0.0, 50.0, "um"),
    "root_relief": (0.0, 50.0, "um"),
    "lead_crowning": (0.0, 30.0, "um"),
    "profile_crowning": (0.0, 20.0, "um"),
    "profile_shift": (-0.6, 1.0, ""),
    "helix_angle": (0.0, 35.0, "deg"),
    "oil_temperature": (20.0, 120.0, "degC"),
    "pressure_angle": (14.5, 28.0, "deg"),
}
#: Ends of other sliders over the value that they begin at.
_BELOW, _ABOVE = 0.0, 2.0
#: No slider is drawn about a number beyond this one.
_LARGEST = 1e30
_KINDS = {"quantity": "number", "number": "number", "whole": "number", "choice": "choice", "switch": "switch"}


def groups_of(groups: Iterable[FormGroup]) -> list[dict[str, Any]]:
    """Groups with their fields, without values."""
    groups = tuple(groups)
    labels = {group.path: group.label for group in groups}
    drawn = []
    for group in groups:
        if not group.fields:
            continue
        fields = [_structure(field, group) for field in group.fields]
        steps = group.path.split(".")
        above = [".".join(steps[: number + 1]) for number in range(len(steps))]
        drawn.append(
            {
                "path": group.path,
                "title": " › ".join(labels[path] for path in above if path in labels) or group.label,
                "description": group.about,
                "present": group.present,
                "open": group.present and group.path.endswith(_OPEN),
                "copied": bool(group.one_of) and steps[-1].isdecimal(),
                "removed": group.present and group.optional and (group.given or steps[-1].isdecimal()),
                "further": any(field["advanced"] for field in fields),
                "fields": fields,
            }
        )
    return drawn


def held_of(groups: Iterable[FormGroup]) -> list[dict[str, Any]]:
    """Where tables can be added, with what there is to say of them."""
    return [
        {
            "path": held.path,
            "label": " › ".join(filter(None, [group.label if group.path else "", held.label])),
            "about": held.about,
            "named": held.named,
        }
        for group in groups
        for held in group.holds
    ]


def _structure(field: FormField, group: FormGroup) -> dict[str, Any]:
    return {
        "path": field.path,
        "label": field.label,
        "description": field.about,
        "kind": _KINDS.get(field.kind, "text"),
        "whole": field.kind == "whole",
        "unit": field.unit,
        "units": list(field.units),
        "choices": list(field.choices),
        "default": field.default,
        "example": field.example,
        "source": field.usual_source,
        "required": field.required and group.present,
        "advanced": field.advanced or (field.path.rpartition(".")[2] in _QUIET and bool(group.path)),
    }


def values_of(fields: Mapping[str, FormField]) -> dict[str, list[Any]]:
    """Text, unit, whether this scenario says it, and where it is from, of every field that has a value."""
    return {
        path: [field.shown, field.unit, field.given, "" if field.source == "default" else field.source]
        for path, field in fields.items()
        if field.shown != "" or field.given
    }


class Sliders:
    """Ends of the sliders; they stay while a value is dragged between them."""

    def __init__(self) -> None:
        self._ends: dict[str, tuple[str, float, float, bool]] = {}

    def of(self, fields: Mapping[str, FormField]) -> dict[str, list[Any]]:
        """Ends in the unit that is shown, and whether they are a usual range, of numbers that have some."""
        for path, field in fields.items():
            known = self._ends.get(path)
            value = _number(field.shown)
            if known and known[0] == field.unit and (value is None or known[1] <= value <= known[2]):
                continue
            found = _ends(field, value)
            if found is None:
                self._ends.pop(path, None)
            else:
                self._ends[path] = (field.unit, *found)
        return {path: list(ends[1:]) for path, ends in self._ends.items() if path in fields}


def _ends(field: FormField, value: float | None) -> tuple[float, float, bool] | None:
    if field.kind not in ("quantity", "number", "whole") or (field.advanced and not field.usual):
        return None
    if field.usual is not None:
        low, high = (_in_unit(field, each, field.usual_unit) for each in field.usual)
        if low is not None and high is not None and low < high and (value is None or low <= value <= high):
            return low, high, True
    name = field.path.rpartition(".")[2]
    if name in _SLIDERS:
        least, most, unit = _SLIDERS[name]
        low, high = _in_unit(field, least, unit), _in_unit(field, most, unit)
        if low is not None and high is not None and (value is None or low <= value <= high):
            return low, high, False
    if value is None or value <= 0.0:
        return None
    low, high = _BELOW * value, _ABOVE * value
    low = low if field.low is None else max(low, field.low)
    high = high if field.high is None else min(high, field.high)
    if field.kind == "whole":
        low, high = float(max(1, round(low))), float(round(high))
    return (low, high, False) if low < high else None


def _in_unit(field: FormField, number: float, unit: str) -> float | None:
    if field.kind != "quantity":
        return number
    with suppress(InputError, ValueError, TypeError):
        return float(converted(repr(number), unit, field.unit))
    return None


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) < _LARGEST else None
