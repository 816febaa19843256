"""Our figures compared with the published ones, as a Markdown table.

python tools/validation_table.py                              # prints the table
python tools/validation_table.py --into docs/validation.md    # and puts it into the page
"""

import argparse
from pathlib import Path

from marked_block import put

from tribodyn.validation import validate
from tribodyn.validation.rows import Row


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
    return f"{100 * value:+.2g} %" if row.tolerance_kind == "relative" else f"{value:+.2g}"


def table(rows: list[Row]) -> str:
    lines = ["| row | published | ours | difference | tolerance | verdict |", "|---|--:|--:|--:|--:|---|"]
    for row in rows:
        unit = "" if row.unit in ("1", "claim") else f", {row.unit}"
        cells = [
            f"`{row.id}`<br>{row.quantity}{unit}",
            cell(row.published),
            cell(row.computed),
            share(row, row.difference),
            share(row, row.tolerance).removeprefix("+"),
            row.verdict,
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description="Published figures compared with ours.")
    parser.add_argument("paper", nargs="?", default="liu-ni-2022")
    parser.add_argument("--into", type=Path, help="page to put the table into")
    options = parser.parse_args()
    text = table(validate(options.paper))
    print(text)
    if options.into:
        put(options.into, options.paper, text)


if __name__ == "__main__":
    main()
