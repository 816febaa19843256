"""What verbs print: JSON for programs, tables for people.

On terminals of any width words go on to the next line and numbers stay whole.
"""

import json
import math
import os
import re
import shlex
import shutil
import sys
import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribodyn.errors import harmless

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from tribodyn.studies.protocol.study import TextTable

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


WIDTH_OF_A_PIPE = 160


def print_json(data: Any) -> None:
    """Write `data` to stdout as JSON; NumPy numbers and arrays become plain ones, NaN becomes null."""
    text = json.dumps(plain(data), indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    if harmless(text) != text:  # JSON leaves some characters that a terminal obeys as they are
        text = "".join(char if char.isprintable() or char == "\n" else f"\\u{ord(char):04x}" for char in text)
    sys.stdout.write(text)


def write_json(path: Path, data: dict[str, Any], force: bool) -> None:
    """Write `data` into a file that says who made it; raises as `write_output`."""
    from tribodyn.numerics.files.output_files import write_output

    marked = {"generator": "tribodyn", **plain(data)}
    write_output(path, json.dumps(marked, indent=2, ensure_ascii=False) + "\n", force=force)


def plain(data: Any) -> Any:
    """Return `data` as JSON can hold it."""
    if isinstance(data, dict):
        return {str(key): plain(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [plain(value) for value in data]
    if hasattr(data, "tolist"):
        return plain(data.tolist())
    if isinstance(data, float) and not math.isfinite(data):
        return None
    return data if data is None or isinstance(data, (bool, int, float, str)) else str(data)


def print_findings(tables: "Iterable[TextTable]", remarks: Iterable[str] = ()) -> None:
    """Write tables of a study to stdout, and sentences below them."""
    for table in tables:
        print_table(*table)
    for remark in remarks:
        print_prose(remark)


#: Lines of tables, and remarks, with which a long answer begins: with what follows they fill a screen.
_SCREEN, _REMARKS = 34, 4


def begun(tables: "list[TextTable]", remarks: "Sequence[str]") -> "tuple[list[TextTable], list[str]]":
    """The tables and remarks that fill a screen, and a remark that names the others."""
    shown, lines = 0, 0
    while shown < len(tables) and (lines := lines + len(tables[shown].rows) + 4) <= _SCREEN:
        shown += 1
    short = list(remarks[:_REMARKS])
    if len(remarks) > _REMARKS:
        short.append(f"… and {len(remarks) - _REMARKS} more remarks.")
    if hidden := [table.title for table in tables[shown:]]:
        short.append(
            f"There is more: {'; '.join(dict.fromkeys(title.partition(', ')[0] for title in hidden))}."
        )
    return tables[:shown], short


def print_files(what: str, files: Iterable[Path]) -> None:
    """Write what files are, by default their ending, and their paths to stdout."""
    from typer import echo

    for file in files:
        echo(f"{what or file.suffix[1:]:8} {quoted_path(file)}")


def print_table(title: str, columns: Iterable[str], rows: Iterable[Iterable[str]]) -> None:
    """Write a table to stdout, as wide as it needs to be where stdout is not a terminal."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False)
    for column in columns:
        table.add_column(column)
    for row in rows:
        table.add_row(*row)
    print_rich(table)


def print_rich(renderable: Any) -> None:
    """Write something that rich can draw to stdout; tables are fitted to the terminal."""
    from rich.console import Console, Group

    console = Console(markup=False, highlight=False)
    parts = renderable.renderables if isinstance(renderable, Group) else [renderable]
    if console.is_terminal:
        for part in parts:
            console.print(fitted(part, console, console.width))
        return
    width = max(WIDTH_OF_A_PIPE, *map(least_width, parts))
    console = Console(markup=False, highlight=False, width=width)
    with console.capture() as captured:
        for part in parts:
            console.print(fitted(part, console, width))
    sys.stdout.writelines(line.rstrip() + "\n" for line in captured.get().splitlines())


def print_prose(text: str) -> None:
    """Write sentences to stdout, on a terminal broken between words."""
    from rich.console import Console
    from rich.text import Text

    if Console().is_terminal:
        print_rich(Text(text))
    else:
        sys.stdout.write(text + "\n")


def command_name() -> str:
    """How tribodyn is called, to be typed: by its name where the shell finds it so, else by its path."""
    called = Path(sys.argv[0])
    if called.name == "__main__.py":
        return f"{quoted_path(_from_here(Path(sys.executable)))} -m tribodyn"
    on_path = shutil.which("tribodyn")
    if called.name != "tribodyn" or (on_path and Path(on_path).resolve() == called.resolve()):
        return "tribodyn"
    return quoted_path(_from_here(called))


def _from_here(path: Path) -> Path:
    here = Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path


def quoted_path(path: Any) -> str:
    """Return a path as it may be pasted into a shell."""
    text = str(path)
    if harmless(text) == text:
        return shlex.quote(text)

    def escaped(char: str) -> str:
        return char if harmless(char) == char else "".join(f"\\x{byte:02x}" for byte in os.fsencode(char))

    return "$'" + "".join(map(escaped, text.replace("\\", r"\\"))).replace("'", r"\'") + "'"
