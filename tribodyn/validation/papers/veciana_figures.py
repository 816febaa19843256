"""Figures 1 and 5 to 10 of Veciana et al., Machines 12 (2024) 943.

The mixed law is drawn in both readings: A as printed, B with Roelands' law at the maximum pressure and each
surface's own speed in the Péclet numbers. Dotted curves of cycloids have the motion of the contact along the
path in the rolling speeds, which the paper leaves out.
"""

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from tribodyn.drawing.picture import gears_in_mesh
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.families import family
from tribodyn.geometry.path import position
from tribodyn.post.figures.gears_in_mesh import draw_gears
from tribodyn.post.style import PALETTE, QUIET, mark_panel, new_figure
from tribodyn.studies.efficiency.scenario import EfficiencyCase
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.surface_state import surface_state
from tribodyn.validation.papers import veciana_study

#: Drives of the panels of figures 5 and 6, and the gear ratios of figure 10.
PANELS = (*veciana_study.DRIVES[:3], veciana_study.DRIVES[0], *veciana_study.DRIVES[3:])
RATIOS = (1.0, 1.5, 2.0, 2.5, 3.0)
CIRCLE = "$d_{g1}/d_1$", "$d_{g2}/d_1$"
COLOUR = dict(zip(veciana_study.LAWS, PALETTE, strict=False))
PROFILES = {"involute": "-", "cycloid": "--", "cycloid, exact speeds": ":"}
#: Half the pinion's angle from one pair to the next, rad.
HALF = math.pi / veciana_study.PINION_TEETH
#: First and last contact, where the contact ratio is 1, as `UnitContact` takes them.
ENDS = np.array([-HALF, HALF]), np.array([0.5, 0.5])


def figure_1(_: Path) -> Figure:
    """Friction coefficient against slide-to-roll ratio at R 5 mm, V_e 5 m/s, p_H 2 GPa (Table 2)."""
    ratio = np.linspace(0.0, 1.0, 401)
    radius, speed, pressure = 5e-3, 5.0, 2.0e9
    load = 2.0 * math.pi * radius * pressure**2 / veciana_study.EFFECTIVE_MODULUS
    slid = ratio * speed
    rolled = speed + slid / 2, speed - slid / 2
    contact = local_contact(load + 0 * slid, 1 / radius + 0 * slid, speed + 0 * slid, slid, *rolled)
    figure = new_figure(4.4, 3.0)
    axes = figure.subplots()
    for law in veciana_study.LAWS:
        friction = surface_state(contact, veciana_study.closure_of(law)).friction_coefficient
        axes.plot(ratio, friction, color=COLOUR[law], label=law)
    axes.set(xlabel="Slide-to-roll ratio (–)", ylabel="Friction coefficient µ (–)", ylim=(0, None))
    axes.legend()
    return figure


def surfaces(law: veciana_study.Law, _: Path) -> Figure:
    """Efficiency over both generating circles; the thick curve is where the involute is as good."""
    circle = np.linspace(0.1, 0.4, 31)
    approach, recess = np.meshgrid(circle, circle, indexing="ij")
    studies = {drive: veciana_study.DriveUnderLaw(*drive, law) for drive in veciana_study.DRIVES}
    percentages = {drive: 100.0 * study.cycloid(approach, recess) for drive, study in studies.items()}
    figure = new_figure(8.2, 5.0)
    panels = figure.subplots(2, 3, sharex=True, sharey=True)
    steps = np.linspace(min(map(np.min, percentages.values())), max(map(np.max, percentages.values())), 15)
    filled: Any = None
    for letter, axes, drive in zip("abcdef", panels.flat, PANELS, strict=True):
        filled = axes.contourf(approach, recess, percentages[drive], levels=steps, cmap="viridis")
        level = [100.0 * studies[drive].involute()]
        axes.contour(approach, recess, percentages[drive], levels=level, colors=[PALETTE[1]], linewidths=2.0)
        axes.set_title(f"i = {drive[0]:g}, m = {drive[1] * 1e3:g} mm")
        axes.grid(False)
        mark_panel(axes, letter)
    for axes in panels[-1]:
        axes.set_xlabel(CIRCLE[0])
    for axes in panels[:, 0]:
        axes.set_ylabel(CIRCLE[1])
    bar = figure.colorbar(filled, ax=panels, shrink=0.8, format="%.2f")
    bar.set_label(f"Efficiency (%), {law}")
    return figure


def drive_of(circle: float) -> Assembly:
    """The gears i = 1, m = 2 mm with generating circles d_g1 = d_g2 over d_1 and a contact ratio of 1."""
    module = 2e-3
    radius = module * veciana_study.PINION_TEETH / 2.0
    pair = veciana_study.DriveUnderLaw(1.0, module, "EHL").cycloid_pair(circle, rotation=ENDS)
    tip = float(np.hypot(pair.pinion_normal_arm, pair.pinion_friction_arm)[-1])
    mm = f"{1e3 * 2.0 * radius * circle} mm"
    changes: dict[str, Any] = {"drive.module": "2 mm"}
    changes |= {f"drive.shape.{name}_circle": mm for name in ("approach", "recess")}
    for side in SIDES:
        teeth = {"teeth": int(veciana_study.PINION_TEETH), "bore_radius": "10 mm"}
        teeth |= {"addendum": (tip - radius) / module, "dedendum": (tip - radius) / module + 0.25}
        changes |= {f"drive.{side}.{key}": value for key, value in teeth.items()}
    case = load_scenario("efficiency-cycloidal-23-47", changes)
    assert isinstance(case, EfficiencyCase)
    return assemble(family(case.family), case.drive)


def figure_7(_: Path) -> Figure:
    """Teeth with generating circles of 0.1 and 0.25 d_1 as a pair begins contact, one scale for both."""
    figure = new_figure(8.2, 3.4)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for letter, axes, circle in zip("ab", panels, (0.1, 0.25), strict=True):
        assembly = drive_of(circle)
        gears = gears_in_mesh(assembly)
        named = {name: place for name, place in gears.key_points.items() if name in ("B_g", "P", "B_p")}
        draw_gears(axes, gears._replace(key_points=named))
        start = np.array(position(assembly.path, assembly.r_start)) * 1e3
        axes.plot(*np.stack([-0.4 * start, 1.25 * start], axis=-1), color=PALETTE[2], linewidth=1.0)
        study = veciana_study.DriveUnderLaw(1.0, 2e-3, "EHL")
        height = 1e3 * veciana_study.contact_height(study.cycloid_pair(circle, rotation=ENDS))
        angle = math.degrees(float(assembly.path.pressure_angle(assembly.r_start)))
        text = f"$d_g$ = {circle:g} $d_1$: α′ = {abs(angle):.1f}°, contact height {height:.2f} mm"
        mark_panel(axes, letter, text)
        axes.set(xlim=(-4.5, 4.5), ylim=(-3.2, 3.2))
    return figure


def figure_8(_: Path) -> Figure:
    """Contact height of the pinion and maximum pressure angle against the generating circles."""
    study = veciana_study.DriveUnderLaw(1.0, 2e-3, "EHL")
    circle = np.linspace(0.1, 0.4, 121)
    heights = np.array([veciana_study.contact_height(study.cycloid_pair(c, rotation=ENDS)) for c in circle])
    figure = new_figure(4.6, 3.0)
    axes = figure.subplots()
    other = axes.twinx()
    other.spines["right"].set_visible(True)
    other.grid(False)
    (height,) = axes.plot(circle, 1e3 * heights, color=PALETTE[0], label="contact height")
    angles = np.degrees(HALF / (2.0 * circle))
    (angle,) = other.plot(circle, angles, color=PALETTE[1], label="maximum pressure angle")
    involute = 1e3 * veciana_study.contact_height(study.involute_pair(ENDS))
    axes.axhline(involute, color=PALETTE[0], linestyle=":", linewidth=0.9)
    other.axhline(20.0, color=PALETTE[1], linestyle=":", linewidth=0.9)
    axes.axvline(veciana_study.CHOSEN, color=QUIET, linestyle=":", linewidth=0.9)
    axes.set(xlabel="$d_{g1,2}/d_1$ (dotted: the involute, and 0.17)", ylabel="Contact height (mm)")
    other.set_ylabel("Pressure angle α′ (°)")
    axes.legend(handles=[height, angle])
    return figure


def figure_9(_: Path) -> Figure:
    """Contact conditions along the path, i = 1, m = 2 mm, d_g = 0.17 d_1."""
    psi = np.linspace(-HALF, HALF, 1200)  # an even number: not at the pitch point itself
    rotation = psi, np.full_like(psi, 1.0 / psi.size)
    studies = {law: veciana_study.DriveUnderLaw(1.0, 2e-3, law) for law in veciana_study.LAWS}
    study = studies["EHL"]
    pairs = (
        study.involute_pair(rotation),
        study.cycloid_pair(veciana_study.CHOSEN, rotation=rotation),
        study.cycloid_pair(veciana_study.CHOSEN, rotation=rotation, exact_speeds=True),
    )
    degrees = np.degrees(psi)
    figure = new_figure(8.6, 6.0)
    a, b, c, d = figure.subplots(2, 2, sharex=True).flat
    right = a.twinx()
    right.grid(False)
    right.spines["right"].set_visible(True)
    for (name, line), pair in zip(PROFILES.items(), pairs, strict=True):
        pinion, gear = study.pinion_speed * pair.pinion_speed, study.pinion_speed * pair.gear_speed
        a.plot(degrees, pinion + gear, line, color=PALETTE[0], label=f"$V_r$ {name}")
        a.plot(degrees, np.abs(pinion - gear), line, color=PALETTE[2], label=f"$V_s$ {name}")
        if line != ":":
            right.plot(degrees, 1e3 * (1.0 / pair.curvature), line, color=PALETTE[3], label=f"R {name}")
        for law in veciana_study.LAWS:
            state = studies[law].solve(pair)
            for axes, values in (
                (b, 1e-3 * state.normal_load),
                (c, state.friction_coefficient),
                (d, state.torque_ratio),
            ):
                axes.plot(degrees, values, line, color=COLOUR[law], label=f"{law}, {name}")
    a.set_ylabel("Speeds $V_r$ (sum), $V_s$ (m/s)")
    right.set(ylabel="Radius R (mm)", ylim=(0.0, 28.0))  # apart from the speeds
    b.set_ylabel("Normal load N (kN)")
    c.set_ylabel("Friction coefficient µ (–)")
    d.set_ylabel(r"$Γ_2/Γ_1$ (–)")
    for axes in (c, d):
        axes.set_xlabel("Pinion rotation $ψ_1$ from the pitch point (°)")
    for letter, axes in zip("abcd", (a, b, c, d), strict=True):
        mark_panel(axes, letter)
    handles = a.get_legend_handles_labels()
    more = right.get_legend_handles_labels()
    a.legend(handles[0] + more[0], handles[1] + more[1], fontsize=5.5, ncols=2, loc="upper center")
    figure.legend(*d.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def figure_10(_: Path) -> Figure:
    """Efficiency of both profiles against module, for gear ratios 1 … 3."""
    modules = np.linspace(2e-3, 6e-3, 9)
    figure = new_figure(8.6, 3.2)
    for letter, axes, law in zip("abc", figure.subplots(1, 3), veciana_study.LAWS, strict=True):
        for colour, ratio in zip(PALETTE, RATIOS, strict=False):
            studies = [veciana_study.DriveUnderLaw(ratio, float(module), law) for module in modules]
            efficiencies = (
                [study.involute() for study in studies],
                [study.cycloid(veciana_study.CHOSEN) for study in studies],
                [study.cycloid(veciana_study.CHOSEN, exact_speeds=True) for study in studies],
            )
            for (name, line), values in zip(PROFILES.items(), efficiencies, strict=True):
                percentages, label = 100.0 * np.array(values, dtype=float), f"i = {ratio:g}, {name}"
                axes.plot(1e3 * modules, percentages, line, color=colour, label=label)
        axes.set(title=law, xlabel="Module (mm)")
        mark_panel(axes, letter)
    axes = figure.axes[0]
    axes.set_ylabel("Efficiency (%)")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=5, fontsize=6.5)
    return figure


FIGURES: dict[str, Callable[[Path], Figure]] = {
    "figure-1": figure_1,
    "figure-5-ehl": partial(surfaces, "EHL"),
    "figure-6-mehl-a": partial(surfaces, "MEHL A"),
    "figure-6-mehl-b": partial(surfaces, "MEHL B"),
    "figure-7": figure_7,
    "figure-8": figure_8,
    "figure-9": figure_9,
    "figure-10": figure_10,
}
