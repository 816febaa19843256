"""Verbs on records: `tribodyn show` prints one, `plot` draws pictures, `report` writes a page."""

from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.options import (
    Align,
    AlignOption,
    FullOption,
    JsonOption,
    MeasuredOption,
    ReplaceOption,
    records_and_plots,
)
from tribodyn.errors import InputError

if TYPE_CHECKING:
    from tribodyn.record.sweep_reader import SweepRecord

PLOT_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn plot crc-23-47.h5\n"
    "  tribodyn plot crc-23-47.h5 involute-23-47.h5 film normal-load -o pictures"
    "\n  tribodyn plot crc-23-47.h5 transmission-error --against time --cycles 0 --format pdf"
    "\n  tribodyn plot jump-involute-23-47-pinion_speed.h5 response campbell"
    "\n  tribodyn plot jump-involute-23-47-pinion_speed.h5 poincare --at pinion_speed=3000rpm"
)
REPORT_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn report crc-23-47.h5\n"
    "  tribodyn report crc-23-47.h5 involute-23-47.h5 -o both.html\n"
    "\b\nThe page is one file, which needs no other and no network: summary, figures that can be\n"
    "zoomed, the teeth rolling through mesh, the scenario."
)
SHOW_EXAMPLES = (
    "\b\nExamples:\n  tribodyn show crc-23-47.h5\n  tribodyn show crc-23-47-pinion_speed.h5 --json"
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
            help="Records, then figures: all, or names from `tribodyn list plots RECORD`.",
            autocompletion=records_and_plots,
        ),
    ],
    *,
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder of the pictures.")] = Path(),
    cycles: Annotated[
        int | None,
        typer.Option(
            help="Mesh cycles to show, the last ones; 0: the whole run. "
            "Default 2; the whole run where speed or load change.",
            show_default=False,
        ),
    ] = None,
    against: Annotated[
        Against | None,
        typer.Option(help="Mesh phase, or time. Default phase; time where speed or load change."),
    ] = None,
    format: Annotated[Format, typer.Option(help="File format.")] = Format.png,
    at: Annotated[
        list[str] | None,
        typer.Option(
            "--at", metavar="NAME=VALUE", help="The case of a sweep for poincare: pinion_speed=3000rpm."
        ),
    ] = None,
    measured: MeasuredOption = None,
    align: AlignOption = Align.given,
    force: ReplaceOption = False,
    json: Annotated[bool, typer.Option("--json", help="Print the paths as JSON.")] = False,
) -> None:
    """Draw figures of records; several are compared."""
    from contextlib import ExitStack

    from tribodyn.cli.pictures import draw, save_all
    from tribodyn.cli.printing import print_files, print_json
    from tribodyn.input.sources import is_file
    from tribodyn.record.reader import Record
    from tribodyn.record.sweep_reader import SweepRecord, is_sweep
    from tribodyn.studies.pages import names as figure_names
    from tribodyn.studies.pages import sweep_figure, sweep_names

    paths = [word for word in what if word.endswith((".h5", ".hdf5")) or is_file(Path(word))]
    names = [word for word in what if word not in paths]
    if not paths:
        raise InputError("record", f'"{what[0]}"', "no such file", "name a record that tribodyn run wrote")
    beside = output / f"{'-'.join(Path(path).stem for path in paths)}.{format.value}"
    everything = not names or "all" in names
    with ExitStack() as stack:
        if measured is not None:
            from tribodyn.studies.measured import measured_figure

            if names:
                raise InputError("plot", names[0], "--measured draws one figure, measured", "omit the name")
            records = [stack.enter_context(Record(path)) for path in paths]
            pictures = save_all(
                ["measured"], beside, lambda _: measured_figure(records, measured, align.value), force=force
            )
        elif is_sweep(paths[0]):
            sweeps = [stack.enter_context(SweepRecord(path)) for path in paths]
            place = _place(sweeps[0], at or [])
            chosen = sweep_names(sweeps) if everything else names
            pictures = save_all(chosen, beside, lambda name: sweep_figure(name, sweeps, place), force=force)
        else:
            records = [stack.enter_context(Record(path)) for path in paths]
            chosen = figure_names(records) if everything else names
            shown = "auto" if cycles is None else cycles or None
            how = against and against.value
            pictures = draw(records, chosen, beside, cycles=shown, against=how, force=force)
    if json:
        print_json({"pictures": [str(picture) for picture in pictures]})
    else:
        print_files("picture", pictures)


def _place(record: "SweepRecord", at: Sequence[str]) -> dict[str, float | str]:
    """Read NAME=VALUE, in the unit given or the record's."""
    from tribodyn.input.units import ANGULAR_SPEED, Kind, NotAQuantity, to_si

    units = {axis.name: axis.units for axis in record.parameters if axis.values.dtype.kind in "fi"}
    place: dict[str, float | str] = {}
    for option in at:
        name, equals, text = (part.strip() for part in option.partition("="))
        if not equals:
            remedy = "write it like --at pinion_speed=3000rpm"
            raise InputError("--at", f'"{option}"', "not NAME=VALUE", remedy)
        if name not in units:
            place[name] = text
            continue
        try:
            unit = units[name]
            kind = ANGULAR_SPEED if unit == ANGULAR_SPEED.si else Kind(name, unit, f"1 {unit}")
            place[name] = float(text) if unit == "1" else to_si(text, kind)
        except NotAQuantity as error:
            raise InputError("--at", f'"{option}"', error.rule, error.remedy) from None
        except ValueError:
            raise InputError("--at", f'"{option}"', "not a number", f"write it like {name}=1.5") from None
    return place


def report(
    records: Annotated[
        list[str],
        typer.Argument(metavar="RECORD...", help="Records of tribodyn run, or one of tribodyn sweep."),
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The page; default: the records' names, in this folder."),
    ] = None,
    measured: MeasuredOption = None,
    align: AlignOption = Align.given,
    force: ReplaceOption = False,
    pdf: Annotated[bool, typer.Option("--pdf", help="Also print it, through an installed browser.")] = False,
    json: Annotated[bool, typer.Option("--json", help="Print the path as JSON.")] = False,
) -> None:
    """Write a page of records for the browser; several side by side."""
    from contextlib import ExitStack

    from tribodyn.cli.printing import print_files, print_json
    from tribodyn.numerics.files.output_files import check_output
    from tribodyn.post.page.document import print_page, require_browser
    from tribodyn.record.sweep_reader import open_any
    from tribodyn.studies.pages import write_report

    target = output or Path(f"{'-'.join(Path(path).stem for path in records)}.html")
    if pdf:
        require_browser()
        check_output(target.with_suffix(".pdf"), force)
    with ExitStack() as stack:
        opened = [stack.enter_context(open_any(Path(path))) for path in records]
        written = write_report(opened, target, force=force, measured=measured, align=align.value)
    files = {"report": written}
    if pdf:
        files["pdf"] = print_page(written, force=force)
    if json:
        print_json({what: str(path) for what, path in files.items()})
    else:
        for what, path in files.items():
            print_files(what, [path])


def show(
    record: Annotated[Path, typer.Argument(help="A record that tribodyn wrote.")],
    full: FullOption = False,
    json: JsonOption = False,
) -> None:
    """Print the summary of a record."""
    from tribodyn.cli.printing import print_json, print_rich
    from tribodyn.post.sweep_report import sweep_as_json
    from tribodyn.record.sweep_reader import SweepRecord, open_any
    from tribodyn.studies.pages import summary_json, summary_table, sweep_table

    with open_any(record) as opened:
        sweep = isinstance(opened, SweepRecord)
        if json:
            data = sweep_as_json(opened) if sweep else summary_json(opened)
            print_json({**data, "scenario": opened.scenario})
        else:
            print_rich(sweep_table(opened) if sweep else summary_table(opened, full))
