"""The --set option: key=value, through references."""

from typing import Annotated

import typer

from tribodyn.cli import completion
from tribodyn.errors import InputError, quoted

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
    typer.Option("--allow-large", help="Also what takes very much memory, disk or time."),
]

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
