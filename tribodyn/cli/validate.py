"""`tribodyn validate`: our numbers beside the published ones."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.output import make_folder

if TYPE_CHECKING:
    from tribodyn.validation.rows import Row

EXAMPLES = (
    "\b\nExit status 4 if a value is outside its tolerance. Examples:\n"
    "  tribodyn validate liu-ni-2022\n"
    "  tribodyn validate liu-ni-2022 --json -o records"
)


def validate(
    paper: Annotated[str, typer.Argument(help="The paper, such as liu-ni-2022.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Folder to keep the records in.")
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Compare with what a paper published."""
    from tribodyn.cli.outcome import OUTSIDE_TOLERANCE, complain
    from tribodyn.cli.printing import print_json, print_table
    from tribodyn.cli.progress import progress_bar
    from tribodyn.validation import validate as compare

    if output is not None:
        make_folder(output)
    with progress_bar(f"validate {paper}") as progress:
        rows = compare(paper, progress, output)
    if json:
        print_json({"rows": [row._asdict() for row in rows]})
    else:
        columns = ("quantity", "unit", "published", "computed", "difference", "tolerance", "verdict", "note")
        print_table(paper, columns, [[_written(row, name) for name in columns] for row in rows])
    failed = [row.id for row in rows if row.verdict == "fail"]
    if failed:
        complain(f"{paper}: outside tolerance: {', '.join(failed)}")
        raise typer.Exit(OUTSIDE_TOLERANCE)


def _written(row: "Row", name: str) -> str:
    value = getattr(row, name)
    if value is None:
        return ""
    if isinstance(value, list):
        return " ".join(
            f"{one:.2g}" if name in ("difference", "tolerance") else f"{one:.5g}" for one in value
        )
    if isinstance(value, bool):
        return str(value).lower()
    if name in ("difference", "tolerance") and row.tolerance_kind == "relative":
        return f"{100 * value:.3g} %"
    return f"{value:.5g}" if isinstance(value, float) else str(value)
