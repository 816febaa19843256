"""Put generated text into a page, between the comments that mark its place, and say when it was made."""

import subprocess
from datetime import date
from pathlib import Path

from tribodyn import __version__

ROOT = Path(__file__).parents[1]


def put(page: Path, name: str, text: str) -> None:
    """Replace what stands between ``<!-- begin NAME -->`` and ``<!-- end NAME -->`` in `page`."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    before, opened, rest = page.read_text(encoding="utf-8").partition(begin)
    _, closed, after = rest.partition(end)
    if not opened or not closed:
        raise SystemExit(f"{page}: no {begin} … {end}")
    page.write_text(f"{before}{begin}\n\n{text.strip()}\n\n{end}{after}", encoding="utf-8")


def made_by() -> str:
    """Date, version and commit of what is being generated; whether the sources differ from that commit."""
    said = f"Made on {date.today().isoformat()} by tribodyn {__version__}"
    commit = _git("rev-parse", "--short", "HEAD")
    if not commit:
        return f"{said}."
    changed = " with changes" if _git("status", "--porcelain", "--", "tribodyn", "tools") else ""
    return f"{said}, commit {commit}{changed}."


def _git(*words: str) -> str:
    """What git prints; nothing where this is no checkout."""
    try:
        done = subprocess.run(
            ["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=True, timeout=60
        )
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.strip()
