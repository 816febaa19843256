"""The figures that can be drawn from records, by name."""

from collections.abc import Sequence
from difflib import get_close_matches

from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.figures import orders
from tribodyn.post.figures import over_phase as panels
from tribodyn.post.figures.panel import View, draw, legend, record_title
from tribodyn.post.figures.path_of_contact import draw_path, path_figure
from tribodyn.post.figures.spectrum import spectrum_figure
from tribodyn.post.style import house_style, mark_panel, new_figure, save
from tribodyn.record.reader import Record
from tribodyn.record.schema import BACKLASH_OSCILLATOR, LOAD_CONTACT, ROLLING
from tribodyn.studies.backlash_oscillator import figures as backlash_oscillator
from tribodyn.studies.load_contact import figures as load_contact
from tribodyn.studies.rolling import figures as rolling

#: Names of the figures of gear pairs, in the order `tribodyn plot` draws them.
NAMES = (
    "transmission-error",
    "spectrum",
    "normal-load",
    "friction",
    "film",
    "entrainment",
    "pressure",
    "efficiency",
    "mesh-stiffness",
    "path-of-contact",
)


#: Those of runs whose speed changes.
RUN_UP_NAMES = (orders.NAME,)
#: Those of gears with rolling elements, of load contact studies and of the oscillator with backlash.
ROLLING_NAMES = rolling.NAMES
LOAD_CONTACT_NAMES = load_contact.NAMES
OSCILLATOR_NAMES = backlash_oscillator.NAMES

#: What draws the records of the other kinds.
_OTHERS = {ROLLING: rolling, LOAD_CONTACT: load_contact, BACKLASH_OSCILLATOR: backlash_oscillator}


def names(records: Sequence[Record]) -> tuple[str, ...]:
    """Names of the figures that can be drawn from these records."""
    other = _OTHERS.get(_kind(records))
    if other:
        return other.names(records)
    return (*NAMES, *RUN_UP_NAMES) if orders.worth_tracking(records[0]) else NAMES


def _kind(records: Sequence[Record]) -> str:
    """Kind that all records are of; different kinds cannot share a figure."""
    first, *others = records
    for record in others:
        if record.kind != first.kind:
            raise InputError(
                "record",
                str(record.path),
                f"of kind {record.kind}, the first of {first.kind}",
                "draw them apart",
            )
    return first.kind


def figure(name: str, records: Sequence[Record], *, cycles: int | None = 2, against: str = "phase") -> Figure:
    """Draw one figure from one record, or from several to compare them.

    Parameters
    ----------
    name : str
        One of `names(records)`, or `overview` (of the first record).
    records : sequence of Record
        Records, open; one colour each.
    cycles : int or None
        How many of the last whole mesh cycles to show, None for the whole run.
    against : str
        `phase` (mesh cycles) or `time` (ms).

    Raises
    ------
    InputError
        For an unknown name or abscissa, no record, or a record without samples.
    """
    if not records:
        raise InputError("records", None, "there is nothing to draw", "name at least one record")
    if against not in ("phase", "time"):
        raise InputError("against", against, "no such abscissa", "phase or time")
    if cycles is not None and cycles < 1:
        raise InputError("cycles", cycles, "at least one mesh cycle is drawn", "1 or more")
    view = View(cycles, against)
    other = _OTHERS.get(_kind(records))
    known = other.NAMES if other else (*NAMES, *RUN_UP_NAMES)
    if name not in ("overview", *known):
        near = get_close_matches(name, known, n=1)
        hint = f"did you mean {near[0]}? " if near else ""
        raise InputError("plot", name, "no such figure", f"{hint}There are: {', '.join(known)}")
    with house_style():
        if other:
            return other.figure(name, records, view)
        if name == "overview":
            return _overview(records[0], view)
        if name == "spectrum":
            return spectrum_figure(records, view)
        if name == orders.NAME:
            return orders.orders_figure(records, view)
        if name == "path-of-contact":
            return path_figure(records, view)
        return panels.over_phase(name, records, view)


def overview(record: Record) -> Figure:
    """Draw what a run found in six panels, over its last two mesh cycles."""
    return figure("overview", [record])


def _overview(record: Record, view: View) -> Figure:
    drawn = new_figure(11.0, 6.2)
    rows = drawn.subplots(2, 3)
    draw_path(rows[0, 0], record)
    quantities = (
        panels.TRANSMISSION_ERROR,
        panels.NORMAL_LOAD,
        panels.FRICTION_FORCE,
        panels.FILM_THICKNESS,
        panels.EFFICIENCY,
    )
    for axes, quantity in zip(rows.flat[1:], quantities, strict=True):
        draw(axes, [record], quantity, view)
    for letter, axes in zip("abcdef", rows.flat, strict=True):
        mark_panel(axes, letter)
    legend(drawn, rows[0, 2], [record])
    drawn.suptitle(record_title(record), x=0.01, ha="left", fontsize=11)
    return drawn


__all__ = [
    "LOAD_CONTACT_NAMES",
    "NAMES",
    "OSCILLATOR_NAMES",
    "ROLLING_NAMES",
    "RUN_UP_NAMES",
    "figure",
    "names",
    "overview",
    "save",
]
