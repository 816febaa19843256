"""`tribodyn export` and `tribodyn import`: files of other programs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.options import (
    JsonOption,
    ReplaceOption,
    SetOption,
    overrides,
    read_formats,
    scenarios_and_records,
    written_formats,
)

if TYPE_CHECKING:
    from tribodyn.exchange.format import ExchangeFormat

EXPORT_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn export\n"
    "  tribodyn export map.h5 --to csv -o reducer.csv\n"
    "  tribodyn export map.h5 --to csv -o reducer --force --json\n"
    "\b\nWithout a file the formats are listed. With a map --set takes what the format lets choose,\n"
    "with a scenario its keys. Printed is how far what was written is from the map."
)
IMPORT_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn import\n"
    "  tribodyn import gearbox.rexs -o gearbox.toml\n"
    "\b\nWithout a file the formats are listed. What was not used, and what is missing, is printed."
)


def export(
    file: Annotated[
        str | None,
        typer.Argument(
            metavar="[FILE]", help="A record, or a scenario.", autocompletion=scenarios_and_records
        ),
    ] = None,
    *,
    to: Annotated[
        str | None,
        typer.Option("--to", metavar="FORMAT", help="Format.", autocompletion=written_formats),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The file; default: named after FILE.")
    ] = None,
    settings: SetOption = None,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Write a map of losses, a record or a scenario for another program."""
    from tribodyn.cli.printing import print_files, print_json, print_prose
    from tribodyn.errors import InputError
    from tribodyn.studies import handed_over

    if file is None:
        _list(handed_over.writers(), json)
        return
    if to is None:
        rule = f"one of {', '.join(handed_over.writers())}"
        raise InputError("--to", None, "the format is missing", rule)
    done = handed_over.export(file, to, output, overrides(settings), force=force)
    if json:
        print_json(done.as_dict())
        return
    for line in (*map(str, done.deviations), *done.remarks):
        print_prose(line)
    print_files("file", done.files)


def import_(
    file: Annotated[Path | None, typer.Argument(metavar="[FILE]", help="A file of another program.")] = None,
    *,
    from_: Annotated[
        str | None,
        typer.Option(
            "--from", metavar="FORMAT", help="Format; default: by the ending.", autocompletion=read_formats
        ),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The scenario; default: named after FILE.")
    ] = None,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Make a scenario of a file of another program."""
    from tribodyn.cli.printing import print_files, print_json, print_prose
    from tribodyn.errors import InputError
    from tribodyn.numerics.files.output_files import check_output, write_output
    from tribodyn.studies import handed_over

    if file is None:
        _list(handed_over.readers(), json)
        return
    target = output or Path(f"{file.stem}.toml")
    if target.suffix != ".toml":
        raise InputError("--output", str(target), "a scenario ends in .toml", f'write "{target.stem}.toml"')
    check_output(target, force)
    imported = handed_over.read_scenario(file, from_)
    write_output(target, imported.toml, force=force)
    if json:
        print_json({"files": [str(target)], "remarks": list(imported.remarks), **imported.details})
        return
    for line in imported.remarks:
        print_prose(line)
    print_files("scenario", [target])


def _list(formats: "dict[str, ExchangeFormat]", json: bool) -> None:
    """Print the formats."""
    from tribodyn.cli.printing import print_json, print_table

    if json:
        print_json(
            {
                name: {
                    "about": each.about,
                    "endings": each.endings,
                    "takes": each.takes,
                    "choices": {key: choice.about for key, choice in each.choices.items()},
                }
                for name, each in formats.items()
            }
        )
        return
    rows = [
        (name, " ".join(each.endings), ", ".join(each.takes), each.about, ", ".join(each.choices))
        for name, each in formats.items()
    ]
    print_table("Formats", ("name", "files", "of", "what it is", "choices"), rows)
