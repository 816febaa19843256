"""`tribodyn show`: what a record says."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tribodyn.record.reader import Record

EXAMPLES = "\b\nExamples:\n  tribodyn show crc-23-47.h5\n  tribodyn show crc-23-47.h5 --json"


def show(
    record: Annotated[Path, typer.Argument(help="A record that tribodyn wrote.")],
    json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Print the summary of a record."""
    from tribodyn.cli.printing import print_json
    from tribodyn.post.report import as_json
    from tribodyn.record.reader import open_record

    with open_record(record) as opened:
        if json:
            print_json({**as_json(opened), "scenario": opened.scenario})
        else:
            print_summary(opened)


def print_summary(record: "Record") -> None:
    """Write the summary of an open record to stdout."""
    from tribodyn.cli.printing import print_rich
    from tribodyn.post.report import summary_table

    print_rich(summary_table(record))
