"""Whether a drive holds, and how long: every way to fail of each gear, green or red against the required."""

from collections.abc import Mapping
from typing import Any

from tribodyn.gears.rating.capacity import as_life, shorter_life
from tribodyn.gears.rating.limits import LIMITS
from tribodyn.geometry.drive import SIDES
from tribodyn.studies.assessment.first_page import Judged, holds_table, judged_cell

#: Limit -> its quantity of either gear, where it has one.
_OF_GEARS = {"pitting": "S_H", "bending": "S_F", "life": ("life_pitting", "life_bending")}
#: Limit -> its quantity of the mesh.
_OF_MESH = {"scuffing_flash": "S_B", "scuffing_integral": "S_intS", "micropitting": "S_lambda"}


def holds(summary: Mapping[str, Any]) -> str:
    """Return the table of an assessment's first page."""
    limits, parts = summary.get("limits", {}), ("iso", "simulated")
    scattered = any("p5" in limit for limit in limits.values())
    rows = []
    for name in (*_OF_GEARS, *_OF_MESH):
        cells = [Judged(f"{LIMITS[name].label}{_unit(name)}")]
        for part in parts:
            cells += _of_part(summary, part, name)
        if all(cell.text == "–" for cell in cells[1:]):
            continue
        if scattered:
            cells.append(_range(limits.get(name, {}), name))
        asked_for = limits.get(name)
        bound = "–" if asked_for is None else f"≥ {LIMITS[name].quantity.written(asked_for['limit'])}"
        rows.append([*cells, Judged(bound)])
    first = [Judged(""), Judged("by the standard", span=2), Judged("simulated", span=2)]
    second = [Judged(""), *(Judged(side) for _ in parts for side in SIDES)]
    if scattered:
        first.append(Judged("worse of both"))
        second.append(Judged("5 to 95 % of samples"))
    return holds_table(
        "Does it hold, and how long?", ([*first, Judged("required")], [*second, Judged("")]), rows
    )


def _unit(name: str) -> str:
    unit = LIMITS[name].quantity.unit
    return f", {unit}" if unit else ""


def _of_part(summary: Mapping[str, Any], part: str, name: str) -> list[Judged]:
    limits = summary.get("limits", {})
    if name in _OF_MESH:
        value = summary.get("margins", {}).get(part, {}).get(_OF_MESH[name])
        return [judged_cell(value, name, limits, span=2)]
    values = summary.get(part, {})
    return [_of_gear(values, side, name, limits) for side in SIDES]


def _of_gear(values: Mapping[str, Any], side: str, name: str, limits: Mapping[str, Any]) -> Judged:
    keys = _OF_GEARS[name]
    if isinstance(keys, str):
        return judged_cell(values.get(keys, {}).get(side), name, limits)
    lives = [
        as_life(values[key][side], values.get(key.replace("life", "damage"), {}).get(side) == 0.0)
        for key in keys
        if key in values
    ]
    life = shorter_life(*lives)
    return judged_cell(life.get("life"), name, limits, unlimited=bool(life.get("life_unlimited")))


def _range(limit: Mapping[str, Any], name: str) -> Judged:
    if "p5" not in limit:
        return Judged("")
    low, high = (
        # what reaches the lower bound of a life without end is one, too
        "≥ " * bool(limit.get("unlimited") and float(limit[end]) >= limit["value"])
        + LIMITS[name].quantity.written(float(limit[end]))
        for end in ("p5", "p95")
    )
    mark = "bad" if limit.get("exceed") else "good"
    return Judged(f"{low} to {high}" if low != high else low, mark)
