"""What results are in a notebook: summaries, xarray datasets, tables and small pictures as HTML."""

from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.errors import InputError, names_with, quoted
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies.protocol.study import Study, TextTable

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from xarray import Dataset

    from tribodyn.post.figures.gears_in_mesh import GearsInMesh


class Summary(dict[str, Any]):
    """Quantities by name; a name that is not there is answered with those that are near."""

    def __missing__(self, name: object) -> Any:
        near = [*names_with(str(name), self), *get_close_matches(str(name), self)]
        hint = (
            f"did you mean {', '.join(list(dict.fromkeys(near))[:5])}?"
            if near
            else f"there is: {', '.join(self)}"
        )
        raise KeyError(f"no quantity {quoted(name)} in the summary; {hint}")


def of_run(record: Record) -> "Dataset":
    """All datasets of a record, those along its axis, their first dimension, before others; in SI units."""
    names = (*record, *record.others)
    dimensions = {dim for name in names for dim in record.dims_of(name)}
    # a record has scales that it does not go through
    coordinates = {dim: _variable(record, dim, (dim,)) for dim in dimensions if dim in record}
    return _dataset(record, names, coordinates)


def of_sweep(record: SweepRecord) -> "Dataset":
    """All quantities of a sweep over its parameters, in SI units; NaN where a case is not done."""
    coordinates: dict[str, Any] = {
        parameter.name: (parameter.name, parameter.values, {"units": parameter.units, "key": parameter.key})
        for parameter in record.parameters
    }
    for name, values in record.listed.items():
        named = {"units": record.units(name), "long_name": record.long_name(name)}
        coordinates[name] = ("case", values, named)
    further = (
        {dim for name in record for dim in record.dims_of(name)} - {*record.dims} if record.listed else ()
    )
    for name in further:
        coordinates[name] = (name, record[name], {"units": record.units(name)})
    if record.directions:
        coordinates["direction"] = ("direction", np.array(record.directions))
    return _dataset(record, dict.fromkeys((*record, "status", "message")), coordinates)


def _dataset(record: Record | SweepRecord, names: Iterable[str], coordinates: Mapping[str, Any]) -> "Dataset":
    from xarray import Dataset  # with pandas half the start of a program that only runs

    data = {name: _variable(record, name, record.dims_of(name)) for name in names if name not in coordinates}
    attributes = {"title": str(record.scenario.get("title", "")), "status": record.status}
    return Dataset(data, coordinates, attributes)


def _variable(record: Record | SweepRecord, name: str, dims: tuple[str, ...]) -> Any:
    named = {"units": record.units(name), "long_name": record.long_name(name)}
    return dims, record[name], {key: value for key, value in named.items() if value}


#: Of a small picture: inches per panel, and its resolution as a share of that of a file.
SIZE, RESOLUTION = (3.6, 2.1), 0.45
#: Panels of a run; mesh cycles in them.
PANELS, CYCLES = 2, 2
#: Characters that fit over a panel.
LONGEST = 40
#: Curves of a sweep over its second key, at most.
CURVES = 6
# columns beside each other where there is room; notebooks align to the right what is not told otherwise
_STYLE = (
    "<style>.tribodyn .tables{display:flex;flex-wrap:wrap;gap:0 2.5rem}"
    ".tribodyn td:first-child,.tribodyn th{text-align:left}</style>"
)


def block(*parts: str) -> str:
    """Put parts below each other."""
    return f'<div class="tribodyn">{_STYLE}{"".join(parts)}</div>'


def heading(title: str, *remarks: str) -> str:
    """Write a title, and what is to be said of it."""
    return f"<p><b>{escape(title)}</b>{''.join(f'<br>{escape(remark)}' for remark in remarks if remark)}</p>"


def folded(title: str, sentences: Sequence[str]) -> str:
    """Write sentences that unfold below a title; nothing, where there are none."""
    items = "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences)
    return f"<details><summary>{escape(title)}</summary><ul>{items}</ul></details>" if items else ""


def table(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Write a table."""

    def row(cells: Sequence[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return f"<table>{row(columns, 'th')}{''.join(row(cells, 'td') for cells in rows)}</table>"


def tables(some: Iterable[TextTable]) -> str:
    """Write tables beside each other."""
    written = (f"<div><h4>{escape(one.title)}</h4>{table(one.columns, one.rows)}</div>" for one in some)
    return f'<div class="tables">{"".join(written)}</div>'


def picture_of_run(record: Record, study: Study) -> str:
    """Draw the first datasets of a record over the last mesh cycles; nothing, where there are none."""
    from tribodyn.post.cycles import first_shown
    from tribodyn.post.page.data import in_engineers_units, series_of, with_unit
    from tribodyn.post.style import literal

    series = {series_name.name: series_name for series_name in series_of(record)}
    names = [name for name in study.panels() if name in series] or list(series)
    if not names or not record.samples:
        return ""
    abscissa = np.asarray(record[record.axis], dtype=float)
    axis, unit = in_engineers_units(abscissa, record.units(record.axis))
    start = abscissa[0]
    if record.summary.get("cycles_done") and record.axis == "time" and record.samples > 1:
        start, _ = first_shown(record, CYCLES)

    def draw(axes: "Axes", name: str) -> None:
        for curve in series[name].curves:
            inside = abscissa[curve.places] >= start
            axes.plot(axis[curve.places][inside], curve.values[inside], label=literal(curve.label))
        title = series[name].title if len(series[name].title) < LONGEST else name.replace("_", " ")
        axes.set_title(literal(with_unit(title, series[name].unit)), loc="left")
        axes.set_xlabel(literal(with_unit(record.axis.replace("_", " "), unit)))
        if 1 < len(series[name].curves) <= CURVES:
            axes.legend(fontsize=7)

    return _picture([lambda axes, name=name: draw(axes, name) for name in names[:PANELS]])


def picture_of_sweep(data: "xarray.Dataset", study: Study) -> str:
    """Draw the first quantity of a sweep over its first key; nothing, where there are no numbers to draw."""
    from tribodyn.post.style import literal

    quantity = next((swept for swept in study.sweep_table() if swept.name in data), None)
    if quantity is None:
        return ""
    values = quantity.in_unit(data[quantity.name])
    first, *others = values.dims
    if data[first].dtype.kind != "f":
        return ""

    def draw(axes: "Axes") -> None:
        stacked = values.stack(others=others) if others else values.expand_dims("others", 1)
        places = np.linspace(0, stacked.sizes["others"] - 1, min(stacked.sizes["others"], CURVES)).astype(int)
        for place in places:
            curve = stacked.isel(others=place)
            label = ", ".join(f"{name} {_short(curve[name].item())}" for name in others)
            axes.plot(data[first], curve, marker=".", label=literal(label))
        axes.set_title(literal(quantity.titled), loc="left")
        unit = data[first].attrs.get("units", "1")
        name = str(first).replace("_", " ")
        axes.set_xlabel(literal(name if unit == "1" else f"{name} ({unit})"))
        if others:
            axes.legend(fontsize=7)

    return _picture([draw])


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def picture_of_gears(mesh: "GearsInMesh") -> str:
    """Draw the teeth in contact."""
    from tribodyn.post.figures.gears_in_mesh import draw_gears

    return _picture([lambda axes: draw_gears(axes, mesh)], height=1.7)


def _picture(panels: Sequence[Any], height: float = 1.0) -> str:
    from matplotlib.figure import Figure

    from tribodyn.post.style import house_style, inline

    with house_style():
        figure = Figure((SIZE[0] * len(panels), SIZE[1] * height), layout="constrained")
        for axes, draw in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            draw(axes)
        return inline(figure, share=RESOLUTION)


#: Of the frame in a notebook, in pixels: room for the teeth, the readings beside them, and the controls.
FRAME = 520


class Animation:
    """The teeth in mesh as a page; `Run.animate` makes one.

    Attributes
    ----------
    html : str
        The page: one HTML document that needs no other, with the teeth, a slider and the quantities of the
        pairs at its position.
    """

    def __init__(self, html: str) -> None:
        self.html = html

    def _repr_html_(self) -> str:
        page = escape(self.html, quote=True)
        return (
            f'<iframe srcdoc="{page}" sandbox="allow-scripts" title="The teeth in mesh" '
            f'style="width: 100%; height: {FRAME}px; border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return "<tribodyn animation: shown in a notebook; `html` is its page>"


def check_teeth(records: Sequence[Record]) -> None:
    """Raise InputError for a record of which there are no teeth to roll."""
    from tribodyn.post.page.motion import rolling_teeth

    for record in records:
        if rolling_teeth(record) is None:
            rule = "holds no gears that turn"
            raise InputError("record", str(record.path), rule, "draw it with plot instead")
