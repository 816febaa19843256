"""`tribodyn init`: a commented scenario to begin with."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn init my-drive\n"
    "  tribodyn run my-drive.toml\n"
    "  tribodyn init my-teeth --kind load-contact"
)


class Kind(StrEnum):
    """Kinds of scenario to begin with."""

    gear_pair = "gear-pair"
    load_contact = "load-contact"


def init(
    name: Annotated[str, typer.Argument(help="Name of the scenario; NAME.toml is written in this folder.")],
    kind: Annotated[Kind, typer.Option(help="Dynamics of a pair, or load contact.")] = Kind.gear_pair,
    force: Annotated[bool, typer.Option("--force", help="Replace a file of that name.")] = False,
) -> None:
    """Write a commented scenario to run and to edit."""
    from tribodyn.cli.printing import quoted_path
    from tribodyn.cli.templates import TEMPLATES
    from tribodyn.errors import InputError

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    if not path.parent.is_dir():
        raise InputError("name", f'"{path}"', "the folder does not exist", f"create {path.parent} first")
    try:
        with path.open("w" if force else "x", encoding="utf-8") as file:
            file.write(TEMPLATES[kind.value].replace("TITLE", path.stem.replace('"', "'")))
    except FileExistsError:
        raise InputError("name", f'"{path}"', "the file exists", "choose another name, or --force") from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(
            "name", f'"{path}"', f"cannot be written: {reason}", "choose another place"
        ) from None
    typer.echo(f"{path}\nrun it with: tribodyn run {quoted_path(path)}")
