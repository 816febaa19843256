"""The summary of a sweep's record: a table for people, a dictionary for programs."""

from collections.abc import Sequence
from numbers import Real
from typing import Any

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from tribodyn.post import verdict
from tribodyn.quantities.catalogue import QUANTITIES, SPREAD, scatter
from tribodyn.quantities.quantity import Quantity, shown, shown_unit
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE

#: Failed cases that are named; the record has them all.
FAILURES_SHOWN = 5
#: Ends of branches that are named; the record has them all.
ENDS_SHOWN = 12
#: Peaks that are named; `show --json` has them all.
PEAKS_SHOWN = 8


def sweep_table(record: SweepRecord, quantities: Sequence[Quantity]) -> Group:
    """Lay out a sweep for the terminal: minimum and maximum of every quantity, and where they are.

    Of no quantities all are shown, as the record describes them.
    """
    # a record of an older version lacks quantities that have been added since
    shown_ones = [quantity for quantity in quantities if quantity.name in record]
    shown_ones = shown_ones or [described(record, name) for name in record.quantities]
    parts: list[Any] = [Text(str(record.scenario.get("title", record.label)), style="bold")]
    if record.status != "complete":
        parts.append(Text(f"{record.status}: {record.message}", style="bold red"))
    parts += map(Text, sweep_verdict(record))
    parts += map(Text, _head(record))
    if record.listed:
        parts += map(Text, (*data_set_lines(record), *_tail(record)))
        return Group(*parts)
    titles = ("", "minimum", "at", "maximum", "at", "")
    parts.append(_table(titles, (1, 3), sweep_rows(record, shown_ones)))
    parts += _tables_over_all(record, shown_ones)
    parts += map(Text, _tail(record))
    parts += [Text(f"Warning: {warning}", style="bold red") for warning in sweep_warnings(record)]
    return Group(*parts)


def sweep_verdict(record: SweepRecord) -> list[str]:
    """Say what a reader asks of a sweep first, see `tribodyn.post.verdict`."""
    return verdict.of_sweep(record, lambda at: _place(record, record.at(at)))


def _table(titles: Sequence[str], numbers: Sequence[int], rows: Sequence[Sequence[str]]) -> Table:
    """A table with titles above its columns; `numbers`: which of the columns are such."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for place, title in enumerate(titles):
        table.add_column(title, justify="right" if place in numbers else "left", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    return table


def _values(record: SweepRecord, name: str) -> np.ndarray | None:
    """A dataset of one number per case, NaN where the case is not done; None for others."""
    if record[name].dtype.kind not in "fiu" or record[name].ndim != len(record.dims):
        return None
    return np.where(record["status"] == DONE, record[name], np.nan)


def spread(record: SweepRecord, name: str) -> dict[str, np.ndarray] | None:
    """Median, 5 and 95 % of a quantity over all samples, for every value of the other parameters.

    None where no samples are varied. Failed cases are left out; NaN where none is left.
    """
    random_dims = record.settings.get("drawn", [])
    over = tuple(number for number, dim in enumerate(record.dims) if dim in random_dims)
    values = _values(record, name)
    return scatter(values, over) if over and values is not None else None


def weighted_mean(record: SweepRecord, name: str) -> np.ndarray | None:
    """Mean of a quantity over weighed cases, such as duties by their time, for every value of the others.

    None where nothing weighed is varied. Failed cases are left out; NaN where none is left.
    """
    weights = record.settings.get("weights", {})
    values = _values(record, name)
    if not weights or values is None:
        return None
    weight = np.ones(values.shape)
    for number, dim in enumerate(record.dims):
        if dim in weights:
            others = tuple(other for other in range(values.ndim) if other != number)
            weight = weight * np.expand_dims(np.asarray(weights[dim], dtype=float), others)
    over = tuple(number for number, dim in enumerate(record.dims) if dim in weights)
    mean = np.ma.average(np.ma.masked_invalid(values), axis=over, weights=weight)
    return np.ma.filled(mean, np.nan)


def _tables_over_all(record: SweepRecord, quantities: Sequence[Quantity]) -> list[Any]:
    """Scatter over the samples, means over weighed cases, each where nothing else is varied."""
    parts: list[Any] = []
    random_dims, weights = record.settings.get("drawn", []), record.settings.get("weights", {})
    done = record.count()["done"]
    if random_dims and all(dim in random_dims for dim in record.dims):
        titles = [name if name == "median" else f"{percentile:g} %" for name, percentile in SPREAD.items()]
        rows = []
        for quantity in quantities:
            scatter = spread(record, quantity.name)
            if scatter is not None and np.isfinite(scatter["median"]):
                cells = [_written(record, quantity, float(scatter[name])) for name in SPREAD]
                rows.append([quantity.title, *cells, quantity.unit])
        parts += [Text(""), _table((f"scatter of {done} samples", *titles, ""), (1, 2, 3), rows)]
    if weights and all(dim in weights for dim in record.dims):
        rows = []
        for quantity in quantities:
            mean = weighted_mean(record, quantity.name)
            if mean is not None and np.isfinite(mean):
                rows.append([quantity.title, _written(record, quantity, float(mean)), quantity.unit])
        parts += [Text(""), _table((f"weighted mean of {done} cases", "", ""), (1,), rows)]
    return parts


def sweep_remarks(record: SweepRecord) -> list[str]:
    """What a sweep found besides its quantities: cases, sorts of motion, ends of branches, failures."""
    return [*_head(record), *_tail(record)]


def sweep_rows(record: SweepRecord, quantities: Sequence[Quantity]) -> list[list[str]]:
    """Rows of the table: name, minimum and where, maximum and where, unit; of quantities with any value."""
    rows = []
    for quantity in quantities:
        values = np.where(record["status"] == DONE, record[quantity.name], np.nan)
        if not np.isfinite(values).any():
            continue
        row = [quantity.title]
        for find in (np.nanargmin, np.nanargmax):
            place = tuple(int(i) for i in np.unravel_index(int(find(values)), values.shape))
            row += [
                _written(record, quantity, float(values[place]), place),
                _place(record, record.at(place)),
            ]
        rows.append([*row, quantity.unit])
    return rows


def _written(
    record: SweepRecord, quantity: Quantity, value: float, place: tuple[int, ...] | None = None
) -> str:
    """A value of a case, or of all cases together, of which one that is a lower bound makes another such."""
    name = f"{quantity.name}_unlimited"
    bounds = record[name] == 1.0 if name in record else np.zeros(1, dtype=bool)
    unlimited = bounds[place] if place is not None and name in record else bounds.any()
    return quantity.written_of({quantity.name: value, name: unlimited})


def _head(record: SweepRecord) -> list[str]:
    count = record.count()
    sizes = {parameter.key: len(parameter.values) for parameter in record.parameters}
    if record.listed:
        sizes = {key: len(values) for key, values in record.settings["vary"].items()}
    axes = ", ".join(f"{size} of {key}" for key, size in sizes.items())
    both = f", {' and '.join(record.directions)}" if record.directions else ""
    states = ", ".join(f"{count[name]} {name}" for name in ("done", "failed", "waiting") if count[name])
    lines = [f"{count['cases']} case{'s' * (count['cases'] != 1)} ({axes}{both}): {states}"]
    if refined := record.settings.get("refine"):
        first = record.parameters[0]
        begun, by = len(record.settings["vary"][first.key]), " or ".join(refined["by"])
        more, most = len(first.values) - begun, refined["most"]
        lines.append(f"{first.key}: {begun} values and {more} more, of at most {most}, where {by} bends")
    if "solution" in record:
        solutions = record["solution"]
        reached = solutions[(solutions != "") & (solutions != "failed")]
        motions = ", ".join(
            f"{number} {name}" for name, number in zip(*np.unique(reached, return_counts=True), strict=True)
        )
        lines += [f"motion: {motions}"] if motions else []
    lines += [f"{key} = {texts}" for key, texts in record.settings.get("chosen", {}).items()]
    return lines


def data_set_lines(record: SweepRecord) -> list[str]:
    """What a data set holds: signals, labels, drives for training and test."""
    sensors = str(record.attrs["sensors"]).split()
    shape = {name: record.dims_of(name)[-1] for name in sensors}
    lines = []
    for name in sensors:
        time = record[shape[name]]
        rate = 1.0 / (time[1] - time[0]) if len(time) > 1 else float("nan")
        lines.append(
            f"signal {name}: {record.long_name(name)}, {record.units(name)}, "
            f"{len(time)} samples at {rate:.6g} Hz"
        )
    told = record.listed
    for name in ("label", "split"):
        counts = zip(*np.unique(told[name].astype(str), return_counts=True), strict=True)
        lines.append(f"{name}: " + ", ".join(f"{number} {value}" for value, number in counts))
    lines[-1] += f", by drive: {len(np.unique(told['drive']))} of them"
    return lines


def _tail(record: SweepRecord) -> list[str]:
    ends = branch_ends(record)
    lines = _peak_lines(record)
    lines += [_end_line(record, end) for end in ends[:ENDS_SHOWN]]
    if len(ends) > ENDS_SHOWN:
        lines.append(f"and {len(ends) - ENDS_SHOWN} more ends of branches, see end_value in the record")
    failures = record.failures()
    lines += [f"failed at {_place(record, at)}: {why}" for at, why in failures[:FAILURES_SHOWN]]
    if len(failures) > FAILURES_SHOWN:
        lines.append(f"and {len(failures) - FAILURES_SHOWN} more, see message in the record")
    return lines


def _peak_lines(record: SweepRecord) -> list[str]:
    tops = record.peaks()
    lines = []
    for top in tops[:PEAKS_SHOWN]:
        quantity = QUANTITIES.get(top["quantity"]) or described(record, top["quantity"])
        value = f"{quantity.written(top['value'])} {quantity.unit}".rstrip()
        near = shown(top["within"], record.parameters[0].units, 4)
        lines.append(f"peak of {quantity.title}: {value} at {_place(record, top['at'])}, within {near}")
    return lines + ([f"and {len(tops) - PEAKS_SHOWN} more peaks"] if len(tops) > PEAKS_SHOWN else [])


def branch_ends(record: SweepRecord) -> list[dict[str, Any]]:
    """Ends of the branches that a followed sweep left, in the order of the cases."""
    if "end_kind" not in record:
        return []
    kinds = record.meanings("end_kind")
    number = record["end_kind"]
    ends = []
    for place in map(tuple, np.argwhere(number > 0)):
        first = record.parameters[0].name
        end = {
            "kind": kinds[int(number[place])].replace("_", " "),
            "at": record.at(place[:-1]) | {first: float(record["end_value"][place])},
            "within": float(record["end_within"][place]),
            "period": int(record["end_period"][place]),
            "multiplier_modulus": float(record["end_multiplier_modulus"][place]),
            "multiplier_angle": float(record["end_multiplier_angle"][place]),
        }
        ends.append(end | _beyond(record, place))
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
    line = f"a branch of period {end['period']} ends at {_place(record, end['at'])}: {end['kind']}"
    beyond = end.get("unstable")
    if beyond is None:
        return line
    units = record.parameters[0].units
    low, high, finish = (shown(beyond[name], units) for name in ("from", "to", "finish_value"))
    goes = f"{beyond['finish']} at {finish}" if np.isfinite(beyond["finish_value"]) else "no end in the range"
    return (
        f"{line}\n  beyond, period {beyond['period']} unstable between {low} and {high}, "
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


def _place(record: SweepRecord, at: dict[str, Any]) -> str:
    """Name a case by its values in engineers' units, in the order of the dimensions."""
    units = {parameter.name: parameter.units for parameter in record.parameters}
    return ", ".join(_value(name, value, units.get(name, "")) for name, value in at.items())


def _value(name: str, value: object, units: str) -> str:
    """A value with its unit; a plain number with its name."""
    plain = isinstance(value, Real) and shown_unit(units)[0] == ""
    return f"{name.replace('_', ' ')} {shown(value, units)}" if plain else shown(value, units)


def sweep_as_json(record: SweepRecord) -> dict[str, Any]:
    """Turn a sweep into what JSON takes: axes, quantities as nested lists in SI, failures; NaN as None."""
    dims = len(record.dims)
    names = [name for name in record if name not in ("message", "status") and record[name].ndim == dims]
    return {
        "record": str(record.path),
        "title": record.scenario.get("title", ""),
        "status": record.status,
        "message": record.message,
        **{name: record.attrs[name] for name in ("created", "tribodyn_version", "scenario_sha256")},
        **record.count(),
        "parameters": [parameter._asdict() for parameter in record.parameters],
        "directions": list(record.directions),
        "settings": record.settings,
        "figures": {name: {"units": record.units(name), "values": record[name]} for name in names},
        "spread": {name: statistic for name in names if (statistic := spread(record, name)) is not None},
        "weighted_mean": {
            name: statistic for name in names if (statistic := weighted_mean(record, name)) is not None
        },
        "peaks": record.peaks(),
        "ends": branch_ends(record),
        "failures": [{"at": at, "message": why} for at, why in record.failures()],
        "warnings": sweep_warnings(record),
        "summary": record.summary,
    }
