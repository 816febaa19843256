"""What is wrong with damage of single teeth: keys, places on flank and face, cracks."""

from collections.abc import Iterator, Mapping, Sequence
from math import pi
from typing import NamedTuple

import numpy as np

from tribodyn.compliance.crack import Crack, ligament_to_bore, root_thickness, tangent_limits
from tribodyn.compliance.energy import LoadedTooth, loaded_tooth
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Side
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.path import radius
from tribodyn.input.tables.gears.drive_data import drive_of
from tribodyn.input.tables.gears.single_teeth import EDGE, DamageTable, GearPlace, MissingTable, angles_of

#: Angle of a crack to the tooth's axis that the formula is for, and how far it leans to either side.
_LEAST_ANGLE, _LARGEST_ANGLE = pi / 6, pi / 2
_SLACK = 1e-9
#: Thicknesses of the root by which a crack stays away from the bore.
_NEAREST = 0.1

_EXAMPLE = {"depth": '"1.5 mm"', "length": '"2 mm"', "diameter": '"1 mm"', "factor": "2.0", "height": "0.5"}


class _Kind(NamedTuple):
    """Keys beside gear, tooth, kind and face."""

    needed: tuple[str, ...]
    optional: tuple[str, ...]


_KINDS = {
    "crack": _Kind(("depth",), ("flank", "angle", "tangent", "deepest", "width")),
    "spall": _Kind(("depth", "length", "height"), ("flank", "radius", "width", "shape", "edge", "map")),
    "pit": _Kind(("depth", "diameter", "height"), ("flank", "radius", "edge")),
    "broken-tip": _Kind(("height",), ("radius", "width", "edge")),
    "scuffing": _Kind(("factor", "length", "height"), ("flank", "radius", "width", "shape", "edge")),
}
_OWN_KEYS = ("gear", "tooth", "kind", "face")


def broken_damage(
    tables: Sequence[DamageTable], gears: Mapping[str, GearPlace], first: int = 0
) -> Iterator[InputError]:
    """Go through what is wrong with damage; the drives of the gears have passed their rules.

    `gears` by their names; `first` is the number of the first table in the scenario.
    """
    for number, table in enumerate(tables, start=first):
        key = f"damage.{number}"
        if table.gear not in gears:
            yield unknown_name(f"{key}.gear", table.gear, list(gears), "gear")
            continue
        gear = gears[table.gear]
        if not 1 <= table.tooth <= gear.table.teeth:
            rule, remedy = f"{table.gear} has {gear.table.teeth} teeth", f"use 1 to {gear.table.teeth}"
            yield InputError(f"{key}.tooth", table.tooth, rule, remedy)
            continue
        if broken := list(_keys(key, table)) or list(_on_face(key, table, gear)):
            yield from broken
            continue
        drive, side = gear.touched(gear.flank(table))
        try:
            assembly = check(family(drive.family), drive_of(drive))
        except InputError as error:  # teeth that cannot be made have no place for damage
            yield error
            return
        if table.kind == "crack":
            yield from _crack(key, table, loaded_tooth(assembly, side))
        elif table.map is None:
            yield from _on_flank(key, table, assembly, side)


def _keys(key: str, table: DamageTable) -> Iterator[InputError]:
    needed, optional = _KINDS[table.kind]
    present = {name for name in type(table).model_fields if getattr(table, name) is not None}
    by_map = table.map is not None and table.kind == "spall"
    if by_map:
        needed, optional = (), ("flank", "map")
    if "radius" in present and "radius" in optional:
        needed = tuple(name for name in needed if name != "height")
    for name in needed:
        if name not in present:
            remedy = f"add {name} = {_EXAMPLE[name]}"
            yield InputError(
                f"{key}.{name}", rule=f"missing: kind = {quoted(table.kind)} needs it", remedy=remedy
            )
    for name in sorted(present - {*needed, *optional, *_OWN_KEYS}):
        rule = "contradicts map" if by_map else f"kind = {quoted(table.kind)} has no such key"
        if name == "height" and "radius" in present:
            rule = "contradicts radius, which says the same"
        yield InputError(f"{key}.{name}", None, rule, "leave it out")
    if table.height is not None and not 0.0 <= table.height <= 1.0:
        rule = "height runs from 0 at the root's end of the path of contact to 1 at the tip's"
        yield InputError(f"{key}.height", table.height, rule, "use 0 to 1")


def _on_face(key: str, table: DamageTable, gear: GearPlace) -> Iterator[InputError]:
    half = gear.table.face_width / 2.0
    if table.map is not None:
        yield from _map(key, table.map, half)
        return
    width = table.diameter if table.kind == "pit" else table.width
    outer = abs(table.face) + (0.0 if width is None else width / 2.0)
    if outer > half * (1.0 + _SLACK):
        rule = f"it reaches {1e3 * outer:.4g} mm from the middle of a face of {2e3 * half:.4g} mm"
        name = "face" if table.face else ("diameter" if table.kind == "pit" else "width")
        remedy = f"keep abs(face) + half the width within {1e3 * half:.4g} mm"
        yield InputError(f"{key}.{name}", f"{1e3 * getattr(table, name):.4g} mm", rule, remedy)
    edge = EDGE if table.edge is None else table.edge
    sizes = [size for size in (table.length, width) if size is not None]
    if table.kind in ("spall", "pit", "scuffing") and sizes and edge > min(sizes) / 2.0:
        rule = f"the edge is wider than half the patch, {1e3 * min(sizes):.3g} mm"
        remedy = f'write edge = "{1e3 * min(sizes) / 4.0:.3g} mm"'
        yield InputError(f"{key}.edge", f"{1e3 * edge:.3g} mm", rule, remedy)


def _map(key: str, table: MissingTable, half: float) -> Iterator[InputError]:
    height, face, depth = table.in_si()
    sizes = len(np.unique(height)), len(np.unique(face))
    if not np.all((height >= 0.0) & (height <= 1.0)):
        rule = "height runs from 0 at the root's end of the path of contact to 1 at the tip's"
        worst = height[(height < 0.0) | (height > 1.0)][0]
        yield InputError(f"{key}.map", f"height {worst:g}", rule, "scale it")
    elif not np.all(np.abs(face) <= half * (1.0 + _SLACK)):
        rule = f"face is the place from the middle of the face, which is {2e3 * half:.4g} mm wide"
        yield InputError(
            f"{key}.map", f"face {1e3 * np.max(np.abs(face)):g} mm", rule, "measure from the middle"
        )
    elif not np.all(depth >= 0.0):
        rule = "depth is what is missing"
        yield InputError(f"{key}.map", f"depth {1e6 * depth.min():g} um", rule, "use 0 where nothing is")
    elif len(height) != sizes[0] * sizes[1] or len(set(zip(height, face, strict=True))) != len(height):
        rule = f"{len(height)} points, not one for each of {sizes[0]} of height and {sizes[1]} of face"
        yield InputError(f"{key}.map", None, rule, "measure at the same places on the face at every height")


def _crack(key: str, table: DamageTable, tooth: LoadedTooth) -> Iterator[InputError]:
    crack = Crack(table.depth or 0.0, *angles_of(table))
    low, high = tangent_limits(tooth)
    low = max(low, 0.0)
    if not low < crack.tangent < high:
        rule = f"the fillet leans {np.degrees(low):.3g} to {np.degrees(high):.3g} deg to the tooth's axis"
        remedy = f'write tangent = "{np.degrees(low + high) / 2.0:.3g} deg"'
        yield InputError(f"{key}.tangent", f"{np.degrees(crack.tangent):.3g} deg", rule, remedy)
        return
    if not _LEAST_ANGLE * (1.0 - _SLACK) <= crack.angle <= _LARGEST_ANGLE * (1.0 + _SLACK):
        rule = "a crack leads from the fillet across the tooth, 30 to 90 deg to its axis"
        remedy = f'write angle = "{np.degrees(pi / 2 - crack.tangent):.3g} deg", normal to the fillet'
        yield InputError(f"{key}.angle", f"{np.degrees(crack.angle):.3g} deg", rule, remedy)
    thickness = root_thickness(tooth, crack.tangent)
    if crack.depth >= thickness:
        rule = f"the tooth is {1e3 * thickness:.3g} mm thick where the crack starts, and would be off"
        remedy = f'use at most "{1e3 * thickness / 2.0:.3g} mm", half of it, up to which it is known'
        yield InputError(f"{key}.depth", f"{1e3 * crack.depth:.3g} mm", rule, remedy)
    elif (ligament := ligament_to_bore(tooth, crack)) < _NEAREST * thickness:
        rule = "the crack reaches the bore" if ligament < 0.0 else "the crack ends at the bore"
        remedy = f'use at most "{1e3 * (crack.depth + ligament - _NEAREST * thickness):.3g} mm"'
        yield InputError(f"{key}.depth", f"{1e3 * crack.depth:.3g} mm", rule, remedy)


def _on_flank(key: str, table: DamageTable, assembly: Assembly, side: Side) -> Iterator[InputError]:
    """Whether a patch lies on the part of the flank that the mate touches."""
    tooth, path = loaded_tooth(assembly, side), assembly.path_of(side)
    ends = assembly.limits if side == "pinion" else tuple(-limit for limit in reversed(assembly.limits))
    distance = np.linspace(float(ends[0]), float(ends[1]), 400)
    at = tooth.contact(distance)
    length = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(at.x), np.diff(at.y)))])
    reach = np.abs(np.asarray(radius(path, distance)))
    low, high = sorted((float(reach[0]), float(reach[-1])))
    if table.radius is not None and not low * (1.0 - _SLACK) <= table.radius <= high * (1.0 + _SLACK):
        rule = f"off the flank, which is touched from {1e3 * low:.5g} to {1e3 * high:.5g} mm"
        yield InputError(f"{key}.radius", f"{1e3 * table.radius:.5g} mm", rule, "place it there")
        return
    if table.kind == "broken-tip":
        return
    size = (table.diameter if table.kind == "pit" else table.length) or 0.0
    order = np.argsort(reach)
    middle = (
        np.interp(table.height or 0.0, (distance - distance[0]) / (distance[-1] - distance[0]), length)
        if table.radius is None
        else np.interp(table.radius, reach[order], length[order])
    )
    below, above = middle - size / 2.0, middle + size / 2.0
    if below < -_SLACK or above > length[-1] + _SLACK:
        name = "diameter" if table.kind == "pit" else "length"
        rule = (
            f"off the flank: it reaches from {1e3 * below:.3g} to {1e3 * above:.3g} mm along the profile, "
            f"of which 0 to {1e3 * length[-1]:.3g} mm are touched"
        )
        fits = 2.0 * min(middle, length[-1] - middle)
        remedy = f'use at most "{1e3 * fits:.3g} mm", or move it' if fits > 1e-5 else "move it"
        yield InputError(f"{key}.{name}", f"{1e3 * size:.3g} mm", rule, remedy)
