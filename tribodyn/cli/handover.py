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
    "  tribodyn import measured.gde\n"
    "  tribodyn import profile.csv pitch.csv --into drive.toml --gear pinion\n"
    "\b\nWithout a file the formats are listed. What was not used, and what is missing, is printed.\n"
    "A measured gear is evaluated by ISO 1328-1, and put into a scenario with --into and --gear."
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
    file: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[FILE]...", help="A file of another program; several of one measured gear."),
    ] = None,
    *,
    into: Annotated[
        str | None,
        typer.Option(
            "--into",
            help="Scenario that a measured gear goes into.",
            autocompletion=scenarios_and_records,
        ),
    ] = None,
    gear: Annotated[
        str, typer.Option("--gear", metavar="NAME", help="The gear of it that was measured.")
    ] = "",
    datum: Annotated[
        str,
        typer.Option("--datum", metavar="END", help="End of its face that is the datum face: start or end."),
    ] = "",
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
    """Make a scenario of a file of another program, or put a measured gear into one."""
    from tribodyn.cli.printing import print_files, print_json, print_prose
    from tribodyn.errors import InputError
    from tribodyn.numerics.files.output_files import check_output, write_output
    from tribodyn.studies import handed_over

    if not file:
        _list(handed_over.readers(), json)
        return
    if into is not None or handed_over.format_of(file[0], from_).measure is not None:
        done = handed_over.import_measured(file, into, gear, datum, output, from_, force=force)
        if json:
            print_json(done.as_dict())
            return
        for line in (*done.evaluation.lines(), *done.remarks):
            print_prose(line)
        print_files("file", done.files)
        return
    if len(file) > 1 or gear or datum:
        what = (
            "one file makes a scenario" if len(file) > 1 else "a gear is measured, not made into a scenario"
        )
        raise InputError("import", str(file[-1]), what, "add --into SCENARIO, or leave it out")
    (file_,) = file
    target = output or Path(f"{file_.stem}.toml")
    if target.suffix != ".toml":
        raise InputError("--output", str(target), "a scenario ends in .toml", f'write "{target.stem}.toml"')
    check_output(target, force)
    imported = handed_over.read_scenario(file_, from_)
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
