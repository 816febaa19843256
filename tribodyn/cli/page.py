"""`tribodyn app`: the page to design on, in the browser."""

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from tribodyn.cli.options import scenarios

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn app\n"
    "  tribodyn app my-drive.toml\n"
    "  tribodyn app spur-25-51 --folder designs --no-browser\n"
    "\b\nThe page is for this machine and this address alone, and works without a network. It reads and\n"
    "writes files of one folder. Ctrl-C ends it; what was saved stays."
)


def app(
    scenario: Annotated[
        str | None,
        typer.Argument(
            metavar="[SCENARIO]",
            help="A scenario file, the name of a shipped scenario, or a link from the page.",
            autocompletion=scenarios,
        ),
    ] = None,
    *,
    folder: Annotated[
        Path | None,
        typer.Option(help="The folder that it works in; default: that of SCENARIO, or this one."),
    ] = None,
    port: Annotated[
        int | None, typer.Option(min=0, max=65535, metavar="N", help="Port; 0: any that is free.")
    ] = None,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the browser.")] = True,
) -> None:
    """Design on a page in the browser: drag a value, see teeth and curves follow."""
    from tribodyn.errors import InputError

    if find_spec("nicegui") is None:
        remedy = 'install it: pip install "tribodyn[app]"'
        raise InputError("app", None, "the package nicegui is not installed", remedy)
    from tribodyn.app.server import serve
    from tribodyn.numerics.processes.child import open_address

    def announce(address: str, once: str) -> None:
        sys.stdout.write(f"{address}\nOpen it in a browser on this machine. Ctrl-C ends the server.\n")
        sys.stdout.flush()
        if browser:
            open_address(once)

    serve(scenario, announce, folder, port)
