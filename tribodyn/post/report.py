"""The summary of a record: a table for people, a dictionary for programs."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from tribodyn.post.verdict import meaning
from tribodyn.quantities.quantity import Reported, from_to
from tribodyn.record import trust
from tribodyn.record.reader import Record
from tribodyn.record.withheld_efficiency import reasons, warnings

#: How a sentence on exceeded limits of a law begins: it is shown in another colour.
EXCEEDED = "Limits of the"
#: Heading of what only those ask for who look into how it was computed.
SOLVER = "Solver"


def summary_table(
    record: Record,
    reported: Reported,
    verdict: Sequence[str],
    sentences: Sequence[str] | None,
    tables: Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]] = (),
) -> Group:
    """Lay out the summary of a record for the terminal (a rich renderable), in engineers' units.

    `reported` is what the study of the record has in its summary, `verdict` what it says first, `sentences`
    how far to trust it; None leaves these details out, and those of the solver. `tables` (title, columns,
    rows) of parts come below.
    """
    parts: list[Any] = [Text(str(record.scenario.get("title", record.path.stem)), style="bold")]
    urgent = "bold red" if record.status != "complete" or record.trust == trust.OUTSIDE else ""
    parts += [Text(line, style=urgent if place == 0 else "") for place, line in enumerate(verdict)]
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(no_wrap=True)
    table.add_column(justify="right")
    table.add_column(no_wrap=True)
    withheld = reasons(record.summary)
    for group, quantities in reported.items():
        if sentences is None and group == SOLVER:
            continue
        rows = []
        for quantity in quantities:
            label, value = quantity.in_table, record.summary.get(quantity.name)
            if quantity.name in withheld:
                rows.append((f"  {label}", "withheld", ""))
            elif value is not None:
                if np.ndim(value) and not quantity.listed:
                    label += f", {_order_of(record.pairs)}"
                rows.append((f"  {label}", quantity.written_of(record.summary), quantity.unit))
        if rows:
            table.add_row(Text(group, style="bold cyan"), "", "")
        for row in rows:
            table.add_row(*row)
    parts += [table, *(_of_parts(*one) for one in tables)]
    if sentences is None:
        return Group(*parts)
    parts.append(Text("How far to trust it", style="bold cyan"))
    parts += [Text(f"  Warning: {warning}.", style="bold red") for warning in warnings(record.summary)]
    lines = [*sentences]
    if record.status != "complete":
        lines.append(f"The run is {record.status}: {record.samples} samples were written.")
    parts += [
        Text(f"  {line}", style="yellow" if line.startswith(EXCEEDED) else "")
        for line in lines or ["The record has no summary."]
    ]
    return Group(*parts)


def _of_parts(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """A table of parts: what the rows are about, a column for each part, units."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold cyan")
    table.add_column(title, no_wrap=True)
    for name in columns[1:]:
        table.add_column(name, justify="right" if name else "left")
    for label, *cells in rows:
        table.add_row(f"  {label}", *cells)
    return table


def _order_of(pairs: Sequence[int]) -> str:
    """In which order values of several pairs stand: the newest pair is 1, back flanks begin with 2."""
    if sorted(pairs) == [0, 1]:
        return "entering / leaving pair"
    return f"pairs {', '.join(map(str, reversed(pairs)))}; 1 is the entering one"


def on_methods(summary: Mapping[str, Any]) -> list[str]:
    """Say by which method it was solved and over which cycles means are taken."""
    sentences = []
    if "solver" in summary and "solver_reason" in summary:
        sentences.append(f"Solved by {summary['solver']} ({summary['solver_reason']}).")
    if summary.get("compliance_remark"):
        sentences.append(str(summary["compliance_remark"]))
    sentences += [str(summary[name]) for name in ("slice_remark", "settling_remark") if summary.get(name)]
    cycles = summary.get("averaging_cycles")
    if cycles is not None:
        sentences.append(f"Means are over the last {cycles} mesh cycle{'s' if cycles != 1 else ''}.")
    return sentences


def on_closures(summary: Mapping[str, Any]) -> list[str]:
    """Say how much of the contact is inside the ranges of the laws, and what pressure at P means."""
    sentences = []
    fraction = summary.get("closure_in_range_fraction")
    if fraction is not None:
        outside = "" if fraction >= 1 else "; the rest is extrapolated"
        sentences.append(f"The film law is inside its range in {_percent(fraction)} of the contact{outside}.")
        sentences += exceeded(summary, "closure_exceeded", "film law")
    if summary.get("film_thickness") == "minimum":
        sentences.append(
            f"The formula of {summary['film_law']} is of the minimum film, some 15 % below that on the line "
            "of centres."
        )
    if summary.get("film_range") == "none stated":
        sentences.append(f"The film law {summary['film_law']} states no range of validity.")
    friction, name = summary.get("friction_in_range_fraction"), summary.get("friction_law")
    if friction is not None and not (friction >= 1):
        sentences.append(
            f"The friction law {name} is inside its range in {_percent(friction)} of the contact; "
            "the rest is extrapolated."
        )
        sentences += exceeded(summary, "friction_exceeded", "friction law")
    elif friction is None and name not in (None, "none"):
        sentences.append(f"The friction law {name} states no range of validity.")
    sentences += [
        f"The {what} law is {summary[f'{what}_law']}, {summary[f'{what}_chosen']}."
        for what in ("film", "friction")
        if f"{what}_chosen" in summary
    ]
    sentences += _without_judged_range(summary)
    errors = [
        f"{what} within {100 * float(summary[key]):.2g} %"
        for what, key in (("film", "film_table_error"), ("friction", "friction_table_error"))
        if key in summary
    ]
    low, high = summary.get("friction_band_low"), summary.get("friction_band_high")
    if low is not None and high is not None:
        sentences.append(
            f"The oil's viscosity at high pressure is estimated by its type: what measured oils span makes "
            f"the solved friction {from_to(float(low), float(high))} times what is printed."
        )
    if errors:
        sentences.append(
            f"The table of solved contacts gives {' and '.join(errors)} of 95 % of those it was held against."
        )
    if summary.get("pitch_point", "regular") != "regular":
        sentences.append(
            f"At the pitch point {summary['pitch_point']}; pressure there is no measure of merit."
        )
    return sentences


def _without_judged_range(summary: Mapping[str, Any]) -> list[str]:
    """Say how far a law is from the solved contact, where that bears it out in no range."""
    sentences = []
    for what in ("film", "friction"):
        ratio = summary.get(f"{what}_judged")  # of the law to the solved contact
        if isinstance(ratio, Mapping) and not ratio.get("limits", 1):  # none of one compared at the duty
            times = f"{from_to(ratio['low'], ratio['high'])} times"
            sentences.append(
                f"The {what} law {summary[f'{what}_law']} has no range by the solved contact: in nine of ten "
                f"contacts of gears it gives {times} the solved {what}."
            )
    return sentences


def exceeded(summary: Mapping[str, Any], name: str, law: str) -> list[str]:
    """Say what exceeds the limits of a law, and in which share of the contact."""
    exceedances = summary.get(name)
    if not isinstance(exceedances, Mapping) or not exceedances:
        return []
    shares: dict[str, float] = {}
    for excess in exceedances.values():
        what = meaning(str(excess["limit"]))
        shares[what] = max(float(excess["share"]), shares.get(what, 0.0))
    parts = [f"{what} in {_percent(share, up=True)}" for what, share in shares.items()]
    return [f"{EXCEEDED} {law} exceeded: {'; '.join(parts)} of the contact."]


def on_energy(summary: Mapping[str, Any]) -> list[str]:
    """Say how well the energy balance closes."""
    residual = summary.get("energy_residual")
    if residual is None or not math.isfinite(residual):
        return []
    return [f"The energy balance closes within {abs(residual):.1e} of the largest work in it."]


def _percent(fraction: float, up: bool = False) -> str:
    """Write a share in per cent, 100 only when it is whole; rounded down, or `up`."""
    tenths = (math.ceil if up else math.floor)(fraction * 1000 - (1e-9 if up else 0.0))
    return f"{min(tenths, 999) / 10:.1f} %" if fraction < 1 else "100 %"


def as_json(record: Record, verdict: Sequence[str]) -> dict[str, Any]:
    """A record's head, verdict and summary, SI units, as `cli.printing.plain` turns them into JSON."""
    head = ("created", "tribodyn_version", "scenario_sha256")
    return {
        "record": str(record.path),
        "title": record.scenario.get("title", ""),
        "status": record.status,
        "message": record.message,
        "verdict": [*verdict],
        "trust": record.trust,
        "trust_reasons": trust.reasons(record.summary),
        **{name: record.attrs[name] for name in head},
        "samples": record.samples,
        **({"elements": len(record.elements)} if record.elements else {"pairs": list(record.pairs)}),
        "summary": record.summary,
    }
