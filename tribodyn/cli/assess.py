"""`tribodyn assess`: a drive from a data sheet to one page, into a folder."""

from pathlib import Path
from typing import Annotated, Any

import typer

from tribodyn.cli.options import FullOption, LargeOption, ScenarioArgument, SetOption, overrides

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn init my-drive --kind assessment\n"
    "  tribodyn assess my-drive.toml -o my-drive/\n"
    '  tribodyn assess my-drive.toml -o warm/ --set operating.oil_temperature="95 degC" --json\n'
    "\b\nThe folder has the record, the report to be opened in a browser, and the parts. A call that was\n"
    "stopped goes on where it was."
)
RECORD, PAGE, DATA, PRINTED = "assessment.h5", "report.html", "assessment.json", "report.pdf"


def assess(
    scenario: ScenarioArgument,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The folder; default: the scenario's name, in this folder."),
    ] = None,
    settings: SetOption = None,
    force: Annotated[
        bool,
        typer.Option(
            "--force", help="Replace the record, report and data of that folder; parts that fit are kept."
        ),
    ] = False,
    allow_large: LargeOption = False,
    full: FullOption = False,
    pdf: Annotated[
        bool, typer.Option("--pdf", help="Also print the report, through an installed browser.")
    ] = False,
    json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
) -> None:
    """Assess a drive: loads, vibration, film, temperatures, losses, margins; one folder, one report."""
    from tribodyn.cli.outcome import SIMULATION_FAILED, end
    from tribodyn.cli.printing import print_files, print_json, print_rich, write_json
    from tribodyn.errors import InputError
    from tribodyn.numerics.files.output_files import check_output, make_folder
    from tribodyn.post.page.document import print_page, require_browser
    from tribodyn.post.progress import progress_bar
    from tribodyn.record.reader import Record
    from tribodyn.record.target import watched
    from tribodyn.studies import STUDIES
    from tribodyn.studies.pages import summary_json, summary_table, write_report
    from tribodyn.studies.protocol.load import load

    loaded = load(scenario, overrides(settings))
    if loaded.study.verb != "assess":
        kinds = " or ".join(name for name, other in STUDIES.items() if other.verb == "assess")
        remedy = f"tribodyn {loaded.study.verb} it, or begin with: tribodyn init NAME --kind {kinds}"
        raise InputError("kind", f'"{loaded.study.kind}"', "is run, not assessed", remedy)
    if pdf:
        require_browser()
    folder = output or Path(loaded.case.name)
    make_folder(folder)
    kept = watched(folder / RECORD)
    if output is None:
        loaded = loaded.recorded_in(folder)
    for name in (PAGE, DATA, *([PRINTED] if pdf else [])):
        check_output(folder / name, force)
    with loaded.naming(), progress_bar(loaded.case.name) as progress:
        result = loaded.study.run(
            loaded.case, folder / RECORD, force=force, progress=progress, allow_large=allow_large
        )
    if result.status != "complete":
        reason = f"the simulation failed: {result.message}; partial record: {result.path}"
        end(SIMULATION_FAILED, f"{loaded.path}: {reason}")
    with Record(result.path) as record:
        page = write_report([record], folder / PAGE, force=force)
        head = summary_json(record)
        data: dict[str, Any] = {**head.pop("summary"), **head, "report": str(page)}
        files = {"record": result.path, "data": folder / DATA, "report": page}
        if pdf:
            files["pdf"] = print_page(page, force=force)
            data["pdf"] = str(files["pdf"])
        write_json(folder / DATA, data, force)
        if json:
            print_json(data)
            return
        print_rich(summary_table(record, full))
    print_files("previous", kept())
    for what, file in files.items():
        print_files(what, [file])
    limits = data.get("limits", {}).items()
    if missed := [name for name, limit in limits if not limit["kept"]]:
        typer.echo(f"limits not kept: {', '.join(missed)}")
    if within := [
        f"{name} ({limit['exceed']} of {limit['samples']})" for name, limit in limits if limit.get("exceed")
    ]:
        typer.echo(f"limits not kept by samples of what is not known: {', '.join(within)}")
