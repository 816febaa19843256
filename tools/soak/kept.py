"""Outcomes on disk, a line of JSON each, so that a stopped soak goes on where it was."""

import json
from collections.abc import Iterator
from pathlib import Path

from tools.soak.outcome import Outcome
from tribodyn.numerics.sources import computing_digest, digest_of

#: Where outcomes are kept unless told otherwise.
FOLDER = Path(__file__).parents[2] / ".soak"


def store(seed: int, short: bool = False) -> Path:
    """The file of a seed's outcomes: another one as soon as a line of the package or of this tool changes."""
    tool = digest_of("tools.soak.outcome", "tribodyn.cli.app").hex()
    return FOLDER / f"{tool[:6]}{computing_digest()[:6]}-{seed}{'-short' if short else ''}.jsonl"


def read(path: Path) -> Iterator[Outcome]:
    """Go through the outcomes in a file; a last line that was cut short is left out."""
    if not path.is_file():
        return
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            values = json.loads(line)
        except json.JSONDecodeError:
            continue
        yield Outcome(**{**values, "faults": tuple(values["faults"])})


def add(path: Path, one: Outcome) -> None:
    """Add an outcome to a file, in one write."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(one._asdict(), ensure_ascii=False) + "\n")
