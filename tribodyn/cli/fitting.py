"""Tables on terminals of any width: words go on to the next line, numbers stay whole."""

import re
import textwrap
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

#: A number with its unit or a short name, which stays on one line.
_WHOLE = re.compile(r"[+\-−–]?[\d.,]+(e[+-]?\d+)?( \S{1,12}){0,2}")
#: What a narrowed table keeps of the table.
_KEPT = ("title", "title_style", "title_justify", "box", "show_header", "pad_edge")
#: Characters of a word that is folded only where there is no other way, such as a path.
LONG_WORD = 30


def fitted(part: Any, console: "Console", width: int) -> Any:
    """Lay out a table in `width` characters: columns of words are narrowed, or rows become short lists.

    What is no table stays as it is.
    """
    from rich.table import Table

    if not isinstance(part, Table):
        return part
    table = part
    columns = [[_text(cell) for cell in (column.header, *column.cells)] for column in table.columns]
    natural = [max(len(line) for cell in column for line in cell.split("\n")) for column in columns]
    least = [max(_least(cell) for cell in column) for column in columns]
    options = console.options.update(max_width=10 * sum(natural) + 1000)
    frame = console.measure(table, options=options).maximum - sum(natural)
    if sum(natural) + frame <= width:
        return table
    if sum(least) + frame > width:
        return _as_lists(table, columns)
    widths = list(natural)
    while sum(widths) + frame > width:
        most = max((size, index) for index, size in enumerate(widths) if size > least[index])
        widths[most[1]] -= 1
    return _narrowed(table, widths)


def _narrowed(table: "Table", widths: list[int]) -> "Table":
    """The same table with columns of given widths; what is indented stays so on its next lines."""
    from rich.table import Table
    from rich.text import Text

    same = {name: getattr(table, name) for name in _KEPT}
    narrow = Table(padding=table.padding, **same)
    for column, size in zip(table.columns, widths, strict=True):
        narrow.add_column(column.header, justify=column.justify, width=size, overflow="fold")
    for cells in zip(*(column.cells for column in table.columns), strict=True):
        row = [
            Text(_wrapped(_text(cell), size), style=getattr(cell, "style", ""))
            for cell, size in zip(cells, widths, strict=True)
        ]
        narrow.add_row(*row)
    return narrow


def _wrapped(cell: str, size: int) -> str:
    indent = cell[: len(cell) - len(cell.lstrip())]
    if not indent or len(cell) <= size:
        return cell
    return "\n".join(textwrap.wrap(cell, size, subsequent_indent=indent + "  ", break_on_hyphens=False))


def least_width(part: Any) -> int:
    """Characters of a line that a table needs to break no number, but for the frame; else 0."""
    columns = getattr(part, "columns", ())
    return sum(max(_least(_text(cell)) for cell in (column.header, *column.cells)) + 3 for column in columns)


def _text(cell: Any) -> str:
    return str(getattr(cell, "plain", cell))


def _least(cell: str) -> int:
    """Characters of the longest part of a cell that is not broken."""
    if _WHOLE.fullmatch(cell.strip()):
        return len(cell)
    indent = len(cell) - len(cell.lstrip())
    return indent + max((min(len(word), LONG_WORD) for word in cell.split()), default=0)


def _as_lists(table: "Table", columns: list[list[str]]) -> Any:
    """The rows one below the other, each cell after its column's name."""
    from rich.console import Group
    from rich.text import Text

    heads = [column[0] for column in columns]
    lines = [Text(_text(table.title), style="bold")] if table.title else []
    for row in zip(*(column[1:] for column in columns), strict=True):
        unit = "" if heads[-1] else row[-1]
        lines.append(Text(row[0] + (f" ({unit})" if unit else "")))
        indent = " " * (len(row[0]) - len(row[0].lstrip()) + 2)
        shown: list[str] = []
        for head, cell in list(zip(heads, row, strict=True))[1 : None if heads[-1] else -1]:
            if cell and (head or not shown):
                shown.append(f"{head}: {cell}" if head else cell)
            elif cell:
                shown[-1] += f"  {cell}"
        lines += [Text(indent + text) for text in shown]
    return Group(*lines)
