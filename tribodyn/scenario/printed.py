"""Numbers as they are printed: by how much the rounding to their last digit may have moved them."""

import re
from decimal import Decimal
from typing import Any, NamedTuple, cast

from tribodyn.scenario.quantity import InUnit

_DIGITS = re.compile(r"\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?)", re.ASCII)
#: Rounding of a profile shift, at most: of two decimals. A number in TOML has lost the zeros at its end, so
#: that fewer decimals do not say how many were printed.
COARSEST_SHIFT = 0.005


class Printed(NamedTuple):
    """A quantity, and half a unit of the last digit that it is written with; both SI."""

    value: float
    rounding: float


class PrintedQuantity(InUnit):
    """Marks a field as written with a unit, whose digits count: "91.50 mm" is 91.5 ± 0.005 mm."""

    def read(self, value: Any) -> Any:
        """Convert what stands in TOML to a `Printed`."""
        magnitude = super().read(value)
        number = cast(re.Match[str], _DIGITS.match(value))[1]  # else it had been refused
        return Printed(magnitude, magnitude / float(number) * half_unit(number))


def half_unit(number: str) -> float:
    """Half a unit of the last digit of a number: 0.005 of "91.50", 0.5 of "584", 50 of "1.2e3"."""
    return float(Decimal(5).scaleb(cast(int, Decimal(number).as_tuple().exponent) - 1))


def shift_rounding(shift: float) -> float:
    """Half a unit of the last decimal of a profile shift, at most `COARSEST_SHIFT`; 0 of a whole number."""
    exact = float(shift).is_integer()
    return 0.0 if exact else min(half_unit(repr(float(shift))), COARSEST_SHIFT)
