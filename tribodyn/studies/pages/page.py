"""Pages of records and of sweeps, as their studies describe them."""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.output_files import check_output, write_output
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies.pages.pictures import study_of_record, study_of_sweep, sweep_figure, sweep_names
from tribodyn.studies.protocol.load import load

if TYPE_CHECKING:
    from tribodyn.studies.protocol.study import TextTable


def report(records: Sequence[Record], figures: bool = True) -> str:
    """Write the page of one record, or of several side by side: one HTML file that needs no other.

    Parameters
    ----------
    figures : whether there is more on it than the teeth in mesh and what moves them

    Raises
    ------
    InputError
        For no record, one without samples, and records that share no quantities.
    """
    from tribodyn.post.page.page import PageContent, page

    if not records:
        raise InputError("records", None, "there is nothing to report on", "name at least one record")
    studies = [study_of_record(record) for record in records]
    for record, study in zip(records, studies, strict=True):
        if study.quantities != studies[0].quantities:
            rule = f"of kind {record.kind}, the first of {records[0].kind}"
            raise InputError("record", str(record.path), rule, "make a page of its own")
    own = studies[0].own_page()
    if own and figures and len(records) == 1:
        return own(records[0])
    contents = [
        PageContent(
            one.reported(),
            one.sentences(record),
            one.panels(),
            one.maps(record),
            sheet(record) if figures else (),
            one.profiles(record),
        )
        for one, record in zip(studies, records, strict=True)
    ]
    return page(records, contents, figures)


def sheet(record: Record | SweepRecord) -> "Sequence[TextTable]":
    """What `check` says of the scenario of a record; nothing where this version cannot make its case."""
    with TemporaryDirectory(prefix="tribodyn-") as folder:
        scenario = Path(folder) / "scenario.toml"
        write_output(scenario, str(record.attrs.get("scenario", "")))
        try:
            loaded = load(scenario)
            return loaded.study.check(loaded.case, allow_large=True).tables
        except (InputError, SimulationError):
            return ()


def sweep_report(record: SweepRecord) -> str:
    """Write the page of a sweep: its figures over the first varied key, and its pictures."""
    from tribodyn.post.page.sweep_page import sweep_page

    study = study_of_sweep(record)
    pictures = []
    for name in sweep_names([record]):
        try:
            pictures.append((name, study.sweep_drawings()[name].about, sweep_figure(name, [record])))
        except InputError:  # of a sweep that lacks what the picture shows
            continue
    return sweep_page(record, study.sweep_table(), pictures, sheet(record))


def write_report(records: Sequence[Record | SweepRecord], path: str | Path, *, force: bool = False) -> Path:
    """Write the page into a file; raises as `report` and `write_output`. Of sweeps one alone."""
    check_page(path, force)
    sweeps = [record for record in records if isinstance(record, SweepRecord)]
    if len(sweeps) == 1 == len(records):
        text = sweep_report(sweeps[0])
    elif sweeps:
        rule = "a sweep has a page of its own"
        raise InputError("record", str(sweeps[0].path), rule, "make a page of each")
    else:
        text = report([record for record in records if isinstance(record, Record)])
    return write_output(path, text, force=force)


def check_page(path: str | Path, force: bool = False) -> None:
    """Raise InputError where a page may not be written, see `check_output`; touches nothing."""
    if Path(path).suffix.lower() not in (".html", ".htm"):
        raise InputError("output", str(path), "a page is a file that ends in .html", "name it so")
    check_output(path, force)
