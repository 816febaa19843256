"""The summary of a sweep's record: a table for people, a dictionary for programs."""

from typing import Any, NamedTuple

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from tribodyn.post.shown_units import shown
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE, FIGURES


class Column(NamedTuple):
    """A figure in the table: dataset, label, factor from SI, unit, format."""

    name: str
    label: str
    factor: float = 1.0
    unit: str = ""
    form: str = ".4g"


COLUMNS = (
    Column("transmission_error_rms", "Transmission error, RMS", 1e6, "µm"),
    Column("transmission_error_peak_to_peak", "Transmission error, peak to peak", 1e6, "µm"),
    Column("dynamic_factor", "Dynamic factor", form=".3f"),
    Column("normal_load_max", "Greatest normal load", form=",.0f", unit="N"),
    Column("hertz_pressure_max", "Greatest Hertz pressure", 1e-9, "GPa", ".3g"),
    Column("film_min", "Least film thickness", 1e6, "µm", ".3g"),
    Column("efficiency", "Efficiency", 100.0, "%", ".3f"),
    Column("contact_loss_fraction", "Time without contact", 100.0, "%", ".3g"),
)
#: Failed cases that are named; the record has them all.
FAILURES_SHOWN = 5


def sweep_table(record: SweepRecord) -> Group:
    """Lay out a sweep for the terminal: least and greatest of every figure, and where they are."""
    parts: list[Any] = [Text(str(record.scenario.get("title", record.label)), style="bold")]
    if record.status != "complete":
        parts.append(Text(f"{record.status}: {record.message}", style="bold red"))
    count = record.count()
    axes = ", ".join(f"{len(one.values)} of {one.key}" for one in record.parameters)
    both = f", {' and '.join(record.directions)}" if record.directions else ""
    parts.append(Text(f"{count['cases']} cases ({axes}{both}): {_counted(count)}"))
    if kinds := _kinds(record):
        parts.append(Text(f"motion: {kinds}"))
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ("", "least", "at", "greatest", "at", ""):
        table.add_column(title, justify="right" if title in ("least", "greatest") else "left", no_wrap=True)
    for column in COLUMNS:
        values = np.where(record["status"] == DONE, record[column.name], np.nan)
        if np.isfinite(values).any():
            table.add_row(*_row(record, column, values))
    parts.append(table)
    failures = record.failures()
    parts += [Text(f"failed at {_place(record, at)}: {why}") for at, why in failures[:FAILURES_SHOWN]]
    if len(failures) > FAILURES_SHOWN:
        parts.append(Text(f"and {len(failures) - FAILURES_SHOWN} more, see message in the record"))
    return Group(*parts)


def _counted(count: dict[str, int]) -> str:
    return ", ".join(f"{count[name]} {name}" for name in ("done", "failed", "waiting") if count[name])


def _kinds(record: SweepRecord) -> str:
    """How often each sort of motion was found."""
    solutions = record["solution"]
    names, numbers = np.unique(solutions[(solutions != "") & (solutions != "failed")], return_counts=True)
    return ", ".join(f"{number} {name}" for name, number in zip(names, numbers, strict=True))


def _row(record: SweepRecord, column: Column, values: np.ndarray) -> list[str]:
    cells = [column.label]
    for find in (np.nanargmin, np.nanargmax):
        place = tuple(int(i) for i in np.unravel_index(int(find(values)), values.shape))
        cells += [format(values[place] * column.factor, column.form), _place(record, record.at(place))]
    return [*cells, column.unit]


def _place(record: SweepRecord, at: dict[str, Any]) -> str:
    """Name a case by its values in engineers' units, in the order of the dimensions."""
    units = {one.name: one.units for one in record.parameters}
    return ", ".join(shown(value, units.get(name, "")) for name, value in at.items())


def sweep_as_json(record: SweepRecord) -> dict[str, Any]:
    """Turn a sweep into what JSON takes: axes, figures as nested lists in SI, failures; NaN becomes None."""
    names = (*FIGURES, "period", "stable", "multiplier_max", "solution", "cycles")
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
        "failures": [{"at": at, "message": why} for at, why in record.failures()],
        "summary": record.summary,
    }
