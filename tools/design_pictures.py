"""Draw the pictures of docs/design.md: overviews of shipped searches, and maps of those with two free keys.

python -m tools.design_pictures --into docs/pictures            # everything: minutes
python -m tools.design_pictures --only shift-23-47 --records /tmp/searches   # keeps records, uses those there
"""

from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import numpy as np

from tools.marked_block import PICTURES, parser_of
from tribodyn.errors import InputError
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, WIDTH, house_style, new_figure, save
from tribodyn.record.reader import Record
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, number_of, value_at
from tribodyn.studies.design.candidates.evaluation import Pool
from tribodyn.studies.design.candidates.scoring import Scoring
from tribodyn.studies.pages import overview
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

SEARCHES = ("tip-relief-18-36", "crowning-18-36", "shift-23-47", "cycloid-23-47", "quiet-range-18-36")
#: Searches with two free keys -> points of the map along each, factor and unit of the objective.
MAPS = {"shift-23-47": (29, 1.0, "W"), "cycloid-23-47": (25, 1.0, "W"), "quiet-range-18-36": (13, 1.0, "")}


def record_of(name: str, folder: Path) -> Path:
    """The record of a search; it is run where it is not there."""
    path = folder / f"design-{name}.h5"
    if not path.exists():
        result = run(load_scenario(f"design-{name}"), path)
        if result.status != "complete":
            raise SystemExit(result.message)
    return path


def scan(case: Any, points: int) -> tuple[np.ndarray, np.ndarray]:
    """Objective and feasibility (second key, first key) on a grid of both free keys: brute force."""
    shares = np.linspace(0.0, 1.0, points)
    with Pool(case.scenarios, 2) as pool:
        scoring = Scoring(case, pool.submit(cases_of(case, {})).result())
        waiting = [[pool.submit(cases_of(case, chosen(case, (x, y)))) for x in shares] for y in shares]
        rows = [[scoring.score(future.result()) for future in row] for row in waiting]
    values = np.array([[score.objectives[0] for score in row] for row in rows])
    return values, np.array([[score.feasible for score in row] for row in rows])


def draw_map(name: str, path: Path, folder: Path) -> Any:
    """The objective over both free keys, the evaluations of the search on it, and its best."""
    case: Any = load_scenario(f"design-{name}")
    points, factor, unit = MAPS[name]
    kept = folder / f"design-{name}-map.npz"
    if not kept.exists():
        values, feasible = scan(case, points)
        np.savez(kept, values=values, feasible=feasible)
    stored = np.load(kept)
    values, feasible = factor * stored["values"], stored["feasible"]
    numbers = [
        [float(str(value_at(key, share)).split()[0]) for share in np.linspace(0, 1, points)]
        for key in case.free
    ]
    figure = new_figure(0.75 * WIDTH, 1.7 * PANEL_HEIGHT)
    axes = figure.subplots()
    drawn = axes.contourf(*numbers, values, 16, cmap="viridis")
    bar = figure.colorbar(drawn, ax=axes)
    axes.contourf(*numbers, (~feasible).astype(float), [0.5, 1.5], colors=["white"], alpha=0.55)
    with Record(path) as record:
        x, y = (record[f"free_{key.name}"] / key.si for key in case.free)
        axes.plot(x, y, ".", color=INK, markersize=2.5, label="evaluations")
        best = [number_of(key, record.summary["best"][key.keys[0]]) / key.si for key in case.free]
        axes.plot(*best, "o", color=PALETTE[1], markersize=6, label="best of the search")
        found = record.summary["objective"] * factor
    row, column = np.unravel_index(np.nanargmin(np.where(feasible, values, np.nan)), values.shape)
    least = values[row, column]
    axes.plot(
        numbers[0][column], numbers[1][row], "s", markersize=8, markerfacecolor="none", color=PALETTE[1]
    )
    axes.plot([], [], "s", markerfacecolor="none", color=PALETTE[1], label="best of the grid")
    for set_label, key in zip((axes.set_xlabel, axes.set_ylabel), case.free, strict=True):
        set_label(key.name.replace("_", " ") + (f" ({key.unit})" if key.unit else ""))
    label = case.objectives[0].name.replace("_", " ")
    bar.set_label(f"{label} ({unit})" if unit else label)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=3)
    axes.set_title(f"Best of the search {found:.4g}, of the grid {least:.4g} {unit}".rstrip(), loc="left")
    return figure


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("--into", type=Path, default=PICTURES)
    parser.add_argument("--records", type=Path, help="folder of records; default: a temporary one")
    parser.add_argument("--only", nargs="*", default=SEARCHES, choices=SEARCHES)
    given = parser.parse_args()
    folder = given.records or Path(mkdtemp(prefix="tribodyn-"))
    for name in given.only:
        try:
            path = record_of(name, folder)
        except InputError as error:
            raise SystemExit(str(error)) from None
        short = name.rpartition("-")[0].rpartition("-")[0]
        with Record(path) as record:
            print(save(overview(record), given.into / f"design-{short}.png", force=True))
        if name in MAPS:
            with house_style():
                print(save(draw_map(name, path, folder), given.into / f"design-{short}-map.png", force=True))


if __name__ == "__main__":
    main()
