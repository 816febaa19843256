"""`tribodyn run`: from a scenario to a record, a summary and pictures."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

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
    from tribodyn.cli.pictures import Drawer
    from tribodyn.studies.protocol.load import Loaded
    from tribodyn.studies.protocol.study import RunResult

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
    from tribodyn.cli.outcome import complain
    from tribodyn.studies.protocol.load import load_every

    def made() -> "Mapping[str, Loaded]":
        every = load_every(scenario, overrides(settings))
        for remark in every.remarks():
            complain(f"{scenario}: {remark}")
        return every.cases

    run_loaded(
        made,
        output=output,
        plot=plot,
        report=report,
        full=full,
        json=json,
        force=force,
        resume=resume,
        allow_large=allow_large,
    )


class _Done(NamedTuple):
    """A run, and the pictures and the page that were made of it."""

    result: "RunResult"
    pictures: list[Path]
    page: Path | None


def run_loaded(
    load_case: "Callable[[], Mapping[str, Loaded]]",
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
    """Run the cases that `load_case` gives and show what became of them; `how` as of `protocol.run.run`.

    Several are of the meshes of a gearbox, by their names: their results stand side by side.
    """
    from tribodyn.cli.outcome import BAD_INPUT, SIMULATION_FAILED, complain, end
    from tribodyn.cli.pictures import drawer, overview_path
    from tribodyn.cli.printing import print_json, print_rich
    from tribodyn.errors import InputError, SimulationError
    from tribodyn.numerics.files.output_files import check_output
    from tribodyn.record.target import watched
    from tribodyn.record.withheld_efficiency import warnings

    require_one_way(resume=resume, force=force)
    with drawer(wanted=plot is None) as ahead:
        cases = dict(load_case())
        several = len(cases) > 1
        records = {mesh: output or Path(f"{loaded.case.name}.h5") for mesh, loaded in cases.items()}
        if output is None:
            cases = {mesh: loaded.recorded_in(records[mesh].parent) for mesh, loaded in cases.items()}
        elif several:
            records = {mesh: output.with_stem(f"{output.stem}-{mesh}") for mesh in cases}
        kept = {mesh: watched(record) for mesh, record in records.items()}
        for record in records.values():
            if plot is not False:
                check_output(overview_path(record), force)
            if report:
                check_output(record.with_suffix(".html"), force)
        how |= {"plot": plot, "report": report, "force": force, "resume": resume}
        how |= {"full": full, "quiet": several or json, "ahead": None if several else ahead}
        done: dict[str, _Done] = {}
        wrong: list[tuple[int, str]] = []
        for mesh, loaded in cases.items():
            place = f"{loaded.path}, mesh {mesh}" if several else f"{loaded.path}"
            try:
                done[mesh] = _run(loaded, records[mesh], **how)
            except (InputError, SimulationError) as error:
                if not several:
                    raise
                status = BAD_INPUT if isinstance(error, InputError) else SIMULATION_FAILED
                wrong.append((status, f"{place}: {error}"))
                continue
            result = done[mesh].result
            if result.status != "complete":
                reason = f"the simulation failed: {result.message}; partial record: {result.path}"
                wrong.append((SIMULATION_FAILED, f"{place}: {reason}"))
    previous = {mesh: kept[mesh]() for mesh in done}
    if json:
        data = {mesh: _data(each, previous[mesh], cases[mesh]) for mesh, each in done.items()}
        print_json({"meshes": data} if several else data[""])
    else:
        if several:
            print_rich(_side_by_side(done, full))
        for mesh, each in done.items():
            _print_files(each, previous[mesh])
    for mesh, each in done.items():
        for warning in warnings(each.result.summary):
            complain(f"{cases[mesh].path}: warning: {warning}")
    for _, message in wrong[:-1]:
        complain(message)
    if wrong:
        end(max(status for status, _ in wrong), wrong[-1][1])


def _run(
    loaded: "Loaded",
    record: Path,
    *,
    ahead: "Drawer | None",
    plot: bool | None,
    report: bool,
    full: bool,
    quiet: bool,
    force: bool,
    **how: Any,
) -> _Done:
    """Run a case, draw it, and print its summary unless that is `quiet`."""
    from tribodyn.cli.pictures import draw_pictures
    from tribodyn.cli.printing import print_rich
    from tribodyn.errors import OutputError
    from tribodyn.post.progress import progress_bar
    from tribodyn.record.reader import Record
    from tribodyn.studies.pages import summary_table, write_report
    from tribodyn.studies.protocol.run import run as run_case

    with loaded.naming(), progress_bar(loaded.case.name) as progress:
        result = run_case(loaded.case, record, progress=progress, force=force, **how)
    failed = result.status != "complete"
    if ahead and not failed:
        ahead.draw(result.path, force)
    if not quiet:
        with Record(result.path) as opened:
            print_rich(summary_table(opened, full))
    drawn = ahead.pictures() if ahead and not failed else None
    page = None
    try:
        if drawn is None:
            wanted = not failed and plot is not False
            drawn = draw_pictures(result.path, everything=bool(plot), force=force) if wanted else []
        if report and not failed:
            with Record(result.path) as opened:
                page = write_report([opened], result.path.with_suffix(".html"), force=force)
    except OutputError as error:
        raise OutputError(error.file, error.reason, f"the record is complete: {result.path}") from None
    return _Done(result, drawn, page)


def _side_by_side(done: "Mapping[str, _Done]", full: bool) -> Any:
    """Complete runs in one table; the others, and with `full` all, in tables of their own."""
    from contextlib import ExitStack

    from rich.console import Group

    from tribodyn.post.compare import comparison_table
    from tribodyn.record.reader import Record
    from tribodyn.studies.pages import compare, summary_table

    with ExitStack() as stack:
        records = [stack.enter_context(Record(each.result.path)) for each in done.values()]
        complete = [record for record in records if record.status == "complete"]
        compared = complete if len(complete) > 1 else []
        parts = [summary_table(record, full) for record in records if full or record not in compared]
        if compared:
            parts.append(comparison_table(compare(compared)))
        return Group(*(part for some in parts for part in some.renderables))


def _data(done: _Done, previous: list[Path], loaded: "Loaded") -> dict[str, Any]:
    """What a program is told of a run."""
    from tribodyn.record.reader import Record
    from tribodyn.studies.pages import summary_json

    with Record(done.result.path) as record:
        data = summary_json(record)
    data |= {name: data["summary"].get(name) for name in loaded.study.top()}
    data |= {"pictures": [str(path) for path in done.pictures]}
    data |= {"report": str(done.page)} if done.page else {}
    return data | ({"previous": str(previous[0])} if previous else {})


def _print_files(done: _Done, previous: list[Path]) -> None:
    from tribodyn.cli.printing import print_files

    print_files("record", [done.result.path])
    print_files("previous", previous)
    print_files("", map(Path, done.result.summary.get("files", {}).values()))
    print_files("picture", done.pictures)
    print_files("report", [done.page] if done.page else [])
