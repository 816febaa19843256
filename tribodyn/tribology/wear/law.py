"""What a wear law is: volume worn off a flank per load and sliding distance, at one contact.

In a line contact that passes a place of a flank, the flank slides by |v_1 − v_2| dt under the pressure p
and loses the depth dh = K p |v_1 − v_2| dt (J. F. Archard, J. Appl. Phys. 24 (1953) 981; as a local law M.
Priest, C. M. Taylor, Wear 241 (2000) 193). The contact goes by with the speed |v_own| along that flank, so
that with a K that is one number for the whole contact

    h = K |v_1 − v_2|/|v_own| ∫ p dx = K w' |v_1 − v_2|/|v_own|,

w' the line load: 2a |v_1 − v_2|/|v_own| is the slip path of the place, w'/2a the mean pressure.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.law import KeyedLaw


class WearContact(NamedTuple):
    """A contact as a wear law sees it; numbers or arrays of one shape, SI."""

    hertz_pressure: Any  # maximum Hertz pressure, Pa
    friction_coefficient: Any  # μ
    film_parameter: Any  # film over composite rms roughness; 0 where there is no lubricant
    asperity_load_ratio: Any  # share of the load that asperities carry, 0 … 1; 1 where there is no lubricant


class WearFunctions(NamedTuple):
    """The functions of a wear law."""

    coefficient: Callable[..., Any]


@dataclass(frozen=True, eq=False)
class WearLaw(KeyedLaw):
    """A law of wear: a plain object, chosen by ``[wear] law`` or handed over from Python.

    `function` is (contact: WearContact, parameters) -> K ≥ 0, volume worn off either flank per load and
    sliding distance, m²/N. It receives arrays, and is written with arithmetic and the functions of
    `tribodyn.numerics.elementary`.
    """

    table: ClassVar[str] = "wear"
    needs_film: bool = False  # whether it says nothing without a film
    film: str | None = None  # name of the film law that goes with it where the scenario names none
    needs_friction: bool = False  # whether it says nothing without a friction coefficient

    @property
    def functions(self) -> WearFunctions:
        """The functions that a study holds."""
        return WearFunctions(self.function)


@dataclass(frozen=True)
class WearData:
    """By which wear law the flanks of a case wear."""

    law: str | WearLaw  # its name in `tribodyn.tribology.wear.WEAR_LAWS`, or the law itself
    #: values of the law's own keys, by name, in SI units
    values: Mapping[str, Any] = field(default_factory=dict)


# From a wear law's coefficient to the depth worn off flanks in contact; running-in of the roughness.
#
# New flanks smooth each other within some revolutions.
#
# The roughness falls from σ to s σ like σ [s + (1 − s) exp(−N/N_0)]: the simplest course that begins with
# the roughness as made and ends with that as run in. Both numbers are the user's, from measured flanks;
# there is no default.


def specific_slip(rolling_speed: Any, sliding_speed: Any) -> Float[Array, " contact"]:
    """Way by which a flank slides per width of the contact that passes it, abs(v_1 − v_2)/abs(v_own).

    0 where the flank stands still in the contact: it would have to be worn for ever there.
    """
    own, sliding = np.abs(rolling_speed), np.abs(sliding_speed)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(own > 0.0, sliding / own, 0.0)


def depth_per_passage(coefficient: Any, line_load: Any, slip: Any) -> Any:
    """Depth that one passage of the contact wears off a flank, m: K w' times the `specific_slip`.

    K volume per load and way, m²/N, w' load per length of the line of contact, N/m.
    """
    return coefficient * line_load * slip


class RunningIn(NamedTuple):
    """How the roughness falls."""

    roughness_share: float  # s, roughness after over before, 0 < s ≤ 1
    revolutions: float  # N_0, > 0

    def share_at(self, revolutions: float) -> float:
        """Roughness after so many revolutions over that of new flanks."""
        transient = 1.0 - self.roughness_share
        return self.roughness_share + transient * math.exp(-revolutions / self.revolutions)

    def step_at(self, revolutions: float) -> float:
        """Revolutions in which a tenth of the running-in happens, about."""
        return 0.1 * self.revolutions * math.exp(min(revolutions / self.revolutions, 100.0))
