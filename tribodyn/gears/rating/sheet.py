"""Every factor of a rating as a table, for `check` and for the page of an assessment."""

from collections.abc import Mapping
from typing import Any

from tribodyn.gears.rating.rating_text import unit_of
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.quantities.load import CAPACITY

COLUMNS = ("", "pinion", "gear", "")
#: Load factors before what they enter.
_FACTORS = ("K_A", "K_gamma", "K_v", "K_Hbeta", "K_Halpha", "C_R")


def rating_rows(iso: Mapping[str, Any]) -> list[tuple[str, str, str, str]]:
    """Title, value of the pinion and of the gear, unit; what both have in common stands in the first column.

    A life without damage has no end: its number is a lower bound.
    """
    rows = []
    for name in (*_FACTORS, *(quantity.name for quantity in CAPACITY)):
        value, quantity = iso.get(name), QUANTITIES[name]
        if value is None:
            continue
        both = value if isinstance(value, Mapping) else {"pinion": value}
        endless = iso.get(name.replace("life", "damage"), {}) if name.startswith("life_") else {}
        written = [
            "≥ " * (endless.get(side) == 0.0) + quantity.written(float(both[side])) if side in both else ""
            for side in ("pinion", "gear")
        ]
        rows.append((quantity.title, *written, unit_of(quantity)))
    return rows
