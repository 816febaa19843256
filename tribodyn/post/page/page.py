"""Puts a page together: one file, which asks nothing of any other place."""

from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.cycles import first_shown, shown_cycles
from tribodyn.post.page.data import (
    PageMap,
    Profiles,
    extrapolated,
    in_engineers_units,
    map_data,
    packed,
    profiles_data,
    series_data,
    series_of,
    with_unit,
)
from tribodyn.post.page.document import assembled, compressed
from tribodyn.post.page.motion import LOAD, Mechanism, mechanism_data, rolling_teeth
from tribodyn.post.page.sensors import SensedSection
from tribodyn.post.page.solid import Solid, solid_data
from tribodyn.post.report import EXCEEDED
from tribodyn.post.style import inline
from tribodyn.quantities.quantity import Quantity, Reported
from tribodyn.record import trust
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.withheld_efficiency import reasons, warnings

#: Figures that are shown at first where a study names none.
FIGURES = 4
#: Characters of a cell of a table that is not broken.
SHORT_CELL = 15


class PageContent(NamedTuple):
    """What a record's study has for its page."""

    reported: Reported  # quantities of its summary by heading
    sentences: Sequence[str]  # how far to trust it
    panels: Sequence[str] = ()  # datasets that are shown at first
    maps: Sequence[PageMap] = ()
    #: (title, columns, rows); the sheet of its gears, or what else stands under `heading`
    tables: Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]] = ()
    profiles: Profiles | None = None  # what is shown at the cursor
    heading: str = "Geometry"
    pictures: Sequence[tuple[str, str, Figure]] = ()  # sequence of (name, about, figure)
    verdict: Sequence[str] = ()  # what it says first
    #: tables as above of what was found; they and the pictures then stand before the run
    found: Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]] = ()
    titles: Mapping[str, str] = MappingProxyType({})  # of datasets, in place of those of the record
    mechanism: Mechanism | None = None  # what moves, where it is no pair of gears
    solid: Solid | None = None  # what bends and turns in space
    sensed: SensedSection = SensedSection()  # what its sensors gave
    #: tables as above of parts of what the summary is about, below it
    parts: Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]] = ()
    bodies: bytes = b""  # its gears and shafts in space, glTF 2.0 in one binary file; none: nothing to show


def page(records: Sequence[Record], contents: Sequence[PageContent], figures: bool = True) -> str:
    """Write the page of records, which share their quantities; the first one's are the panels.

    Without `figures` there is no more on it than the teeth and what moves them. Raises InputError for a
    record without samples.
    """
    data = [_record(record, len(records)) for record in records]
    for entry, record, content in zip(data, records, contents, strict=True):
        for series in entry["series"]:
            series["title"] = content.titles.get(series["name"], series["title"])
        if content.mechanism:
            entry["teeth"] = mechanism_data(content.mechanism)
        if content.solid and figures:
            entry["solid"] = solid_data(content.solid)
        if figures:
            entry["maps"] = [map_data(record, page_map) for page_map in content.maps]
            over_places: set[str] = set()
            if content.profiles:
                entry["profiles"] = profiles_data(record, content.profiles)
                over_places = {row.name for row in content.profiles.rows}
            entry["series"] = [series for series in entry["series"] if series["name"] not in over_places]
        else:
            kept = (LOAD, *contents[0].panels)
            entry["series"] = [
                series for series in entry["series"] if len(series["curves"]) > 1 or series["name"] in kept
            ]
    bodies = list(dict.fromkeys(content.bodies for content in contents if content.bodies))
    for entry, content in zip(data, contents, strict=True):
        if content.bodies:
            entry["bodies"] = bodies.index(content.bodies)
    units = [entry.pop("axis_unit") for entry in data]
    names = [series["name"] for series in data[0]["series"]]
    panels = [name for name in contents[0].panels if name in names] or names[:FIGURES]
    axis = with_unit(records[0].axis.replace("_", " ").capitalize(), units[0])
    several, both = len(records) > 1, list(zip(records, contents, strict=True))
    sections = {
        "WARNINGS": "".join(
            warnings_of(record, several) + _verdict(record, content, several)
            for record, content in zip(records, contents, strict=True)
        ),
        "SUMMARY": summary_tables(records, [content.reported for content in contents])
        + _parts(records, contents)
        if figures
        else "",
        "TRUST": "".join(
            _on_trust(record, content.sentences, several)
            for record, content in zip(records, contents, strict=True)
        ),
        "SHEET": _sheets(records, contents) if figures else "",
        "RESULT": "".join(_result(content) for content in contents if content.found),
        "PICTURES": "".join(
            picture(*drawing) for content in contents if not content.found for drawing in content.pictures
        ),
        "SENSED": "".join(_sensed(record, content, several) for record, content in both),
        "ORIGIN": "".join(map(origin, records)) if figures else "",
        "OVER": "Over the run",
    }
    payload = {"records": data, "panels": panels, "load": LOAD, "axis": axis}
    payload["bodies"] = [compressed(each) for each in bodies]
    return assembled(" · ".join(dict.fromkeys(map(title_of, records))), payload, sections, figures)


def title_of(record: Record | SweepRecord) -> str:
    """What a record is about, and that it is unfinished where it is."""
    title = str(record.scenario.get("title", record.label))
    return title if record.status == "complete" else f"{title} [{record.status}]"


def _record(record: Record, count: int) -> dict[str, Any]:
    """A record as the page reads it."""
    if not record.samples:
        raise record.refused("holds no samples to draw", "run the scenario again")
    abscissa = np.asarray(record[record.axis], dtype=float)
    axis, unit = in_engineers_units(abscissa, record.units(record.axis))
    cycle = float(axis[-1] - axis[0]) / 20.0
    window = [float(axis[0]), float(axis[-1])]
    if record.summary.get("cycles_done") and record.axis == "time" and record.samples > 1:
        start, lasts = first_shown(record, shown_cycles(record))
        scale = (axis[-1] - axis[0]) / (abscissa[-1] - abscissa[0])
        cycle, window[0] = float(lasts * scale), float(start * scale)
    elif record.axis == "phase":
        cycle = 1.0
    return {
        "label": record.label,
        "axis": packed(axis, "<f8"),
        "axis_unit": unit,
        "cycle": cycle,
        "window": window,
        "start": window[0],
        "series": [series_data(series) for series in series_of(record, count)],
        "outside": extrapolated(record),
        "trust": record.trust == trust.OUTSIDE,
        "teeth": rolling_teeth(record),
    }


def _result(content: PageContent) -> str:
    """Tables and pictures of what was found."""
    tables = "".join(table(*part) for part in content.found)
    pictures = "".join(picture(*part) for part in content.pictures)
    return f'<section><h2>Result</h2><div class="tables">{tables}</div></section>{pictures}'


def _sensed(record: Record, content: PageContent, named: bool) -> str:
    """What the sensors of a record gave, to be heard, and the lines of their spectra."""
    sensed = content.sensed
    if not sensed.sounds:
        return ""
    lines = f'<div class="tables">{table(*sensed.lines)}</div>' if sensed.lines else ""
    heading = f"Sensors of {record.label}" if named else "Sensors"
    return f"<section><h2>{escape(heading)}</h2>{sensed.sounds}{lines}</section>"


def warnings_of(record: Record, named: bool) -> str:
    """Write what forbids to trust a record, a paragraph each; `named`: with its label."""
    head = f"{record.label}: " if named else ""
    texts = [*warnings(record.summary), *([record.message] if record.message else [])]
    return "".join(f'<p class="warning">{escape(head + warning)}</p>' for warning in texts)


def summary_tables(records: Sequence[Record], reported: Sequence[Reported]) -> str:
    """Headings with a table each; a column per record."""
    merged: dict[str, dict[str, Quantity]] = {}
    for some in reported:
        for heading, group in some.items():
            for quantity in group:
                merged.setdefault(heading, {}).setdefault(quantity.name, quantity)
    tables, missing = [], False
    several = len(records) > 1
    head = "".join(f"<th>{escape(record.label)}</th>" for record in records)
    head = f"<tr><th></th>{head}<th></th></tr>" if several else ""
    for heading, group in merged.items():
        rows = []
        for quantity in group.values():
            cells = [_cell(record, quantity) for record in records]
            if any(cells):
                about = f"{quantity.definition} In the record: {quantity.name}.".strip()
                name = f'<td title="{escape(about)}">{escape(quantity.in_table)}</td>'
                values = "".join(f"<td>{escape(cell or '–')}</td>" for cell in cells)
                missing = missing or not all(cells)
                rows.append(f"<tr>{name}{values}<td>{escape(quantity.unit)}</td></tr>")
        if rows:
            tables.append(f"<div><h3>{escape(heading)}</h3><table>{head}{''.join(rows)}</table></div>")
    note = '<p class="keys">–: this record does not have the quantity.</p>' if missing else ""
    kind = "summary tables several" if several else "summary tables"
    return f'<div class="{kind} wide">{"".join(tables)}</div>{note}'


def _parts(records: Sequence[Record], contents: Sequence[PageContent]) -> str:
    tables = [
        table(f"{record.label}: {title}" if len(records) > 1 else title, columns, rows)
        for record, content in zip(records, contents, strict=True)
        for title, columns, rows in content.parts
    ]
    return f'<div class="tables parts">{"".join(tables)}</div>' if tables else ""


def _cell(record: Record, quantity: Quantity) -> str:
    if quantity.name in reasons(record.summary):
        return "withheld"
    return "" if record.summary.get(quantity.name) is None else quantity.written_of(record.summary)


def _verdict(record: Record, content: PageContent, named: bool) -> str:
    return verdict_list([f"{record.label}: {line}" if named else line for line in content.verdict])


def verdict_list(lines: Sequence[str]) -> str:
    """What a record's study says first, above all numbers."""
    return (
        f'<ul class="verdict-lines">{"".join(f"<li>{escape(line)}</li>" for line in lines)}</ul>'
        if lines
        else ""
    )


def _on_trust(record: Record, sentences: Sequence[str], named: bool) -> str:
    heading = f"<h3>{escape(record.label)}</h3>" if named else ""
    marks = [' class="note"' if sentence.startswith(EXCEEDED) else "" for sentence in sentences]
    items = (f"<li{mark}>{escape(sentence)}</li>" for mark, sentence in zip(marks, sentences, strict=True))
    return f"{heading}<details><summary>Details</summary><ul>{''.join(items)}</ul></details>"


def _sheets(records: Sequence[Record], contents: Sequence[PageContent]) -> str:
    """Tables of the gears of every record, equal ones once."""
    sheets: dict[str, list[str]] = {}
    for record, content in zip(records, contents, strict=True):
        if content.tables:
            sheets.setdefault("".join(table(*part) for part in content.tables), []).append(record.label)
    texts = (
        f"<details{' open' if len(sheets) == 1 else ''}><summary>{escape(', '.join(names))}</summary>"
        f'<div class="tables">{text}</div></details>'
        for text, names in sheets.items()
    )
    heading = escape(contents[0].heading)
    return f"<section><h2>{heading}</h2>{''.join(texts)}</section>" if sheets else ""


def table(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table with a heading; short cells, a number with its unit or a name, stay on one line."""

    def cells(tag: str, row: Sequence[str]) -> str:
        kinds = (f"{tag} class=short" if len(str(cell)) <= SHORT_CELL else tag for cell in row)
        texts = zip(kinds, map(escape, map(str, row)), strict=True)
        return "<tr>" + "".join(f"<{kind}>{cell}</{tag}>" for kind, cell in texts) + "</tr>"

    body = cells("th", columns) + "".join(cells("td", row) for row in rows)
    return f'<div class="wide"><h3>{escape(title)}</h3><table>{body}</table></div>'


def picture(name: str, about: str, figure: Figure) -> str:
    """A picture within the page."""
    heading = f"{name[:1].upper()}{name[1:]}: {about}"
    return f'<section class="pictures"><h2>{escape(heading)}</h2>{inline(figure, about)}</section>'


def origin(record: Record | SweepRecord) -> str:
    """The scenario and what made the record."""
    attributes = ("created", "tribodyn_version", "scenario_sha256", "status")
    rows = "".join(
        f"<tr><td>{escape(name.replace('_', ' '))}</td><td>{escape(str(record.attrs[name]))}</td></tr>"
        for name in attributes
        if name in record.attrs
    )
    scenario = escape(str(record.attrs.get("scenario", "")))
    return (
        f"<h3>{escape(Path(record.path).name)}</h3><table>{rows}</table>"
        f"<details><summary>Scenario</summary><pre>{scenario}</pre></details>"
    )
