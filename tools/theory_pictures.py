"""Figures of docs/theory.md, of both drives of Liu & Ni.

python -m tools.theory_pictures           # writes docs/pictures/theory-*.png
"""

from typing import Any

import numpy as np

import tribodyn as td
from tools.marked_block import PICTURES
from tribodyn.compliance.energy import hertz_linear, loaded_tooth, tooth_compliance
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.body import gear_polygon
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.families import family
from tribodyn.geometry.path import kinematics, position
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.post.style import INK, PALETTE, QUIET, house_style, new_figure, save

BLUE, ORANGE, GREEN, PURPLE = PALETTE[:4]
CRC, INVOLUTE = "crc-23-47", "involute-23-47"
CASES = {name: td.scenario(name).pair for name in (CRC, INVOLUTE)}
#: Pinion speeds of the dynamic runs, rad/s: slow, and between two resonances.
SPEEDS = (10.0, 300.0)


def made(name: str) -> Assembly:
    return assemble(family(CASES[name].family), CASES[name].drive)


def turned(outline: np.ndarray, angle: float, centre: float) -> np.ndarray:
    """An outline about its own axis, turned counter-clockwise and put on the line of centres, mm."""
    c, s = np.cos(angle), np.sin(angle)
    return 1e3 * (outline @ np.array([[c, s], [-s, c]]) + [0.0, centre])


def profiles(axes: Any, assembly: Assembly) -> None:
    """Draw flanks of one pair at three points of the path, each with the normal through P."""
    path = assembly.path
    polygons = {side: np.asarray(gear_polygon(assembly, side)) for side in SIDES}
    for r in (0.8 * assembly.r_start, 0.0, 0.8 * assembly.r_end):
        phi = float(path.rotation(r))
        ratio = path.pinion_pitch_radius / path.gear_pitch_radius
        turns = {"pinion": (-phi, -path.pinion_pitch_radius), "gear": (ratio * phi, path.gear_pitch_radius)}
        x, y = (1e3 * float(value) for value in position(path, r))
        for side, colour in (("pinion", BLUE), ("gear", ORANGE)):
            outline = turned(polygons[side], *turns[side])
            near = np.hypot(outline[:, 0] - x, outline[:, 1] - y) < 1.9
            axes.plot(*np.where(near, outline.T, np.nan), colour, lw=1.3, label=None if r else side)
        if r:
            axes.plot([-0.3 * x, 1.7 * x], [-0.3 * y, 1.7 * y], QUIET, lw=0.8, ls="--")
        axes.plot(x, y, "o", color=INK, ms=3)
    along = np.linspace(assembly.r_start, assembly.r_end, 201)
    axes.plot(*(1e3 * np.asarray(position(path, along))), INK, lw=1.8)
    axes.axhline(0, color=QUIET, lw=0.6)
    axes.annotate("P", (0, 0), (3, -10), textcoords="offset points")
    axes.legend(loc="upper left")
    axes.set(xlim=(-9, 9), ylim=(-6, 6), aspect="equal", xlabel="x (mm)", ylabel="y (mm)")
    axes.set_title("(a) one pair at three points of its path", loc="left")


def frame(axes: Any) -> None:
    """Draw a contact with its normal, tangent and the arms of both forces; not to scale."""
    alpha, r, pinion = np.radians(28.0), 0.75, 1.0
    normal, tangent = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    contact, axis = r * normal, np.array([0.0, -pinion])
    foot = normal * (axis @ normal)
    axes.axhline(0, color=QUIET, lw=0.6)
    axes.axvline(0, color=QUIET, lw=0.6)
    axes.plot(*np.array([-0.75 * normal, 1.25 * normal]).T, QUIET, lw=0.8, ls="--")
    axes.plot(*np.array([axis, foot]).T, BLUE, lw=1.4)
    across = contact + tangent * ((axis - contact) @ tangent)
    axes.plot(*np.array([axis, across]).T, GREEN, lw=1.4)
    axes.plot(*np.array([contact, across]).T, QUIET, lw=0.8, ls=":")
    for vector, name in ((normal, "n"), (tangent, "t")):
        tip = contact + 0.38 * vector
        axes.annotate("", tip, contact, arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.2})
        axes.annotate(
            name, tip, (2, -11) if name == "n" else (3, 2), textcoords="offset points", weight="bold"
        )
    for place, name, shift in (
        (np.zeros(2), "P", (-11, 3)),
        (contact, "C", (-1, -12)),
        (axis, "$O_p$", (-16, -4)),
    ):
        axes.plot(*place, "o", color=INK, ms=3)
        axes.annotate(name, place, shift, textcoords="offset points")
    angle = np.linspace(0.0, alpha, 20)
    axes.plot(0.42 * np.cos(angle), 0.42 * np.sin(angle), INK, lw=0.8)
    axes.annotate("α", (0.46, 0.09))
    axes.annotate("r", 0.5 * contact, (-4, 5), textcoords="offset points", style="italic")
    axes.annotate("$H_p$", (axis + foot) / 2, (-18, -2), textcoords="offset points", color=BLUE)
    axes.annotate("$L_p$", (axis + across) / 2, (3, -10), textcoords="offset points", color=GREEN)
    axes.set(xlim=(-0.8, 1.35), ylim=(-1.15, 0.95), aspect="equal", xticks=[], yticks=[])
    axes.set_xlabel("x, along the pitch tangent")
    axes.set_ylabel("y, along the centres")
    axes.set_title("(b) normal, tangent and arms", loc="left")


def along_path(figure: Any) -> None:
    """Draw pressure angle, radii and speeds of both drives along their paths."""
    panels = figure.subplots(1, 3)
    speed = float(CASES[CRC].operating.pinion_speed)
    for name, style, label in ((CRC, "-", "CRC"), (INVOLUTE, "--", "involute")):
        assembly = made(name)
        r = np.linspace(assembly.r_start, assembly.r_end, 401)
        at = kinematics(assembly.path, r)
        panels[0].plot(1e3 * r, np.degrees(at.pressure_angle), style, color=INK, label=label)
        for curvature, colour, what in (
            (at.pinion_curvature, BLUE, "$ρ_p$"),
            (at.gear_curvature, ORANGE, "$ρ_g$"),
            (at.relative_curvature, GREEN, "$ρ$"),
        ):
            panels[1].plot(
                1e3 * r, 1e3 / curvature, style, color=colour, label=what if style == "-" else None
            )
        for value, colour, what in (
            (at.pinion_speed, BLUE, "$u_p$"),
            (at.gear_speed, ORANGE, "$u_g$"),
            (at.sliding, PURPLE, "$v_s$"),
        ):
            panels[2].plot(1e3 * r, speed * value, style, color=colour, label=what if style == "-" else None)
    panels[0].set(ylabel="pressure angle α (°)", title="(a)")
    panels[1].set(ylabel="radius of curvature (mm)", title="(b)")
    panels[2].set(ylabel=f"speed at {speed:g} rad/s (m/s)", title="(c)")
    for panel in panels:
        panel.set_xlabel("distance r from P (mm)")
        panel.legend()


def cycle_of(name: str) -> MeshCycle:
    assembly = made(name)
    return tabulate(assembly, CASES[name].materials, MeshData("energy", 0.05), pair_slots(assembly))


def stiffness(figure: Any) -> None:
    """Draw parts of a pair's compliance, stiffness and load sharing of the involute pair."""
    parts, whole, share = figure.subplots(1, 3)
    case, assembly = CASES[INVOLUTE], made(INVOLUTE)
    r = np.linspace(assembly.r_start, assembly.r_end, 201)
    width = assembly.common_width
    first_material, second_material = case.materials
    teeth = [
        tooth_compliance(loaded_tooth(assembly, side), material, width, r)
        for side, material in zip(SIDES, case.materials, strict=True)
    ]
    stacked = {
        "contact": np.full_like(r, hertz_linear(first_material, second_material, width)),
        "bodies": sum(tooth.foundation for tooth in teeth),
        "shear, axial": sum(tooth.shear + tooth.axial for tooth in teeth),
        "bending": sum(tooth.bending for tooth in teeth),
    }
    parts.stackplot(1e3 * r, *(1e9 * part for part in stacked.values()), labels=stacked, colors=PALETTE)
    parts.set(xlabel="distance r from P (mm)", ylabel="compliance of a pair (µm/kN)", title="(a)")
    parts.legend(loc="upper center", ncols=2)
    parts.set_ylim(0, 1.5 * parts.get_ylim()[1])
    cycle = cycle_of(INVOLUTE)
    still = quasi_static(cycle, float(case.operating.gear_torque))
    for segment in range(cycle.phase.shape[0]):
        phase = np.asarray(cycle.phase)[segment]
        first = segment == 0
        whole.plot(phase, 1e-6 * still.mesh_stiffness[segment], color=INK, label="mesh" if first else None)
        for slot, colour in ((1, BLUE), (0, ORANGE)):
            if cycle.in_contact[segment, slot]:
                pair = f"pair {slot}" if first else None
                whole.plot(phase, 1e-6 / cycle.compliance[segment, :, slot], color=colour, label=pair)
                share.plot(phase, 1e-3 * still.normal_load[segment, :, slot], color=colour, label=pair)
    whole.set(xlabel="phase (mesh cycles)", ylabel="stiffness (N/µm)", ylim=(0, None), title="(b)")
    share.set(xlabel="phase (mesh cycles)", ylabel="normal load (kN)", ylim=(0, None), title="(c)")
    whole.legend()
    share.legend()


def motion(figure: Any) -> None:
    """Draw the transmission error over the mesh cycle at three speeds, and its swing over the speed."""
    over_phase, over_speed = figure.subplots(1, 2)
    teeth = float(CASES[INVOLUTE].drive.pinion.teeth)
    cycle = cycle_of(INVOLUTE)
    still = quasi_static(cycle, float(CASES[INVOLUTE].operating.gear_torque))
    slow = np.ravel(still.deflection) * np.cos(np.ravel(cycle.pressure_angle[..., 1]))
    over_phase.plot(np.ravel(cycle.phase), 1e6 * slow, color=QUIET, lw=2.5, label="infinitely slow")
    for speed, colour in zip(SPEEDS, (BLUE, ORANGE), strict=True):
        run = td.run(INVOLUTE, {"operating.pinion_speed": f"{speed} rad/s", "solver.cycles": 60})
        last = last_cycle(run)
        error = 1e6 * last["transmission_error_normal"].sel(pair=1)
        over_phase.plot(phase_of(last, teeth), error, color=colour, label=f"{speed:g} rad/s")
    over_phase.set(xlabel="phase (mesh cycles)", ylabel="deflection of pair 1 (µm)", title="(a)")
    over_phase.set_ylim(0, 1.3 * over_phase.get_ylim()[1])
    over_phase.legend(loc="upper center", ncols=3)
    speeds = np.geomspace(20.0, 620.0, 90)
    for name, colour, label in ((CRC, BLUE, "CRC"), (INVOLUTE, ORANGE, "involute")):
        grid = td.sweep(name, {"operating.pinion_speed": [f"{speed:.4f} rad/s" for speed in speeds]})
        swing = 1e6 * grid["transmission_error_peak_to_peak"]
        over_speed.semilogx(grid["pinion_speed"], swing, color=colour, label=label)
    over_speed.set(
        xlabel="pinion speed (rad/s)", ylabel="peak to peak of ξ (µm)", ylim=(0, None), title="(b)"
    )
    over_speed.set_xticks([20, 50, 100, 200, 500], ["20", "50", "100", "200", "500"])
    over_speed.set_xticks([], minor=True)
    over_speed.legend()


def last_cycle(run: td.Run) -> Any:
    return run.data.isel(time=slice(-201, -1))


def phase_of(last: Any, teeth: float) -> Any:
    angle = last["pinion_angle"]
    return (angle - angle[0]) * teeth / (2 * np.pi)


def losses(figure: Any) -> None:
    """Draw film, friction force and works of the CRC drive over its last mesh cycle."""
    film, force, works = figure.subplots(1, 3)
    run = td.run(CRC, {"solver.cycles": 8})
    last = last_cycle(run)
    phase = phase_of(last, float(CASES[CRC].drive.pinion.teeth))
    for pair, colour in ((1, BLUE), (0, ORANGE)):
        at = last.sel(pair=pair).where(last["normal_load"].sel(pair=pair) > 0)
        film.plot(phase, 1e6 * at["central_film_thickness"], color=colour, label=f"pair {pair}")
        force.plot(phase, at["friction_force"], color=colour, label=f"pair {pair}")
    film.set(xlabel="phase (mesh cycles)", ylabel="central film (µm)", ylim=(0, None), title="(a)")
    force.set(xlabel="phase (mesh cycles)", ylabel="friction force (N)", title="(b)")
    force.axhline(0, color=QUIET, lw=0.6)
    film.legend()
    ends = run.data.isel(time=[-201, -1])
    names = ("in", "out", "friction", "damping", "parametric")
    done = {name: float(np.diff(ends[f"work_{name}"])[0]) for name in names}
    stored = float(np.diff(ends["stored_energy"])[0])
    residual = done["in"] + done["parametric"] - done["out"] - done["friction"] - done["damping"] - stored
    done["residual"] = abs(residual)
    works.barh(list(done)[::-1], list(done.values())[::-1], color=BLUE)
    for place, value in enumerate(list(done.values())[::-1]):
        works.annotate(f" {value:.3g}", (value, place), va="center")
    works.set(xscale="log", xlabel="work per mesh cycle (J)", title="(c)")
    works.set_xlim(1e-7, 1e5)


def main() -> None:
    with house_style():
        figure = new_figure(8.0, 3.6)
        left, right = figure.subplots(1, 2, width_ratios=(1.35, 1))
        profiles(left, made(CRC))
        frame(right)
        print(save(figure, PICTURES / "theory-path.png", force=True))
        for name, draw in (
            ("kinematics", along_path),
            ("stiffness", stiffness),
            ("motion", motion),
            ("losses", losses),
        ):
            figure = new_figure(8.0, 2.9)
            draw(figure)
            print(save(figure, PICTURES / f"theory-{name}.png", force=True))


if __name__ == "__main__":
    main()
