"""`tribodyn judge`: every film and friction law beside the solved contact."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli import completion
from tribodyn.cli.options import JsonOption, ReplaceOption, SetOption, overrides
from tribodyn.errors import InputError

if TYPE_CHECKING:
    from tribodyn.studies.ehl.judged import Judgement

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn judge crc-23-47\n"
    "  tribodyn judge my-drive.toml --map -o judged.png\n"
    '  tribodyn judge involute-23-47 --set operating.gear_torque="100 N*m"'
)
#: Of files that keep the result.
ENDINGS = (".json", ".png", ".svg", ".pdf")


def judge(
    scenario: Annotated[
        str,
        typer.Argument(
            help="A scenario with a drive, a lubricant and a duty: a file, or a shipped one.",
            autocompletion=completion.scenarios,
        ),
    ],
    settings: SetOption = None,
    positions: Annotated[
        int, typer.Option("--positions", min=4, max=2000, help="Positions of the pair along its way.")
    ] = 24,
    over_map: Annotated[
        bool, typer.Option("--map", help="Also over 1/4 to 2 times the load and the speed.")
    ] = False,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Keep it in this file: .json, or a picture: .png, .svg, .pdf."),
    ] = None,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Compare every film and friction law with the solved contact."""
    from tribodyn.cli.printing import print_json, print_prose, print_table, quoted_path
    from tribodyn.cli.progress import progress_bar
    from tribodyn.studies.ehl.judged import FACTORS, judgement
    from tribodyn.studies.protocol.load import load

    _check(output, force)
    loaded = load(scenario, overrides(settings))
    factors = FACTORS if over_map else ()
    with progress_bar("judge") as progress, loaded.naming():
        judged = judgement(loaded.case, positions, factors, progress)
    found = judged.laws
    if output is not None:
        _keep(judged, output, force)
    if json:
        print_json(judged.as_dict() | ({"files": [str(output)]} if output is not None else {}))
        return
    columns = ("", "law", "compared with", "minimum", "median", "maximum", "inside its range", "judged range")
    rows = [
        [
            *(one.what, one.law, one.against),
            *(f"{value:.3f}" for value in one[2:5]),
            *(_share(one.in_range), _share(one.in_judged_range, "none")),
        ]
        for one in found
    ]
    print_table("Law over solved contact, along the way of a pair", columns, rows)
    ranges = [[one.what, one.law, one.range or "none stated"] for one in found]
    print_table("Ranges of the laws", ("", "law", "range"), ranges)
    if over_map:
        head = ("", "law", "load", *(f"speed × {factor:g}" for factor in factors))
        lines = [
            [one.what, one.law, f"× {factor:g}", *(f"{value:.3f}" for value in row)]
            for one in found
            for factor, row in zip(factors, one.map, strict=True)
        ]
        print_table("Median over load and speed", head, lines)
    print_prose(judged.said)
    if output is not None:
        typer.echo(f"kept     {quoted_path(output)}")


def _check(output: Path | None, force: bool) -> None:
    """Raise InputError at a file that could not be written in the end."""
    from tribodyn.numerics.output_files import check_output

    if output is None:
        return
    if output.suffix not in ENDINGS:
        rule = f"ends with none of {', '.join(ENDINGS)}"
        raise InputError("--output", str(output), rule, f'write "{output.with_suffix(".json")}"')
    if not output.absolute().parent.is_dir():
        raise InputError("--output", str(output), "its folder is not there", "make it, or choose another")
    check_output(output, force)


def _keep(judged: "Judgement", output: Path, force: bool) -> None:
    if output.suffix == ".json":
        from tribodyn.cli.printing import write_json

        write_json(output, judged.as_dict(), force)
        return
    from tribodyn.post.style import save
    from tribodyn.studies.ehl.judged_picture import picture

    save(picture(judged), output, force=force)


def _share(value: float, without: str = "not stated") -> str:
    return without if math.isnan(value) else f"{100 * value:.0f} %"
