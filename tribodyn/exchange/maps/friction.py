"""Coulomb and viscous friction of a joint, fitted to the losses of a map: what simulators of robots have."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from tribodyn.exchange.format import Deviation, Exported, FormatChoice, deviation
from tribodyn.exchange.maps.chosen import CHOICES, at_temperature, celsius, within

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
        found = [deviation("friction at the output", "N m", fitted, exact, over)]
        if "torque" in choices:
            exact = _at_load(exported, choices)
            found.append(deviation("friction at the output", "N m", fitted[0], exact, "the chosen load"))
        return tuple(found)


def fitted_friction(exported: Exported, choices: Mapping[str, float]) -> JointFriction:
    """By least squares over the loads and speeds of the map at an oil temperature, neither below 0."""
    from scipy.optimize import nnls

    losses = exported.losses
    temperature, drag = at_temperature(exported, choices)
    if "torque" in choices:
        within(exported, "torque", choices["torque"], losses.torque)
        friction, load = _at_load(exported, choices)[None], f"a load of {choices['torque']:.6g} N m"
    else:
        friction, load = drag / abs(losses.ratio), "all loads of the map, which it cannot tell apart"
    speed = np.broadcast_to(np.abs(losses.speed * losses.ratio), friction.shape).ravel()
    (coulomb, viscous), _ = nnls(np.stack([np.ones_like(speed), speed], axis=1), friction.ravel())
    remark = f"friction fitted at {celsius(temperature)} oil to {load}"
    return JointFriction(float(coulomb), float(viscous), (remark,))


def _at_load(exported: Exported, choices: Mapping[str, float]) -> np.ndarray:
    losses = exported.losses
    temperature, _ = at_temperature(exported, choices)
    return losses.at(temperature, choices["torque"], losses.speed) / abs(losses.ratio)
