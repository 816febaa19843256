"""The short form of a map, of the command line and of Python, and what a map says between its points."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.quantity import InUnit, Table
from tribodyn.input.vary import axes_of
from tribodyn.record.loss_map import AXES, LossMap, efficiency_of
from tribodyn.studies.map.scenario import KIND
from tribodyn.studies.protocol.load import Loaded, loaded_around

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

    `table` has keys of ``[map]``, in place of those of a map; `overrides` are of the gearbox.
    """
    return loaded_around(KIND, source, table, overrides, "Losses of")


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
