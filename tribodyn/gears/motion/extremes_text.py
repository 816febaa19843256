"""Which extremes of a run are not those of its summary, in words."""

from collections.abc import Mapping
from typing import Any

from tribodyn.gears.case import TRIBOLOGY
from tribodyn.quantities.catalogue import QUANTITIES

#: Relative difference between the extremes of the whole run and those of its last cycles that is said.
DIFFERENT = 0.005


def on_extremes(summary: Mapping[str, Any]) -> list[str]:
    """Say which extremes of the whole run, or of its last mesh cycles, are not those of the table."""
    described = summary.get("extremes")
    if not described:  # a record of 0.1.0, or of a run that stopped at once
        return []
    said = []
    for part, words in (("run", "Over the whole run"), ("last_cycles", "Over the last mesh cycles")):
        others = []
        for quantity in (QUANTITIES["normal_load_max"], *TRIBOLOGY):
            known, value = described.get(part, {}).get(quantity.name), summary.get(quantity.name)
            if known is None or value is None or not abs(known["value"] - value) > DIFFERENT * abs(value):
                continue
            name = quantity.title[0].lower() + quantity.title[1:]
            at = f" at t = {known['time']:.4g} s" if part == "run" and "time" in known else ""
            others.append(f"{name} {quantity.with_unit(known['value'])}" + at)
        if others:
            said.append(f"{words}: {', '.join(others)}.")
    return said
