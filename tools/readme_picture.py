"""The picture of the README: two shipped drives compared.

python -m tools.readme_picture            # writes docs/pictures/*.png
"""

from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

from tools.marked_block import PICTURES
from tribodyn.post.figures.over_mesh import TRACES
from tribodyn.post.figures.panel import View, draw, legend
from tribodyn.post.figures.path_of_contact import draw_path
from tribodyn.post.style import house_style, mark_panel, new_figure, save
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run


def comparison(records: list[Record]):
    """Draw both drives in six panels: the first one's path of contact, then quantities of both over phase."""
    view = View(cycles=1)
    with house_style():
        figure = new_figure(11.0, 6.2)
        axes = figure.subplots(2, 3).ravel()
        draw_path(axes[0], records[0])
        for panel, trace in zip(axes[1:], TRACES, strict=True):
            draw(panel, records, trace, view, first=panel in (axes[1], axes[2]))
        for letter, panel in zip("abcdef", axes, strict=True):
            mark_panel(panel, letter)
        legend(figure, axes[1:], records, view)
    return figure


def main() -> None:
    with TemporaryDirectory(prefix="tribodyn-") as temporary, ExitStack() as stack:
        records = []
        for name in ("crc-23-47", "involute-23-47"):
            # enough samples for the ringing after engagement
            case = load_scenario(name, {"solver.cycles": 4, "output.samples_per_cycle": 2000})
            result = run(case, Path(temporary) / f"{name}.h5")
            records.append(stack.enter_context(Record(result.path)))
        print(save(comparison(records), PICTURES / "crc-and-involute.png", force=True))


if __name__ == "__main__":
    main()
