"""Reported quantities of a search, and how far to trust them."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Quantity, Reported
from tribodyn.record.reader import Record
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.sources import split
from tribodyn.studies.design.case import naming_key

REPORTED: Reported = {
    "Search": quantities(
        *("objective_name", "method"),
        *("evaluations", "evaluations_feasible", "evaluations_without_quantities"),
        *("evaluations_finer", "evaluations_about", "evaluations_total"),
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = quantities(
    "objective", "objective_start", "evaluations", "evaluations_feasible", "evaluations_without_quantities"
)
SWEEP_TABLE = quantities("objective", "objective_start", "evaluations")

PANELS = ("objective",)
#: Share of its range from an end of it at which a free key stands there.
AT_END = 2e-3
#: Of what `run --json` prints.
TOP = ("objective_start", "objective", "best", "evaluations", "evaluations_total")


def verdict(record: Record) -> list[str]:
    """Say what was won, by which values, whether the constraints hold, and what could not be made."""
    summary = record.summary
    if "objective" not in summary:
        return []
    won = []
    for name, before, best in _objectives(summary):
        ratio = best / before if before and np.isfinite(before) else np.nan
        changed = f" ({100.0 * (ratio - 1.0):+.2g} %)" if np.isfinite(ratio) else ""
        title = _quantity_or_name(record.scenario, name).title
        won.append(f"{title}: {_change(record.scenario, name, before, best)}{changed}")
    texts = [f"{'; '.join(won)}."]
    values = [f"{key} = {value}" for key, value in summary.get("best", {}).items()]
    if values:
        more = f" and {len(values) - 4} more" if len(values) > 4 else ""
        texts.append(f"By {', '.join(values[:4])}{more}.{_at_ends(record)}")
    feasible, evaluations = summary.get("evaluations_feasible"), summary.get("evaluations")
    if feasible is not None and evaluations:
        kept = "The best keeps every constraint" if feasible else "No candidate keeps every constraint"
        total = summary.get("evaluations_total", evaluations)
        more = f" Besides, {total - evaluations} evaluations were finer or about the best." * (
            total > evaluations
        )
        texts.append(f"{kept}; {feasible} of {evaluations} candidates do.{more}")
    if feasible:
        texts.append("To do: run the best, which lies beside the record as a scenario of its own.")
    return texts


def sentences(record: Record) -> list[str]:
    """Say what changed from the start to the best, and how the best was confirmed."""
    summary = record.summary
    if "objective" not in summary:
        return []
    search, objectives = record.scenario, _objectives(summary)
    names = [name for name, *_ in objectives]
    texts = [
        f"{_quantity_or_name(search, name).title}: {_change(search, name, before, best)}."
        for name, before, best in objectives
    ]
    texts += [
        f"{key}: {summary.get('start', {}).get(key, 'not set')} at the start, {value} at the best."
        for key, value in summary.get("best", {}).items()
    ]
    before, after = summary.get("constraints_start", {}), summary.get("constraints_best", {})
    quantities = summary.get("quantities_best", {})
    for text, value in after.items():
        if name := _quantity_in(text, quantities):
            texts.append(f"{text}: at its worst {_change(search, name, before.get(text), value)}.")
    if "resolution" in summary:
        texts.append(_resolution(search, names, summary))
    if "objective_confirmed" in summary:
        ends = (summary[f"objective_{end}confirmed"] for end in ("start_", ""))
        change = _change(search, names[0], *ends)
        texts.append(f"Evaluated once more as design.confirm says: {change}.")
    if "without_quantities_message" in summary:
        count = summary["evaluations_without_quantities"]
        texts.append(
            f"{count} candidates have no quantities, most because: {summary['without_quantities_message']}"
        )
    return texts


def bounds(entry: Mapping[str, Any]) -> tuple[float, float]:
    """Bounds of a free key in the units of its dataset."""
    if "choices" in entry:
        return 0.0, len(entry["choices"]) - 1.0
    return number_of(entry["from"], entry), number_of(entry["to"], entry)


def number_of(value: Any, entry: Mapping[str, Any]) -> float:
    """Value of a free key in the units of its dataset; of a choice its place."""
    from tribodyn.input.units import base_units

    if "choices" in entry:
        return float(list(map(str, entry["choices"])).index(str(value)))
    base = base_units(value)
    return float(value) if base is None else base[0]


def _at_ends(record: Record) -> str:
    """Name the free keys whose best value stands at an end of their range; "" without any."""
    best, ends = record.summary.get("best", {}), []
    for entry in record.scenario["design"]["free"]:
        key = naming_key(entry["key"])
        with suppress(ValueError):  # of a changed record
            low, high = bounds(entry)
            place = (number_of(best.get(key, ""), entry) - low) / ((high - low) or 1.0)
            if "choices" not in entry and min(place, 1.0 - place) < AT_END:
                ends.append(key)
    return f" At an end of its range, beyond which may be better: {', '.join(ends)}." if ends else ""


def _objectives(summary: Mapping[str, Any]) -> list[tuple[str, float, float]]:
    """Name of every objective, and its value at the start (NaN: none) and at the best."""
    names = str(summary["objective_name"]).split(" and ")
    start, best = (np.atleast_1d(summary.get(f"objective{end}", np.nan)) for end in ("_start", ""))
    before = [np.nan if value is None else float(value) for value in start]
    before += [np.nan] * (len(names) - len(before))
    return [(name, before[place], float(best[place])) for place, name in enumerate(names)]


def _resolution(search: Mapping[str, Any], names: Sequence[str], summary: Mapping[str, Any]) -> str:
    """Say on which resolution the quantities stand, and what the best is on the one that was searched on."""
    sought = [_quantity_or_name(search, name) for name in names]
    fine, coarse = (
        ", ".join(f"{key} = {value}" for key, value in summary[name].items())
        for name in ("resolution", "resolution_searched")
    )
    stands = "do not change there" if summary["quantity_stands"] else "still change there"
    if not summary["quantity_stands"] and summary["resolution"] == summary["resolution_searched"]:
        stands = "cannot be computed on a finer one"
    before = " and ".join(
        quantity.with_unit(float(value))
        for quantity, value in zip(sought, np.atleast_1d(summary["objective_searched"]), strict=True)
    )
    return (
        f"Quantities are those of {fine}, and {stands}; searched with {coarse}, where the best has {before}."
    )


def _quantity_in(text: str, quantities: Mapping[str, Any]) -> str:
    name = text.split()[0].split("<")[0].split(">")[0]
    return name if name in quantities else ""


def quantity_of(search: Mapping[str, Any], name: str) -> Quantity | None:
    """The quantity of a name, as a search's scenario or a part of it reports it; None: a sum of several."""
    parts = search.get("design", {}).get("part") or {}
    part, plain = split(name, parts)
    quantity = study_of(parts[part] if part else search.get("scenario", {})).quantity(plain)
    return quantity._replace(label=f"{quantity.title} ({part})", symbol="") if part and quantity else quantity


def _quantity_or_name(search: Mapping[str, Any], name: str) -> Quantity:
    return quantity_of(search, name) or Quantity(name, name)


def _change(search: Mapping[str, Any], name: str, before: Any, after: Any) -> str:
    quantity = _quantity_or_name(search, name)
    first = "no value"
    if before is not None and not np.isnan(before):
        first = quantity.with_unit(float(before))
    return f"{first} at the start, {quantity.with_unit(float(after))} at the best"
