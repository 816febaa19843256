"""Speeds and torques: from REXS to [operating] and [[duty]]."""

from collections.abc import Mapping
from typing import NamedTuple

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.file.model import Component, LoadCase
from tribodyn.exchange.rexs.file.sheet import Sheet
from tribodyn.exchange.rexs.reading.draft import Draft, text
from tribodyn.exchange.rexs.reading.shafts import masses_on


class Ends(NamedTuple):
    """Where power enters and leaves, and which way the input turns."""

    load: Component  # the external load whose torque is known
    fast: Component  # the shaft whose speed is known
    input: Component  # shafts
    output: Component
    torque_at_input: bool
    speed_at_input: bool
    sense: int  # of the input about the axis of the gear unit


def _value(
    sheet: Sheet, case: LoadCase | None, part: Component, key: rexs.RexsKey
) -> tuple[Component, float] | None:
    """A value of a part in a load case, else its own."""
    for each in (*(case.parts if case is not None else ()), part):
        if each.number == part.number and (value := sheet.si(each, key)) is not None:
            return each, value
    return None


def transmitting(sheet: Sheet) -> list[tuple[Component, Component]]:
    """Loads that transmit torque, each with its shaft."""
    found = []
    for load in sheet.model.of_type("external_load"):
        shafts = sheet.model.related("assembly", "part", load.number, "assembly", "shaft")
        transmits = sheet.truth(load, rexs.TRANSMITS)
        if transmits is None:
            cases: tuple[LoadCase | None, ...] = sheet.model.cases or (None,)
            transmits = any((_value(sheet, case, load, rexs.TORQUE) or (load, 0.0))[1] for case in cases)
        if transmits and shafts:
            found.append((load, shafts[0]))
    return found


def ends_of(sheet: Sheet, speeds: Mapping[int, float]) -> Ends:
    """Where power enters and leaves; `speeds`: shaft -> speed over that of the first of them, signed."""
    loads = transmitting(sheet)
    shafts = {shaft.number: shaft for _, shaft in loads}
    if len(shafts) != 2:
        there = ", ".join(f"{load} on {shaft}" for load, shaft in loads) or "none"
        rule = f"torque is transmitted at {len(shafts)} shafts, two are taken: {there}"
        raise sheet.refused("external_load", rule, "one load where power enters and one where it leaves")
    case = sheet.model.cases[0] if sheet.model.cases else None
    told = [(load, shaft, value[1]) for load, shaft in loads if (value := _torque(sheet, case, load))]
    fast = [
        (shaft, value[1])
        for shaft in sheet.model.of_type("shaft")
        if (value := _value(sheet, case, shaft, rexs.SPEED)) and value[1]
    ]
    told.sort(key=lambda each: sheet.truth(each[0], rexs.DEFINES_TORQUE) is False)
    fast.sort(
        key=lambda each: (sheet.truth(each[0], rexs.DEFINES_SPEED) is not True, each[0].number not in shafts)
    )
    if not told or not fast:
        what = rexs.TORQUE.name if not told else rexs.SPEED.name
        raise sheet.refused("external_load" if not told else "shaft", f"no {what} is given", "add it")
    load, loaded, torque = told[0]
    quick, speed = fast[0]
    for number in (loaded.number, quick.number):
        if number not in speeds:
            raise sheet.refused(
                sheet.model.parts[number], "no gear links it with the input", "check the relations"
            )
    other = next(shaft for number, shaft in shafts.items() if number != loaded.number)
    drives = torque * speed * speeds[loaded.number] / speeds[quick.number] > 0
    drives = torque > 0 if _torque_key(sheet, case, load) is rexs.POWER else drives
    into, out = (loaded, other) if drives else (other, loaded)
    if out.number not in speeds or into.number not in speeds:
        raise sheet.refused(out, "no gear links it with the input", "check the relations")
    # an end, or a shaft that turns as fast as one
    fast_ends = [abs(speeds[each.number] / speeds[quick.number]) for each in (into, out)]
    if 1.0 not in fast_ends:
        rule = "its speed is known, but power neither enters nor leaves there"
        raise sheet.refused(quick, rule, "give that of an end", rexs.SPEED.name)
    sense = speed * speeds[into.number] / speeds[quick.number]
    return Ends(load, quick, into, out, drives, fast_ends[0] == 1.0, 1 if sense > 0 else -1)


def _torque_key(sheet: Sheet, case: LoadCase | None, load: Component) -> rexs.RexsKey:
    return rexs.TORQUE if _value(sheet, case, load, rexs.TORQUE) else rexs.POWER


def _torque(sheet: Sheet, case: LoadCase | None, load: Component) -> tuple[Component, float] | None:
    for key in (rexs.TORQUE, rexs.POWER):
        found = _value(sheet, case, load, key)
        if found is not None and found[1]:
            return found
    return None


def put_operating(draft: Draft, ends: Ends, names: Mapping[int, str]) -> None:
    """Write [operating], and [[duty]] of every load case; `names`: what shafts are called in the scenario."""
    sheet = draft.sheet
    cases = sheet.model.cases
    draft.table("[operating]")
    for key, shaft in (("input", ends.input), ("output", ends.output)):
        draft.put(key, text(_end(draft, shaft, names)))
    draft.put("sense", text("counter-clockwise" if ends.sense > 0 else "clockwise"))
    warm = [_oil_of(sheet, case) for case in cases or (None,)]
    if warm[0] is None:
        draft.assume("oil_temperature", '"60 degC"')
    draft.put("oil_temperature", warm[0])
    if not cases:
        _put_case(draft, ends, None)
        return
    draft.put("duty", "1", f"of {len(cases)} load cases" if len(cases) > 1 else "")
    unit = next(iter(sheet.model.of_type("gear_unit")), None)
    for case in cases:
        draft.table("[[duty]]", case.name)
        told = None
        for part in (*case.parts, *([unit] if unit else ())):
            if unit is not None and part.number == unit.number and told is None:
                hours = sheet.si(part, rexs.HOURS)
                told = sheet.toml(part, rexs.SHARE) or (f"{hours / 3600:.12g}" if hours else None)
        if told is None:
            draft.assume("share", "1.0", "not in the file: all load cases last equally long")
        draft.put("share", told)
        _put_case(draft, ends, case)
        own = _oil_of(sheet, case)
        draft.put("oil_temperature", own if own != warm[0] else None)


def _end(draft: Draft, shaft: Component, names: Mapping[int, str]) -> str:
    """What the scenario calls an end: the body at the load's place, else the gear or the shaft."""
    sheet = draft.sheet
    for load, its in transmitting(sheet):
        place = sheet.si(load, rexs.U_ON_SHAFT) if its is shaft else None
        for mass in masses_on(sheet, shaft):
            there = sheet.si(mass, rexs.U_ON_SHAFT) or 0.0
            if mass.number in draft.bodies and place is not None and abs(there - place) < 1e-6:
                return draft.name(mass)
        if its is shaft:
            sheet.leave(load, rexs.U_ON_SHAFT, "torque enters and leaves at gears and bodies")
    return names[shaft.number]


def _put_case(draft: Draft, ends: Ends, case: LoadCase | None) -> None:
    sheet = draft.sheet
    speed, torque = _value(sheet, case, ends.fast, rexs.SPEED), _torque(sheet, case, ends.load)
    if speed is None or torque is None or not speed[1]:
        what = ends.load if torque is None else ends.fast
        raise sheet.refused(
            what, f"{case.name if case else 'the file'} gives no speed or no torque", "add it"
        )
    end = "input" if ends.speed_at_input else "output"
    draft.put(f"{end}_speed", (sheet.toml(speed[0], rexs.SPEED) or "").replace('"-', '"'))
    own = ends.input if ends.torque_at_input else ends.output
    key = _torque_key(sheet, case, ends.load)
    way = "power" if key is rexs.POWER else f"{'input' if own is ends.input else 'output'}_torque"
    draft.put(way, (sheet.toml(torque[0], key) or "").replace('"-', '"'))
    first = sheet.model.cases[0] if sheet.model.cases else None
    if _flow(sheet, case, ends) != _flow(sheet, first, ends):
        rule = f"its torque or speed reverses in {case.name if case else 'the file'}"
        raise sheet.refused(ends.load, rule, "import load cases of one direction")


def _oil_of(sheet: Sheet, case: LoadCase | None) -> str | None:
    """The temperature of the oil in a load case, else that of the casing."""
    oil = next(iter(sheet.model.of_type("gear_casing")), None)
    warm = None
    for part in (*(case.parts if case is not None else ()), *([oil] if oil else ())):
        if oil is not None and part.number == oil.number and warm is None:
            warm = sheet.toml(part, rexs.OIL_TEMPERATURE)
    return warm


def _flow(sheet: Sheet, case: LoadCase | None, ends: Ends) -> tuple[bool, bool]:
    """Signs of speed and of torque or power."""
    speed, torque = _value(sheet, case, ends.fast, rexs.SPEED), _torque(sheet, case, ends.load)
    return (speed or (None, 0.0))[1] > 0, (torque or (None, 0.0))[1] > 0
