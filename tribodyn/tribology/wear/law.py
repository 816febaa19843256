"""What a wear law is: volume worn off a flank per load and sliding distance, at one contact.

In a line contact that passes a place of a flank, the flank slides by |v_1 − v_2| dt under the pressure p
and loses the depth dh = K p |v_1 − v_2| dt (J. F. Archard, J. Appl. Phys. 24 (1953) 981; as a local law M.
Priest, C. M. Taylor, Wear 241 (2000) 193). The contact goes by with the speed |v_own| along that flank, so
that with a K that is one number for the whole contact

    h = K |v_1 − v_2|/|v_own| ∫ p dx = K w' |v_1 − v_2|/|v_own|,

w' the line load: 2a |v_1 − v_2|/|v_own| is the slip path of the place, w'/2a the mean pressure.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple

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
