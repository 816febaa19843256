"""Miner's sum duty by duty: cycles, stresses and damage of a load spectrum, ISO 6336-6."""

from collections.abc import Mapping
from typing import Any

from tribodyn.cases.results import TextTable
from tribodyn.gears.rating.capacity import MOST_DAMAGE, Capacity
from tribodyn.gears.rating.rating_text import unit_of
from tribodyn.geometry.drive import SIDES
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.standards.fatigue import damage

#: Names of stress and damage of either way to fail.
_FAILURES = {"pitting": ("duty_sigma_H", "duty_U_H"), "bending": ("duty_sigma_F", "duty_U_F")}


def spectrum_part(capacity: Capacity | None, required: Mapping[str, float]) -> dict[str, Any]:
    """What a summary has of the duties, ``spectrum``: lists of pinion and gear; nothing of a single duty.

    Damage is at the required safeties.
    """
    count = len(capacity.gears[0].pitting.bins) if capacity else 0
    if capacity is None or count < 2:
        return {}
    spectrum: dict[str, Any] = {"duty_number": list(range(1, count + 1)), "duty_n": {}}
    for side, gear in zip(SIDES, capacity.gears, strict=True):
        spectrum["duty_n"][side] = [one.cycles for one in gear.pitting.bins]
        for name, (stress, share) in _FAILURES.items():
            failure = getattr(gear, name)
            spectrum.setdefault(stress, {})[side] = [one.stress for one in failure.bins]
            spectrum.setdefault(share, {})[side] = [
                min(damage([one], failure.curve, required[name]), MOST_DAMAGE) for one in failure.bins
            ]
    return {"spectrum": spectrum}


def spectrum_tables(spectrum: Mapping[str, Any]) -> list[TextTable]:
    """A table of each gear from `spectrum_part`: duty by duty, and Miner's sum."""
    if not spectrum:
        return []
    cycles = QUANTITIES["duty_n"]
    tables = []
    for side in SIDES:
        heads, columns = ["duty", cycles.symbol], [list(map(str, spectrum["duty_number"]))]
        columns.append([cycles.written(value) for value in spectrum["duty_n"][side]])
        sums = ["sum", cycles.written(sum(spectrum["duty_n"][side]))]
        for stress, share in _FAILURES.values():
            of_stress, of_share = QUANTITIES[stress], QUANTITIES[share]
            letter = stress[-1]
            heads += [f"{of_stress.symbol} ({unit_of(of_stress)})", f"N_{letter}", of_share.symbol]
            columns.append([of_stress.written(value) for value in spectrum[stress][side]])
            columns.append(
                [
                    cycles.written(n / used) if used > 0.0 else "∞"
                    for n, used in zip(spectrum["duty_n"][side], spectrum[share][side], strict=True)
                ]
            )
            columns.append([of_share.written(value) for value in spectrum[share][side]])
            sums += ["", "", of_share.written(sum(spectrum[share][side]))]
        rows = [*zip(*columns, strict=True), tuple(sums)]
        tables.append(TextTable(f"Miner's sum of the {side}", tuple(heads), rows))
    return tables
