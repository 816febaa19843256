"""`tribodyn validate`: our numbers beside the published ones."""

from typing import Annotated, Any

import typer

EXAMPLES = (
    "\b\nExit status 4 if a value is outside its tolerance. Examples:\n"
    "  tribodyn validate liu-ni-2022\n"
    "  tribodyn validate liu-ni-2022 --json"
)


def validate(
    paper: Annotated[str, typer.Argument(help="The paper, such as liu-ni-2022.")],
    json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Compare with what a paper published."""
    from tribodyn.cli.outcome import OUTSIDE_TOLERANCE, complain
    from tribodyn.cli.printing import print_json, print_table
    from tribodyn.cli.progress import progress_bar
    from tribodyn.validation import validate as compare

    with progress_bar(f"validate {paper}") as progress:
        rows = compare(paper, progress)
    if json:
        print_json({"rows": [_as_json(row) for row in rows]})
    else:
        columns = ("quantity", "unit", "published", "computed", "difference", "tolerance", "verdict", "note")
        print_table(paper, columns, [[_written(getattr(row, name)) for name in columns] for row in rows])
    failed = [row.id for row in rows if row.verdict == "fail"]
    if failed:
        complain(f"{paper}: outside tolerance: {', '.join(failed)}")
        raise typer.Exit(OUTSIDE_TOLERANCE)


def _as_json(row: Any) -> dict[str, Any]:
    names = (
        "id",
        "quantity",
        "unit",
        "published",
        "computed",
        "difference",
        "tolerance",
        "verdict",
        "note",
    )
    return {name: getattr(row, name) for name in names}


def _written(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.5g}" if isinstance(value, float) else str(value)
