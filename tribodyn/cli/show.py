"""`tribodyn show`: what a record says."""

from pathlib import Path
from typing import Annotated

import typer

from tribodyn.cli.options import FullOption, JsonOption

EXAMPLES = "\b\nExamples:\n  tribodyn show crc-23-47.h5\n  tribodyn show crc-23-47-pinion_speed.h5 --json"


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
