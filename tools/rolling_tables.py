"""Tables and picture of docs/rolling-elements.md, from runs of the shipped scenarios.

python -m tools.rolling_tables            # writes them into the page
"""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from tools.marked_block import DOCS, PICTURES, put, table
from tribodyn.post.style import save
from tribodyn.record.reader import Record
from tribodyn.studies.pages import overview
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

PAGE = DOCS / "rolling-elements.md"
RADII = (1.2, 1.6, 2.0, 2.4, 2.8)


def result(folder: Path, scenario: str, **changes: str) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Summary of a run, and its datasets at the start."""
    settings = {name.replace("__", "."): value for name, value in changes.items()}
    path = run(load_scenario(scenario, settings), folder / "run.h5", force=True).path
    with Record(path) as record:
        return record.summary, {name: record[name][0] for name in record}


def modes(folder: Path) -> str:
    """The table's position in both modes, the corrected one with both rolling arms."""
    published = result(folder, "irefc-as-published")
    coarse = result(folder, "irefc", friction__rolling_arm="1 mm")
    fine = result(folder, "irefc")
    runs = (published, coarse, fine)
    head = "as published, μ 1 mm", "corrected, μ 1 mm", "corrected, μ 0.01 mm"
    columns = ["element", "φ, °", "R, N", "v_s, mm/s: published", "corrected"]
    columns += ["ω_b, rad/s: published", "corrected", f"N_S, W: {head[0]}", *head[1:]]
    rows = []
    for i in range(len(published[1]["normal_load"])):
        old, new = published[1], fine[1]
        cells = [
            i + 1,
            f"{np.degrees(new['element_angle'][i]):.1f}",
            f"{new['normal_load'][i]:.1f}",
            *(f"{data['slip_speed'][i] * 1e3:.2f}" for data in (old, new)),
            *(f"{data['spin_speed'][i]:.1f}" for data in (old, new)),
            *(f"{data['power_cam'][i] + data['power_crown'][i]:.3f}" for _, data in runs),
        ]
        rows.append(cells)
    means = []
    for label, name, form in (
        ("loss, W", "power_friction_mean", ".1f"),
        ("of it at the cam, W", "power_cam_mean", ".1f"),
        ("of it at the crown, W", "power_crown_mean", ".1f"),
        ("maximum slip, mm/s", "slip_speed_max", ".2f"),
        ("efficiency", "efficiency", ".4f"),
        ("efficiency by energy", "efficiency_by_energy", ".4f"),
    ):
        factor = 1e3 if name == "slip_speed_max" else 1.0
        cells = [format(factor * summary[name], form) for summary, _ in runs]
        means.append([label, *cells])
    parts = table(columns, rows, "r" * 10), table(["", *head], means, "lrrr")
    return "\n\n".join([*parts, "Means are over the revolution in mode `corrected`."])


def conclusions(folder: Path) -> str:
    """Sizes that the paper varies, with the corrected loss beside the printed one."""

    def loss(scenario: str, **changes: str) -> str:
        return f"{result(folder, scenario, **changes)[0]['power_friction_mean']:.1f}"

    head = "", "loss as published, W", "corrected, μ 0.01 mm, W"
    sizes = [(f"r_b {radius:g} mm", {"drive__element_radius": f"{radius} mm"}) for radius in RADII]
    sizes += [(f"r₂ {radius:g} mm", {"drive__pitch_radius": f"{radius} mm"}) for radius in (20, 30)]
    modes = "irefc-as-published", "irefc"
    rows = [[label, *(loss(scenario, **changes) for scenario in modes)] for label, changes in sizes]
    return table(head, rows, "lrr")


def main() -> None:
    with TemporaryDirectory(prefix="tribodyn-") as temporary:
        folder = Path(temporary)
        put(PAGE, "rolling-modes", modes(folder))
        put(PAGE, "rolling-conclusions", conclusions(folder))
        path = run(load_scenario("irefc"), folder / "irefc.h5").path
        with Record(path) as record:
            print(save(overview(record), PICTURES / "irefc.png", force=True))


if __name__ == "__main__":
    main()
