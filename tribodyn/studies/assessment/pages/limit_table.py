"""Whether a gearbox holds, and how long: every way to fail, green or red against what is required."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from tribodyn.gears.rating.capacity import as_life, shorter_life
from tribodyn.gears.rating.limits import LIMITS, SAFETIES
from tribodyn.geometry.drive import SIDES
from tribodyn.studies.assessment.pages.first_page import Judged, holds_table, judged_cell
from tribodyn.studies.assessment.report import groups_of, meshes_of

HEADING = "Does it hold, and how long?"
#: Limit -> its quantity of either gear, where it has one.
_OF_GEARS = {
    **{"pitting": "S_H", "bending": "S_F", "flank_fracture": "S_FF"},
    "life": ("life_pitting", "life_bending"),
}
#: Limit -> its quantity of the mesh.
_OF_MESH = {"scuffing_flash": "S_B", "scuffing_integral": "S_intS", "micropitting": "S_lambda"}


def holds(summary: Mapping[str, Any]) -> str:
    """Return the table of an assessment's first page: of every mesh, of a single one of each of its gears."""
    meshes = meshes_of(summary)
    if len(meshes) == 1:
        return holds_of_mesh(next(iter(meshes.values())))
    return _of_meshes(meshes, summary.get("limits", {}))


def holds_of_mesh(summary: Mapping[str, Any], heading: str = HEADING) -> str:
    """The table of a mesh: every way to fail of each of its gears, by the standard and simulated."""
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
    return holds_table(heading, ([*first, Judged("required")], [*second, Judged("")]), rows)


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


#: Limit -> what of a mesh it bounds.
_BOUNDED = SAFETIES | {"life": "life"}


def _of_meshes(meshes: Mapping[str, Mapping[str, Any]], limits: Mapping[str, Any]) -> str:
    """The worse of the standard and the simulation of every kind of mesh, that with the least room first."""
    columns = [limit for limit, name in _BOUNDED.items() if any(name in mesh for mesh in meshes.values())]
    quantities = [LIMITS[limit].quantity for limit in columns]
    groups = {group: [meshes[name] for name in names] for group, names in groups_of(meshes).items()}
    rows = [
        [Judged(group), *(_worst_cell(groups[group], limit, limits) for limit in columns)]
        for group in sorted(groups, key=lambda group: room(groups[group]))
    ]
    if any("p5" in limits.get(limit, {}) for limit in columns):
        ranges = [_range(limits.get(limit, {}), limit) for limit in columns]
        rows.append([Judged("5 to 95 % of samples, worst mesh"), *ranges])
    bounds = [limits.get(limit, {}).get("limit") for limit in columns]
    required = [
        "" if bound is None else f"≥ {quantity.written(bound)}"
        for quantity, bound in zip(quantities, bounds, strict=True)
    ]
    rows.append([Judged("required"), *map(Judged, required)])
    heads = [f"{one.label.rstrip(',')} {one.symbol or one.unit}" for one in quantities]
    return holds_table(HEADING, ([Judged(""), *map(Judged, heads)],), rows)


def _worst_cell(meshes: Sequence[Mapping[str, Any]], limit: str, limits: Mapping[str, Any]) -> Judged:
    values = [mesh[_BOUNDED[limit]] for mesh in meshes if _BOUNDED[limit] in mesh]
    endless = limit == "life" and bool(shorter_life(*meshes).get("life_unlimited"))
    return judged_cell(min(values, default=None), limit, limits, unlimited=endless)


def room(meshes: Sequence[Mapping[str, Any]]) -> float:
    """The smallest value over what is required of it: how far meshes are from their limits."""
    limits = [(name, limit) for mesh in meshes for name, limit in mesh.get("limits", {}).items()]
    over = [limit["value"] / limit["limit"] for name, limit in limits if name in _BOUNDED]
    return min(over, default=math.inf)
