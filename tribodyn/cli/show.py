"""`tribodyn show`: what a record says."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.options import JsonOption

if TYPE_CHECKING:
    from tribodyn.record.reader import Record
    from tribodyn.record.sweep_reader import SweepRecord

EXAMPLES = "\b\nExamples:\n  tribodyn show crc-23-47.h5\n  tribodyn show crc-23-47-pinion_speed.h5 --json"


def show(
    record: Annotated[Path, typer.Argument(help="A record that tribodyn wrote.")], json: JsonOption = False
) -> None:
    """Print the summary of a record."""
    from tribodyn.cli.printing import print_json
    from tribodyn.post.report import as_json
    from tribodyn.record.sweep_reader import SweepRecord, open_any

    with open_any(record) as opened:
        if isinstance(opened, SweepRecord):
            _show_sweep(opened, json)
        elif json:
            print_json({**as_json(opened), "scenario": opened.scenario})
        else:
            print_summary(opened)


def _show_sweep(record: "SweepRecord", json: bool) -> None:
    from tribodyn.cli.printing import print_json, print_rich
    from tribodyn.post.sweep_report import sweep_as_json
    from tribodyn.studies.pages.pictures import sweep_table

    if json:
        print_json({**sweep_as_json(record), "scenario": record.scenario})
    else:
        print_rich(sweep_table(record))


def print_summary(record: "Record") -> None:
    """Write the summary of an open record to stdout."""
    from tribodyn.cli.printing import print_rich
    from tribodyn.studies.pages.pictures import summary_table

    print_rich(summary_table(record))
