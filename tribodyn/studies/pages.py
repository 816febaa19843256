"""Pages of records, as their studies describe them."""

from collections.abc import Sequence
from pathlib import Path

from tribodyn.errors import InputError, OutputError
from tribodyn.record.reader import Record
from tribodyn.studies.pictures import study_of_record

#: What every page has near its beginning; a file without it is not replaced.
MADE_HERE = '<meta name="generator" content="tribodyn">'


def report(records: Sequence[Record], figures: bool = True) -> str:
    """Write the page of one record, or of several side by side: one HTML file that needs no other.

    Parameters
    ----------
    records : sequence of Record
    figures : bool
        Whether there is more on it than the teeth in mesh and what moves them.

    Raises
    ------
    InputError
        For no record, one without samples, and records that share no quantities.
    """
    from tribodyn.post.page.page import Told, page

    if not records:
        raise InputError("records", None, "there is nothing to report on", "name at least one record")
    studies = [study_of_record(record) for record in records]
    for record, study in zip(records, studies, strict=True):
        if study.quantities != studies[0].quantities:
            rule = f"of kind {record.kind}, the first of {records[0].kind}"
            raise InputError("record", str(record.path), rule, "make a page of its own")
    told = [
        Told(one.lines(), one.sentences(record), one.panels())
        for one, record in zip(studies, records, strict=True)
    ]
    return page(records, told, figures)


def write_report(records: Sequence[Record], path: str | Path) -> Path:
    """Write the page into a file; raises as `report`, and OutputError where it cannot be written."""
    text = report(records)
    target = Path(path)
    if target.suffix.lower() not in (".html", ".htm"):
        raise InputError("output", str(target), "a page is a file that ends in .html", "name it so")
    try:
        if target.exists() and MADE_HERE not in target.read_text(encoding="utf-8", errors="replace")[:1000]:
            rule = "the file exists and is no page of tribodyn"
            raise InputError("output", str(target), rule, "choose another name")
        target.write_text(text, encoding="utf-8")
    except OSError as error:
        raise OutputError(str(target), error.strerror or str(error)) from None
    return target
