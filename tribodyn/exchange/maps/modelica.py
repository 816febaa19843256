"""A map as a Modelica package in one file: a gearbox of our own, and the standard library's LossyGear.

Modelica Standard Library 4, of which it takes connectors and `Rotational.Components.LossyGear`.
"""

import re
from collections.abc import Mapping
from importlib import resources
from string import Template
from typing import Any

import numpy as np

from tribodyn.exchange.format import MAP, ExchangeFormat, Exported, Written, deviation
from tribodyn.exchange.heading import heading
from tribodyn.exchange.maps.chosen import (
    CHOICES,
    DAMPING_RATIO,
    TORQUE,
    at_temperature,
    celsius,
    damping_ratio,
    identifier,
    inertia,
    nominal,
    numbers,
    read_numbers,
    shares,
    stiffness,
)
from tribodyn.exchange.maps.lossy_gear import drag_of_table, fitted_table, one_sided
from tribodyn.record.loss_map import GridValues, LossMap

#: Share of the largest speed below which friction is smoothed through standstill.
_SMALL = 1e-3
#: What concerns LossyGear in the template.
_LOSSY_GEAR = re.compile(r"  constant Real lossTable.*?;\n|  model Lossy .*?end Lossy;\n\n", re.DOTALL)
#: Duration of the example over the time in which the torque would bring its inertia to the fan's speed.
_RISES = 5.0
_AXES = {"oilTemperatures": "oil_temperature", "torques": "torque", "speeds": "speed"}


class _At(Template):
    delimiter = "@"


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """The package; its tables are read back and compared."""
    losses = exported.losses
    temperature, drag = at_temperature(exported, choices)
    torque = nominal(exported, "torque", choices, losses.torque)
    spring = stiffness(exported, torque)
    at_output = inertia(exported) / losses.ratio**2
    ratio = damping_ratio(exported, choices)
    fan_speed = abs(losses.ratio) * (np.abs(losses.speed).max() or 1.0)
    twist, twist_torque = _characteristic(losses, spring)
    order, amplitude, phase = _errors(losses, torque)
    table = fitted_table(losses, drag)
    values: dict[str, Any] = {
        "name": identifier(name),
        "file": exported.path.name.replace("\\", "/").replace('"', "'"),
        "ratio": f"{losses.ratio:.12g}",
        **{part: numbers(getattr(losses, part)) for part in _AXES.values()},
        "drag": numbers(losses.total),
        "twist": numbers(twist),
        "twist_torque": numbers(twist_torque),
        "order": numbers(order),
        "amplitude": numbers(amplitude),
        "phase": numbers(phase),
        "loss_table": numbers(np.zeros((1, 5)) if table is None else table),
        "temperature": celsius(temperature),
        "inertia": f"{inertia(exported):.9g}",
        "damping": f"{2 * ratio * np.sqrt(spring * at_output):.9g}",
        "backlash": f"{_backlash(losses):.9g}",
        "small": f"{_SMALL * np.abs(losses.speed).max() or 1e-3:.9g}",
        "motor": f"{1.2 * abs(losses.ratio * torque):.9g}",
        "fan": f"{abs(torque):.9g}",
        "fan_speed": f"{fan_speed:.9g}",
        "duration": f"{_RISES * 11 * at_output * fan_speed / (abs(torque) or 1.0):.3g}",
        "oil": f"{temperature:.9g}",
    }
    text = _At(_template(with_lossy_gear=table is not None)).substitute(values)
    axes = tuple(read_numbers(text, axis) for axis in _AXES)
    drags = GridValues(axes, read_numbers(text, "drags"))(*losses.points)
    found = [deviation("drag at the input (Gearbox)", "N m", drags, losses.total)]
    remarks = [f"damping {ratio:.3g} of critical for the gearbox's own inertia and its stiffness"]
    if table is None:
        remarks.append("it locks itself where the load drives: LossyGear cannot hold that, and is left out")
    else:
        read = drag_of_table(losses, read_numbers(text, "lossTable"))
        over = f"all loads and speeds of the map at {celsius(temperature)} oil"
        weights = shares(losses.torque, losses.speed)
        found.append(deviation("drag at the input (Lossy)", "N m", read, drag, over, weights))
        if one_sided(losses):
            remarks.append("the map has loads of one sign only: Lossy loses as much under the others")
    if amplitude.any():
        unknown = "" if losses.error_phase.size else "; the map has no phases of it, here they are 0"
        remarks.append(f"transmission error as at {torque:.6g} N m{unknown}")
    else:
        remarks.append("the map has no transmission error with orders of its meshes: there is none in it")
    if not losses.backlash > 0.0:
        remarks.append("the map has no backlash: there is none in it")
    return Written({".mo": heading(exported, "// ", found, remarks) + text}, tuple(found), tuple(remarks))


def _template(*, with_lossy_gear: bool) -> str:
    text = resources.files(__package__ or "").joinpath("modelica.mo").read_text(encoding="utf-8")
    return text if with_lossy_gear else _LOSSY_GEAR.sub("", text)


def _backlash(losses: LossMap) -> float:
    return losses.backlash if np.isfinite(losses.backlash) else 0.0


def _characteristic(losses: LossMap, spring: float) -> tuple[np.ndarray, np.ndarray]:
    """Twist at the output and torque, to both sides of the backlash."""
    sound = np.isfinite(losses.stiffness) & (losses.stiffness > 0.0)
    loads = np.union1d(np.abs(losses.torque), [0.0])
    known = losses.torque[sound]
    ends = []
    for sign in (-1.0, 1.0):
        tangent = np.interp(sign * loads, known, losses.stiffness[sound])
        step = np.diff(loads) * 0.5 * (1.0 / tangent[1:] + 1.0 / tangent[:-1])
        ends.append(sign * (0.5 * _backlash(losses) + np.append(0.0, np.cumsum(step))))
    torque = np.concatenate([-loads[::-1], loads])
    twist = np.concatenate([ends[0][::-1], ends[1]])
    if len(loads) == 1:
        return np.array([-1.0, 1.0]) / spring, np.array([-1.0, 1.0])
    keep = np.append(True, np.diff(twist) > 0.0)
    return twist[keep], torque[keep]


def _errors(losses: LossMap, torque: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Order, amplitude and phase of every harmonic of every mesh, at a torque."""
    if not losses.error_amplitude.size or not losses.mesh_order.size:
        return np.zeros(1), np.zeros(1), np.zeros(1)
    near = int(np.argmin(np.abs(losses.torque - torque)))
    amplitude = losses.error_amplitude[:, near]
    phase = losses.error_phase[:, near] if losses.error_phase.size else np.zeros_like(amplitude)
    order = losses.mesh_order[:, None] * np.arange(1, amplitude.shape[1] + 1)
    return order.ravel(), amplitude.ravel(), phase.ravel()


FORMAT = ExchangeFormat(
    "modelica",
    "package in one file: a gearbox with loss map, stiffness, backlash, error, heat port; a LossyGear",
    (".mo",),
    takes=(MAP,),
    write=write,
    choices={**CHOICES, **TORQUE, **DAMPING_RATIO},
)
