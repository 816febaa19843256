"""The page of a search: what it found, before and after, its pictures, how it went."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.post.page.page import PageContent
from tribodyn.post.page.page import page as write
from tribodyn.record.reader import Record
from tribodyn.studies.design.figures import DRAWINGS, objective
from tribodyn.studies.design.outcome import OBJECTIVES
from tribodyn.studies.design.report import PANELS, REPORTED, quantity_of, sentences, verdict
from tribodyn.studies.pages import figure, sheet
from tribodyn.studies.protocol.study import TextTable

#: Pictures on the page, where the record holds enough for them.
PICTURES = ("teeth", "overview", "front")


def page(record: Record) -> str:
    """Write the page of a search's record."""
    pictures = [
        (name, DRAWINGS[name].about, figure(name, [record]))
        for name in PICTURES
        if DRAWINGS[name].fits(record)
    ]
    content = PageContent(
        REPORTED,
        sentences(record),
        PANELS,
        tables=sheet(record),
        heading="Scenario that was searched through",
        found=before_and_after(record),
        pictures=pictures,
        titles={
            name: f"Objective: {objective(record, place).title}"
            for place, name in enumerate(OBJECTIVES)
            if name in record
        },
        verdict=verdict(record),
    )
    return write([record], [content])


def before_and_after(record: Record) -> tuple[TextTable, ...]:
    """Free keys, and all quantities that a summary has a line for, at the start and at the best."""
    summary = record.summary
    if "best" not in summary:
        return ()
    start, best = (summary.get(name, {}) for name in ("start", "best"))
    keys = [(key, str(start.get(key, "not set")), str(value)) for key, value in best.items()]
    before, after = (summary.get(f"quantities_{name}", {}) for name in ("start", "best"))
    rows = [
        row for name, value in after.items() if (row := _row(record.scenario, name, before.get(name), value))
    ]
    columns = ("quantity", "start", "best", "unit", "change")
    of_keys = TextTable("Values of the free keys", ("key", "start", "best"), keys)
    return of_keys, TextTable("Quantities before and after", columns, rows)


def _row(search: Mapping[str, Any], name: str, before: Any, after: Any) -> tuple[str, ...] | None:
    quantity = quantity_of(search, name)
    if quantity is None:
        return None
    change = "no start"
    if before is not None and np.isfinite(before) and before:
        change = f"{100.0 * (after / before - 1.0):+.1f} %"
    first = "not known" if before is None else quantity.written(before)
    return quantity.title, first, quantity.written(after), quantity.unit, change
