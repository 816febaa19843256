"""What must hold of the clutches and brakes of a train, and their data."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.studies.motion.case import HOUSING, ClutchData
from tribodyn.studies.motion.drivetrain.structure import ClutchPart, Structure
from tribodyn.studies.motion.drivetrain.tables import GROUND, Clutch
from tribodyn.train.joints import joined
from tribodyn.train.kinematics import TrainSpeeds

_TORQUES = "torque", "torque_table"
_FORCES = "normal_force", "normal_force_table"
_OF_FORCE = {"friction_coefficient": "0.12", "effective_radius": '"60 mm"'}
#: Slip speed over which the static torque falls off, in reversal speeds, where none is given.
STATIC_SPEEDS = 10.0


def broken_clutch(key: str, clutch: Clutch) -> Iterator[InputError]:
    """Go through what is missing or said twice of the capacity of a clutch, and of its friction."""
    given = [name for name in (*_TORQUES, *_FORCES) if getattr(clutch, name) is not None]
    if not given:
        rule = "missing: what the clutch can transmit"
        yield InputError(
            f"{key}.torque", None, rule, 'add torque = "200 N*m", or torque_table = "closing.csv"'
        )
    elif len(given) > 1:
        yield InputError(f"{key}.{given[1]}", None, f"contradicts {given[0]}", "give the one or the other")
    elif given[0] in _FORCES:
        for name, example in _OF_FORCE.items():
            if getattr(clutch, name) is None:
                rule = f"missing: {given[0]} needs it"
                yield InputError(f"{key}.{name}", None, rule, f"add {name} = {example}")
    else:
        for name in _OF_FORCE:
            if getattr(clutch, name) is not None:
                rule = f"contradicts {given[0]}, which is the whole torque"
                yield InputError(f"{key}.{name}", None, rule, "leave it out, or give normal_force")
    for name in ("torque_table", "normal_force_table"):
        curve = getattr(clutch, name)
        if curve is not None and np.min(least := curve.in_si()[1]) < 0.0:
            rule = f"falls to {np.min(least):.3g}: what presses the faces together cannot be negative"
            yield InputError(
                f"{key}.{name}", None, rule, "end it at 0; friction finds its direction by itself"
            )
    if clutch.static_speed is not None and clutch.static_speed < clutch.reversal_speed:
        rule = f"is below reversal_speed, {clutch.reversal_speed:g} rad/s, over which friction sets in"
        yield InputError(f"{key}.static_speed", f"{clutch.static_speed:g} rad/s", rule, "give at least that")
    if clutch.slip is not None and GROUND in clutch.ends:
        rule = "is of clutches: a brake slips as its body turns"
        yield InputError(f"{key}.slip", f"{clutch.slip:g} rad/s", rule, "leave it out")


def refuse_meshing_beyond(parts: Structure, motion: TrainSpeeds, *, prescribed: bool) -> None:
    """Raise InputError where teeth mesh on both sides of a clutch, or what it parts cannot be started so.

    Phases of all meshes follow the rotation of the reference body, from which a clutch that slips parts what
    is beyond it. With a prescribed speed the rotation of the reference is.
    """
    pairs = [(parts.gears[one].body, parts.gears[two].body) for one, two in (m.gears for m in parts.meshes)]
    pairs += [ends for _, ends in parts.springs()]
    for own in parts.sets:
        members = own.turning()
        pairs += [(members.carrier, body) for body in (*members.central, *members.planets)]
    group = joined(len(parts.bodies), pairs)
    reference = group[motion.bodies[0]]
    beyond = next(
        (mesh for mesh in parts.meshes if group[parts.gears[mesh.gears[0]].body] != reference), None
    )
    if beyond is not None:
        clutch = next(one for one in parts.clutches if one.ends[1] >= 0 and _parts(one, group))
        rule = f"parts the meshes: {beyond.name} turns otherwise than the others while it slips"
        remedy = "put the clutch where all gears are on one side of it, such as between motor and gearbox"
        raise InputError(f"{clutch.key}.ends", " and ".join(clutch.table.ends), rule, remedy)
    new = {body: number for number, body in enumerate(motion.bodies)}
    for one in parts.clutches:
        if not motion.ratio[new[one.ends[0]]]:
            rule = f"{parts.bodies[one.ends[0]].name} does not turn, and nothing can slip on it"
            raise InputError(f"{one.key}.ends", " and ".join(one.table.ends), rule, "name a body that turns")
    source = motion.bodies[motion.input]
    if prescribed and group[source] != reference:
        rule = "prescribes the rotation of the gears, and a clutch parts these from the input"
        remedy = 'let a motor drive it: source = "torque" with speed_regulation'
        raise InputError("operating.source", quoted("speed"), rule, remedy)
    slips: dict[int, str] = {}
    for one in parts.clutches:
        if one.table.slip is None:
            continue
        if not _parts(one, group):
            rule = "is of a clutch that parts bodies: these are joined by springs or teeth too"
            raise InputError(f"{one.key}.slip", f"{one.table.slip:g} rad/s", rule, "leave it out")
        beyond_it = max(group[one.ends[0]], group[one.ends[1]], key=lambda number: number != reference)
        if slips.setdefault(beyond_it, one.key) != one.key:
            rule = f"is said by {slips[beyond_it]} too, which slips with it"
            raise InputError(f"{one.key}.slip", f"{one.table.slip:g} rad/s", rule, "say it once")


def _parts(clutch: ClutchPart, group: list[int]) -> bool:
    return clutch.ends[1] >= 0 and group[clutch.ends[0]] != group[clutch.ends[1]]


def clutch_data(part: ClutchPart, new: Mapping[int, int]) -> ClutchData:
    """The data of a clutch that breaks no rule; `new`: number of each body in the train's order."""
    table = part.table
    ends = new[part.ends[0]], HOUSING if part.ends[1] < 0 else new[part.ends[1]]
    curve: Any = table.torque_table or table.normal_force_table
    constant = table.torque if table.normal_force is None else table.normal_force
    times, values = curve.in_si() if curve is not None else (np.zeros(1), np.array([constant]))
    if table.normal_force is not None or table.normal_force_table is not None:
        values = values * (table.friction_coefficient or 0.0) * (table.effective_radius or 0.0) * table.faces
    static = table.static_speed or STATIC_SPEEDS * table.reversal_speed
    friction = table.static_ratio, static, table.reversal_speed
    return ClutchData(part.name, part.key, ends, (times, values), *friction, table.slip)
