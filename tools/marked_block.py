"""Put generated text into a page, between the comments that mark its place; when and where it was made."""

import argparse
import os
import platform
import subprocess
from collections.abc import Callable, Sequence
from datetime import UTC, date, datetime
from pathlib import Path
from time import perf_counter, process_time

from tribodyn import __version__

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PICTURES = DOCS / "pictures"
STAT = Path("/proc/stat")


def put(page: Path, name: str, text: str) -> None:
    """Replace what stands between ``<!-- begin NAME -->`` and ``<!-- end NAME -->`` in `page`."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    before, opened, rest = page.read_text(encoding="utf-8").partition(begin)
    _, closed, after = rest.partition(end)
    if not opened or not closed:
        raise SystemExit(f"{page}: no {begin} … {end}")
    page.write_text(f"{before}{begin}\n\n{text.strip()}\n\n{end}{after}", encoding="utf-8")


def parser_of(about: str | None) -> argparse.ArgumentParser:
    """Parser of a tool's command line; its help is the tool's docstring as it stands."""
    return argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)


def generate(
    about: str | None,
    *,
    parser: argparse.ArgumentParser | None = None,
    **blocks: Callable[[argparse.Namespace], str],
) -> None:
    """Print texts; with ``--into PAGE`` put each into the marked block of its name (there with - for _).

    A parser may have an option ``--part`` for the names of some of them.
    """
    parser = parser or parser_of(about)
    parser.add_argument("--into", type=Path, metavar="PAGE", help="page with the marked blocks")
    given = parser.parse_args()
    for name in getattr(given, "part", blocks):
        text = blocks[name](given)
        print(f"{text}\n", flush=True)
        if given.into:
            put(given.into, name.replace("_", "-"), text)


def table(head: Sequence[str], rows: Sequence[Sequence[object]], align: str = "") -> str:
    """Table of Markdown; `align` has a letter per column, r for right."""
    aligned = (align or "l" * len(head)).ljust(len(head), "l")
    rule = "|".join("--:" if side == "r" else "---" for side in aligned)
    lines = [f"| {' | '.join(map(str, cells))} |" for cells in (head, *rows)]
    return "\n".join([lines[0], f"|{rule}|", *lines[1:]])


def made_by() -> str:
    """Date, version and commit of what is being generated; whether the sources differ from that commit."""
    made = f"Made on {date.today().isoformat()} by tribodyn {__version__}"
    commit = _git("rev-parse", "--short", "HEAD")
    if not commit:
        return f"{made}."
    changed = " with changes" if _git("status", "--porcelain", "--", "tribodyn", "tools") else ""
    return f"{made}, commit {commit}{changed}."


def _git(*words: str) -> str:
    """What git prints; nothing where this is no checkout."""
    try:
        return subprocess.check_output(
            ["git", "-C", str(ROOT), *words], stderr=subprocess.DEVNULL, text=True, timeout=60
        ).strip()
    except (OSError, subprocess.SubprocessError):
        return ""


def measured_on() -> str:
    """Date, processor, cores, and how many other processes kept busy since this module was imported."""
    model, cpuinfo = platform.processor() or platform.machine(), Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        lines = cpuinfo.read_text(encoding="utf-8").splitlines()
        named = (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
        model = next(named, model)
    measured = f"{datetime.now(UTC):%Y-%m-%d}, {model}, {os.cpu_count()} cores"
    elapsed = perf_counter() - _BEGUN
    if not STAT.is_file() or elapsed <= 0.0:
        return measured
    others = max(_busy_seconds() - _BUSY_BEFORE, 0.0) / elapsed
    return f"{measured}, {others:.1f} of them busy with other work"


def _busy_seconds() -> float:
    """Processor seconds of all but this process and its children since the machine started."""
    if not STAT.is_file():
        return 0.0
    user, nice, system, _, _, irq, softirq, *_ = map(int, STAT.read_text(encoding="ascii").split()[1:9])
    return (user + nice + system + irq + softirq) / os.sysconf("SC_CLK_TCK") - sum(os.times()[:4])


def spent(work: Callable[[], object]) -> tuple[float, float]:
    """Seconds on the clock and of the processor that a call takes."""
    begun = perf_counter(), process_time()
    work()
    return perf_counter() - begun[0], process_time() - begun[1]


_BEGUN, _BUSY_BEFORE = perf_counter(), _busy_seconds()
