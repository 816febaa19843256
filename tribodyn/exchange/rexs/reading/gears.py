"""Gears and their stages: from REXS to the tables [gear.NAME] and [[stage]]."""

import math
from collections.abc import Sequence

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.file.sheet import Sheet
from tribodyn.exchange.rexs.reading.draft import Draft, text
from tribodyn.exchange.rexs.reading.frames import line_of_centres
from tribodyn.exchange.rexs.reading.materials import material_of

GEARS = "cylindrical_gear", "ring_gear"
_FLANKS = "cylindrical_gear_flank", "flank_geometry"
_TURNED = {"lead_relief_start": "lead_relief_end", "lead_relief_end": "lead_relief_start"}
#: How far what both flanks, or both gears, say may differ.
_NEAR = 1e-9


def stages_of(sheet: Sheet) -> list[tuple[Component, Component, Component]]:
    """Every cylindrical stage with its two gears."""
    found = []
    for stage in sheet.model.of_type("cylindrical_stage"):
        first, second = (
            sheet.model.related("stage", "stage", stage.number, role) for role in ("gear_1", "gear_2")
        )
        if len(first) != 1 or len(second) != 1:
            raise sheet.refused(stage, "has not two gears", "add a relation stage with gear_1 and gear_2")
        for gear in (first[0], second[0]):
            if gear.type not in GEARS:
                raise sheet.refused(gear, f"is no gear of {stage}", "name a cylindrical_gear or ring_gear")
        found.append((stage, first[0], second[0]))
    return found


def flanks_of(sheet: Sheet, gear: Component) -> list[Component]:
    """The left and the right flank of a gear, as far as the file has them."""
    left, right = (
        sheet.model.related("flank", "gear", gear.number, role, *_FLANKS) for role in ("left", "right")
    )
    return [*left, *right]


def of_both_flanks(sheet: Sheet, gear: Component, key: rexs.RexsKey) -> Component | None:
    """The flank to read an attribute from; both flanks must say the same."""
    flanks = [flank for flank in flanks_of(sheet, gear) if sheet.number(flank, key) is not None]
    values = [sheet.si(flank, key) or 0.0 for flank in flanks]
    if values and max(values) - min(values) > _NEAR:
        rule = "differs from that of the other flank: gears with different flanks are not taken"
        raise sheet.refused(flanks[-1], rule, "let both say the same", key.name)
    return flanks[0] if flanks else None


def common(sheet: Sheet, stage: Component, gears: Sequence[Component], key: rexs.RexsKey) -> str | None:
    """What the gears of a stage say alike of their teeth, as a scenario writes it, without sign."""
    told = [(sheet.si(gear, key), gear) for gear in gears]
    said = [(abs(value), gear) for value, gear in told if value is not None]
    for value, gear in said[1:]:
        if abs(value - said[0][0]) > _NEAR:
            rule = f"differs from that of {said[0][1]}: gears of {stage} need the same"
            raise sheet.refused(gear, rule, "let both say the same", key.name)
    shown = sheet.toml(said[0][1], key) if said else None
    return shown.replace('"-', '"') if shown is not None else None


def hand_of(sheet: Sheet, gear: Component) -> int:
    """1 right, -1 left, 0 spur: a positive helix angle is right-handed (ISO 21771)."""
    angle = sheet.si(gear, rexs.HELIX_ANGLE) or 0.0
    return 0 if angle == 0.0 else 1 if angle > 0 else -1


def check_hands(sheet: Sheet, stage: Component, first: Component, second: Component) -> None:
    """Refuse hands that cannot mesh: external gears have opposite ones, a ring that of what runs in it."""
    inside = "ring_gear" in (first.type, second.type)
    hands = hand_of(sheet, first), hand_of(sheet, second)
    if hands[0] != (hands[1] if inside else -hands[1]):
        words = {1: "right-handed", -1: "left-handed", 0: "a spur gear"}
        needed = "the same hand as its ring" if inside else "opposite hands"
        rule = f"{first} is {words[hands[0]]}, {second} {words[hands[1]]}: parallel axes need {needed}"
        raise sheet.refused(stage, rule, f"check the sign of {rexs.HELIX_ANGLE.name}")


def put_gear(draft: Draft, gear: Component, called: str = "gear") -> None:
    """Write the table of a gear."""
    sheet = draft.sheet
    internal = gear.type == "ring_gear"
    name = draft.name(gear)
    draft.table(f"[{called}.{name}]", gear.name if gear.name != name else "")
    teeth = sheet.whole(gear, rexs.NUMBER_OF_TEETH)
    width = sheet.toml(gear, rexs.FACE_WIDTH)
    for key, value in ((rexs.NUMBER_OF_TEETH, teeth), (rexs.FACE_WIDTH, width)):
        if value is None:
            raise sheet.refused(gear, f"{key.name} missing", "add it")
    draft.put("teeth", str(abs(teeth or 0)))
    draft.put("face_width", width)
    draft.put("internal", "true" if internal else None)
    hand = hand_of(sheet, gear)
    draft.put("hand", text("right" if hand > 0 else "left") if hand else None)
    _put_shift(draft, gear)
    _put_tip(draft, gear, abs(teeth or 0), internal)
    tip = draft.lines[-1].startswith("tip_diameter")
    for key in rexs.FLANK:
        flank = of_both_flanks(sheet, gear, key)
        draft.put(key.key, sheet.toml(flank, key) if flank is not None and not tip else None)
        for each in flanks_of(sheet, gear) if tip else ():
            sheet.leave(each, key, f"{rexs.TIP_DIAMETER.name} goes before")
    for key in rexs.GEAR:
        draft.put(key.key, sheet.toml(gear, key))
    _put_roughness(draft, gear)
    _put_tool(draft, gear)
    _put_thickness(draft, gear)
    quality = sheet.whole(gear, rexs.QUALITY)
    draft.put("quality", str(quality) if quality is not None else None)
    draft.put("material", material_of(draft, gear))
    _put_modification(draft, gear)


def _put_shift(draft: Draft, gear: Component) -> None:
    flank = of_both_flanks(draft.sheet, gear, rexs.PROFILE_SHIFT)
    if flank is not None:
        draft.put("profile_shift", draft.sheet.toml(flank, rexs.PROFILE_SHIFT))
    else:
        draft.suggest("profile_shift", "0.0", "not in the file: none")


def _put_tip(draft: Draft, gear: Component, teeth: int, internal: bool) -> None:
    """The tip diameter, where it is one: writers put 1 mm where they know none."""
    sheet = draft.sheet
    tip, module = sheet.si(gear, rexs.TIP_DIAMETER), sheet.si(gear, rexs.NORMAL_MODULE) or 0.0
    if tip is None:
        if internal and not any(of_both_flanks(sheet, gear, key) for key in rexs.FLANK):
            draft.assume("addendum", "0.9", "no tip diameter in the file: clear of its planets' fillets")
        return
    helix = sheet.si(gear, rexs.HELIX_ANGLE) or 0.0
    reference = teeth * module / math.cos(helix)
    if abs(abs(tip) - reference) > 4 * module or (abs(tip) > reference + 2 * module and internal):
        sheet.leave(
            gear, rexs.TIP_DIAMETER, f"no tip diameter of a reference diameter of {1e3 * reference:.6g} mm"
        )
        return
    draft.put("tip_diameter", (sheet.toml(gear, rexs.TIP_DIAMETER) or "").replace('"-', '"'))


def _put_roughness(draft: Draft, gear: Component) -> None:
    """Ra from Rz where the file has no Ra: a sixth of it, as ISO 6336-2 takes it."""
    sheet = draft.sheet
    if sheet.found(gear, rexs.ROUGHNESS) is None and (rz := sheet.si(gear, rexs.ROUGHNESS_RZ)):
        draft.put("mean_roughness", f'"{1e6 * rz / 6.0:.6g} um"')
        draft.change(gear, f"Rz = {1e6 * rz:.6g} µm as Ra = Rz/6")


def _put_tool(draft: Draft, gear: Component) -> None:
    """Tooth root from the tool that cuts it: the first one of a series."""
    sheet = draft.sheet
    tools = sheet.model.related(
        "reference", "origin", gear.number, "referenced", "rack_shaped_tool", "cutter_wheel_tool"
    )
    for flank in flanks_of(sheet, gear)[:1]:
        tools += sheet.model.related(
            "manufacturing_step", "workpiece", flank.number, "tool", "rack_shaped_tool", "cutter_wheel_tool"
        )
    for tool in tools[:1]:
        cutter = tool.type == "cutter_wheel_tool"
        if cutter and gear.type != "ring_gear":
            continue
        for key in rexs.CUTTER if cutter else rexs.RACK:
            draft.put(
                key.key, sheet.toml(tool, key), tool.name if key in (rexs.CUTTER[0], rexs.RACK[0]) else ""
            )


def _put_thickness(draft: Draft, gear: Component) -> None:
    sheet = draft.sheet
    code = sheet.text(gear, rexs.THICKNESS_CODE)
    upper, lower = sheet.si(gear, rexs.UPPER_SPAN), sheet.si(gear, rexs.LOWER_SPAN)
    if code is not None:
        draft.put("thickness_code", text(code))
        for key in (rexs.UPPER_SPAN, rexs.LOWER_SPAN):
            sheet.leave(gear, key, f"{rexs.THICKNESS_CODE.name} goes before")
    elif upper is not None:
        flank = of_both_flanks(sheet, gear, rexs.PRESSURE_ANGLE)
        along = math.cos(
            (sheet.si(flank, rexs.PRESSURE_ANGLE) if flank is not None else None) or math.radians(20)
        )
        draft.put("thickness_allowance", f'"{1e6 * upper / along:.9g} um"')
        if lower is not None and lower < upper:
            draft.put("thickness_tolerance", f'"{1e6 * (upper - lower) / along:.9g} um"')


def _put_modification(draft: Draft, gear: Component) -> None:
    """What is taken off the flanks; both are read, the left one is written."""
    sheet = draft.sheet
    written: dict[str, str | None] = {}
    turned = sheet.text(gear, rexs.DATUM_FACE) == "positive"
    for number, flank in enumerate(flanks_of(sheet, gear)):
        found: dict[str, str | None] = {}
        parts = sheet.model.related("reference", "origin", flank.number, "referenced")
        for part in parts:
            found |= _modification(sheet, part)
        _add_end_reliefs(draft, gear, [part for part in parts if part.type in rexs.END_RELIEFS], found)
        if turned:  # the datum face is at the end of larger z
            found = {_TURNED.get(key, key): value for key, value in found.items()}
            if (slope := found.get("helix_slope")) is not None:
                found["helix_slope"] = (
                    slope.replace('"-', '"') if slope[1] == "-" else slope.replace('"', '"-', 1)
                )
        if number and found != written:
            draft.change(gear, "the modification of the left flank stands for that of both")
        written = written or found
    draft.modified_spur |= bool(written) and hand_of(sheet, gear) == 0
    if written:
        draft.lines.append(
            "modification = { " + ", ".join(f"{key} = {value}" for key, value in written.items()) + " }"
        )


def _modification(sheet: Sheet, part: Component) -> dict[str, str | None]:
    found: dict[str, str | None] = {}
    if part.type in rexs.RELIEFS:
        found = {key.key: sheet.toml(part, key) for key in rexs.RELIEFS[part.type]}
        shape = sheet.text(part, rexs.RELIEF_SHAPE)
        if shape in ("linear", "parabolic"):
            found[f"{part.type}_shape"] = text(shape)
        elif shape is not None:
            sheet.leave(part, rexs.RELIEF_SHAPE, "linear and parabolic reliefs are known")
    elif part.type == "helix_crowning":
        found = {key.key: sheet.toml(part, key) for key in rexs.CROWNING}
        if sheet.text(part, rexs.CROWNING_SHAPE) not in (None, "parabolic"):
            sheet.leave(part, rexs.CROWNING_SHAPE, "a parabola stands for it")
    elif part.type == "helix_slope":
        found = {"helix_slope": sheet.toml(part, rexs.HELIX_SLOPE)}
    return {key: value for key, value in found.items() if value is not None}


def _add_end_reliefs(
    draft: Draft, gear: Component, parts: Sequence[Component], found: dict[str, str | None]
) -> None:
    """Reliefs of the ends of the face: scenarios have parabolas of one length, without crowning."""
    sheet = draft.sheet
    if not parts:
        return
    width, reliefs = sheet.si(gear, rexs.FACE_WIDTH) or 0.0, [rexs.END_RELIEFS[part.type] for part in parts]
    lengths = [sheet.si(part, length) for part, (_, length) in zip(parts, reliefs, strict=True)]
    length = lengths[0]
    why = ""
    if length is None or not 0.0 < length <= width / 2.0 or any(each != length for each in lengths):
        why = "end reliefs of one length, up to half the face, are known"
    elif any(key.key in found for key in rexs.CROWNING):
        why = "helix_crowning goes before"
    if why or length is None:
        for part, keys in zip(parts, reliefs, strict=True):
            for key in keys:
                sheet.leave(part, key, why)
        return
    for key in rexs.CROWNING:
        found[key.key] = '"0 um"'
    for part, (depth, _) in zip(parts, reliefs, strict=True):
        found[depth.key] = sheet.toml(part, depth) or '"0 um"'
        if (shape := sheet.text(part, rexs.RELIEF_SHAPE)) not in (None, "parabolic"):
            draft.change(gear, f"a parabola stands for the {shape} relief of an end of its face")
    found["lead_unmodified"] = f'"{1e3 * (width - 2.0 * length):.9g} mm"'


def put_stage(draft: Draft, stage: Component, first: Component, second: Component) -> None:
    """Write a stage of two gears."""
    sheet = draft.sheet
    check_hands(sheet, stage, first, second)
    draft.table("[[stage]]", stage.name)
    draft.put("name", text(draft.name(stage)))
    draft.put("gears", f"[{text(draft.name(first))}, {text(draft.name(second))}]")
    line = line_of_centres(sheet, stage, first, second)
    put_teeth(draft, stage, (first, second), line.distance)
    if line.azimuth is not None:
        draft.put("azimuth", f'"{math.degrees(line.azimuth):.12g} deg"')


def put_teeth(draft: Draft, stage: Component, gears: Sequence[Component], distance: float | None) -> None:
    """Write what the gears of a stage have alike."""
    sheet = draft.sheet
    module, helix = (
        common(sheet, stage, gears, rexs.NORMAL_MODULE),
        common(sheet, stage, gears, rexs.HELIX_ANGLE),
    )
    if module is None:
        raise sheet.refused(gears[0], f"{rexs.NORMAL_MODULE.name} missing", "add it")
    flanks = [
        flank for gear in gears if (flank := of_both_flanks(sheet, gear, rexs.PRESSURE_ANGLE)) is not None
    ]
    angle = common(sheet, stage, flanks, rexs.PRESSURE_ANGLE)
    draft.put("module", module)
    if angle is None:
        draft.assume("pressure_angle", '"20 deg"')
    draft.put("pressure_angle", angle)
    draft.put("helix_angle", None if helix is None or hand_of(sheet, gears[0]) == 0 else helix)
    draft.put("centre_distance", None if distance is None else f'"{1e3 * distance:.12g} mm"')
