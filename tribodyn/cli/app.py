"""The typer application: its verbs in the order that a newcomer needs them."""

import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup
from typer.main import get_command

from tribodyn.cli import (
    assess,
    compare,
    gear,
    handover,
    page,
    records,
    run,
    scenario,
    signals,
    sweep,
    validate,
)
from tribodyn.cli import list as list_
from tribodyn.cli.outcome import verb


class Verbs(TyperGroup):
    """The verbs of this package, then those of studies, which are looked for only where needed."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names of all verbs."""
        from tribodyn.cli.study_verbs import study_verbs

        return [*super().list_commands(ctx), *(name for name, _ in study_verbs())]

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Find a verb by its name; None: there is none."""
        if command := super().get_command(ctx, cmd_name):
            return command
        from tribodyn.cli.study_verbs import command_of, study_verbs

        for name, offered in study_verbs():
            if cmd_name in (name, offered.alias):
                alone = typer.Typer(
                    rich_markup_mode=None, add_completion=False, pretty_exceptions_enable=False
                )
                alone.command(name, epilog=offered.examples)(verb(command_of(name, offered)))
                return get_command(alone)
        return None


app = typer.Typer(
    cls=Verbs,
    help="From tooth shape to transmission error, loads, film thickness and efficiency.",
    epilog="\b\nBegin with:\n"
    "  tribodyn list                what there is to run\n"
    "  tribodyn run crc-23-47       run a scenario: record, summary, picture\n"
    "  tribodyn init my-drive       write a scenario of your own to edit\n"
    "  tribodyn --install-completion    let the shell complete verbs, options and names\n"
    "\b\nExit status: 0 done; 1 a bug in tribodyn; 2 bad input; 3 the simulation\n"
    "failed, partial record kept, or its results cannot be written; 4 a validation\n"
    "outside its tolerance; 130 interrupted; 143 terminated.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
    # plain help: half the start-up time, and it pipes well
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)

for function, examples in (
    (run.run, run.EXAMPLES),
    (assess.assess, assess.EXAMPLES),
    (sweep.sweep, sweep.EXAMPLES),
    (scenario.check, scenario.CHECK_EXAMPLES),
    (gear.gear, gear.EXAMPLES),
    (records.show, records.SHOW_EXAMPLES),
    (records.plot, records.PLOT_EXAMPLES),
    (records.report, records.REPORT_EXAMPLES),
    (signals.listen, signals.LISTEN_EXAMPLES),
    (signals.signals, signals.SIGNALS_EXAMPLES),
    (compare.compare, compare.EXAMPLES),
    (handover.export, handover.EXPORT_EXAMPLES),
    (handover.import_, handover.IMPORT_EXAMPLES),
    (list_.list, list_.EXAMPLES),
    (scenario.init, scenario.INIT_EXAMPLES),
    (scenario.schema, scenario.SCHEMA_EXAMPLE),
    (validate.validate, validate.EXAMPLES),
    (page.app, page.EXAMPLES),
):
    app.command(function.__name__.rstrip("_"), epilog=examples)(verb(function))


def _print_version(wanted: bool) -> None:
    if wanted:
        from tribodyn import __version__

        sys.stdout.write(f"tribodyn {__version__}\n")
        raise typer.Exit


@app.callback()
def _options(
    _version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass
