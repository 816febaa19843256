"""`tribodyn run`: from a scenario to a record, a summary and pictures."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from tribodyn.cli.options import (
    ForceOption,
    FullOption,
    LargeOption,
    ScenarioArgument,
    SetOption,
    overrides,
    require_one_way,
)

if TYPE_CHECKING:
    from tribodyn.studies.protocol.load import Loaded

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn run crc-23-47\n"
    "  tribodyn run my-drive.toml -o results/heavy.h5 --force\n"
    '  tribodyn run crc-23-47 --set operating.gear_torque="600 N*m" --set solver.cycles=40\n'
    "  tribodyn run crc-23-47 --json --no-plot"
)


def run(
    scenario: ScenarioArgument,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The record; default: named after the scenario, in this folder."),
    ] = None,
    settings: SetOption = None,
    *,
    force: ForceOption = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue a stopped run of that name, where its kind can.")
    ] = False,
    allow_large: LargeOption = False,
    plot: Annotated[
        bool | None,
        typer.Option("--plot/--no-plot", help="All pictures, or none; default: one overview picture."),
    ] = None,
    report: Annotated[
        bool, typer.Option("--report", help="Also write a page for the browser, beside the record.")
    ] = False,
    full: FullOption = False,
    json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Run a scenario: record, summary, picture."""
    from tribodyn.studies.protocol.load import load

    run_loaded(
        lambda: load(scenario, overrides(settings)),
        output=output,
        plot=plot,
        report=report,
        full=full,
        json=json,
        force=force,
        resume=resume,
        allow_large=allow_large,
    )


def run_loaded(
    made: "Callable[[], Loaded]",
    *,
    output: Path | None,
    plot: bool | None,
    report: bool,
    full: bool,
    json: bool,
    force: bool,
    resume: bool,
    **how: Any,
) -> None:
    """Run the case that `made` gives and show what became of it; `how` as of `protocol.run.run`."""
    from tribodyn.cli.outcome import SIMULATION_FAILED, complain, end
    from tribodyn.cli.pictures import draw_pictures, drawer, overview_path
    from tribodyn.cli.printing import print_files, print_json, print_rich
    from tribodyn.errors import OutputError
    from tribodyn.numerics.files.output_files import check_output
    from tribodyn.post.progress import progress_bar
    from tribodyn.record.files.previous import watched
    from tribodyn.record.reader import Record
    from tribodyn.record.withheld_efficiency import warnings
    from tribodyn.studies.protocol.run import run as run_case

    require_one_way(resume=resume, force=force)
    with drawer(wanted=plot is None) as ahead:
        loaded = made()
        record = output or Path(f"{loaded.case.name}.h5")
        if output is None:
            loaded = loaded.recorded_in(record.parent)
        kept = watched(record)
        if plot is not False:
            check_output(overview_path(record), force)
        if report:
            check_output(record.with_suffix(".html"), force)
        with loaded.naming(), progress_bar(loaded.case.name) as progress:
            result = run_case(loaded.case, record, progress=progress, force=force, resume=resume, **how)
        failed = result.status != "complete"
        if ahead and not failed:
            ahead.draw(result.path, force)
        if not json:
            from tribodyn.studies.pages import summary_table

            with Record(result.path) as opened:
                print_rich(summary_table(opened, full))
        drawn = ahead.pictures() if ahead and not failed else None
    page = None
    try:
        if drawn is None:
            wanted = not failed and plot is not False
            drawn = draw_pictures(result.path, everything=bool(plot), force=force) if wanted else []
        if report and not failed:
            from tribodyn.studies.pages import write_report

            with Record(result.path) as opened:
                page = write_report([opened], result.path.with_suffix(".html"), force=force)
    except OutputError as error:
        raise OutputError(error.file, error.reason, f"the record is complete: {result.path}") from None
    if json:
        from tribodyn.studies.pages import summary_json

        with Record(result.path) as opened:
            data = summary_json(opened)
        data |= {name: data["summary"].get(name) for name in loaded.study.top()}
        files = {"pictures": [str(path) for path in drawn], **({"report": str(page)} if page else {})}
        files |= {"previous": str(kept()[0])} if kept() else {}
        print_json(data | files)
    else:
        print_files("record", [result.path])
        print_files("previous", kept())
        print_files("", map(Path, result.summary.get("files", {}).values()))
        print_files("picture", drawn)
        print_files("report", [page] if page else [])
    for warning in warnings(result.summary):
        complain(f"{loaded.path}: warning: {warning}")
    if failed:
        reason = f"the simulation failed: {result.message}; partial record: {result.path}"
        end(SIMULATION_FAILED, f"{loaded.path}: {reason}")
