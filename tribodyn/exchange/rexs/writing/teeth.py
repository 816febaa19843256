"""Gears: from the tables of a scenario to components with flanks, tools, modifications, materials."""

import math
from collections.abc import Mapping
from typing import Any

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.writing.builder import ModelText, si, value_in

#: Basic racks of ISO 53: addendum, dedendum, rounding.
_RACKS = {"A": (1.0, 1.25, 0.38), "B": (1.0, 1.25, 0.3), "C": (1.0, 1.25, 0.25), "D": (1.0, 1.4, 0.39)}


def said(table: Mapping[str, Any], keys: tuple[rexs.RexsKey, ...]) -> dict[rexs.RexsKey, Any]:
    """The attributes that a table has the keys of."""
    return {key: value_in(table[key.key], key) for key in keys if table.get(key.key) is not None}


def common_of(tables: Mapping[str, Any], name: str) -> dict[str, Any]:
    """A gear's table with what the scenario says of all gears, and its stage of its teeth."""
    gear = {
        key: tables[key] for key in ("material", "mean_roughness", "quality") if tables.get(key) is not None
    }
    gear |= {key: value for key, value in tables["gear"][name].items() if value is not None}
    stage = stage_of(tables, name)
    rack = _RACKS.get(str(stage.get("rack") or "")[-1:])
    if rack is not None:
        gear = dict(zip(("addendum", "dedendum", "fillet_radius"), rack, strict=True)) | gear
    if gear.get("internal") and not {"addendum", "tip_diameter", "tip_radius"} & gear.keys():
        gear["addendum"] = 1.0
    if gear.get("mean_roughness") is None and stage.get("roughness") is not None:
        gear["mean_roughness"] = f"{si(stage['roughness'], 'um') / math.sqrt(math.pi):.12g} um"
    for radius, diameter in (("tip_radius", "tip_diameter"), ("bore_radius", "bore_diameter")):
        if gear.get(radius) is not None:
            gear[diameter] = f"{2e3 * si(gear[radius]):.12g} mm"
    return gear


def stage_of(tables: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """The first stage that a gear is in."""
    for stage in tables["stage"]:
        if name in (*stage.get("gears", ()), *(stage.get(member) for member in ("sun", "planet", "ring"))):
            return stage
    return {}


def hand(tables: Mapping[str, Any], name: str) -> int:
    """1 right, -1 left: the gear's own, or what follows from those that it meshes with."""
    hands = {
        each: {"right": 1, "left": -1}[gear["hand"]]
        for each, gear in tables["gear"].items()
        if gear.get("hand")
    }
    for _ in range(len(tables["gear"]) + 1):
        for stage in tables["stage"]:
            if stage.get("type", "pair") == "pair":
                pairs = [tuple(stage["gears"])]
            else:
                pairs = [(stage["sun"], stage["planet"]), (stage["planet"], stage["ring"])]
            for first, second in pairs:
                inside = any(tables["gear"][each].get("internal") for each in (first, second))
                for one, other in ((first, second), (second, first)):
                    if one in hands and other not in hands:
                        hands[other] = hands[one] if inside else -hands[one]
    if name not in hands and stage_of(tables, name).get("helix_angle"):
        driver = next(iter(tables["gear"]))
        return hand(
            {**tables, "gear": tables["gear"] | {driver: tables["gear"][driver] | {"hand": "right"}}}, name
        )
    return hands.get(name, 1)


class GearText:
    """Writes gears; materials that are the same are one component."""

    def __init__(self, model: ModelText, tables: Mapping[str, Any]) -> None:
        self.model, self.tables = model, tables
        self._materials: dict[str, int] = {}

    def gear(self, name: str, called: str = "") -> int:
        """Add a gear with its flanks, its tool and its material; its id."""
        model, gear, stage = self.model, common_of(self.tables, name), stage_of(self.tables, name)
        internal = bool(gear.get("internal"))
        number = model.add("ring_gear" if internal else "cylindrical_gear", called or name)
        helix = value_in(stage["helix_angle"], rexs.HELIX_ANGLE) if stage.get("helix_angle") else 0.0
        angle = value_in(stage.get("pressure_angle") or "20 deg", rexs.PRESSURE_ANGLE)
        values = {
            rexs.NUMBER_OF_TEETH: gear["teeth"],
            rexs.NORMAL_MODULE: value_in(stage["module"], rexs.NORMAL_MODULE),
            rexs.HELIX_ANGLE: float(helix) * hand(self.tables, name) + 0.0,
            rexs.FACE_WIDTH: value_in(gear["face_width"], rexs.FACE_WIDTH),
        }
        values |= said(gear, (rexs.TIP_DIAMETER, rexs.QUALITY, *rexs.GEAR))
        if gear.get("thickness_code") is not None:
            values[rexs.THICKNESS_CODE] = gear["thickness_code"]
        elif gear.get("thickness_allowance") is not None:
            along = math.cos(math.radians(float(angle)))
            upper = si(gear["thickness_allowance"], "um")
            values[rexs.UPPER_SPAN] = float(f"{upper * along:.12g}")
            if gear.get("thickness_tolerance") is not None:
                lower = upper - si(gear["thickness_tolerance"], "um")
                values[rexs.LOWER_SPAN] = float(f"{lower * along:.12g}")
        modified = {key: value for key, value in (gear.get("modification") or {}).items() if _counts(value)}
        if modified:
            values[rexs.DATUM_FACE] = "negative"
        for key, value in values.items():
            model.put(number, key, value)
        self._flanks(number, gear, angle, modified)
        if gear.get("material"):
            model.relate("reference", origin=number, referenced=self.material(gear["material"]))
        return number

    def _flanks(self, number: int, gear: Mapping[str, Any], angle: Any, modified: Mapping[str, Any]) -> None:
        model = self.model
        shift = gear.get("profile_shift") or 0.0
        if gear.get("profile_shift_of") == "gap":
            shift = -shift
        values = {rexs.PRESSURE_ANGLE: angle, rexs.PROFILE_SHIFT: float(shift)} | said(gear, rexs.FLANK)
        left, right = (model.add("cylindrical_gear_flank", "", values) for _ in range(2))
        model.relate("flank", gear=number, left=left, right=right)
        keys, sort = (
            (rexs.CUTTER, "cutter_wheel_tool") if gear.get("internal") else (rexs.RACK, "rack_shaped_tool")
        )
        tool = said(gear, keys)
        if tool:
            made = model.add(sort, "", tool)
            for flank in (left, right):
                settings = model.add("cylindrical_gear_manufacturing_settings")
                model.relate(
                    "manufacturing_step", 1, workpiece=flank, tool=made, manufacturing_settings=settings
                )
        for part in _modifications(model, modified, gear["face_width"]):
            for flank in (left, right):
                model.relate("reference", origin=flank, referenced=part)

    def material(self, table: Mapping[str, Any]) -> int:
        """The component of a material."""
        if str(table) not in self._materials:
            values = said(table, rexs.MATERIAL)
            values[rexs.MATERIAL_NAME] = str(table.get("title", "own values"))
            if table.get("treatment") in rexs.TREATMENTS:
                values[rexs.TREATMENT] = rexs.TREATMENTS[table["treatment"]]
            self._materials[str(table)] = self.model.add("material", str(table.get("title", "")), values)
        return self._materials[str(table)]


def _counts(value: Any) -> bool:
    """Whether a modification is one."""
    return not (
        isinstance(value, str) and value[:1].isdecimal() and float(value.split()[0]) == 0.0
    ) and value not in (False, [], {})


def _modifications(model: ModelText, table: Mapping[str, Any], width: Any) -> list[int]:
    found = []
    for kind, keys in rexs.RELIEFS.items():
        if table.get(kind) is not None:
            shape = {rexs.RELIEF_SHAPE: table.get(f"{kind}_shape", "linear")}
            found.append(model.add(kind, "", said(table, keys) | shape))
    unmodified = table.get("lead_unmodified")
    for kind, (depth, length) in rexs.END_RELIEFS.items() if unmodified is not None else ():
        if table.get(depth.key) is not None:
            reach = (si(width, "mm") - si(unmodified, "mm")) / 2.0
            values = {depth: value_in(table[depth.key], depth), length: float(f"{reach:.12g}")}
            found.append(model.add(kind, "", values | {rexs.RELIEF_SHAPE: "parabolic"}))
    ends = {key: table.get(key.key, table.get("crowning")) for key in rexs.CROWNING}
    if unmodified is None and any(value is not None for value in ends.values()):
        amounts = {key: value_in(value or "0 um", key) for key, value in ends.items()}
        found.append(model.add("helix_crowning", "", amounts | {rexs.CROWNING_SHAPE: "parabolic"}))
    if table.get("helix_slope") is not None:
        found.append(
            model.add("helix_slope", "", {rexs.HELIX_SLOPE: value_in(table["helix_slope"], rexs.HELIX_SLOPE)})
        )
    return found
