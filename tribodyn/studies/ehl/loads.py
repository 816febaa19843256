"""The loads of a pair along its way: quasi-static ones, given ones, and those of a record."""

from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.numerics.shapes import Array
from tribodyn.post.cycles import last_cycles
from tribodyn.record.reader import open_record

KEY = "contact.loads"
#: By how much of the whole way the ends of given loads may miss those of the contact.
_SAME_WAY = 0.02


def quasi_static_loads(
    cycle: MeshCycle, gear_torque: float, friction: tuple[Array, Array] | None
) -> tuple[Array, Array]:
    """Roll angles of the table's nodes, and the load of the pair that is there; in order of the angle.

    Nodes on both sides of a boundary share an angle and keep the order of time. `friction`: roll angles and
    friction coefficients there; None: frictionless.
    """
    pairs = cycle.front_pairs
    age = np.asarray(cycle.phase)[:, :, None] + np.arange(pairs - 1.0, -1.0, -1.0)
    roll = float(cycle.roll_start) + float(cycle.pitch_angle) * age
    signed = None
    if friction is not None:
        # the pinion slides ahead of the gear behind the pitch point, which the pair passes at roll angle zero
        signed = np.zeros(np.shape(cycle.compliance))
        signed[:, :, :pairs] = np.sign(roll) * np.interp(roll, *friction)
    load = np.asarray(quasi_static(cycle, gear_torque, signed).normal_load)[:, :, :pairs]
    touching = np.broadcast_to(np.asarray(cycle.in_contact)[:, None, :pairs] > 0, load.shape)
    # a pair passes through the phases as the youngest, then once more as the one before
    roll, load, touching = (np.moveaxis(values, 2, 0)[::-1] for values in (roll, load, touching))
    return roll[touching], load[touching]


def given_loads(loads: tuple[Array, Array], cycle: MeshCycle) -> tuple[Array, Array]:
    """Return given loads, those below 0 as 0.

    Raises
    ------
    InputError
        If they are those of another way of contact, or nowhere positive.
    """
    roll, load = loads
    start, end = float(cycle.roll_start), float(cycle.roll_end)
    if max(abs(roll[0] - start), abs(roll[-1] - end)) > _SAME_WAY * (end - start):
        rule = (
            f"for roll angles {_degrees(roll[0], roll[-1])}, where a pair touches at {_degrees(start, end)}"
        )
        raise InputError(
            KEY, None, rule, "give loads of this drive over its whole contact, from the pitch point"
        )
    if not np.any(load > 0.0):
        raise InputError(KEY, None, "nowhere above 0: there is no contact to solve", "give loads that press")
    return roll, np.maximum(load, 0.0)


def _degrees(start: float, end: float) -> str:
    return f"{np.degrees(start):.4g} … {np.degrees(end):.4g}°"


def loads_of_record(path: Path, key: str) -> dict[str, Any]:
    """Loads of the last pair that passed through the whole mesh in a simulation over time, as columns.

    Raises
    ------
    InputError
        If the file is no such record, or too short.
    """

    def bad(rule: str, remedy: str) -> InputError:
        return InputError(key, quoted(path.name), rule, remedy, str(path))

    try:
        opened = open_record(path)
    except InputError as error:
        raise bad(error.rule, error.remedy) from None
    with opened as record:
        if record.axis != "time" or "normal_load" not in record or "mesh_cycle" not in record.groups:
            raise bad("holds no loads of pairs over time", "give the record of a gear pair's simulation")
        cycle, numbers = record.mesh_cycle, np.asarray(record["pair"])
        ratio = float(cycle["contact_ratio"])
        window = last_cycles(record, int(np.ceil(ratio)))
        if window.phase[-1] < ratio:
            raise bad("ends before a pair has passed through the mesh", "let it run for more mesh cycles")
        age = window.phase[window.phase <= ratio]
        load = np.asarray(record["normal_load"])[window.part][: len(age)]
    # the pair that entered with the first sample is number 1, then 0, then -1
    column = np.searchsorted(numbers, 1 - np.floor(age + 1e-9).astype(int))
    roll = float(cycle["roll_start"]) + 2.0 * np.pi / float(cycle["pinion_teeth"]) * age
    values = np.nan_to_num(load[np.arange(len(age)), column])
    return {
        "roll_angle": {"unit": "rad", "values": list(map(float, roll))},
        "normal_load": {"unit": "N", "values": [float(value) for value in values]},
    }
