"""Records side by side: one table of their results, and what besides the gears differs between the runs."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from tribodyn.errors import InputError
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.quantities.quantity import Quantity, Reported
from tribodyn.record.reader import Record
from tribodyn.record.withheld_efficiency import reasons, warnings

#: The share of the power that is lost, beside the efficiency whose difference it shows better.
LOSS = QUANTITIES["loss_fraction"]
#: Parts of a scenario that say under which conditions a drive ran, not which drive nor how it was solved.
CONDITIONS = (
    *("kind", "mode", "operating", "lubricant", "friction", "bearings", "mesh", "losses", "temperature"),
)
_PROSE = ("source", "assumptions")


class ComparedRow(NamedTuple):
    """One quantity of every record."""

    quantity: Quantity  # what it is and how it is written
    values: tuple[Any, ...]  # SI, in the order of the records; None where a record lacks it

    def differences(self) -> tuple[float | None, ...]:
        """Relative difference of every later record from the first; None where it means nothing."""
        first = self.values[0]
        return tuple(_relative(first, value) for value in self.values[1:])


class Comparison(NamedTuple):
    """Several records side by side."""

    #: labels, titles: names of the records in table and legends, and titles of their scenarios
    labels: tuple[str, ...]
    titles: tuple[str, ...]
    groups: dict[str, tuple[ComparedRow, ...]]  # heading -> rows
    #: dotted key of the scenario -> what each record's says, for the keys in which they differ
    conditions: dict[str, tuple[str, ...]]
    withheld: tuple[dict[str, str], ...] = ()  # of every record: name of a quantity that is withheld -> why
    warnings: tuple[tuple[str, ...], ...] = ()  # what every record warns of


def compare(records: Sequence[Record], reported: Reported) -> Comparison:
    """Set complete records whose `reported` quantities can be compared side by side.

    Their labels become distinct. Raises InputError for fewer than two records, one of them twice, or an
    unfinished one.
    """
    _refuse(records)
    for record, label in zip(records, distinct_labels(records), strict=True):
        record.label = label
    summaries = [dict(record.summary) for record in records]
    for summary in summaries:
        if summary.get("efficiency") is not None:
            summary[LOSS.name] = 1.0 - summary["efficiency"]
    groups = {}
    for heading, quantities in reported.items():
        if any(quantity.name == "efficiency" for quantity in quantities):
            quantities = (*quantities, LOSS)
        rows = (
            ComparedRow(quantity, tuple(summary.get(quantity.name) for summary in summaries))
            for quantity in quantities
        )
        groups[heading] = tuple(row for row in rows if any(value is not None for value in row.values))
    return Comparison(
        tuple(record.label for record in records),
        tuple(str(record.scenario.get("title", "")) for record in records),
        {heading: rows for heading, rows in groups.items() if rows},
        _differing([dict(_conditions(record.scenario)) for record in records]),
        tuple(reasons(record.summary) for record in records),
        tuple(tuple(warnings(record.summary)) for record in records),
    )


def _refuse(records: Sequence[Record]) -> None:
    if len(records) < 2:
        path = str(records[0].path) if records else None
        raise InputError("compare", path, "there is nothing to compare it with", "name at least two")
    seen = set()
    for record in records:
        if record.path.resolve() in seen:
            raise record.refused("given twice", "name each record once")
        seen.add(record.path.resolve())
        if record.status != "complete":
            rule = f"{record.status}, so its means and extremes are not those of a whole run"
            raise record.refused(rule, "run its scenario again")


def distinct_labels(records: Sequence[Record]) -> list[str]:
    """Name every record by its file, and by as many folders above as distinguish it from the others."""
    labels = [record.label for record in records]
    for depth in range(1, max(len(record.path.resolve().parts) for record in records)):
        same = {label for label in labels if labels.count(label) > 1}
        if not same:
            break
        for number, record in enumerate(records):
            if labels[number] in same:
                folders = record.path.resolve().parts[-1 - depth : -1]
                labels[number] = "/".join((*folders, record.path.stem))
    return labels


def _relative(first: Any, value: Any) -> float | None:
    if first is None or value is None or np.ndim(first) or np.ndim(value) or isinstance(first, str):
        return None
    if not (math.isfinite(first) and math.isfinite(value)) or first == 0:
        return None
    return value / first - 1


def _conditions(scenario: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Go through what a scenario says of its conditions, dotted key and value; models by their titles.

    Of one that has another one within, such as that of a map, also what this one says.
    """
    if isinstance(inner := scenario.get("scenario"), Mapping):
        yield from ((key, value) for key, value in _conditions(inner) if key != "kind")
    for part in CONDITIONS:
        value = scenario.get(part)
        if isinstance(value, Mapping) and "title" in value:
            yield part, str(value["title"])
        if value is not None:
            yield from _flat(part, value)
    for part in ("drive", "gear"):
        for gear, keys in scenario.get(part, {}).items():
            if isinstance(keys, Mapping) and keys.get("modification") is not None:
                yield from _flat(f"{part}.{gear}.modification", keys["modification"])


def _flat(key: str, value: Any) -> Iterator[tuple[str, str]]:
    if not isinstance(value, Mapping):
        yield key, str(value)
        return
    for name, item in value.items():
        if name not in _PROSE and name != "title":
            yield from _flat(f"{key}.{name}", item)


def _differing(conditions: Sequence[Mapping[str, str]]) -> dict[str, tuple[str, ...]]:
    keys = dict.fromkeys(key for condition in conditions for key in condition)
    values = {key: tuple(condition.get(key, "–") for condition in conditions) for key in keys}
    different = {key: value for key, value in values.items() if len(set(value)) > 1}
    if "kind" in different:
        # another kind of study has no such key, which says nothing
        different = {key: value for key, value in different.items() if "–" not in value}
    # where the titles of two models differ, they identify it better than all the numbers
    titled = [key for key in different if "." not in key]
    return {
        key: value
        for key, value in different.items()
        if "." not in key or key.partition(".")[0] not in titled
    }


def comparison_table(comparison: Comparison) -> Group:
    """Lay out a comparison for the terminal (a rich renderable), in engineers' units."""
    parts: list[Any] = [
        Text.assemble((label, "bold"), f": {title}")
        for label, title in zip(comparison.labels, comparison.titles, strict=True)
    ]
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    first, *others = comparison.labels
    table.add_column("", no_wrap=True)
    table.add_column(first, justify="right", overflow="fold")
    for label in others:
        table.add_column(label, justify="right", overflow="fold")
        table.add_column(f"against {first}" if len(others) == 1 else "", justify="right")
    table.add_column("")
    for heading, rows in comparison.groups.items():
        table.add_row(Text(heading, style="bold cyan"))
        for row in rows:
            written = ["–" if value is None else row.quantity.written(value) for value in row.values]
            cells = [written[0]]
            for value, difference in zip(written[1:], _differences(row), strict=True):
                cells += [value, difference]
            table.add_row(f"  {row.quantity.title}", *cells, row.quantity.unit)
    parts += ["", table, ""]
    for label, warnings_of_record in zip(comparison.labels, comparison.warnings, strict=True):
        parts += [Text(f"Warning, {label}: {warning}", style="bold red") for warning in warnings_of_record]
    if comparison.conditions:
        parts.append(Text("What besides the drive differs between the runs", style="bold cyan"))
    else:
        parts.append(
            Text("Speed, load, lubricant, friction law, bearings and mesh are the same in all runs.")
        )
    parts += [Text(f"  {key}: {' / '.join(values)}") for key, values in comparison.conditions.items()]
    return Group(*parts)


def _differences(row: ComparedRow) -> list[str]:
    """Write how later records differ from the first: in per cent, or of shares in percentage points."""
    texts = []
    for value, relative in zip(row.values[1:], row.differences(), strict=True):
        if relative is None:
            texts.append("")
        elif row.quantity.unit == "%" and row.quantity is not LOSS:
            texts.append(f"{100 * (value - row.values[0]):+.2f} pp")
        else:
            texts.append(f"{100 * relative:+.1f} %")
    return texts


def as_json(comparison: Comparison) -> dict[str, Any]:
    """Turn a comparison, SI units, into plain data; relative differences are those from the first record."""
    return {
        "records": [
            {"label": label, "title": title}
            for label, title in zip(comparison.labels, comparison.titles, strict=True)
        ],
        "quantities": {
            row.quantity.name: {
                "label": row.quantity.title,
                "values": list(row.values),
                "relative_differences": list(row.differences()),
            }
            for rows in comparison.groups.values()
            for row in rows
        },
        "withheld": {
            label: why for label, why in zip(comparison.labels, comparison.withheld, strict=True) if why
        },
        "different_conditions": {key: list(values) for key, values in comparison.conditions.items()},
    }
