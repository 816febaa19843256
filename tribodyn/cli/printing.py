"""What verbs print: JSON for programs, tables for people."""

import json
import math
import os
import shlex
import shutil
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribodyn.errors import harmless

if TYPE_CHECKING:
    from tribodyn.studies.protocol.study import TextTable

WIDTH_OF_A_PIPE = 160


def print_json(data: Any) -> None:
    """Write `data` to stdout as JSON; NumPy numbers and arrays become plain ones, NaN becomes null."""
    text = json.dumps(plain(data), indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    # JSON leaves some characters that a terminal obeys as they are
    sys.stdout.write(text if harmless(text) == text else _escaped(text))


def write_json(path: Path, data: dict[str, Any], force: bool) -> None:
    """Write `data` into a file that says who made it; raises as `write_output`."""
    from tribodyn.numerics.output_files import write_output

    marked = {"generator": "tribodyn", **plain(data)}
    write_output(path, json.dumps(marked, indent=2, ensure_ascii=False) + "\n", force=force)


def _escaped(text: str) -> str:
    return "".join(char if char.isprintable() or char == "\n" else f"\\u{ord(char):04x}" for char in text)


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


def print_text_table(table: "TextTable") -> None:
    """Write a table of a study to stdout."""
    print_table(table.title, table.columns, table.rows)


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

    from tribodyn.cli.fitting import fitted, least_width

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
    found = shutil.which("tribodyn")
    if called.name != "tribodyn" or (found and Path(found).resolve() == called.resolve()):
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
    escaped = "".join(
        char if harmless(char) == char else _bytes_of(char) for char in text.replace("\\", r"\\")
    )
    return "$'" + escaped.replace("'", r"\'") + "'"


def _bytes_of(character: str) -> str:
    return "".join(f"\\x{byte:02x}" for byte in os.fsencode(character))
