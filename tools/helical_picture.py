"""Picture of docs/helical.md: peak to peak transmission error over contact ratio and overlap ratio.

python -m tools.helical_picture            # writes docs/pictures/helical-contact-ratios.png
"""

from dataclasses import replace

import numpy as np

from tools.marked_block import PICTURES as FOLDER
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import from_written
from tribodyn.mesh.by_compliance import mesh_cycle_of
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.post import style

STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 460.0, 7e9)
TEETH, HELIX, MODULE = (31, 61), np.radians(20.0), 3e-3
#: Heights of the teeth over the normal module, and overlap ratios by the face width.
HEIGHTS = np.linspace(0.55, 1.3, 9)
OVERLAPS = np.linspace(0.1, 2.2, 43)
#: Load per face width on the pitch circles, N/m.
LINE_LOAD = 150e3
MESHES = {
    "uniform stiffness along the lines of contact": MeshData("constant", 0.0, stiffness=4e8, slices=31),
    "energy method": MeshData("energy", 0.0, slices=21),
}


def pair(height: float, overlap: float) -> Assembly:
    """A helical pair of so high teeth, its face as wide as the overlap ratio asks."""
    involute, width = family("involute"), overlap * np.pi * MODULE / np.sin(HELIX)
    bodies = [
        GearBody(z, 0.0, height, height + 0.25, 0.2, width, 0.3 * z * MODULE / 2.0 / np.cos(HELIX))
        for z in TEETH
    ]
    written = Drive(MODULE, np.radians(20.0), *bodies, helix_angle=float(HELIX))
    return assemble(involute, from_written(involute, written))


def swing(gears: Assembly, mesh: MeshData) -> float:
    """Peak to peak transmission error over its mean deflection, in slow rotation."""
    width = float(gears.common_width)
    torque = LINE_LOAD * width * float(gears.path.gear_pitch_radius)
    if mesh.stiffness:  # of so much face
        mesh = replace(mesh, stiffness=mesh.stiffness * width / 20e-3)
    deflection = quasi_static(mesh_cycle_of(gears, (STEEL, STEEL), mesh, torque), torque).deflection
    return float(np.ptp(deflection) / np.mean(deflection))


def main() -> None:
    with style.house_style():
        figure = style.new_figure(9.0, 4.0)
        parts, images = figure.subplots(1, 2, sharey=True), []
        for axes, (name, mesh) in zip(parts, MESHES.items(), strict=True):
            gears = [[pair(height, overlap) for height in HEIGHTS] for overlap in OVERLAPS]
            ratios = [float(one.contact_ratio) for one in gears[0]]
            values = 100.0 * np.array([[swing(one, mesh) for one in row] for row in gears])
            levels = np.concatenate([[0.0, 1.0, 2.0], np.arange(4.0, 32.0, 4.0)])
            images.append(axes.contourf(ratios, OVERLAPS, values, levels, cmap="viridis", extend="max"))
            for whole in (1.0, 2.0):
                axes.axhline(whole, color="white", linestyle=":", linewidth=1.0)
                if ratios[0] < whole < ratios[-1]:
                    axes.axvline(whole, color="white", linestyle=":", linewidth=1.0)
            axes.set_title(name, loc="left", fontsize=10)
            axes.set_xlabel("Contact ratio $ε_α$")
            at_one = values[np.argmin(np.abs(OVERLAPS - 1.0))]
            print(name, "at ε_β = 1:", np.round(at_one[[0, -1]], 3), "maximum", values.max().round(1))
        parts[0].set_ylabel("Overlap ratio $ε_β$")
        figure.colorbar(images[-1], ax=parts, label="Peak to peak over mean deflection (%)")
        print(style.save(figure, FOLDER / "helical-contact-ratios.png", force=True))


if __name__ == "__main__":
    main()
