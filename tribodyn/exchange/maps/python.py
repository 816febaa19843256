"""A map of losses as a Python module that imports nothing but the standard library."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.exchange.format import MAP, ExchangeFormat, Exported, Written, deviation
from tribodyn.exchange.heading import heading

_CODE = '''
from bisect import bisect_right

RATIO = {ratio!r}
OIL_TEMPERATURE = {oil_temperature}
TORQUE = {torque}
SPEED = {speed}
DRAG = (
{drag}
)


def drag(torque, speed, oil_temperature):
    """Loss as a torque at the input, N m: linear between the points, constant beyond the ends."""
    corners = [(1.0, ())]
    for axis, value in ((OIL_TEMPERATURE, oil_temperature), (TORQUE, torque), (SPEED, speed)):
        if len(axis) == 1:
            corners = [(weight, (*place, 0)) for weight, place in corners]
            continue
        value = min(max(value, axis[0]), axis[-1])
        number = min(bisect_right(axis, value), len(axis) - 1)
        part = (value - axis[number - 1]) / (axis[number] - axis[number - 1])
        corners = [
            (weight * share, (*place, at))
            for weight, place in corners
            for share, at in ((1.0 - part, number - 1), (part, number))
        ]
    return sum(weight * DRAG[t][m][n] for weight, (t, m, n) in corners)


def power_loss(torque, speed, oil_temperature):
    """Loss, W."""
    return drag(torque, speed, oil_temperature) * abs(speed)


def torque_at_input(torque, speed, oil_temperature):
    """Torque at the input in the direction of its motion, N m."""
    return abs(RATIO) * torque + drag(torque, speed, oil_temperature)


def efficiency(torque, speed, oil_temperature):
    """Power out over power in, whichever end drives; 0 or less: it locks itself."""
    load, lost = abs(RATIO) * torque, drag(torque, speed, oil_temperature)
    return load / (load + lost) if load > 0.0 else 1.0 - lost / -load
'''


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """The module; it is run, and its drag compared at every point."""
    losses = exported.losses

    def listed(values: np.ndarray) -> str:
        return "(" + "".join(f"{value:.9g}, " for value in values) + ")"

    tables = (
        "    (\n" + "".join(f"        {listed(row)},\n" for row in part) + "    )," for part in losses.total
    )
    axes = {axis: listed(getattr(losses, axis)) for axis in ("oil_temperature", "torque", "speed")}
    code = _CODE.format(ratio=losses.ratio, drag="\n".join(tables), **axes)
    module: dict[str, Any] = {}
    exec(compile(code, name, "exec"), module)
    read = [
        module["drag"](m, n, t) for t, m, n in zip(*(part.ravel() for part in losses.points), strict=True)
    ]
    found = (deviation("drag at the input", "N m", np.reshape(read, losses.total.shape), losses.total),)
    top = heading(exported, "", found).rstrip().replace("\\", "/").replace('"', "'")
    units = "Torques in N m, speeds in rad/s, temperatures in K."
    return Written({".py": f'"""{top}\n{units}\n"""\n{code}'}, found)


FORMAT = ExchangeFormat(
    "python",
    "Python module that looks the losses up; it imports nothing but the standard library",
    (".py",),
    takes=(MAP,),
    write=write,
)
