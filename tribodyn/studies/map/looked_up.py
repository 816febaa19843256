"""The short form of a map, of the command line and of Python, and what a map says between its points."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.quantity import InUnit, Table
from tribodyn.input.resolve import resolve_table
from tribodyn.input.sources import find_scenario, read_toml
from tribodyn.input.vary import axes_of
from tribodyn.record.loss_map import AXES, LossMap, efficiency_of
from tribodyn.studies.map.scenario import KIND
from tribodyn.studies.protocol.load import Loaded, loaded_from, table_of
from tribodyn.studies.protocol.study import CaseHead

#: Share of an axis's largest magnitude beyond its end that is its end.
_SLACK = 1e-9


class AxisValues(Table):
    """What the values of an axis are."""

    torque: Annotated[float, InUnit(units.TORQUE)]
    speed: Annotated[float, InUnit(units.ANGULAR_SPEED)]
    oil_temperature: Annotated[float, InUnit(units.TEMPERATURE_KIND)]


def axis_of(name: str, given: Any) -> Any:
    """Values of an axis as a file has them; raises InputError for a text that says none."""
    if not isinstance(given, str):
        return given
    try:
        return list(axes_of([f"{name}={given}"], AxisValues)[0].written)
    except InputError as error:
        key = f"--{name.replace('_', '-')}"
        raise InputError(key, quoted(given), error.rule, error.remedy) from None


def loaded_map(source: Any, table: Mapping[str, Any], overrides: Mapping[str, Any]) -> Loaded:
    """Make the case of a map of a gearbox, or of a map: name, file, tables, or a case.

    `table` has keys of ``[map]``, in place of those of a map; `overrides` are of the
    gearbox.
    """
    if isinstance(source, CaseHead):
        path, data = Path("scenario"), tomllib.loads(source.toml)
    elif isinstance(source, Mapping):
        path, data = Path("scenario"), dict(source)
    else:
        path = find_scenario(str(source))
        data = read_toml(path)
    if data.get("kind") == KIND:
        whole = data | {KIND: {**data.get(KIND, {}), **table}}
    else:
        name = str(data.get("name", path.stem))
        title = f"Losses of {data.get('title', name)}"
        whole = {"title": title, "name": f"{name}-map", "kind": KIND, "scenario": data, KIND: dict(table)}
    own = (f"{KIND}.", "scenario.")  # keys of the gearbox, but for those of the map itself
    within = {key if key.startswith(own) else f"scenario.{key}": value for key, value in overrides.items()}
    return loaded_from(resolve_table(whole, path, within, table_of), path)


def looked_up(losses: LossMap, torque: Any, speed: Any, oil_temperature: Any) -> dict[str, np.ndarray]:
    """What a map says at points; see `verbs.Map.interpolate`."""
    if oil_temperature is None:
        if len(losses.oil_temperature) > 1:
            rule = "missing: the map has several temperatures of the oil"
            raise InputError("oil_temperature", None, rule, "give one, in K")
        oil_temperature = losses.oil_temperature[0]
    given = dict(zip(AXES, (oil_temperature, torque, speed), strict=True))
    for name, value in given.items():
        axis, values = getattr(losses, name), np.atleast_1d(np.asarray(value, float))
        slack = _SLACK * max(abs(axis[0]), abs(axis[-1]))
        beyond = values[~((values >= axis[0] - slack) & (values <= axis[-1] + slack))]
        if beyond.size:
            rule = f"outside the map, which reaches from {axis[0]:.6g} to {axis[-1]:.6g}"
            raise InputError(name, f"{beyond[0]:.6g}", rule, "ask within it, SI units")
    drag = losses.at(**given)
    through = abs(losses.ratio) * np.asarray(torque, float)
    return {
        "drag": drag,
        "power_loss": drag * np.abs(np.asarray(speed, float)),
        "input_torque": through + drag,
        "efficiency": efficiency_of(through, drag),
    }
