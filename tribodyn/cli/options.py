"""Arguments and options that several commands take alike."""

from typing import Annotated

import typer

from tribodyn.cli import completion
from tribodyn.errors import InputError, quoted

ScenarioArgument = Annotated[
    str,
    typer.Argument(
        help="A scenario file, or the name of a shipped scenario.", autocompletion=completion.scenarios
    ),
]

SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help='Set a key of the scenario, also inside what it refers to: operating.gear_torque="600 N*m".',
        autocompletion=completion.keys,
    ),
]

LargeOption = Annotated[
    bool,
    typer.Option("--allow-large", help="Allow runs above the resource limits."),
]

ForceOption = Annotated[
    bool,
    typer.Option("--force", help="Replace a record of that name, and what stands in place of its pictures."),
]

ReplaceOption = Annotated[
    bool, typer.Option("--force", help="Replace also files that tribodyn did not make, and links.")
]

PlotOption = Annotated[
    bool | None,
    typer.Option("--plot/--no-plot", help="All pictures, or none; default: one overview picture."),
]

PageOption = Annotated[
    bool, typer.Option("--report", help="Also write a page for the browser, beside the record.")
]

JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON.")]

SummaryOption = Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")]

#: Characters of a key; above that it is none of a scenario's.
LONGEST_KEY = 200


def overrides(settings: list[str] | None) -> dict[str, str]:
    """Return key and value of each ``KEY=VALUE``; the last of a key wins."""
    parsed: dict[str, str] = {}
    for setting in settings or []:
        key, equals, value = setting.partition("=")
        key = key.strip()
        if not equals or len(key) > LONGEST_KEY or not all(key.split(".")):
            raise InputError(
                "--set", quoted(setting), "not KEY=VALUE", "write it like --set solver.cycles=40"
            )
        parsed[key] = value.strip()
    return parsed


def require_one_way(*, resume: bool, force: bool) -> None:
    """Refuse to continue a record and to replace it at once."""
    if resume and force:
        raise InputError("--resume", None, "contradicts --force", "give one of them")
