"""A page as one file: HTML put together of a template, its script and its data, or printed into a PDF."""

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from tribodyn.errors import InputError, OutputError
from tribodyn.numerics.files.output_files import MARKS, write_output
from tribodyn.numerics.processes.child import installed_program, run_program

if TYPE_CHECKING:
    import subprocess
import gzip
import json
from base64 import b64encode
from html import escape
from importlib import resources
from typing import Any

BROWSERS = (
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "microsoft-edge",
    "chrome",
    "msedge",
)
#: Options under which a browser draws a file and asks nothing of the network.
QUIET = (
    "--headless",
    "--disable-gpu",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--virtual-time-budget=10000",
)
TIME_LIMIT = 120.0
#: Characters of a path to which the browser can add the name of a socket: 45 of 104 at most.
LONGEST_PROFILE = 58


def browser() -> str | None:
    """Path of a browser that can print without a window; None where there is none."""
    return installed_program(BROWSERS)


def require_browser() -> str:
    """Path of the `browser`; InputError where none is installed: to be said before any work."""
    program = browser()
    if program is None:
        rule = "no browser is installed that could print the page"
        raise InputError(
            "--pdf", None, rule, "install Chromium or Chrome, or print the page from your browser"
        )
    return program


def run_browser(*options: str) -> "subprocess.CompletedProcess[str]":
    """Run the browser without a window, in a profile of its own; InputError where none is installed."""
    import os

    program = require_browser()
    # as root, in containers, a browser runs without its sandbox only; the page is our own
    sandbox = ("--no-sandbox",) if hasattr(os, "geteuid") and os.geteuid() == 0 else ()
    with tempfile.TemporaryDirectory(prefix="tribodyn-", ignore_cleanup_errors=True) as profile:
        command = [program, *QUIET, *sandbox, f"--user-data-dir={profile}", *options]
        # killed, it leaves what it has in the folder for temporary files, a socket with a long name among it
        variables = ("TMPDIR", "TMP", "TEMP") if len(profile) < LONGEST_PROFILE else ()
        return run_program(command, TIME_LIMIT, dict.fromkeys(variables, profile))


def print_page(page: Path, *, force: bool = False) -> Path:
    """Print a page into a PDF beside it.

    Raises InputError where no browser is installed, OutputError where it does not print the page or there is
    no room; also as `write_output`.
    """
    target = page.with_suffix(".pdf")
    with tempfile.TemporaryDirectory(prefix="tribodyn-") as folder:
        printed = Path(folder) / "page.pdf"
        try:
            ended = run_browser(
                "--no-pdf-header-footer", f"--print-to-pdf={printed}", page.resolve().as_uri()
            )
        except TimeoutError:
            raise OutputError(str(target), f"the browser did not end within {TIME_LIMIT:g} s") from None
        except OSError as error:
            raise OutputError(str(target), f"the browser does not run: {error}") from None
        if ended.returncode or not printed.is_file():
            raise OutputError(str(target), f"the browser ended with status {ended.returncode}")
        return write_output(target, printed.read_bytes() + MARKS[".pdf"], force=force)


def assembled(title: str, payload: dict[str, Any], sections: dict[str, str], figures: bool = True) -> str:
    """Put a page together of its title, its data and the HTML of its sections."""
    payload["figures"] = figures
    parts = {
        "RESULT": "",
        "SENSED": "",
        **sections,
        "TITLE": escape(title),
        # no text of a record can end the element that holds it
        "DATA": json.dumps(payload, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c"),
        "PLOTLY": _file("package_data/plotly.min.js", "plotly") if figures else "",
        "SCRIPT": "".join(map(_file, ("solid.js", "space.js", "page.js"))),
    }
    # every other piece is a name: what stands in for one is not looked through again
    body = "".join(parts.get(piece, piece) for piece in _file("page.html").split("@"))
    policy = "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:"
    policy += "; media-src data:"
    return document(title, _file("page.css"), body, policy)


def compressed(content: bytes) -> str:
    """A file within the data of a page."""
    return b64encode(gzip.compress(content, mtime=0)).decode()


def document(title: str, style: str, body: str, policy: str) -> str:
    """Put a body (HTML) into a file that may load nothing but what the `policy` names."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; {policy}">
<meta name="generator" content="tribodyn">
<title>{escape(title)}</title>
<style>{style}</style>
</head>
<body>
{body}</body>
</html>
"""


def _file(name: str, package: str = __package__ or "") -> str:
    return resources.files(package).joinpath(name).read_text(encoding="utf-8")
