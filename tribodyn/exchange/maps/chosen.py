"""What a format that holds less than a map takes from it: one oil temperature, one load, a damping ratio."""

import json
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.exchange.format import Exported, FormatChoice

OIL_TEMPERATURE = "oil_temperature"
CHOICES = {OIL_TEMPERATURE: FormatChoice("temperature", "of the oil; default: the middle of the map's axis")}
DAMPING_RATIO = {
    "damping_ratio": FormatChoice("number", "of the gearbox on its stiffness; default: the scenario's")
}
TORQUE = {"torque": FormatChoice("torque", "at the output; default: the nominal one")}
SPEED = {"speed": FormatChoice("angular speed", "of the input; default: the nominal one")}


def at_temperature(exported: Exported, choices: Mapping[str, float]) -> tuple[float, np.ndarray]:
    """Oil temperature, K, and total drag (torque, speed) at it."""
    losses = exported.losses
    temperature = choices.get(OIL_TEMPERATURE, float(np.median(losses.oil_temperature)))
    within(exported, OIL_TEMPERATURE, temperature, losses.oil_temperature)
    torque, speed = np.meshgrid(losses.torque, losses.speed, indexing="ij")
    return temperature, losses.at(temperature, torque, speed)


def within(exported: Exported, name: str, value: float, axis: np.ndarray) -> None:
    """Refuse a value beyond the ends of an axis of the map."""
    if not axis[0] <= value <= axis[-1]:
        unit = {OIL_TEMPERATURE: "K", "torque": "N*m", "speed": "rad/s"}[name]
        rule = f"{name} {value:.6g} {unit} lies outside its map, {axis[0]:.6g} to {axis[-1]:.6g} {unit}"
        raise exported.refused(rule, f"choose another {name}, or map further")


def nominal(exported: Exported, name: str, choices: Mapping[str, float], axis: np.ndarray) -> float:
    """Torque or speed that is chosen, or the nominal one, within the axis; refuses where there is none."""
    value = choices.get(name, float(getattr(exported.losses, f"nominal_{name}")))
    if not np.isfinite(value):
        raise exported.refused(f"has no nominal {name}", f"choose one: --set {name}=...")
    within(exported, name, value, axis)
    return value


def damping_ratio(exported: Exported, choices: Mapping[str, float]) -> float:
    """Damping ratio that is chosen, or that of the scenario."""
    if "damping_ratio" in choices:
        return choices["damping_ratio"]
    found = _found(exported.scenario, "damping_ratio")
    if found is None:
        raise exported.refused("has no damping ratio", "choose one: --set damping_ratio=0.05")
    return found


def _found(table: Any, key: str) -> float | None:
    """The first number of that key in a table, or in one below it; that of `mesh` before others."""
    if not isinstance(table, Mapping):
        return None
    if isinstance(value := table.get(key), (int, float)):
        return float(value)
    parts = sorted(table, key=lambda name: name != "mesh")
    return next((found for name in parts if (found := _found(table[name], key)) is not None), None)


def stiffness(exported: Exported, torque: float) -> float:
    """Stiffness at the output, N m/rad, at a torque."""
    losses = exported.losses
    sound = np.isfinite(losses.stiffness) & (losses.stiffness > 0.0)
    if not losses.stiffness.size or not sound.any():
        raise exported.refused("holds no stiffness", "map a gearbox whose meshes have one")
    return float(np.interp(torque, losses.torque[sound], losses.stiffness[sound]))


def inertia(exported: Exported) -> float:
    """Inertia of the gearbox reflected to the input, kg m²."""
    value = exported.losses.inertia_input
    if not value > 0.0:
        raise exported.refused("holds no inertia", "map it again")
    return value


def identifier(name: str) -> str:
    """A name as programs take it."""
    word = re.sub(r"\W", "_", name, flags=re.ASCII) or "gearbox"
    return word if not word[0].isdigit() else f"gearbox_{word}"


def numbers(values: Any) -> str:
    """Nested rows of numbers in braces, a row a line."""
    array = np.asarray(values, dtype=float)
    if array.ndim == 1:
        return "{" + ", ".join(f"{value:.9g}" for value in array) + "}"
    return "{" + ",\n".join(numbers(part) for part in array) + "}"


def read_numbers(text: str, name: str) -> np.ndarray:
    """The array behind `name … =` in a text, as `numbers` wrote it."""
    match = re.search(rf"\b{name}\b[^=;]*=\s*(\{{[^;]*\}})", text)
    if match is None:
        raise ValueError(f"no {name}")
    return np.array(json.loads(match[1].translate({ord("{"): "[", ord("}"): "]"})))


def shares(*axes: np.ndarray) -> np.ndarray:
    """Share of the range of a map that each of its points stands for: they are not evenly spread."""
    found = np.ones(())
    for axis in axes:
        ends = np.concatenate([axis[:1], 0.5 * (axis[1:] + axis[:-1]), axis[-1:]])
        width = np.diff(ends) if len(axis) > 1 else np.ones(1)
        found = np.multiply.outer(found, width / width.sum())
    return found


def celsius(temperature: float) -> str:
    """For remarks."""
    return f"{temperature - 273.15:.4g} °C"
