"""The page of the command line, from the help of every verb, into docs/command-line.md.

::

    python -m tools.command_line_page           # print it
    python -m tools.command_line_page --write   # into the page
"""

import sys

from typer.main import get_command
from typer.testing import CliRunner

from tools.marked_block import DOCS, put
from tribodyn.cli.app import app

PAGE = DOCS / "command-line.md"


def page() -> str:
    """The help of every verb below a heading, in the order in which the program lists them."""
    verbs = get_command(app).list_commands(None)  # type: ignore[attr-defined]
    return "\n\n".join(f"## {verb}\n\n```text\n{_help(verb)}\n```" for verb in verbs)


def _help(verb: str) -> str:
    shown = CliRunner().invoke(app, [verb, "--help"], env={"COLUMNS": "100"}, prog_name="tribodyn")
    return "\n".join(line.rstrip() for line in shown.stdout.strip().splitlines())


if __name__ == "__main__":
    if "--write" in sys.argv:
        put(PAGE, "verbs", page())
    else:
        sys.stdout.write(page() + "\n")
