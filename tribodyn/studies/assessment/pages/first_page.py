"""Pieces of the first page of an assessment: verdict, tiles, tables of numbers, sentences, origin."""

import math
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib import resources
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.assessment_part import TaskResult
from tribodyn.cases.results import TextTable
from tribodyn.gears.rating.bearings import bearing_rows
from tribodyn.gears.rating.limits import LIMITS, on_limits, written_limit
from tribodyn.post.page.document import document
from tribodyn.post.page.page import summary_tables, table, verdict_list, warnings_of
from tribodyn.post.style import inline
from tribodyn.quantities.catalogue import scatter
from tribodyn.record.reader import Record
from tribodyn.studies.pages import drawable, figure, overview
from tribodyn.studies.protocol.study import Study
from tribodyn.tribology.oil import ZERO_CELSIUS, LubricantData

#: The figure of a run that stands beside its overview where it is to be had.
_SHAFTS = "shafts"


def header(record: Record, what: str) -> str:
    """Title, kind and date of a record."""
    created = str(record.attrs["created"]).partition("T")[0]
    origin_text = f"{what}, {created}, tribodyn {record.attrs['tribodyn_version']}"
    return f"<header><h1>{escape(_title(record))}</h1><p>{escape(origin_text)}</p></header>"


class Front(NamedTuple):
    """What stands on the first page, and first behind it."""

    verdict: Sequence[str]  # its lines
    holds: str
    asked: str
    tiles: str
    below_limits: str


def written(record: Record, what: str, front: Front, body: Sequence[str], sheets: Iterable[TextTable]) -> str:
    """The page: of these pieces the first page, the `body` behind it, sheets of gears and oil, the origin."""
    summary = record.summary
    pieces = [
        header(record, what),
        verdict_of(record, front.verdict),
        front.holds,
        f"<section><h2>Duty</h2>{front.asked}</section>",
        '<div class="columns">',
        f"<div>{listed('Assumed', summary.get('assumed', {}))}</div>",
        f"<div>{listed('Extrapolated', summary.get('extrapolated', {}))}</div>",
        "</div>",
        '<div class="break"></div>',
        front.tiles,
        limits_table(summary),
        front.below_limits,
        *body,
        f"<section><h2>Gears and oil</h2>{''.join(table(*sheet) for sheet in sheets)}</section>",
        origin(record),
    ]
    style = resources.files(__package__ or "").joinpath("page.css").read_text(encoding="utf-8")
    policy = "style-src 'unsafe-inline'; img-src data:"
    return document(_title(record), style, "\n".join(pieces) + "\n", policy)


def _title(record: Record) -> str:
    return str(record.scenario.get("title", record.label))


def verdict_of(record: Record, lines: Sequence[str]) -> str:
    """Whether the limits hold, warnings, and other lines of a verdict."""
    summary = record.summary
    marked = [("good" if good else "bad", text) for good, text in on_limits(summary)]
    paragraphs = [f'<p class="verdict {kind}">{escape(text)}</p>' for kind, text in marked]
    warnings = warnings_of(record, named=False).replace('class="warning"', 'class="verdict bad"')
    lines = [line for line in lines if line not in [text for _, text in marked]]
    return "".join(paragraphs) + warnings + verdict_list(lines)


def asked(rows: Mapping[str, str]) -> str:
    """What was asked: a line of text each."""
    cells = (f"<tr><td><b>{name}</b></td><td>{escape(text)}</td></tr>" for name, text in rows.items())
    return f'<table class="asked">{"".join(cells)}</table>'


def oil_line(lubricant: LubricantData, temperature: float, lubrication: str) -> str:
    """An oil and how it gets to the mesh, at a temperature in K."""
    sheet, duty = lubricant.sheet, f"at {temperature - ZERO_CELSIUS:.4g} °C, {lubrication}"
    if sheet is None:
        return duty
    return f"{sheet.type}, {sheet.viscosity_40 * 1e6:.4g}/{sheet.viscosity_100 * 1e6:.4g} mm²/s, {duty}"


def tiles(shown: Sequence[Sequence[str]]) -> str:
    """Values, written, what they are, and where known their range over samples."""
    each = (
        f'<div class="tile"><b>{escape(value)}</b>'
        + "".join(f"<i>{escape(text)}</i>" for text in over if text)
        + f"<span>{escape(text)}</span></div>"
        for value, text, *over in shown
    )
    five = " five" * (len(shown) % 4 == 1)
    return f'<div class="tiles{five}">{"".join(each)}</div>'


def numbers_table(
    heading: str, columns: Sequence[str], rows: Sequence[Sequence[str]], kind: str = "", marked: Any = ()
) -> str:
    """A section with a table of numbers, some rows of which are marked as bad."""

    def cells(tag: str, row: Sequence[str]) -> str:
        return "".join(f"<{tag}>{escape(text)}</{tag}>" for text in row)

    lines = [f"<tr>{cells('th', columns)}</tr>"]
    for number, row in enumerate(rows):
        mark = ' class="bad"' if number in marked else ""
        lines.append(f"<tr{mark}>{cells('td', row)}</tr>")
    table = f'<table class="numbers{kind}">{"".join(lines)}</table>'
    dashes = '<p class="quiet">–: not determined.</p>' if any("–" in row for row in rows) else ""
    return f'<section><h2>{heading}</h2><div class="wide">{table}</div>{dashes}</section>'


class Judged(NamedTuple):
    """A cell of a table that says what holds."""

    text: str
    mark: str = ""  # "good", "bad" or neither
    span: int = 1  # columns that it takes


def judged_cell(
    value: float | None, limit: str, limits: Mapping[str, Any], span: int = 1, *, unlimited: bool = False
) -> Judged:
    """A value as it is written, good or bad by a limit of the summary; a dash where there is none.

    An `unlimited` one is a lower bound.
    """
    if value is None or not math.isfinite(value):
        return Judged("–", "", span)
    mark, asked_for = "", limits.get(limit)
    if asked_for is not None:
        kept = value >= asked_for["limit"] if LIMITS[limit].least else value <= asked_for["limit"]
        mark = "good" if kept else "bad"
    return Judged("≥ " * unlimited + LIMITS[limit].quantity.written(float(value)), mark, span)


def holds_table(heading: str, heads: Sequence[Sequence[Judged]], rows: Sequence[Sequence[Judged]]) -> str:
    """A section with what holds in green and what does not in red."""

    def line(tag: str, cells: Sequence[Judged]) -> str:
        return "".join(
            f'<{tag} class="{cell.mark}" colspan="{cell.span}">{escape(cell.text)}</{tag}>' for cell in cells
        )

    lines = [f"<tr>{line('th', head)}</tr>" for head in heads] + [
        f"<tr>{line('td', row)}</tr>" for row in rows
    ]
    table = f'<table class="holds">{"".join(lines)}</table>'
    return f'<section><h2>{escape(heading)}</h2><div class="wide">{table}</div></section>'


def bearings_table(summary: Mapping[str, Any]) -> str:
    """The bearings of drawn shafts; "" where there are none."""
    bearings = summary.get("bearings")
    return numbers_table("Bearings", *bearing_rows(bearings), " points") if bearings else ""


def limits_table(summary: Mapping[str, Any]) -> str:
    """Every limit that was judged, those that are not kept red."""
    judged = summary.get("limits", {})
    limits, rows = {name: judged[name] for name in LIMITS if name in judged}, []
    for name, cell in limits.items():
        limit = LIMITS[name]
        value, bound = written_limit(name, cell), limit.quantity.written(float(cell["limit"]))
        required = f"{'≥' if limit.least else '≤'} {bound}"
        missed = "below" if limit.least else "above"
        verdict = "holds" if cell["kept"] else missed
        if cell.get("exceed"):
            verdict += f"; {cell['exceed']} of {cell['samples']} samples {missed}"
        rows.append((limit.label, value, required, limit.quantity.unit, verdict))
    exceeded = [
        number for number, cell in enumerate(limits.values()) if not cell["kept"] or cell.get("exceed")
    ]
    return numbers_table("Limits", ("Limit", "value", "required", "", ""), rows, marked=exceeded)


def listed(heading: str, sentences: Mapping[str, str]) -> str:
    """Sentences under a heading."""
    items = "".join(f"<li>{escape(str(text))}</li>" for text in sentences.values()) or "<li>Nothing.</li>"
    return f'<section class="small"><h2>{heading}</h2><ul>{items}</ul></section>'


def part_section(study: Study, title: str, done: Sequence[TaskResult]) -> str:
    """Picture and summary of the first record of a part; of rows their extremes stand on the first page."""
    for result in done:
        if not result.summary:
            continue
        with Record(result.path) as record:
            picture = f'<div class="pictures">{inline(overview(record), title)}</div>'
            if _SHAFTS in drawable([record]):
                picture += f'<div class="pictures">{inline(figure(_SHAFTS, [record]), _SHAFTS)}</div>'
            tables = summary_tables([record], [study.reported()])
        return f"<section><h2>{escape(title)}</h2>{picture}{tables}</section>"
    return ""


def origin(record: Record) -> str:
    """The scenario file and its digest."""
    scenario = escape(str(record.attrs["scenario"]))
    digest = escape(str(record.attrs["scenario_sha256"]))
    return (
        f'<section class="break"><h2>Scenario and origin</h2><p class="quiet">scenario sha256 {digest}</p>'
        f"<details><summary>Scenario file</summary><pre>{scenario}</pre></details></section>"
    )


def range_over(values: Any, digits: str, factor: float = 1.0, offset: float = 0.0) -> str:
    """5 and 95 % of values over the samples, in another unit; nothing where none is known."""
    if values is None or not np.any(np.isfinite(np.asarray(values, dtype=float))):
        return ""
    ends = (factor * (float(scatter(values)[end]) + offset) for end in ("p5", "p95"))
    return f"samples {' to '.join(format(end, digits) for end in ends)}"


def folded_sums(tables: Sequence[TextTable]) -> str:
    """Miner's sums duty by duty, folded; "" without a load spectrum."""
    shown = "".join(numbers_table(*each, " points") for each in tables)
    return f"<details><summary>Miner's sum, duty by duty</summary>{shown}</details>" if shown else ""
