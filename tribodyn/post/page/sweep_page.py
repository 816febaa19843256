"""The page of a sweep: figures of its cases over the first varied key, its table and its pictures."""

from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.figures.sweep.branch import axis_label, branches
from tribodyn.post.page.data import packed
from tribodyn.post.page.page import FIGURES, assembled, origin, picture, table, title_of
from tribodyn.post.sweep_report import described, sweep_remarks, sweep_rows, sweep_warnings
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.sweep_reader import SweepRecord


def sweep_page(
    record: SweepRecord,
    quantities: Sequence[Quantity],
    pictures: Sequence[tuple[str, str, Figure]],
    tables: Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]],
) -> str:
    """Write the page; InputError if the first key is no number.

    Of no quantities all are shown, as the record describes them. Pictures have name, about and figure, tables
    (what is known of the scenario that is varied) title, columns and rows.
    """
    known = [quantity for quantity in quantities if quantity.name in record]
    known = known or [described(record, name) for name in record.quantities]
    drawn = branches([record])
    if not drawn or not len(drawn[0].x):
        raise InputError("record", str(record.path), "holds no cases to draw", "run the sweep again")
    order = np.argsort(drawn[0].x)
    series = [
        {
            "name": quantity.name,
            "short": quantity.title,
            "title": quantity.title,
            "unit": quantity.unit,
            "curves": [
                {
                    "label": ", ".join(filter(None, (branch.label, branch.direction))),
                    "y": packed(quantity.in_unit(branch.values(quantity.name)[order])),
                    "i": None,
                }
                for branch in drawn
            ],
        }
        for quantity in known
    ]
    axis = drawn[0].x[order]
    span = [float(axis[0]), float(axis[-1]) if len(axis) > 1 else float(axis[0]) + 1.0]
    data: dict[str, Any] = {
        "label": record.label,
        "axis": packed(axis, "<f8"),
        "cycle": (span[1] - span[0]) / 4.0,
        "window": span,
        "start": span[0],
        "series": series,
        "teeth": None,
    }
    payload = {
        "records": [data],
        "panels": [quantity.name for quantity in known[:FIGURES]],
        "load": "",
        "axis": axis_label(record.parameters[0]),
    }
    columns = ("", "minimum", "at", "maximum", "at", "unit")
    warnings = [*sweep_warnings(record), *([record.message] if record.message else [])]
    sheet = "".join(table(*written) for written in tables)
    remarks = "".join(f"<li>{escape(remark)}</li>" for remark in sweep_remarks(record))
    return assembled(
        title_of(record),
        payload,
        {
            "WARNINGS": "".join(f'<p class="warning">{escape(warning)}</p>' for warning in warnings),
            "SUMMARY": table("Quantities of the cases", columns, sweep_rows(record, known)),
            "TRUST": f"<ul>{remarks}</ul>",
            "OVER": "Over the first varied key",
            "SHEET": f"<section><h2>The scenario that is varied</h2>{sheet}</section>" if sheet else "",
            "PICTURES": "".join(picture(*drawing) for drawing in pictures),
            "ORIGIN": origin(record),
        },
    )
