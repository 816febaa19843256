"""The summary of a sweep's record: a table for people, a dictionary for programs."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from tribodyn.quantities.catalogue import SPREAD, scatter
from tribodyn.quantities.quantity import Quantity, shown, shown_unit
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE

#: Failed cases that are named; the record has them all.
FAILURES_SHOWN = 5
#: Ends of branches that are named; the record has them all.
ENDS_SHOWN = 12


def sweep_table(record: SweepRecord, quantities: Sequence[Quantity]) -> Group:
    """Lay out a sweep for the terminal: minimum and maximum of every figure, and where they are.

    Parameters
    ----------
    quantities : those shown; none: all, as the record describes them
    """
    # a record of an older version lacks figures that have been added since
    columns = [one for one in quantities if one.name in record]
    columns = columns or [described(record, name) for name in record.quantities]
    parts: list[Any] = [Text(str(record.scenario.get("title", record.label)), style="bold")]
    if record.status != "complete":
        parts.append(Text(f"{record.status}: {record.message}", style="bold red"))
    head, tail = _head(record), _tail(record)
    parts += map(Text, head)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ("", "minimum", "at", "maximum", "at", ""):
        table.add_column(title, justify="right" if title in ("minimum", "maximum") else "left", no_wrap=True)
    for row in sweep_rows(record, columns):
        table.add_row(*row)
    parts.append(table)
    parts += _spread_table(record, columns)
    parts += _mean_table(record, columns)
    parts += map(Text, tail)
    parts += [Text(f"Warning: {warning}", style="bold red") for warning in sweep_warnings(record)]
    return Group(*parts)


def spread(record: SweepRecord, name: str) -> dict[str, np.ndarray] | None:
    """Median, 5 and 95 % of a figure over all samples, for every value of the other parameters.

    None where no samples are varied. Failed cases are left out; NaN where none is left.
    """
    drawn = record.settings.get("drawn", [])
    over = tuple(number for number, dim in enumerate(record.dims) if dim in drawn)
    if not over or record[name].dtype.kind not in "fiu" or record[name].ndim != len(record.dims):
        return None
    values = np.where(record["status"] == DONE, record[name], np.nan)
    return scatter(values, over)


def _spread_table(record: SweepRecord, columns: Sequence[Quantity]) -> list[Any]:
    """Scatter over the samples, where nothing else is varied."""
    drawn = record.settings.get("drawn", [])
    if not drawn or any(dim not in drawn for dim in record.dims):
        return []
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(f"scatter of {record.count()['done']} samples", no_wrap=True)
    for name, percentile in SPREAD.items():
        title = name if name == "median" else f"{percentile:g} %"
        table.add_column(title, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for column in columns:
        found = spread(record, column.name)
        if found is not None and np.isfinite(found["median"]):
            cells = [column.written(float(found[name])) for name in SPREAD]
            table.add_row(column.title, *cells, column.unit)
    return [Text(""), table]


def weighted_mean(record: SweepRecord, name: str) -> np.ndarray | None:
    """Mean of a figure over weighed cases, such as duties by their time, for every value of the others.

    None where nothing weighed is varied. Failed cases are left out; NaN where none is left.
    """
    weights = record.settings.get("weights", {})
    if not weights or record[name].dtype.kind not in "fiu" or record[name].ndim != len(record.dims):
        return None
    values = np.where(record["status"] == DONE, record[name], np.nan)
    weight = np.ones(values.shape)
    for number, dim in enumerate(record.dims):
        if dim in weights:
            weight = weight * np.expand_dims(
                np.asarray(weights[dim], dtype=float), tuple(i for i in range(values.ndim) if i != number)
            )
    over = tuple(number for number, dim in enumerate(record.dims) if dim in weights)
    weight = np.where(np.isfinite(values), weight, 0.0)
    total = weight.sum(axis=over)
    mean = np.where(weight > 0.0, weight * values, 0.0).sum(axis=over)
    return np.where(total > 0.0, mean / np.where(total > 0.0, total, 1.0), np.nan)


def _mean_table(record: SweepRecord, columns: Sequence[Quantity]) -> list[Any]:
    """Means over weighed cases, where nothing else is varied."""
    weights = record.settings.get("weights", {})
    if not weights or any(dim not in weights for dim in record.dims):
        return []
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(f"weighted mean of {record.count()['done']} cases", no_wrap=True)
    table.add_column("", justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for column in columns:
        found = weighted_mean(record, column.name)
        if found is not None and np.isfinite(found):
            table.add_row(column.title, column.written(float(found)), column.unit)
    return [Text(""), table]


def sweep_remarks(record: SweepRecord) -> list[str]:
    """What a sweep found besides its figures: cases, sorts of motion, ends of branches, failures."""
    return [*_head(record), *_tail(record)]


def sweep_rows(record: SweepRecord, columns: Sequence[Quantity]) -> list[list[str]]:
    """Rows of the table: name, minimum and where, maximum and where, unit; of figures with any value."""
    rows = []
    for column in columns:
        values = np.where(record["status"] == DONE, record[column.name], np.nan)
        if np.isfinite(values).any():
            rows.append(_row(record, column, values))
    return rows


def _head(record: SweepRecord) -> list[str]:
    count = record.count()
    axes = ", ".join(f"{len(one.values)} of {one.key}" for one in record.parameters)
    both = f", {' and '.join(record.directions)}" if record.directions else ""
    kinds = _kinds(record)
    return [
        f"{count['cases']} cases ({axes}{both}): {_counted(count)}",
        *([f"motion: {kinds}"] if kinds else []),
    ]


def _tail(record: SweepRecord) -> list[str]:
    ends = branch_ends(record)
    said = [_end_line(record, end) for end in ends[:ENDS_SHOWN]]
    if len(ends) > ENDS_SHOWN:
        said.append(f"and {len(ends) - ENDS_SHOWN} more ends of branches, see end_value in the record")
    failures = record.failures()
    said += [f"failed at {_place(record, at)}: {why}" for at, why in failures[:FAILURES_SHOWN]]
    if len(failures) > FAILURES_SHOWN:
        said.append(f"and {len(failures) - FAILURES_SHOWN} more, see message in the record")
    return said


def branch_ends(record: SweepRecord) -> list[dict[str, Any]]:
    """Ends of the branches that a followed sweep left, in the order of the cases."""
    if "end_kind" not in record:
        return []
    kinds = record.meanings("end_kind")
    number = record["end_kind"]
    ends = []
    for place in map(tuple, np.argwhere(number > 0)):
        first = record.parameters[0].name
        ends.append(
            {
                "kind": kinds[int(number[place])].replace("_", " "),
                "at": record.at(place[:-1]) | {first: float(record["end_value"][place])},
                "within": float(record["end_within"][place]),
                "period": int(record["end_period"][place]),
                "multiplier_modulus": float(record["end_multiplier_modulus"][place]),
                "multiplier_angle": float(record["end_multiplier_angle"][place]),
            }
            | _beyond(record, place)
        )
    return ends


def _beyond(record: SweepRecord, place: tuple[int, ...]) -> dict[str, Any]:
    """What is unstable beyond an end, where the sweep continued its branch."""
    if "unstable_value" not in record:
        return {}
    values = record["unstable_value"][place]
    values = values[np.isfinite(values)]
    if not values.size:
        return {"unstable": None}
    finish = record.meanings("unstable_finish")[int(record["unstable_finish"][place])]
    return {
        "unstable": {
            "period": int(record["unstable_period"][place]),
            "motions": int(values.size),
            "from": float(np.min(values)),
            "to": float(np.max(values)),
            "multiplier_modulus_max": float(np.nanmax(record["unstable_multiplier_modulus"][place])),
            "finish": finish.replace("_", " "),
            "finish_value": float(record["unstable_finish_value"][place]),
        }
    }


def _end_line(record: SweepRecord, end: dict[str, Any]) -> str:
    said = f"a branch of period {end['period']} ends at {_place(record, end['at'])}: {end['kind']}"
    beyond = end.get("unstable")
    if beyond is None:
        return said
    units = record.parameters[0].units
    low, high, finish = (shown(beyond[name], units) for name in ("from", "to", "finish_value"))
    goes = f"{beyond['finish']} at {finish}" if np.isfinite(beyond["finish_value"]) else "no end in the range"
    return (
        f"{said}\n  beyond, period {beyond['period']} unstable between {low} and {high}, "
        f"multiplier at most {beyond['multiplier_modulus_max']:.4g}: {goes}"
    )


def sweep_warnings(record: SweepRecord) -> list[str]:
    """What the cases warn of, and how many they are."""
    done = record.count()["done"]
    return [f"{count} of {done} cases: {text}" for text, count in record.warnings().items()]


def described(record: SweepRecord, name: str) -> Quantity:
    """A quantity as the record itself describes it."""
    label = record.long_name(name)
    return Quantity(name, label[:1].upper() + label[1:], shown_unit(record.units(name))[0])


def _counted(count: dict[str, int]) -> str:
    return ", ".join(f"{count[name]} {name}" for name in ("done", "failed", "waiting") if count[name])


def _kinds(record: SweepRecord) -> str:
    """How often each sort of motion was found; nothing where no motion was sought."""
    if "solution" not in record:
        return ""
    solutions = record["solution"]
    names, numbers = np.unique(solutions[(solutions != "") & (solutions != "failed")], return_counts=True)
    return ", ".join(f"{number} {name}" for name, number in zip(names, numbers, strict=True))


def _row(record: SweepRecord, column: Quantity, values: np.ndarray) -> list[str]:
    cells = [column.title]
    for find in (np.nanargmin, np.nanargmax):
        place = tuple(int(i) for i in np.unravel_index(int(find(values)), values.shape))
        cells += [column.written(float(values[place])), _place(record, record.at(place))]
    return [*cells, column.unit]


def _place(record: SweepRecord, at: dict[str, Any]) -> str:
    """Name a case by its values in engineers' units, in the order of the dimensions."""
    units = {one.name: one.units for one in record.parameters}
    return ", ".join(shown(value, units.get(name, "")) for name, value in at.items())


def sweep_as_json(record: SweepRecord) -> dict[str, Any]:
    """Turn a sweep into what JSON takes: axes, figures as nested lists in SI, failures; NaN becomes None."""
    dims = len(record.dims)
    names = [name for name in record if name not in ("message", "status") and record[name].ndim == dims]
    return {
        "record": str(record.path),
        "title": record.scenario.get("title", ""),
        "status": record.status,
        "message": record.message,
        **{name: record.attrs[name] for name in ("created", "tribodyn_version", "scenario_sha256")},
        **record.count(),
        "parameters": [one._asdict() for one in record.parameters],
        "directions": list(record.directions),
        "settings": record.settings,
        "figures": {name: {"units": record.units(name), "values": record[name]} for name in names},
        "spread": {name: found for name in names if (found := spread(record, name)) is not None},
        "weighted_mean": {
            name: found for name in names if (found := weighted_mean(record, name)) is not None
        },
        "ends": branch_ends(record),
        "failures": [{"at": at, "message": why} for at, why in record.failures()],
        "warnings": sweep_warnings(record),
        "summary": record.summary,
    }
