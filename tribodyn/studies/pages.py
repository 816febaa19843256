"""Figures, summaries, comparisons and pages of records and of sweeps, as their studies make them."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal

from tribodyn.errors import InputError, SimulationError, near_name
from tribodyn.numerics.files.output_files import check_output, write_output
from tribodyn.record.reader import Record
from tribodyn.record.sensors import SENSORS
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import Loaded, load
from tribodyn.studies.protocol.study import Study

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Group

    from tribodyn.post.compare import Comparison
    from tribodyn.post.figures.drawing import Drawing, SweepDrawing
    from tribodyn.quantities.quantity import Quantity, Reported
    from tribodyn.studies.measured import Source
    from tribodyn.studies.protocol.study import TextTable

OVERVIEW = "overview"


def study_of_record(record: Record | SweepRecord) -> Study:
    """Return the study of a record, or of a sweep's cases; InputError if no installed package knows it."""
    sweep = isinstance(record, SweepRecord)
    kind, what = (record.kind_of_study, "sweep") if sweep else (record.kind, "study")
    if kind not in STUDIES:
        rule = f'a {what} of kind "{kind}", which nothing that is installed knows'
        raise InputError("record", str(record.path), rule, "install the package that offers it")
    return STUDIES[kind]


def names(records: Sequence[Record]) -> tuple[str, ...]:
    """Names of the figures that these records hold enough for, but the overview of the first."""
    return tuple(name for name in drawable(records) if name != OVERVIEW)


def drawable(records: Sequence[Record]) -> "Mapping[str, Drawing]":
    """Figures that these records hold enough for, by name."""
    by_name = drawings(records)
    return {name: drawing for name, drawing in by_name.items() if all(map(drawing.fits, records))}


def drawings(records: Sequence[Record]) -> "Mapping[str, Drawing]":
    """Figures that the studies of all records have; InputError where they share no quantities."""
    first, *others = [study.drawings() for study in _studies_of(records, "draw them apart")]
    return {name: drawing for name, drawing in first.items() if all(name in other for other in others)}


def _studies_of(
    records: Sequence[Record], remedy: str, rule: str = "of kind {}, the first of {}"
) -> list[Study]:
    """Studies of records, one each; InputError where they share no quantities."""
    studies = [study_of_record(record) for record in records]
    for record, study in zip(records, studies, strict=True):
        if study.quantities != studies[0].quantities:
            raise record.refused(rule.format(record.kind, records[0].kind), remedy)
    return studies


def compare(records: Sequence[Record]) -> "Comparison":
    """Set complete records side by side; see `tribodyn.post.compare`. InputError where they cannot be."""
    from tribodyn.post import compare as comparing

    rule = 'kind "{}" and kind "{}" share no quantities to compare'
    studies = _studies_of(records, "compare records of one kind", rule)
    for record, study in zip(records, studies, strict=True):
        if not study.compared:
            rule = f"{study.about}: it has no means over a run to compare"
            raise InputError("record", str(record.path), rule, "draw them into one figure")
    headings: dict[str, dict[str, Quantity]] = {}  # in the order of the first study that has them
    for study in studies:
        for heading in study.compared:
            some = headings.setdefault(heading, {})
            for quantity in study.reported().get(heading, ()):
                some.setdefault(quantity.name, quantity)
    reported: Reported = {heading: tuple(some.values()) for heading, some in headings.items()}
    return comparing.compare(records, reported)


def figure(
    name: str,
    records: Sequence[Record],
    *,
    cycles: int | Literal["auto"] | None = "auto",
    against: str | None = None,
) -> "Figure":
    """Draw one figure, of `names(records)` or "overview", from an open record, or from several, compared.

    `cycles` are the last whole mesh cycles to show, None for the whole run; by default two, in a train of its
    slowest mesh, and the whole run where speed or load change in it. `against` is "phase" (mesh cycles) or
    "time" (ms), by default phase, and time where speed or load change. Raises InputError for an unknown name
    or abscissa, no record, or a record without samples.
    """
    from tribodyn.post.cycles import abscissa_of, shown_cycles, transient
    from tribodyn.post.figures.drawing import with_whole_markers
    from tribodyn.post.figures.panel import View
    from tribodyn.post.style import house_style

    if not records:
        raise InputError("records", None, "there is nothing to draw", "name at least one record")
    if against not in ("phase", "time", None):
        raise InputError("against", against, "no such abscissa", "phase or time")
    if isinstance(cycles, int) and cycles < 1:
        raise InputError("cycles", cycles, "at least one mesh cycle is drawn", "1 or more")
    by_name = drawings(records)
    if name not in by_name:
        raise _unknown(name, "no such figure", drawable(records))
    whole = cycles == "auto" and any(transient(record) for record in records)
    shown = None if whole else max(map(shown_cycles, records))
    number = shown if cycles == "auto" else cycles
    with house_style():
        over = abscissa_of(records, against, whole)
        return with_whole_markers(by_name[name].draw(records, View(number, over, against is not None)))


def overview(record: Record) -> "Figure":
    """Draw the figure that sums up a record."""
    return figure(OVERVIEW, [record])


def summary_table(record: Record, full: bool = False) -> "Group":
    """Lay out the summary of a record for the terminal; the `full` one says how far to trust it in detail."""
    from tribodyn.post import report

    study = study_of_record(record)
    details = study.sentences(record) if full else None
    return report.summary_table(
        record, study.reported(), study.verdict(record), details, study.besides("tables", record) or ()
    )


def summary_json(record: Record) -> "dict[str, Any]":
    """The same for programs, SI units, as `cli.printing.plain` turns it into JSON."""
    from tribodyn.post import report

    return report.as_json(record, study_of_record(record).verdict(record))


def sweep_names(records: Sequence[SweepRecord]) -> tuple[str, ...]:
    """Names of the figures that can be drawn from sweeps."""
    return tuple(drawable_of_sweep(records))


def drawable_of_sweep(records: Sequence[SweepRecord]) -> "Mapping[str, SweepDrawing]":
    """Figures that can be drawn from sweeps, by name."""
    study = study_of_record(records[0])
    for record in records[1:]:
        if study_of_record(record) is not study:
            rule = f"of kind {record.kind_of_study}, the first of {study.kind}"
            raise record.refused(rule, "draw them apart")
    if any(record.listed for record in records):
        from tribodyn.post.figures.sweep_response import DATA_SET_DRAWINGS

        return DATA_SET_DRAWINGS
    return study.sweep_drawings()


def sweep_figure(
    name: str, records: Sequence[SweepRecord], at: Mapping[str, float | str] | None = None
) -> "Figure":
    """Draw one figure of sweeps, of `sweep_names(records)` or "overview", which is the first of them.

    Several are compared where the figure has curves; some figures show the first. `at` has values of
    parameters by name, SI, for a figure of one case. Raises InputError for an unknown name, or a sweep that
    the figure cannot show.
    """
    from tribodyn.post.figures.drawing import with_whole_markers
    from tribodyn.post.style import house_style

    by_name = drawable_of_sweep(records)
    name = next(iter(by_name)) if name == OVERVIEW else name
    if name not in by_name:
        raise _unknown(name, "no such figure of a sweep", by_name)
    with house_style():
        return with_whole_markers(by_name[name].draw(records, at or {}))


def _unknown(name: str, rule: str, names: Mapping[str, object]) -> InputError:
    near = near_name(name, names)
    hint = f"did you mean {near}? " if near else ""
    return InputError("plot", name, rule, f"{hint}there is: {', '.join(names)}")


def sweep_table(record: SweepRecord) -> "Group":
    """Lay out the summary of a sweep for the terminal."""
    from tribodyn.post.sweep_report import sweep_table as table_of

    return table_of(record, study_of_record(record).sweep_table())


def report(
    records: Sequence[Record], figures: bool = True, measured: "Source | None" = None, align: str = "given"
) -> str:
    """Write the page of one record, or of several side by side: one HTML file that needs no other.

    Without `figures` there are only the teeth in mesh on it, and what moves them. `measured`, `align`: see
    `measured.measured_figure`. Raises InputError for no record, one without samples, and records that share
    no quantities.
    """
    from tribodyn.post.page.page import PageContent, page
    from tribodyn.post.page.sensors import SensedSection, sensed_section
    from tribodyn.studies.handed_over import bodies_in_space

    if not records:
        raise InputError("records", None, "there is nothing to report on", "name at least one record")
    studies = _studies_of(records, "make a page of its own")
    own_page = studies[0].own_page() if figures and len(records) == 1 else None
    if own_page:
        if measured is not None:
            rule = f"{studies[0].about}: its page has no curves over a run"
            raise InputError("measured", None, rule, "omit it")
        return own_page(records[0])
    contents = [
        PageContent(
            study.reported(),
            study.sentences(record),
            study.panels(),
            study.besides("maps", record) or (),
            sheet(record) if figures else (),
            study.besides("profiles", record),
            verdict=study.verdict(record),
            mechanism=study.besides("mechanism", record) if record.samples else None,
            solid=study.besides("solid", record) if record.samples and figures else None,
            parts=study.besides("tables", record) or (),
            sensed=sensed_section(record) if figures else SensedSection(),
            pictures=_pictures_of_sensors(record) if figures and len(records) == 1 else (),
            bodies=bodies_in_space(record) if figures else b"",
        )
        for study, record in zip(studies, records, strict=True)
    ]
    if measured is not None:
        from tribodyn.studies.measured import measured_figure

        overlay = "measured", "the simulation beside it", measured_figure(records, measured, align)
        contents[0] = contents[0]._replace(pictures=[overlay, *contents[0].pictures])
    return page(records, contents, figures)


def _pictures_of_sensors(record: Record) -> "list[tuple[str, str, Figure]]":
    """Pictures of what a record's sensors gave: name, what it shows, figure."""
    if SENSORS not in record.groups:
        return []
    from tribodyn.post.figures.sensor_averages import DRAWINGS

    by_name = drawable([record])
    return [(name, by_name[name].about, figure(name, [record])) for name in DRAWINGS if name in by_name]


def sheet(record: Record | SweepRecord) -> "Sequence[TextTable]":
    """What `check` says of the scenario of a record; nothing where this version cannot make its case."""
    try:
        loaded = loaded_again(record)
        return loaded.study.check(loaded.case, allow_large=True).every
    except (InputError, SimulationError):
        return ()


def loaded_again(record: Record | SweepRecord) -> Loaded:
    """Load the scenario of a record; InputError, which names the record, where this version cannot."""
    with TemporaryDirectory(prefix="tribodyn-") as folder:
        scenario = Path(folder) / "scenario.toml"
        write_output(scenario, str(record.attrs.get("scenario", "")))
        try:
            return load(scenario)
        except InputError as error:  # the file that it names is gone with this block
            raise error.moved(lambda _: str(record.path)) from None


def sweep_report(record: SweepRecord) -> str:
    """Write the page of a sweep: its quantities over the first varied key, its teeth, its pictures."""
    from tribodyn.post.figures.sweep_response import more_than_curves
    from tribodyn.post.page.sweep_page import sweep_page
    from tribodyn.studies.handed_over import bodies_in_space

    if record.listed:
        raise record.refused("a data set has no page", "draw its signals: tribodyn plot FILE signals")
    study, pictures = study_of_record(record), []
    for name, drawing in study.sweep_drawings().items():
        if not drawing.curves or more_than_curves(record):
            with suppress(InputError):  # of a sweep that lacks what the picture shows
                pictures.append((name, drawing.about, sweep_figure(name, [record])))
    varied = sheet(record), _teeth(record), bodies_in_space(record)
    return sweep_page(record, study.sweep_table(), pictures, *varied)


def _teeth(record: SweepRecord) -> "dict[str, Any] | None":
    """Teeth of the scenario that is varied, for a page; None where it has no pair of gears."""
    from tribodyn.geometry.body import geometry_arrays
    from tribodyn.geometry.families import family
    from tribodyn.geometry.limits.checks import check
    from tribodyn.post.page.motion import turning_teeth

    if not study_of_record(record).has_gears:
        return None
    try:
        case = loaded_again(record).case.pair
        assembly = check(family(case.family), case.drive)
    except InputError:
        return None
    return turning_teeth(geometry_arrays(assembly), float(assembly.drive.pinion.teeth))


def write_report(
    records: Sequence[Record | SweepRecord],
    path: str | Path,
    *,
    force: bool = False,
    measured: "Source | None" = None,
    align: str = "given",
) -> Path:
    """Write the page into a file; raises as `report` and `write_output`. Of sweeps one alone."""
    check_page(path, force)
    sweeps = [record for record in records if isinstance(record, SweepRecord)]
    if sweeps and measured is not None:
        rule = "lies beside a run, and this is a sweep"
        raise InputError("measured", None, rule, "name the record of a run")
    if len(sweeps) == 1 == len(records):
        text = sweep_report(sweeps[0])
    elif sweeps:
        raise sweeps[0].refused("a sweep has a page of its own", "make a page of each")
    else:
        runs = [record for record in records if isinstance(record, Record)]
        text = report(runs, measured=measured, align=align)
    return write_output(path, text, force=force)


def check_page(path: str | Path, force: bool = False) -> None:
    """Raise InputError where a page may not be written, see `check_output`; touches nothing."""
    if Path(path).suffix.lower() not in (".html", ".htm"):
        raise InputError("output", str(path), "a page is a file that ends in .html", "name it so")
    check_output(path, force)
