"""What a law of a link is: torque, energy and share of the damping over the twist between its ends."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.numerics.elementary import law
from tribodyn.tribology.law import KeyedLaw
from tribodyn.tribology.trial import REMEDY, refuse_unmarked

#: Twists on which a law from outside this package is tried, rad.
_TRIED = np.linspace(-0.02, 0.02, 4001)
#: Difference of the energy from the work of the torque, over the largest work.
_ENERGY_ERROR = 1e-3


@dataclass(frozen=True, eq=False)
class LinkLaw(KeyedLaw):
    """A law of a torsional link: a plain object, chosen by ``law`` of a link or shaft, or from Python.

    `function` is (twist of the first end against the second in rad, stiffness of the link in N m/rad,
    parameters) -> (torque in N m that turns the first end back, strain energy in J, share of the link's
    damping that acts, 0 … 1). The torque is the derivative of the energy, and continuous: integrators step
    over its kinks. Dynamics at a kink are exact only to their tolerance.
    """

    table: ClassVar[str] = "link"

    @property
    def functions(self) -> tuple[Callable[..., Any]]:
        """The function that kernels and models hold."""
        return (self.function,)


def try_link_law(law: LinkLaw, stiffness: float, parameters: Any) -> None:
    """Try a law that is not this package's own, on a number and on an array.

    Raises InputError if it calls what kernels cannot compile, fails, or its torque is not the derivative of
    its energy.
    """
    if (law.function.__module__ or "").partition(".")[0] == "tribodyn":
        return
    key, name = "link.law", quoted(law.name)
    refuse_unmarked(key, law)
    torque = energy = _TRIED
    for how, twist in (("a number", float(_TRIED[0])), ("arrays", _TRIED)):
        try:
            with np.errstate(all="ignore"):
                torque, energy, share = law.function(twist, stiffness, parameters)
                values = np.array([0.0 * twist + each for each in (torque, energy, share)])
        except Exception as error:
            why = " ".join(f"{type(error).__name__}: {error}".split())
            raise InputError(key, name, f"fails on {how}: {why}", REMEDY) from error
        if not np.all(np.isfinite(values)) or np.any((values[2] < 0.0) | (values[2] > 1.0)):
            rule = "gives no finite torque and energy with a share of the damping from 0 to 1"
            raise InputError(key, name, rule, "mend its formula or its parameters")
    work = np.concatenate([[0.0], np.cumsum((torque[1:] + torque[:-1]) / 2.0 * np.diff(_TRIED))])
    if np.max(np.abs(energy - energy[0] - work)) > _ENERGY_ERROR * np.max(np.abs(work)):
        rule = "its torque is not the derivative of its energy"
        raise InputError(key, name, rule, "return torque, energy, share of the damping that acts")


@law
def linear(twist, stiffness, parameters):
    """Torque k s, its energy, and all of the damping."""
    return stiffness * twist, 0.5 * stiffness * twist * twist, 1.0


LAW = LinkLaw("linear", "torque and damping linear in twist and its rate", linear)
