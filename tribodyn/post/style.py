"""House style of the figures: one look, fit for print, with colours for every kind of colour vision."""

import base64
import functools
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from html import escape
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.layout_engine import ConstrainedLayoutEngine, LayoutEngine

from tribodyn.errors import InputError, cut, harmless
from tribodyn.numerics.files.output_files import MARKS, check_output, write_output

#: Okabe & Ito (2008), the colours that stay apart for every kind of colour vision; yellow is left out, too
#: pale for a line on white.
PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
INK = "#202020"
QUIET = "#7a7a7a"
GRID = "#e4e4e4"

#: Line styles of pairs 1, 0, −1 and of back flanks 2, 3, 4.
PAIR_STYLES = {
    1: "-",
    0: (0, (4, 1.6)),
    -1: (0, (1, 1.2)),
    2: (0, (6, 1.2, 1, 1.2)),
    3: (0, (6, 1.2, 1, 1.2, 1, 1.2)),
    4: (0, (2, 1.2)),
}

#: Width of a figure over both columns of a paper, and of a panel's height, inch.
WIDTH, PANEL_HEIGHT = 6.7, 2.5

#: Ticks that an axis seldom exceeds.
TICKS = 10
#: Resolution of a picture within a page, as a share of that of a file.
INLINE = 0.7
#: Characters of a text from a file that a figure shows.
LONGEST_TEXT = 110
#: Height of a row of names above axes, points.
ROW = 9.5

STYLE: dict[Any, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8.5,
    "mathtext.fontset": "dejavusans",
    # at the resolution of a print, hinted letters look the same, but unevenly spaced, and take a third longer
    "text.hinting": "none",
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.5,
    "axes.linewidth": 0.7,
    "axes.edgecolor": "#404040",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.xmargin": 0.0,
    "axes.ymargin": 0.08,
    "axes.formatter.useoffset": False,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.1,
    "lines.solid_capstyle": "round",
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "xtick.color": "#404040",
    "ytick.color": "#404040",
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "figure.facecolor": "white",
    "savefig.dpi": 200,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}


@contextmanager
def house_style() -> Iterator[None]:
    """Draw in the house style inside the block, whatever the user's own settings are."""
    with warnings.catch_warnings(), matplotlib.rc_context():
        warnings.simplefilter("ignore", matplotlib.MatplotlibDeprecationWarning)
        # a frame stands for a letter that the font lacks, and what is drawn is not to be read twice
        warnings.filterwarnings("ignore", r"Glyph \d+ .* missing from|Matplotlib currently does not support")
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        yield


_place: ContextVar[Axes | None] = ContextVar("place", default=None)


@contextmanager
def in_place_of(axes: Axes | None) -> Iterator[None]:
    """Draw the next figure where axes stand, which are removed from their figure; None: on its own.

    Raises InputError for axes that are in no grid, such as ``figure.add_axes(...)`` makes.
    """
    if axes is not None and axes.get_subplotspec() is None:
        rule = "axes that stand in no grid have no room for a figure"
        raise InputError("ax", None, rule, "make them with plt.subplots")
    token = _place.set(axes)
    try:
        yield
    finally:
        _place.reset(token)


def new_figure(width: float = WIDTH, height: float = PANEL_HEIGHT) -> Figure:
    """Make an empty figure, inch, that keeps its labels apart by itself; see `in_place_of`."""
    axes = _place.get()
    if axes is not None:
        _place.set(None)
        whole: Any = axes.figure
        spec = axes.get_subplotspec()
        axes.remove()
        if whole.get_layout_engine() is None:  # without it labels would lie on each other
            whole.set_layout_engine("constrained")
        return whole.add_subfigure(spec)
    return Figure(figsize=(width, height), layout=ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06))


_prepared: dict[tuple[float, float, int, int], tuple[Any, np.ndarray]] = {}


def new_grid(width: float, height: float, rows: int, columns: int) -> tuple[Any, np.ndarray]:
    """Make a figure (inch) and its axes (rows, columns), or give those of `prepare_grid`."""
    grid = width, height, rows, columns
    if _place.get() is None and grid in _prepared:
        return _prepared.pop(grid)
    figure = new_figure(width, height)
    return figure, figure.subplots(rows, columns, squeeze=False)


def prepare_grid(width: float, height: float, rows: int, columns: int) -> None:
    """Make the next grid of that size, and the ticks of its axes, which take longest."""
    grid = width, height, rows, columns
    with house_style():
        figure, panels = new_grid(*grid)
        for axes in panels.flat:
            for axis in (axes.xaxis, axes.yaxis):
                axis.get_major_ticks(TICKS)
    _prepared[grid] = figure, panels


class Margins(LayoutEngine):
    """A grid of panels with room of a known size for its labels, inch; saves half the time to draw it.

    There is room around the grid (below it also for a legend of the figure), and `between` panels across and
    down.
    """

    _adjust_compatible = True
    _colorbar_gridspec = False

    def __init__(
        self, left: float, right: float, top: float, bottom: float, between: tuple[float, float]
    ) -> None:
        super().__init__()
        self._around = left, right, top, bottom
        self._between = between

    def execute(self, fig: Any) -> None:
        """Place the grid."""
        left, right, top, bottom = self._around
        width, height = fig.get_size_inches()
        for legend in fig.legends:
            bottom += legend.get_window_extent().height / fig.dpi
        grid = fig.axes[0].get_subplotspec().get_gridspec()
        across = (width - left - right + self._between[0]) / grid.ncols - self._between[0]
        down = (height - top - bottom + self._between[1]) / grid.nrows - self._between[1]
        fig.subplots_adjust(
            left / width,
            bottom / height,
            1.0 - right / width,
            1.0 - top / height,
            self._between[0] / across,
            self._between[1] / down,
        )


def save(figure: Figure, path: str | Path, *, force: bool = False) -> Path:
    """Write a figure as PNG, PDF or SVG, by the file's ending; raises as `write_output`."""
    path = Path(path)
    check_output(path, force)
    with house_style():
        if path.suffix == ".png":
            content = _png(painted(figure), STYLE["savefig.dpi"])
        else:
            stream = BytesIO()
            figure.savefig(stream, format=path.suffix[1:], metadata={"Creator": "tribodyn"})
            content = stream.getvalue() + (MARKS[".pdf"] if path.suffix == ".pdf" else b"")
    return write_output(path, content, force=force)


def inline(figure: Figure, about: str = "", share: float = INLINE) -> str:
    """A figure as an image within a page: what it is about in words, its resolution over that of a file."""
    dpi = share * STYLE["savefig.dpi"]
    with house_style():
        data = base64.b64encode(_png(painted(figure, dpi), dpi)).decode("ascii")
    return f'<img alt="{escape(about)}" src="data:image/png;base64,{data}">'


def _png(pixels: np.ndarray, dpi: float) -> bytes:
    """Write pixels as a PNG file; beyond this level files hardly shrink, but take twice as long."""
    from PIL import Image, PngImagePlugin  # which matplotlib brings

    stream, about = BytesIO(), PngImagePlugin.PngInfo()
    about.add_text("Software", "tribodyn")
    Image.fromarray(pixels).save(stream, "png", compress_level=3, dpi=(dpi, dpi), pnginfo=about)
    return stream.getvalue()


@functools.cache
def _formulas() -> Any:
    """Return what reads formulas for all pictures, and remembers them."""
    from matplotlib.backends.backend_agg import RendererAgg

    return RendererAgg(1, 1, 72).mathtext_parser


def read_formulas(texts: Iterable[str], size: float) -> None:
    """Read formulas of a size (points), which then need not be read for a picture."""
    with house_style():
        for text in texts:
            _formulas().parse(text, STYLE["savefig.dpi"], FontProperties(size=size))


def painted(figure: Figure, dpi: float | None = None) -> np.ndarray:
    """Draw a figure as PNG files have it: uint8 (rows, columns, 4), red, green, blue, opacity.

    `savefig` would draw it once more to no effect.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    shown_at = figure.dpi
    figure.dpi = dpi or matplotlib.rcParams["savefig.dpi"]
    try:
        canvas = FigureCanvasAgg(figure)
        canvas.get_renderer().mathtext_parser = _formulas()
        canvas.draw()
        return np.asarray(canvas.buffer_rgba())
    finally:
        figure.dpi = shown_at


def literal(text: str) -> str:
    """A text from a file as a figure shows it: on one line, cut where it is long, no formula, never left out.

    Texts that stand in a program may hold formulas between dollar signs; what comes from scenarios, records
    and names of files passes through here.
    """
    line = cut(" ".join(harmless(text).split()), LONGEST_TEXT)
    shown = line.replace("$", r"\$")
    return f"\u200a{shown}" if shown.startswith("_") else shown  # which a legend would leave out


def panel_title(letter: str, title: str) -> str:
    """Set (a), (b), … before what a panel shows."""
    marked = rf"$\mathbf{{({letter})}}$" if letter else ""
    return " ".join(filter(None, (marked, title)))


def name_above(axes: Axes, place: float, text: str, row: int, color: str = QUIET, size: float = 6.5) -> None:
    """Write a name above the axes at a place along them, in a row that is counted upwards."""
    where = {"xycoords": ("data", "axes fraction"), "ha": "center"}
    write_beside(axes, text, (place, 1), (0, 3 + ROW * row), size, color, **where)


def write_beside(
    axes: Axes, text: str, place: Any, offset: tuple[float, float], size: float, color: str, **how: Any
) -> None:
    """Write a text of a size so many points beside a place; `how` as of `Axes.annotate`."""
    axes.annotate(text, place, xytext=offset, textcoords="offset points", fontsize=size, color=color, **how)


def mark_panel(axes: Axes, letter: str, title: str = "", rows: int = 0) -> None:
    """Put (a), (b), … and what a panel shows above the axes at the left, above `rows` rows of names."""
    # no ticks stand above the axes that the title would have to stay clear of
    axes.set_title(panel_title(letter, title), loc="left", y=1.0, pad=5 + ROW * rows)
