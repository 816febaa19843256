"""Our values compared with the published ones, as Markdown tables, and their counts.

python -m tools.validation_table liu-ni-2022                # prints the table
python -m tools.validation_table liu-ni-2022 jia-2022 --write  # and puts it into the page that has its place
python -m tools.validation_table --write                    # all papers: some minutes

Written with them is how many rows of each kind hold, into docs/validation.md and the README.
"""

import re

from tools.marked_block import DOCS, ROOT, parser_of, put
from tools.marked_block import table as table_of
from tribodyn.validation import PAPERS, validate
from tribodyn.validation.rows import (
    BESIDE,
    CHOSEN,
    FAIL,
    ONE_WAY,
    OTHER,
    REPORTED,
    REPRODUCED,
    STANDINGS,
    Row,
    counted,
    of_part,
    per_cent,
)

VALIDATION = DOCS / "validation.md"
#: Pages of the papers that do not stand on the page of validation.
PAGES = {"efremenkov-2024": DOCS / "rolling-elements.md"}
PAGES |= {name: DOCS / "standards.md" for name, paper in PAPERS.items() if paper.source}
#: Rows in the order of a table, and those that do not stand in it.
WORST_FIRST = (FAIL, REPORTED, ONE_WAY, OTHER, CHOSEN, BESIDE, REPRODUCED)
PLAIN = (ONE_WAY, REPRODUCED, BESIDE)
#: A bar that ends no cell.
BAR = "\\|"
#: Pages with the counts of all papers.
COUNTING = (VALIDATION, ROOT / "README.md")


def cell(value: object) -> str:
    if isinstance(value, list):
        return " ".join(map(cell, value))
    if isinstance(value, bool):
        return "holds" if value else "does not hold"
    if isinstance(value, float):
        return f"{value:.5g}"
    return "" if value is None else str(value)


def share(row: Row, value: float | list[float] | None) -> str:
    """A difference or tolerance, in per cent where the row is judged so; the maximum of several."""
    if value is None or value == []:
        return ""
    value = max(value, key=abs) if isinstance(value, list) else value
    return ("+" * (value >= 0.0)) + per_cent(value) if row.tolerance_kind == "relative" else f"{value:+.2g}"


def difference(row: Row) -> str:
    written = share(row, row.difference)
    if row.part_difference is None:
        return written
    return f"{written}<br>{of_part(row.part_difference, row.part, '+')}"


def tolerance(row: Row) -> str:
    """The tolerance; with its share of the value and its reason where it is wide."""
    return row.written("tolerance") if row.tolerance_reason else share(row, row.tolerance).removeprefix("+")


def other(row: Row) -> str:
    """The row under other choices, where it differs."""
    lines = []
    for otherwise in row.otherwise:
        parts = (cell(otherwise.computed), share(row, otherwise.difference), otherwise.verdict)
        lines.append(f"{otherwise.choice}: {', '.join(part for part in parts if part)}")
    return "<br>".join(lines)


def table(paper: str, rows: list[Row]) -> str:
    """Rows of a paper under the choices that they are computed with, worst first, and their counts.

    What is plainly reproduced, or in its direction only, stands in a sentence. Of a book only rows that do
    not agree, with their reason.
    """
    source = PAPERS[paper].source
    if source:
        lines = [
            [
                f"`{row.id.partition('/')[2]}`",
                row.quantity,
                row.printed,
                row.written("computed"),
                row.unit,
                row.note,
            ]
            for row in rows
            if row.verdict != "pass"
        ]
        body = table_of(["row", "quantity", "printed", "here", "unit", "reason"], lines, "llrrll")
        said = f"{source.said()} Computed {PAPERS[paper].choices}."
        return f"{said}\n\nIn all: {counted(rows)}.\n\n{body}"
    head = ["row", "published", "ours", "difference", "tolerance", "verdict", "under another choice"]
    lines = []
    for row in sorted(rows, key=lambda row: WORST_FIRST.index(row.standing)):
        if row.standing in PLAIN:
            continue
        unit = "" if row.unit in ("1", "claim") else f", {row.unit}"
        cells = [
            f"`{row.id}`<br>{row.written('quantity').replace('|', BAR)}{unit}",
            cell(row.published),
            cell(row.computed),
            difference(row),
            tolerance(row),
            row.written("verdict"),
            other(row),
        ]
        lines.append(cells)
    body = table_of(head, lines, "lrrrlll")
    text = f"Computed {PAPERS[paper].choices}.\n\nIn all: {counted(rows)}.\n\n{body}"
    for standing in PLAIN:
        named = "; ".join(plainly(row) for row in rows if row.standing == standing)
        text += f"\n\n{standing.capitalize()}: {named}." if named else ""
    return text


def plainly(row: Row) -> str:
    """A row in few words: our value for the published one, and how far off a direction is."""
    off = ""
    if row.standing == ONE_WAY and row.part_difference is not None:
        off = f" ({of_part(row.part_difference, row.part, '+')})"
    if row.tolerance_kind == "claim" or isinstance(row.computed, list):
        return f"`{row.id}`{off}"
    published = cell(row.published) or row.note.rpartition("another implementation: ")[2].partition(";")[0]
    return f"`{row.id}` {cell(row.computed)} for {published}{off}"


def counts() -> str:
    """Counts of all papers, as their tables on the pages have them."""
    lines = []
    for paper in PAPERS:
        page = PAGES.get(paper, VALIDATION).read_text(encoding="utf-8")
        block = page.partition(f"<!-- begin {paper} -->")[2].partition(f"<!-- end {paper} -->")[0]
        found = re.search(r"^In all: (\d+) rows?: (.*)\.$", block, re.MULTILINE)
        total, parts = found.groups() if found else ("", "")
        numbers = {name: number for number, _, name in (part.partition(" ") for part in parts.split("; "))}
        lines.append(
            [PAPERS[paper].about.partition(": ")[0], total, *(numbers.get(one, "") for one in STANDINGS)]
        )
    return table_of(["paper", "rows", *STANDINGS], lines, "l" + "r" * (1 + len(STANDINGS)))


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("papers", nargs="*", choices=[[], *PAPERS], help="default: all")
    parser.add_argument("--write", action="store_true", help="put tables and counts into the pages")
    options = parser.parse_args()
    for paper in options.papers or PAPERS:
        text = table(paper, validate(paper))
        print(f"\n{text}\n", flush=True)
        if options.write:
            put(PAGES.get(paper, VALIDATION), paper, text)
    if options.write:
        for page in COUNTING:
            put(page, "counts", counts())


if __name__ == "__main__":
    main()
