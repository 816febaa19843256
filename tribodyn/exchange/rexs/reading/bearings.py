"""Bearings: from REXS to [[shaft.drawn.bearing]], and to the springs of [bearings.NAME]."""

import math
from typing import NamedTuple

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.file.sheet import Sheet
from tribodyn.exchange.rexs.reading.draft import UNKNOWN, Draft, text

BEARINGS = (
    "rolling_bearing_with_catalog_geometry",
    "rolling_bearing_with_detailed_geometry",
    "concept_bearing",
)
#: Stiffness that REXS calls rigid begins here; what stands for it; what stands for one that is not said. N/m
RIGID, STIFF, TYPICAL = 1e12, 1e10, 5e8
#: The same of springs against tilts and twists, N m/rad.
RIGID_TILT, STIFF_TILT = 1e11, 1e9
#: The same of what holds a member of a set against rotation: that of a wind turbine has 1e11 N m/rad.
RIGID_SUPPORT = 1e14
#: Types with rollers, with a contact angle that is needed, with a direction of thrust.
_ROLLERS = "cylindrical-roller", "needle-roller", "tapered-roller", "spherical-roller"
_ANGLED = (
    "angular-contact-ball",
    "four-point-contact-ball",
    "self-aligning-ball",
    "tapered-roller",
    "spherical-roller",
)
_NO_WAY = "cylindrical-roller", "needle-roller"
_ONE_WAY = "angular-contact-ball", "tapered-roller"
#: Those that hold both ways and may slide.
_BOTH_WAYS = "deep-groove-ball", "four-point-contact-ball", "self-aligning-ball", "spherical-roller"


class Support(NamedTuple):
    """A bearing of a shaft."""

    bearing: Component
    place: float | None  # m, from the start of the shaft
    other: Component | None  # what it stands in


def supports_of(sheet: Sheet, shaft: Component) -> list[Support]:
    """The bearings of a shaft, along it."""
    found = []
    for bearing in sheet.model.of_type(*BEARINGS):
        inner, outer = (
            sheet.model.related("side", "assembly", bearing.number, role)
            for role in ("inner_part", "outer_part")
        )
        for parts, others, key in ((inner, outer, rexs.U_INNER), (outer, inner, rexs.U_OUTER)):
            if shaft in parts:
                found.append(Support(bearing, sheet.si(bearing, key), others[0] if others else None))
    return sorted(found, key=lambda each: each.place or 0.0)


def put_bearing(draft: Draft, support: Support, place: float, sense: int) -> None:
    """Write a bearing of a drawn shaft, `place` m from its start; `sense`: whether the shaft runs along u."""
    sheet, bearing = draft.sheet, support.bearing
    draft.table("[[shaft.drawn.bearing]]", bearing.name)
    draft.put("position", f'"{1e3 * place:.12g} mm"')
    named = {name: kind for kind, names in rexs.BEARING_TYPES.items() for name in names}
    said = sheet.text(bearing, rexs.BEARING_TYPE)
    kind = named.get(said or "")
    if said is not None and kind is None:
        sheet.leave(bearing, rexs.BEARING_TYPE, "no such type in a scenario: springs stand for it")
    sizes = {} if kind is None else _sizes(sheet, bearing, kind)
    if kind in _ONE_WAY and sizes and not _thrust(sheet, bearing, sense):
        draft.change(
            bearing, f"the direction in which a {kind} bearing holds is not in the file: springs stand for it"
        )
        sizes = {}
    if kind is None or not sizes:
        _put_springs(draft, bearing, kind)
        return
    draft.put("type", text(kind), sheet.text(bearing, rexs.DESIGNATION) or "")
    sheet.truth(bearing, rexs.RADIAL_ABSORPTION)
    for key, value in sizes.items():
        draft.put(key, value)
    for rating in rexs.RATINGS:
        if rating.key not in sizes and sheet.si(bearing, rating):
            draft.put(rating.key, sheet.toml(bearing, rating))
    if not sheet.si(bearing, rexs.RATINGS[3]):
        draft.suggest("contamination_factor", "0.5")
    held = sheet.text(bearing, rexs.AXIAL_ABSORPTION)
    if kind in _ONE_WAY:
        for key, value in _thrust(sheet, bearing, sense).items():
            draft.put(key, value)
        if sheet.si(bearing, rexs.PRELOAD):
            draft.put("preload", sheet.toml(bearing, rexs.PRELOAD))
        elif sheet.si(bearing, rexs.PRELOAD_FORCE):
            draft.put("preload_force", sheet.toml(bearing, rexs.PRELOAD_FORCE))
        return
    if sheet.si(bearing, rexs.CLEARANCE) is not None:
        draft.put("clearance", sheet.toml(bearing, rexs.CLEARANCE))
    if kind in _BOTH_WAYS and held == "no_direction":
        draft.put("locating", "false")
    elif kind in _BOTH_WAYS and held in ("positive", "negative"):
        draft.change(bearing, f"takes axial force in the direction {held} alone; here both ways")
    elif kind not in _BOTH_WAYS and held not in (None, "no_direction"):
        draft.change(bearing, f"a {kind} bearing takes no axial force here; in the file {held}")


def _rows(sheet: Sheet, bearing: Component) -> list[Component]:
    return sheet.model.related("assembly", "assembly", bearing.number, "part", "rolling_bearing_row")


def _thrust(sheet: Sheet, bearing: Component, sense: int) -> dict[str, str]:
    """Which way a bearing with a contact angle holds the shaft; nothing where the file does not say it.

    What takes force towards -u stands at the end of smaller u of a pair in X arrangement.
    """
    ways = {"positive": sense, "negative": -sense}
    held, rows = sheet.text(bearing, rexs.AXIAL_ABSORPTION), _rows(sheet, bearing)
    of_rows = [sheet.text(row, rexs.ROW_ABSORPTION) for row in rows]
    count = max(len(rows), sheet.whole(bearing, rexs.ROWS) or 1)
    if count == 1:
        return {"thrust": text("+z" if ways[held] > 0 else "-z")} if held in ways else {}
    distance = sheet.toml(bearing, rexs.ROW_DISTANCE) if sheet.si(bearing, rexs.ROW_DISTANCE) else None
    pair = {("negative", "positive"): "X", ("positive", "negative"): "O"}.get(tuple(of_rows), "")  # type: ignore[call-overload]
    if distance is None or count > 2 or not pair:
        return {}
    sliding = {"locating": "false"} if held == "no_direction" else {}
    return {"arrangement": text(pair), "row_distance": distance, **sliding}


def _sizes(sheet: Sheet, bearing: Component, kind: str) -> dict[str, str]:
    """The inside of a bearing, or what its catalogue says; nothing where neither is complete."""
    rows = _rows(sheet, bearing)
    found: dict[str, str] = {}
    if kind in _ANGLED:
        angle = _contact_angle(sheet, bearing, rows)
        if angle is None:
            return {}
        found["contact_angle"] = angle
    if max(len(rows), sheet.whole(bearing, rexs.ROWS) or 1) == 2 and kind in _NO_WAY:
        if not sheet.si(bearing, rexs.ROW_DISTANCE):
            return {}
        found |= {"rows": "2", "row_distance": sheet.toml(bearing, rexs.ROW_DISTANCE) or ""}
    elements = (
        sheet.model.related("assembly", "assembly", rows[0].number, "part", "rolling_element") if rows else []
    )
    if elements:
        keys = rexs.ELEMENT if kind in _ROLLERS else rexs.ELEMENT[:1]
        inside = {key.key: sheet.toml(rows[0], key) for key in rexs.ROW}
        inside |= {key.key: sheet.toml(elements[0], key) for key in keys}
        if all(inside.values()):
            return found | {key: value for key, value in inside.items() if value is not None}
    catalogue = {"bore": sheet.toml(bearing, rexs.INNER), "outside_diameter": sheet.toml(bearing, rexs.OUTER)}
    catalogue[rexs.RATINGS[1].key] = (
        sheet.toml(bearing, rexs.RATINGS[1]) if sheet.si(bearing, rexs.RATINGS[1]) else None
    )
    if None in catalogue.values() or kind == "needle-roller":
        return {}
    return found | {key: value for key, value in catalogue.items() if value is not None}


def _contact_angle(sheet: Sheet, bearing: Component, rows: list[Component]) -> str | None:
    """Of its rows, else from e = 1.5 tan α of the catalogue."""
    if rows and sheet.si(rows[0], rexs.CONTACT_ANGLE):
        return sheet.toml(rows[0], rexs.CONTACT_ANGLE)
    limit = sheet.si(bearing, rexs.E_OF_CATALOGUE)
    return f'"{math.degrees(math.atan(limit / 1.5)):.6g} deg"' if limit else None


def _put_springs(draft: Draft, bearing: Component, kind: str | None) -> None:
    """Springs: the file's, or for what it leaves open a typical stiffness."""
    sheet = draft.sheet
    if kind is not None:
        name = sheet.text(bearing, rexs.DESIGNATION) or bearing.name
        lacking = (
            "bore, outside diameter and ratings"
            if kind not in _ANGLED
            else "bore, outside diameter, ratings, contact angle"
        )
        draft.suggest(
            "type", text(kind), f"{name}: {lacking} are not in the file; with them in place of the springs"
        )
    if sheet.truth(bearing, rexs.RADIAL_ABSORPTION) is not False:
        value = sheet.si(bearing, rexs.RADIAL_STIFFNESS)
        for axis in ("stiffness_x", "stiffness_y"):
            _put_spring(draft, bearing, axis, value)
    if sheet.text(bearing, rexs.AXIAL_ABSORPTION) in ("positive", "negative", "both_directions"):
        _put_spring(draft, bearing, "stiffness_axial", sheet.si(bearing, rexs.AXIAL_STIFFNESS))
        if sheet.text(bearing, rexs.AXIAL_ABSORPTION) != "both_directions":
            draft.change(bearing, "takes axial force one way alone; here its spring holds both ways")
    tilt = sheet.si(bearing, rexs.TILT_STIFFNESS)
    if tilt:
        _put_limited(draft, bearing, "stiffness_tilt", tilt)


def _put_spring(draft: Draft, bearing: Component, key: str, value: float | None) -> None:
    if not value:
        draft.assume(key, f'"{TYPICAL:g} N/m"')
    else:
        _put_limited(draft, bearing, key, value)


def _put_limited(draft: Draft, part: Component, key: str, value: float) -> None:
    """Write a stiffness, SI; what is rigid is as stiff as is of use, and listed as changed."""
    tilts = key == "stiffness_tilt"
    rigid, most, unit = (RIGID_TILT, STIFF_TILT, "N*m/rad") if tilts else (RIGID, STIFF, "N/m")
    if value >= rigid:
        draft.change(part, f"is rigid; here {key} = {most:g} {unit}")
    shown, comment = (most, "rigid in the file") if value >= rigid else (value, "")
    draft.put(key, f'"{shown:.9g} {unit}"', comment)


def put_springs_of(draft: Draft, name: str, supports: list[Support]) -> None:
    """Write [bearings.NAME], what holds a shaft that is not drawn: the sum of its bearings."""
    sheet, parts = draft.sheet, [each.bearing for each in supports]
    draft.table(f"[bearings.{name}]", ", ".join(part.name for part in parts))
    across = [part for part in parts if sheet.truth(part, rexs.RADIAL_ABSORPTION) is not False]
    stiffness = [sheet.si(part, rexs.RADIAL_STIFFNESS) for part in across]
    along = [
        sheet.si(part, rexs.AXIAL_STIFFNESS) or 0.0
        for part in parts
        if sheet.text(part, rexs.AXIAL_ABSORPTION) not in (None, "no_direction")
    ]
    tilt = [sheet.si(part, rexs.TILT_STIFFNESS) or 0.0 for part in parts]
    if across and all(stiffness):
        put_stiffness(draft, parts[0], sum(value or 0.0 for value in stiffness), sum(along), sum(tilt))
    else:
        for key in ("stiffness_x", "stiffness_y"):
            draft.assume(key, f'"{TYPICAL:g} N/m"', "floats: does not count" if not across else UNKNOWN)
        put_stiffness(draft, parts[0], 0.0, sum(along), sum(tilt))
    draft.assume("damping_ratio", "0.05")


def put_stiffness(draft: Draft, part: Component, across: float, along: float, tilt: float) -> None:
    """Write the stiffness of springs, SI, that stand for a part and those beside it; 0: nothing."""
    for direction, value in {"x": across, "y": across, "axial": along, "tilt": tilt}.items():
        if value:
            _put_limited(draft, part, f"stiffness_{direction}", value)


def hold_across(sheet: Sheet, supports: list[Support]) -> bool:
    """Whether bearings hold what they carry in x and y."""
    return any(sheet.truth(each.bearing, rexs.RADIAL_ABSORPTION) is not False for each in supports)
