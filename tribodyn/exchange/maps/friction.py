"""Coulomb and viscous friction of a joint, fitted to the losses of a map: what simulators of robots have."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from tribodyn.exchange.format import Deviation, Exported, FormatChoice, deviation
from tribodyn.exchange.maps.chosen import CHOICES, at_temperature, celsius, shares, within

#: Choices of formats that hold such a friction.
FRICTION_CHOICES = {
    **CHOICES,
    "torque": FormatChoice("torque", "at the output, for which friction is fitted; default: all of the map"),
}


class JointFriction(NamedTuple):
    """At the output."""

    coulomb: float  # N m
    viscous: float  # N m s/rad
    remarks: tuple[str, ...]

    def deviations(self, exported: Exported, choices: Mapping[str, float]) -> tuple[Deviation, ...]:
        """Of this friction from the map."""
        losses, over = exported.losses, "all loads and speeds of the map at this oil temperature"
        exact = at_temperature(exported, choices)[1] / abs(losses.ratio)
        speed = np.abs(losses.speed * losses.ratio)
        fitted = np.broadcast_to(self.coulomb + self.viscous * speed, exact.shape)
        weights = shares(losses.torque, losses.speed)
        found = [deviation("friction at the output", "N m", fitted, exact, over, weights)]
        if "torque" in choices:
            exact = _at_load(exported, choices)
            load = "the chosen load"
            found.append(
                deviation("friction at the output", "N m", fitted[0], exact, load, shares(losses.speed))
            )
        return tuple(found)


def fitted_friction(exported: Exported, choices: Mapping[str, float]) -> JointFriction:
    """By least squares over the range of loads and speeds at an oil temperature, neither below 0."""
    from scipy.optimize import nnls

    losses = exported.losses
    temperature, drag = at_temperature(exported, choices)
    if "torque" in choices:
        within(exported, "torque", choices["torque"], losses.torque)
        friction, weights = _at_load(exported, choices)[None], shares(losses.speed)[None]
        load = f"a load of {choices['torque']:.6g} N m"
    else:
        friction, weights = drag / abs(losses.ratio), shares(losses.torque, losses.speed)
        load = "all loads of the map, which it cannot tell apart"
    speed = np.broadcast_to(np.abs(losses.speed * losses.ratio), friction.shape).ravel()
    root = np.sqrt(weights.ravel())
    matrix = np.stack([np.ones_like(speed), speed], axis=1)
    (coulomb, viscous), _ = nnls(matrix * root[:, None], friction.ravel() * root)
    remark = f"friction fitted at {celsius(temperature)} oil to {load}"
    return JointFriction(float(coulomb), float(viscous), (remark,))


def _at_load(exported: Exported, choices: Mapping[str, float]) -> np.ndarray:
    losses = exported.losses
    temperature, _ = at_temperature(exported, choices)
    return losses.at(temperature, choices["torque"], losses.speed) / abs(losses.ratio)
