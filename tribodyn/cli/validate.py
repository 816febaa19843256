"""`tribodyn validate`: our numbers compared with the published ones."""

from pathlib import Path
from typing import Annotated

import typer

from tribodyn.cli.options import JsonOption, ReplaceOption, papers
from tribodyn.numerics.files.output_files import check_output, make_folder

EXAMPLES = (
    "\b\nExit status 4 if a value is outside its tolerance or a claim no longer holds. Examples:\n"
    "  tribodyn validate liu-ni-2022\n"
    "  tribodyn validate liu-ni-2022 --json -o records\n"
    "  tribodyn validate diez-ibarbia --plots pictures\n"
    "  tribodyn validate stplus-fzg-c"
)


def validate(
    paper: Annotated[str, typer.Argument(help="The paper: tribodyn list papers.", autocompletion=papers)],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Folder to keep the records in.")
    ] = None,
    plots: Annotated[
        Path | None, typer.Option("--plots", help="Folder for figures like the paper's, from our numbers.")
    ] = None,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Compare with what a paper published."""
    from contextlib import ExitStack
    from tempfile import TemporaryDirectory

    from tribodyn import validation
    from tribodyn.cli.outcome import OUTSIDE_TOLERANCE, end
    from tribodyn.cli.printing import print_files, print_json, print_prose, print_table
    from tribodyn.post.progress import progress_bar
    from tribodyn.validation.rows import SHOWN, counted, counts

    if plots is not None:
        for name in validation.figures_of(paper):
            check_output(validation.picture_path(paper, name, plots), force)
    for folder in (output, plots):
        if folder is not None:
            make_folder(folder)
    pictures: list[Path] = []
    with ExitStack() as stack:
        records = output
        if plots is not None and records is None:
            records = Path(stack.enter_context(TemporaryDirectory(prefix="tribodyn-")))
        with progress_bar(f"validate {paper}") as progress:
            rows = validation.validate(paper, progress, records)
        if plots is not None and records is not None:
            with progress_bar("drawing") as progress:
                pictures = validation.draw(paper, plots, records, progress, force=force)
    source = validation.PAPERS[paper].source
    if json:
        plotted = {"pictures": [str(picture) for picture in pictures]} if plots is not None else {}
        head = {"choices": validation.PAPERS[paper].choices, "counts": counts(rows)}
        head |= {"source": source._asdict()} if source else {}
        print_json({**head, "rows": [row.plain() for row in rows], **plotted})
    else:
        title = f"{paper}: {validation.PAPERS[paper].choices}"
        print_table(title, SHOWN, [[row.written(name) for name in SHOWN] for row in rows])
        print_prose(counted(rows))
        if source:
            print_prose(source.said())
        print_files("picture", pictures)
    failed = [row.id for row in rows if row.verdict == "fail"]
    if failed:
        end(OUTSIDE_TOLERANCE, f"{paper}: outside tolerance: {', '.join(failed)}")
