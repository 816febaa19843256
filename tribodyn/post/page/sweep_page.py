"""The page of a sweep: figures of its cases over the first varied key, its table and its pictures."""

from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.cycles import stretches
from tribodyn.post.figures.sweep_branch import Branch, axis_label, branches
from tribodyn.post.figures.sweep_response import panels_of
from tribodyn.post.page.data import packed
from tribodyn.post.page.document import assembled, compressed
from tribodyn.post.page.page import origin, picture, table, title_of, verdict_list
from tribodyn.post.sweep_report import described, sweep_remarks, sweep_rows, sweep_verdict, sweep_warnings
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.sweep_reader import SweepRecord


def sweep_page(
    record: SweepRecord,
    quantities: Sequence[Quantity],
    pictures: Sequence[tuple[str, str, Figure]],
    tables: Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]],
    teeth: dict[str, Any] | None = None,
    bodies: bytes = b"",
) -> str:
    """Write the page; InputError if the first key is no number.

    Of no quantities all are shown, as the record describes them. Pictures have name, about and figure, tables
    (what is known of the scenario that is varied) title, columns and rows; `teeth` are those of that
    scenario, as `rolling_teeth.turning_teeth` has them, `bodies` its gears and shafts as glTF.
    """
    recorded = [quantity for quantity in quantities if quantity.name in record]
    recorded = recorded or [described(record, name) for name in record.quantities]
    curves = branches([record])
    if not curves or not len(curves[0].x):
        raise record.refused("holds no cases to draw", "run the sweep again")
    order = np.argsort(curves[0].x)
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
                for branch in curves
            ],
        }
        for quantity in recorded
    ]
    axis = curves[0].x[order]
    span = [float(axis[0]), float(axis[-1]) if len(axis) > 1 else float(axis[0]) + 1.0]
    data: dict[str, Any] = {
        "label": record.label,
        "axis": packed(axis, "<f8"),
        "cycle": (span[1] - span[0]) / 4.0,
        "window": span,
        "start": span[0],
        "series": series,
        "teeth": teeth,
        "rates": packed(_rates(record, axis)),
        "outside": _lost(curves, order, [quantity.name for quantity in recorded]),
    }
    payload = {
        "records": [data | ({"bodies": 0} if bodies else {})],
        "bodies": [compressed(bodies)] if bodies else [],
        "panels": [panel.quantity.name for panel in panels_of([record], recorded)],
        "shaded": "contact is lost at times",
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
            "WARNINGS": "".join(f'<p class="warning">{escape(warning)}</p>' for warning in warnings)
            + verdict_list(sweep_verdict(record)),
            "SUMMARY": table("Quantities of the cases", columns, sweep_rows(record, recorded)),
            "TRUST": f"<ul>{remarks}</ul>",
            "OVER": "Over the first varied key",
            "SHEET": f"<section><h2>The scenario that is varied</h2>{sheet}</section>" if sheet else "",
            "PICTURES": "".join(picture(*drawing) for drawing in pictures),
            "ORIGIN": origin(record),
        },
    )


def _rates(record: SweepRecord, axis: np.ndarray) -> np.ndarray:
    """How fast gears turn at each value of the first key, of the fastest; all alike where it is no speed."""
    if record.parameters[0].units != "rad/s":
        return np.ones(len(axis))
    return np.abs(axis) / (np.max(np.abs(axis)) or 1.0)


def _lost(curves: Sequence[Branch], order: np.ndarray, names: Sequence[str]) -> dict[str, list[list[int]]]:
    """First and last case of intervals in which contact is lost on any branch, for every quantity."""
    if "contact_loss_fraction" not in curves[0].record:
        return {}
    lost = np.any([branch.values("contact_loss_fraction")[order] > 0.0 for branch in curves], axis=0)
    intervals = (stretches(lost) - (0, 1)).tolist()
    return {name: intervals for name in names} if intervals else {}
