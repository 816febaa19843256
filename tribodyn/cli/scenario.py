"""Verbs on scenario files: `tribodyn init`, `tribodyn check` and `tribodyn schema`."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.options import JsonOption, LargeOption, ScenarioArgument, SetOption, kinds, overrides

if TYPE_CHECKING:
    from tribodyn.studies.protocol.load import Loaded
    from tribodyn.studies.protocol.study import CheckResult, TextTable

INIT_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn init my-drive\n"
    "  tribodyn run my-drive.toml\n"
    "  tribodyn init my-study --kind efficiency"
)
CHECK_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn check involute-18-36\n"
    "  tribodyn check my-drive.toml --set drive.pinion.profile_shift=0.3 --json\n"
    "  tribodyn check two-stage-reducer first"
)
SCHEMA_EXAMPLE = "\b\nExample:\n  tribodyn schema > scenario.schema.json"


def init(
    name: Annotated[str, typer.Argument(help="Name of the scenario; NAME.toml is written in this folder.")],
    kind: Annotated[
        str, typer.Option(help="Kind of study; all of them: tribodyn list kinds.", autocompletion=kinds)
    ] = "",
    force: Annotated[bool, typer.Option("--force", help="Replace a file of that name.")] = False,
) -> None:
    """Write a commented scenario to run and to edit."""
    from tribodyn.cli.printing import command_name, quoted_path
    from tribodyn.errors import InputError
    from tribodyn.numerics.files.output_files import write_output
    from tribodyn.studies import DEFAULT, STUDIES
    from tribodyn.studies.protocol.load import filled

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    template = filled(kind or DEFAULT, path.stem)
    if not path.parent.is_dir():
        raise InputError("name", f'"{path}"', "the folder does not exist", f"create {path.parent} first")
    write_output(path, template, force=force)
    typer.echo(f"{path}\nrun it with: {command_name()} {STUDIES[kind or DEFAULT].verb} {quoted_path(path)}")


def check(
    scenario: ScenarioArgument,
    part: Annotated[
        str, typer.Argument(help="Of a train: only tables with this in their title, such as a mesh.")
    ] = "",
    settings: SetOption = None,
    full: Annotated[bool, typer.Option("--full", help="Of a train: all tables of all meshes.")] = False,
    allow_large: LargeOption = False,
    json: JsonOption = False,
) -> None:
    """Check a scenario; print duty, geometry and stiffness."""
    from tribodyn.cli.outcome import complain
    from tribodyn.cli.printing import print_json
    from tribodyn.post.progress import progress_bar
    from tribodyn.studies.protocol.load import load_every

    every = load_every(scenario, overrides(settings))
    results = {}
    for mesh, loaded in every.cases.items():
        with loaded.naming(), progress_bar(loaded.case.name):
            results[mesh] = loaded.study.check(loaded.case, allow_large=allow_large)
    for remark in every.remarks():
        complain(f"{scenario}: {remark}")
    if json:
        data = {mesh: checked.data for mesh, checked in results.items()}
        path = str(next(iter(every.cases.values())).path)
        print_json({"scenario": path, **(data[""] if "" in data else {"meshes": data})})
        return
    for mesh, loaded in every.cases.items():
        _print_checked(loaded, results[mesh], part, full)


def _print_checked(loaded: "Loaded", checked: "CheckResult", part: str, full: bool) -> None:
    from tribodyn.cli.outcome import complain
    from tribodyn.cli.printing import begun, print_findings, print_prose

    number = len(checked.warnings)
    unusual = f"can be computed, but has {number} unusual value{'s' * (number > 1)}, see the end"
    print_prose(f"{loaded.path}: {loaded.case.title}: {unusual if number else 'sound'}")
    if full or part or not checked.details:
        print_findings(_named(checked.every, part), () if part else checked.remarks)
    else:
        print_findings(*begun(checked.every, checked.remarks))
        print_prose("All of it: --full; some of it: a mesh, or a word of a title, behind the scenario.")
    for warning in checked.warnings:
        complain(f"{loaded.path}: warning: {warning}")


def _named(tables: "list[TextTable]", part: str) -> "list[TextTable]":
    """The tables with a word in their title; InputError where there is none."""
    from tribodyn.errors import InputError, quoted

    matching = [table for table in tables if part.casefold() in table.title.casefold()]
    if not matching:
        titles = "; ".join(table.title for table in tables)
        raise InputError("part", quoted(part), "in no title of a table", f"there is: {titles}")
    return matching


def schema() -> None:
    """Print the JSON schema of a scenario file."""
    from tribodyn.cli.printing import print_json
    from tribodyn.studies.protocol.load import json_schema

    print_json(json_schema())
