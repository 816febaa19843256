"""`tribodyn design`: search for the values of a scenario's keys that minimise its figures."""

from contextlib import nullcontext
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from tribodyn.cli import completion
from tribodyn.cli.options import (
    ForceOption,
    LargeOption,
    PageOption,
    PlotOption,
    SetOption,
    SummaryOption,
    overrides,
    require_one_way,
)


class EngineName(StrEnum):
    """Where candidates are evaluated."""

    native = "native"
    dask = "dask"


EXAMPLES = (
    "\b\nValues of --free, the unit at least once, at the end:\n"
    '  KEY="0 um:40 um"   between these bounds\n'
    "  KEY=17:25          whole numbers, where the key takes those\n"
    "  KEY=linear,parabolic    one of these\n"
    "\b\nExamples:\n"
    "  tribodyn design load-contact-18-36 "
    '--free drive.pinion.modification.tip_relief="0 um:40 um" '
    '--free drive.pinion.modification.tip_relief_length="1 mm:6 mm" --minimise peak_to_peak\n'
    "  tribodyn design efficiency-involute-18-36 --free drive.pinion.profile_shift=-0.2:0.4 "
    '--minimise loss --subject-to "contact_ratio >= 1.4"\n'
    "  tribodyn design design-tip-relief-18-36 --method differential-evolution"
)


def design(
    scenario: Annotated[
        str,
        typer.Argument(
            help="The scenario to search through, or a search (kind design): a file, or a shipped one.",
            autocompletion=completion.scenarios,
        ),
    ],
    *,
    free: Annotated[
        list[str] | None,
        typer.Option("--free", metavar="KEY=FROM:TO", help="A key that the search may change, see below."),
    ] = None,
    minimise: Annotated[
        list[str] | None,
        typer.Option("--minimise", metavar="FIGURE", help="A figure of the summary; two make a front."),
    ] = None,
    maximise: Annotated[
        str | None, typer.Option("--maximise", metavar="FIGURE", help="A figure, in place of --minimise.")
    ] = None,
    subject_to: Annotated[
        list[str] | None,
        typer.Option(
            "--subject-to",
            metavar="CONSTRAINT",
            help='What must hold: "contact_ratio >= 1.3", or "… >= start".',
        ),
    ] = None,
    part: Annotated[
        list[str] | None,
        typer.Option(
            "--part", metavar="NAME=SCENARIO", help="A further scenario; its figures are NAME.FIGURE."
        ),
    ] = None,
    method: Annotated[
        str | None, typer.Option("--method", help="As design.method; default: chosen by the problem.")
    ] = None,
    evaluations: Annotated[
        int | None, typer.Option("--evaluations", min=2, max=10**6, help="At most; default: 200.")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Continue a stopped search of that name.")] = False,
    engine: Annotated[
        EngineName, typer.Option(help="native: the cores of this machine; dask: many machines.")
    ] = EngineName.native,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Dask's scheduler, tcp://host:8786; default: one of its own."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The record; default: the scenario's name and -design."),
    ] = None,
    settings: SetOption = None,
    force: ForceOption = False,
    allow_large: LargeOption = False,
    plot: PlotOption = None,
    report: PageOption = False,
    json: SummaryOption = False,
) -> None:
    """Search for the best values of a scenario's keys."""
    from tribodyn.cli.run import Shown, run_loaded
    from tribodyn.errors import InputError
    from tribodyn.studies.design.short_form import as_options, loaded_search, parts_of
    from tribodyn.studies.sweeping.cluster import client_of

    require_one_way(resume=resume, force=force)
    if scheduler is not None and engine is EngineName.native:
        raise InputError("--scheduler", scheduler, "belongs to --engine dask", "add --engine dask")
    more = {"method": method, "evaluations": evaluations, "part": parts_of(part or []) or None}
    options = as_options(free or [], minimise or [], maximise, subject_to or [], more)
    how = {"output": output, "force": force, "resume": resume, "allow_large": allow_large}
    with nullcontext() if engine is EngineName.native else client_of(None, scheduler) as client:
        run_loaded(
            lambda: loaded_search(scenario, options, overrides(settings)),
            Shown(plot, report, json),
            **how,
            client=client,
        )
