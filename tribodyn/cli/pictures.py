"""Pictures of records as files, for every verb that draws; imports no part of the command line's grammar."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from tribodyn.cli.output import make_folder, unwritable

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
) -> list[Path]:
    """Draw figures by name into files named after `beside`: ``crc.png`` becomes ``crc-film.png``."""
    from tribodyn.studies.pictures import figure

    return save_all(names, beside, lambda name: figure(name, records, cycles=cycles, against=against))


def draw_pictures(path: Path, *, everything: bool) -> list[Path]:
    """Draw the overview of a record, or all its figures, beside it."""
    from tribodyn.record.reader import open_record
    from tribodyn.studies.pictures import names

    with open_record(path) as record:
        chosen = ["overview", *names([record])] if everything else ["overview"]
        return draw([record], chosen, path.with_suffix(".png"))


def save_all(names: Iterable[str], beside: Path, make: Callable[[str], "Figure"]) -> list[Path]:
    """Make figures by name and write them into files named after `beside`."""
    from tribodyn.cli.progress import progress_bar
    from tribodyn.post.style import save

    names = list(names)
    pictures = []
    with progress_bar("drawing") as progress:
        for done, name in enumerate(names, start=1):
            picture = beside.with_name(f"{beside.stem}-{name}{beside.suffix}")
            drawn = make(name)
            make_folder(beside.parent)
            try:
                pictures.append(save(drawn, picture))
            except OSError as error:
                raise unwritable(beside.parent, error) from None
            progress(done / len(names))
    return pictures
