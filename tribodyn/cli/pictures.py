"""Pictures of records as files, for every verb that draws; imports no part of the command line's grammar."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from tribodyn.numerics.output_files import make_folder

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
    from tribodyn.studies.pages.pictures import figure

    def make(name: str) -> "Figure":
        return figure(name, records, cycles=cycles, against=against)

    return save_all(names, beside, make, force=force)


def overview_path(record: Path) -> Path:
    """Where the overview of a record is drawn."""
    return _named(record.with_suffix(".png"), "overview")


def draw_pictures(path: Path, *, everything: bool, force: bool = False) -> list[Path]:
    """Draw the overview of a record, or all its figures, beside it."""
    from tribodyn.record.reader import open_record
    from tribodyn.studies.pages.pictures import names

    with open_record(path) as record:
        chosen = ["overview", *names([record])] if everything else ["overview"]
        return draw([record], chosen, path.with_suffix(".png"), force=force)


def save_all(
    names: Iterable[str], beside: Path, make: Callable[[str], "Figure"], *, force: bool = False
) -> list[Path]:
    """Make figures by name and write them into files named after `beside`; raises as `write_output`."""
    from tribodyn.cli.progress import progress_bar
    from tribodyn.numerics.output_files import check_output
    from tribodyn.post.style import save

    names = list(names)
    for name in names:
        check_output(_named(beside, name), force)
    pictures = []
    with progress_bar("drawing") as progress:
        for done, name in enumerate(names, start=1):
            drawn = make(name)
            make_folder(beside.parent)
            pictures.append(save(drawn, _named(beside, name), force=force))
            progress(done / len(names))
    return pictures


def _named(beside: Path, name: str) -> Path:
    return beside.with_name(f"{beside.stem}-{name}{beside.suffix}")
