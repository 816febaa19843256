"""`tribodyn report`: a page of records, to be opened in a browser."""

from pathlib import Path
from typing import Annotated

import typer

from tribodyn.cli.options import Align, AlignOption, MeasuredOption, ReplaceOption

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn report crc-23-47.h5\n"
    "  tribodyn report crc-23-47.h5 involute-23-47.h5 -o both.html\n"
    "\b\nThe page is one file, which needs no other and no network: summary, figures that can be\n"
    "zoomed, the teeth rolling through mesh, the scenario."
)


def report(
    records: Annotated[
        list[str],
        typer.Argument(metavar="RECORD...", help="Records of tribodyn run, or one of tribodyn sweep."),
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The page; default: the records' names, in this folder."),
    ] = None,
    measured: MeasuredOption = None,
    align: AlignOption = Align.given,
    force: ReplaceOption = False,
    pdf: Annotated[bool, typer.Option("--pdf", help="Also print it, through an installed browser.")] = False,
    json: Annotated[bool, typer.Option("--json", help="Print the path as JSON.")] = False,
) -> None:
    """Write a page of records for the browser; several side by side."""
    from contextlib import ExitStack

    from tribodyn.cli.printing import print_files, print_json
    from tribodyn.numerics.files.output_files import check_output
    from tribodyn.post.page.pdf import print_page, require_browser
    from tribodyn.record.sweep_reader import open_any
    from tribodyn.studies.pages import write_report

    target = output or Path(f"{'-'.join(Path(path).stem for path in records)}.html")
    if pdf:
        require_browser()
        check_output(target.with_suffix(".pdf"), force)
    with ExitStack() as stack:
        opened = [stack.enter_context(open_any(Path(path))) for path in records]
        written = write_report(opened, target, force=force, measured=measured, align=align.value)
    files = {"report": written}
    if pdf:
        files["pdf"] = print_page(written, force=force)
    if json:
        print_json({what: str(path) for what, path in files.items()})
    else:
        for what, path in files.items():
            print_files(what, [path])
