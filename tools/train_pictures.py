"""Figures of docs/trains.md, of the reducer that the page describes, and of a thin ring.

python -m tools.train_pictures            # writes docs/pictures/train-*.png, ring-shape.png
"""

import re
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray

import tribodyn as td
from tools.marked_block import DOCS, PICTURES
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.post.style import INK, PALETTE, QUIET, house_style, new_figure, save
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

PAGE, FILE = DOCS / "trains.md", "reducer.toml"
#: The shaft of the page that twists, and the range of torsional stiffness that is drawn, N m/rad.
SHAFT = {"shaft.0.stiffness": "5e5 N*m/rad", "shaft.0.damping_ratio": 0.02}
STIFFNESSES = np.geomspace(1e3, 1e9, 121)
#: Cycles of the first mesh in a common period.
PERIOD = 17


def block(name: str) -> str:
    """Return the file that the page shows."""
    found = re.search(
        rf"^```toml {re.escape(name)}\n(.*?)^```$", PAGE.read_text("utf-8"), re.DOTALL | re.MULTILINE
    )
    if found is None:
        raise SystemExit(f"{PAGE}: no block {name}")
    return found[1]


def frequencies(file: Path, overrides: dict[str, Any]) -> np.ndarray:
    """Natural frequencies, Hz."""
    prepared = prepare(load_scenario(file, overrides))
    return natural_frequencies(prepared.model, [made.cycle for made in prepared.tables])


def draw_modes(file: Path) -> None:
    """Draw the natural frequencies over the shaft's stiffness, and those of the rigid shaft."""
    rigid = frequencies(file, {})
    soft = np.array([frequencies(file, {"shaft.0.stiffness": f"{k} N*m/rad"}) for k in STIFFNESSES.tolist()])
    figure = new_figure(6.4, 3.6)
    axes = figure.subplots()
    axes.semilogx(STIFFNESSES, soft * 1e-3, color=PALETTE[0], lw=1.2)
    axes.hlines(rigid * 1e-3, 3e8, 1e9, color=INK, ls="--", lw=0.9)
    axes.axvline(5e5, color=QUIET, lw=0.8)
    axes.set(xlabel="torsional stiffness of the middle shaft (N m/rad)", ylabel="natural frequency (kHz)")
    axes.set(xlim=(1e3, 1e9), ylim=(0, 7.5))
    print(save(figure, PICTURES / "train-modes.png", force=True))


def draw_run(runs: dict[str, td.Run]) -> None:
    """Draw the forces in both meshes over the last common period, and the loss of the rigid shaft's."""
    figure = new_figure(8.0, 6.0)
    panels = figure.subplots(3, 1, sharex=True)
    for axes, (title, run) in zip(panels, runs.items(), strict=False):
        data = last_period(run)
        for m, name in enumerate(data.mesh.values):
            radius = pitch_radius(run, str(name))
            axes.plot(data.cycle, data.driver_torque[:, m] / radius * 1e-3, color=PALETTE[m], label=str(name))
        axes.set_ylabel("mesh force (kN)")
        axes.set_title(title, loc="left")
        axes.legend(loc="upper right", ncols=2)
    data = last_period(next(iter(runs.values())))
    for m, name in enumerate(data.mesh.values):
        panels[2].plot(data.cycle, data.mesh_power_friction[:, m] * 1e-3, color=PALETTE[m], label=str(name))
    panels[2].set(xlabel="cycles of the first mesh", ylabel="loss (kW)", xlim=(0, PERIOD))
    panels[2].set_title("(c) rigid shaft: power lost to friction", loc="left")
    print(save(figure, PICTURES / "train-loads.png", force=True))


def draw_ring(run: td.Run) -> None:
    """Draw the thin ring that planets bend."""
    print(save(run.plot("ring-shape"), PICTURES / "ring-shape.png", force=True))


def last_period(run: td.Run) -> Any:
    """Samples of the last common period, with `cycle`: cycles of the first mesh since its beginning."""
    cycle = run.data.mesh_phase[:, 0]
    cycle = cycle - float(cycle[-1]) + PERIOD
    return run.data.assign(cycle=cycle).isel(time=np.flatnonzero(cycle.values >= -1e-9))


def pitch_radius(run: td.Run, mesh: str) -> float:
    """Operating pitch radius of a mesh's driver, m."""
    with xarray.open_dataset(run.path, engine="h5netcdf", group=f"meshes/{mesh}/mesh_cycle") as table:
        return float(table.attrs["pinion_pitch_radius"])


def main() -> None:
    """Write the pictures."""
    with TemporaryDirectory(prefix="tribodyn-") as folder, house_style():
        file = Path(folder) / FILE
        file.write_text(block(FILE), "utf-8")
        draw_modes(file)
        rigid, soft = td.run(file), td.run(file, SHAFT)
        draw_run({"(a) rigid shaft": rigid, "(b) shaft of 0.5 MN m/rad": soft})
        print(save(rigid.plot("train"), PICTURES / "train.png", force=True))
        draw_ring(td.run("planetary-thin-ring"))


if __name__ == "__main__":
    main()
