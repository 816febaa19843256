"""`tribodyn run`: from a scenario to a record, a summary and pictures."""

from pathlib import Path
from typing import Annotated, Any

import typer

from tribodyn.cli import completion
from tribodyn.cli.overrides import LargeOption, SetOption, overrides

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn run crc-23-47\n"
    "  tribodyn run my-drive.toml -o results/heavy.h5 --force\n"
    '  tribodyn run crc-23-47 --set operating.gear_torque="600 N*m" --set solver.cycles=40\n'
    "  tribodyn run crc-23-47 --json --no-plot"
)


def run(
    scenario: Annotated[
        str,
        typer.Argument(
            help="A scenario file, or the name of a shipped scenario.", autocompletion=completion.scenarios
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The record; default: the scenario's name, in this folder."),
    ] = None,
    settings: SetOption = None,
    force: Annotated[bool, typer.Option("--force", help="Replace a record of that name.")] = False,
    allow_large: LargeOption = False,
    plot: Annotated[
        bool | None,
        typer.Option("--plot/--no-plot", help="All pictures, or none; default: one overview picture."),
    ] = None,
    report: Annotated[
        bool, typer.Option("--report", help="Also write a page for the browser, beside the record.")
    ] = False,
    json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Run a scenario: record, summary, picture."""
    from tribodyn.cli.ahead import drawer
    from tribodyn.cli.outcome import SIMULATION_FAILED, complain
    from tribodyn.cli.plot import draw_pictures
    from tribodyn.cli.printing import print_json, quoted_path
    from tribodyn.cli.progress import progress_bar
    from tribodyn.record.withheld import warnings
    from tribodyn.studies.load import load
    from tribodyn.studies.run import run as run_case

    with drawer(wanted=plot is None) as ahead:
        loaded = load(scenario, overrides(settings))
        case = loaded.case
        record = output or Path(f"{case.name}.h5")
        with loaded.naming(), progress_bar(case.name) as progress:
            result = run_case(case, record, force=force, progress=progress, allow_large=allow_large)
        failed = result.status != "complete"
        if ahead and not failed:
            ahead.draw(result.path)
        if not json:
            _print_summary(result.path)
        drawn = ahead.pictures() if ahead and not failed else None
    if drawn is None:
        drawn = [] if failed or plot is False else draw_pictures(result.path, everything=plot is True)
    page = None if failed or not report else _report(result.path)
    if json:
        shown = {"pictures": [str(path) for path in drawn], **({"report": str(page)} if page else {})}
        print_json({**_as_json(result.path), **shown})
    else:
        typer.echo(f"record   {quoted_path(result.path)}")
        for picture in drawn:
            typer.echo(f"picture  {quoted_path(picture)}")
        if page:
            typer.echo(f"report   {quoted_path(page)}")
    for warning in warnings(result.summary):
        complain(f"{loaded.path}: warning: {warning}")
    if failed:
        complain(f"{loaded.path}: the simulation failed: {result.message}; partial record: {result.path}")
        raise typer.Exit(SIMULATION_FAILED)


def _print_summary(path: Path) -> None:
    from tribodyn.cli.show import print_summary
    from tribodyn.record.reader import open_record

    with open_record(path) as record:
        print_summary(record)


def _as_json(path: Path) -> dict[str, Any]:
    from tribodyn.post.report import as_json
    from tribodyn.record.reader import open_record

    with open_record(path) as record:
        return as_json(record)


def _report(path: Path) -> Path:
    from tribodyn.record.reader import open_record
    from tribodyn.studies.pages import write_report

    with open_record(path) as record:
        return write_report([record], path.with_suffix(".html"))
