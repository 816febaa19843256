"""`tribodyn plot`: pictures of records."""

from collections.abc import Iterable, Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.output import make_folder, unwritable

if TYPE_CHECKING:
    from tribodyn.record.reader import Record

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn plot crc-23-47.h5\n"
    "  tribodyn plot crc-23-47.h5 involute-23-47.h5 film normal-load -o pictures"
    "\n  tribodyn plot crc-23-47.h5 transmission-error --against time --cycles 0 --format pdf"
)


class Against(StrEnum):
    """What figures over a run are drawn against."""

    phase = "phase"
    time = "time"


class Format(StrEnum):
    """File format of the pictures."""

    png = "png"
    pdf = "pdf"
    svg = "svg"


def plot(
    what: Annotated[
        list[str],
        typer.Argument(
            metavar="RECORD... [NAME...]",
            help="Records, then figures: all, or names out of `tribodyn list plots`.",
        ),
    ],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder of the pictures.")] = Path(),
    cycles: Annotated[int, typer.Option(help="Mesh cycles to show, the last ones; 0: the whole run.")] = 2,
    against: Annotated[Against, typer.Option(help="Mesh phase, or time.")] = Against.phase,
    format: Annotated[Format, typer.Option(help="File format.")] = Format.png,
    json: Annotated[bool, typer.Option("--json", help="Print the paths as JSON.")] = False,
) -> None:
    """Draw figures of records; several are compared."""
    from contextlib import ExitStack

    from tribodyn.cli.printing import print_json, quoted_path
    from tribodyn.errors import InputError
    from tribodyn.post.plots import names as figure_names
    from tribodyn.record.reader import open_record

    paths = [word for word in what if word.endswith((".h5", ".hdf5")) or Path(word).is_file()]
    names = [word for word in what if word not in paths]
    if not paths:
        raise InputError("record", f'"{what[0]}"', "no such file", "name a record that tribodyn run wrote")
    prefix = "-".join(Path(path).stem for path in paths)
    with ExitStack() as stack:
        records = [stack.enter_context(open_record(path)) for path in paths]
        chosen = figure_names(records) if not names or "all" in names else names
        pictures = draw(
            records,
            chosen,
            output / f"{prefix}.{format.value}",
            cycles=cycles or None,
            against=against.value,
        )
    if json:
        print_json({"pictures": [str(picture) for picture in pictures]})
    else:
        for picture in pictures:
            typer.echo(f"picture  {quoted_path(picture)}")


def draw(
    records: Sequence["Record"],
    names: Iterable[str],
    beside: Path,
    *,
    cycles: int | None = 2,
    against: str = "phase",
) -> list[Path]:
    """Draw figures by name into files named after `beside`: ``crc.png`` becomes ``crc-film.png``."""
    from tribodyn.cli.progress import progress_bar
    from tribodyn.post.plots import figure, save

    names = list(names)
    pictures = []
    with progress_bar("drawing") as progress:
        for done, name in enumerate(names, start=1):
            picture = beside.with_name(f"{beside.stem}-{name}{beside.suffix}")
            drawn = figure(name, records, cycles=cycles, against=against)
            make_folder(beside.parent)
            try:
                pictures.append(save(drawn, picture))
            except OSError as error:
                raise unwritable(beside.parent, error) from None
            progress(done / len(names))
    return pictures
