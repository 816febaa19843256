"""`tribodyn run`: from a scenario to a record, a summary and pictures."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from tribodyn.cli.options import (
    ForceOption,
    LargeOption,
    PageOption,
    PlotOption,
    ScenarioArgument,
    SetOption,
    SummaryOption,
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
        typer.Option("--output", "-o", help="The record; default: the scenario's name, in this folder."),
    ] = None,
    settings: SetOption = None,
    force: ForceOption = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue a stopped search of that name (kind design).")
    ] = False,
    allow_large: LargeOption = False,
    plot: PlotOption = None,
    report: PageOption = False,
    json: SummaryOption = False,
) -> None:
    """Run a scenario: record, summary, picture."""
    from tribodyn.studies.protocol.load import load

    require_one_way(resume=resume, force=force)
    how = {"output": output, "force": force, "resume": resume, "allow_large": allow_large}
    run_loaded(lambda: load(scenario, overrides(settings)), Shown(plot, report, json), **how)


class Shown(NamedTuple):
    """What is shown of a run: pictures (all, none or one), a page, JSON."""

    plot: bool | None = None
    report: bool = False
    json: bool = False


def run_loaded(made: "Callable[[], Loaded]", shown: Shown, *, output: Path | None, **how: Any) -> None:
    """Run a case and show what became of it.

    Parameters
    ----------
    made : gives the case
    **how
        Further arguments of `protocol.run.run`.
    """
    from tribodyn.cli.outcome import SIMULATION_FAILED, complain
    from tribodyn.cli.pictures import draw_pictures, drawer, overview_path
    from tribodyn.cli.printing import print_json, quoted_path
    from tribodyn.cli.progress import progress_bar
    from tribodyn.errors import OutputError
    from tribodyn.numerics.output_files import check_output
    from tribodyn.record.withheld import warnings
    from tribodyn.studies.protocol.run import run as run_case

    force = bool(how.get("force"))
    with drawer(wanted=shown.plot is None) as ahead:
        loaded = made()
        case = loaded.case
        record = output or Path(f"{case.name}.h5")
        if shown.plot is not False:
            check_output(overview_path(record), force)
        if shown.report:
            check_output(record.with_suffix(".html"), force)
        with loaded.naming(), progress_bar(case.name) as progress:
            result = run_case(case, record, progress=progress, **how)
        failed = result.status != "complete"
        if ahead and not failed:
            ahead.draw(result.path, force)
        if not shown.json:
            _print_summary(result.path)
        drawn = ahead.pictures() if ahead and not failed else None
    page = None
    try:
        if drawn is None:
            wanted = not failed and shown.plot is not False
            drawn = draw_pictures(result.path, everything=bool(shown.plot), force=force) if wanted else []
        if shown.report and not failed:
            page = _report(result.path, force)
    except OutputError as error:
        raise OutputError(error.file, error.reason, f"the record is complete: {result.path}") from None
    files = result.summary.get("files", {}).values()
    if shown.json:
        more = {"pictures": [str(path) for path in drawn], **({"report": str(page)} if page else {})}
        data = _as_json(result.path)
        top = {name: data["summary"].get(name) for name in loaded.study.top()}
        print_json({**data, **top, **more})
    else:
        typer.echo(f"record   {quoted_path(result.path)}")
        for file in files:
            typer.echo(f"{Path(file).suffix[1:]:8} {quoted_path(Path(file))}")
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


def _report(path: Path, force: bool) -> Path:
    from tribodyn.record.reader import open_record
    from tribodyn.studies.pages.page import write_report

    with open_record(path) as record:
        return write_report([record], path.with_suffix(".html"), force=force)
