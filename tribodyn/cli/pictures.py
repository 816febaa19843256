"""Pictures of records as files, and a second process that gets ready to draw while the first one computes.

It imports matplotlib, finds fonts and reads formulas, 0.65 s: as long as a warm run of `crc-23-47` computes,
so that with a second core the whole command takes half the time. Where it cannot be had, or ends without an
answer, the first process draws. No part of the command line's grammar is imported here.
"""

import json
import os
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

from tribodyn.numerics.files.output_files import check_output, make_folder
from tribodyn.numerics.processes import child
from tribodyn.numerics.processes.work import usable_cores

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from tribodyn.record.reader import Record


def draw(
    records: Sequence["Record"],
    names: Iterable[str],
    beside: Path,
    *,
    cycles: int | Literal["auto"] | None = "auto",
    against: str | None = None,
    force: bool = False,
) -> list[Path]:
    """Draw figures by name into files named after `beside`: ``crc.png`` becomes ``crc-film.png``."""
    from tribodyn.studies.pages import figure

    make = partial(figure, records=records, cycles=cycles, against=against)
    return save_all(names, beside, make, force=force)


def overview_path(record: Path) -> Path:
    """Where the overview of a record is drawn."""
    return _named(record.with_suffix(".png"), "overview")


def draw_pictures(path: Path, *, everything: bool, force: bool = False) -> list[Path]:
    """Draw the overview of a record, or all its figures, beside it."""
    from tribodyn.record.reader import Record
    from tribodyn.studies.pages import names

    with Record(path) as record:
        chosen = ["overview", *names([record])] if everything else ["overview"]
        return draw([record], chosen, path.with_suffix(".png"), force=force)


def save_all(
    names: Iterable[str], beside: Path, make: Callable[[str], "Figure"], *, force: bool = False
) -> list[Path]:
    """Make figures by name and write them into files named after `beside`; raises as `write_output`."""
    from tribodyn.post.progress import progress_bar
    from tribodyn.post.style import save

    names = list(names)
    for name in names:
        check_output(_named(beside, name), force)
    pictures = []
    with progress_bar("drawing") as progress:
        for done, name in enumerate(names, start=1):
            figure = make(name)
            make_folder(beside.parent)
            pictures.append(save(figure, _named(beside, name), force=force))
            progress(done / len(names))
    return pictures


def _named(beside: Path, name: str) -> Path:
    return beside.with_name(f"{beside.stem}-{name}{beside.suffix}")


#: What the process calls.
TARGET = ("tribodyn.cli.pictures:serve",)
#: How long it waits for a record, s: of a longer run the drawing takes a small share.
PATIENCE = 60.0
#: How long the first process waits for the pictures, s.
LONGEST_DRAWING = 120.0


class Drawer:
    """A process that draws the overview of a record, which is not there yet."""

    def __init__(self) -> None:
        self._process = child.start(*TARGET)

    def draw(self, record: Path, force: bool) -> None:
        """Begin to draw the overview of a record; `force` as of `write_output`."""
        with suppress(OSError):
            child.tell(self._process, json.dumps([str(record), force]).encode() + b"\n")

    def pictures(self) -> list[Path] | None:
        """Return the pictures as soon as they are drawn; None where the process gives no answer."""
        with suppress(OSError, ValueError):
            return [Path(file) for file in json.loads(child.answer(self._process, LONGEST_DRAWING))]
        return None

    def close(self) -> None:
        """End the process, which has nothing left to do."""
        child.end(self._process)


_begun: list[Drawer] = []


def begin(words: Sequence[str]) -> None:
    """Start the process before anything else of a command that will draw an overview, if a core is free."""
    drawn_otherwise = {"--plot", "--no-plot", "-h", "--help"}
    if list(words[:1]) == ["run"] and not drawn_otherwise.intersection(words) and usable_cores() > 1:
        with suppress(OSError):
            _begun.append(Drawer())


@contextmanager
def drawer(wanted: bool) -> Iterator[Drawer | None]:
    """Give a process that gets ready to draw, where this is the command line's own and a core is free."""
    import tribodyn

    worker = _begun.pop() if _begun else None
    if worker is None and wanted and tribodyn.OWN_PROCESS and usable_cores() > 1:
        with suppress(OSError):
            worker = Drawer()
    try:
        yield worker if wanted else None
    finally:
        if worker is not None:
            worker.close()


def serve() -> None:
    """Get ready, wait for the name of a record, draw it, write the names of the pictures."""
    import gc

    gc.disable()
    timer = threading.Timer(PATIENCE, lambda: os._exit(0))
    timer.daemon = True
    timer.start()

    # import what draws, and do what an overview has that needs no record
    from matplotlib import artist

    # matplotlib composes help texts of its classes as it is imported: 0.1 s of 0.75 s
    artist.kwdoc = lambda _: ""
    cast(Any, artist.Artist)._update_set_signature_and_docstring = classmethod(lambda _: None)

    import tribodyn.post.progress
    import tribodyn.studies.pages  # noqa: F401
    from tribodyn.post.figures.over_mesh import prepare_overview
    from tribodyn.record.soundness import remember_own

    prepare_overview()
    line = sys.stdin.readline()
    timer.cancel()
    name, force = json.loads(line)
    record = Path(name)
    remember_own(record)  # the first process has just written it
    pictures = draw_pictures(record, everything=False, force=force)
    sys.stdout.write(json.dumps([str(path) for path in pictures]))
    sys.stdout.flush()
    os._exit(0)  # to take matplotlib apart in order would let the first process wait
