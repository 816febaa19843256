"""`tribodyn judge`: every film and friction law beside the solved contact."""

import math
from typing import Annotated

import typer

from tribodyn.cli import completion
from tribodyn.cli.options import JsonOption, SetOption, overrides

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn judge crc-23-47\n"
    "  tribodyn judge my-drive.toml --map --json\n"
    '  tribodyn judge involute-23-47 --set operating.gear_torque="100 N*m"'
)
#: Factors on load and speed of the map.
FACTORS = (0.25, 0.5, 1.0, 2.0)


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
    json: JsonOption = False,
) -> None:
    """Compare every film and friction law with the solved contact."""
    from tribodyn.cli.printing import print_json, print_prose, print_table
    from tribodyn.cli.progress import progress_bar
    from tribodyn.studies.ehl.judged import case_for, judged, sentence

    case = case_for(scenario, overrides(settings), positions)
    factors = FACTORS if over_map else ()
    with progress_bar("judge") as progress:
        found = judged(case, factors, factors, progress)
    said = sentence(found)
    if json:
        print_json(
            {
                "title": case.title,
                "positions": positions,
                "load_factors": list(factors),
                "speed_factors": list(factors),
                "laws": [one._asdict() for one in found],
                "said": said,
            }
        )
        return
    columns = ("", "law", "minimum", "median", "maximum", "inside its range")
    rows = [
        [one.what, one.law, *(f"{value:.3f}" for value in one[2:5]), _share(one.in_range)] for one in found
    ]
    print_table("Law over solved contact, along the way of a pair", columns, rows)
    if over_map:
        head = ("", "law", "load", *(f"speed × {factor:g}" for factor in factors))
        lines = [
            [one.what, one.law, f"× {factor:g}", *(f"{value:.3f}" for value in row)]
            for one in found
            for factor, row in zip(factors, one.map, strict=True)
        ]
        print_table("Median over load and speed", head, lines)
    print_prose(said)


def _share(value: float) -> str:
    return "not stated" if math.isnan(value) else f"{100 * value:.0f} %"
