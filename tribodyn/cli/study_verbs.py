"""Verbs that studies offer, found through the registry; see `studies.protocol.verb`."""

import inspect
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_args

import typer

from tribodyn.cli.options import JsonOption, ReplaceOption, ScenarioArgument, SetOption, overrides
from tribodyn.cli.run import run, run_loaded
from tribodyn.errors import InputError
from tribodyn.numerics.files.output_files import check_output

if TYPE_CHECKING:
    from tribodyn.studies.protocol.verb import Finding, Option, Verb

#: Endings of files that keep an answer.
ENDINGS = (".json", ".png", ".svg", ".pdf")


class SearchEngine(StrEnum):
    """Where candidates are evaluated."""

    native = "native"
    dask = "dask"


def study_verbs() -> "Iterator[tuple[str, Verb]]":
    """Go through the verbs of all studies."""
    from tribodyn.studies import STUDIES

    for _, verbs in STUDIES.each(lambda study: study.verbs()):
        yield from verbs.items()


def command_of(name: str, verb: "Verb") -> Callable[..., None]:
    """The verb as typer takes it: its own options, then those that all verbs of its form have."""
    form = _answer if verb.answers else _run
    verb_options = {
        parameter.name: parameter.replace(annotation=_annotation(parameter, option))
        for parameter in inspect.signature(verb.function).parameters.values()
        if (option := _option_of(parameter)) is not None
    }
    shared = dict(inspect.signature(form).parameters) | (
        {} if verb.answers else inspect.signature(run).parameters
    )
    scenario, *others = (shared[key] for key in shared if key not in ("function", "how"))

    def command(**arguments: Any) -> None:
        options = {key: arguments.pop(key) for key in verb_options}
        form(lambda *source, **how: verb.function(*source, **options, **how), **arguments)

    parameters = [scenario, *verb_options.values(), *others]
    signature = inspect.Signature([part.replace(kind=part.KEYWORD_ONLY) for part in parameters])
    command.__name__, command.__doc__ = name, (verb.function.__doc__ or "").partition("\n")[0]
    command.__annotations__ = {key: value.annotation for key, value in signature.parameters.items()}
    vars(command)["__signature__"] = signature
    return command


def _option_of(parameter: inspect.Parameter) -> "Option | None":
    from tribodyn.studies.protocol.verb import Option

    return next((part for part in get_args(parameter.annotation) if isinstance(part, Option)), None)


def _annotation(parameter: inspect.Parameter, option: "Option") -> Any:
    kind = get_args(parameter.annotation)[0] if option.type is None else option.type
    shown = {"help": option.help, "metavar": option.metavar, "min": option.min, "max": option.max}
    return Annotated[kind, typer.Option(f"--{parameter.name.replace('_', '-')}", **shown)]


def _run(
    function: Callable[..., Any],
    scenario: ScenarioArgument,
    *,
    engine: Annotated[
        SearchEngine, typer.Option(help="native: the cores of this machine; dask: many machines.")
    ] = SearchEngine.native,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Dask's scheduler, tcp://host:8786; default: one of its own."),
    ] = None,
    settings: list[str] | None = None,
    **how: Any,
) -> None:
    """Run the scenario that a verb makes, and show what became of it, with the options of `tribodyn run`."""
    from tribodyn.studies.protocol.cluster import client_of

    if scheduler is not None and engine is SearchEngine.native:
        raise InputError("--scheduler", scheduler, "belongs to --engine dask", "add --engine dask")
    with nullcontext() if engine is SearchEngine.native else client_of(None, scheduler) as client:
        run_loaded(lambda: {"": function(scenario, overrides=overrides(settings))}, client=client, **how)


def _answer(
    function: Callable[..., "Finding"],
    scenario: ScenarioArgument,
    *,
    settings: SetOption = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Keep it in this file: .json, or a picture: .png, .svg, .pdf."),
    ] = None,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Print what a verb finds, and keep it."""
    from tribodyn.cli.printing import print_files, print_findings, print_json, write_json
    from tribodyn.post.progress import progress_bar
    from tribodyn.studies.protocol.load import load

    _check(output, force)
    loaded = load(scenario, overrides(settings))
    with progress_bar(loaded.case.name) as progress, loaded.naming():
        answer = function(loaded.case, progress=progress)
    if output is not None and output.suffix == ".json":
        write_json(output, answer.as_dict(), force)
    elif output is not None:
        from tribodyn.post.style import save

        save(answer.plot(), output, force=force)
    files = [output] if output is not None else []
    if json:
        print_json(answer.as_dict() | ({"files": [str(output)]} if files else {}))
        return
    print_findings(answer.tables(), answer.remarks)
    print_files("kept", files)


def _check(output: Path | None, force: bool) -> None:
    """Raise InputError at a file that could not be written in the end."""
    if output is None:
        return
    if output.suffix not in ENDINGS:
        rule = f"ends with none of {', '.join(ENDINGS)}"
        raise InputError("--output", str(output), rule, f'write "{output.with_suffix(".json")}"')
    if not output.absolute().parent.is_dir():
        raise InputError("--output", str(output), "its folder is not there", "make it, or choose another")
    check_output(output, force)
