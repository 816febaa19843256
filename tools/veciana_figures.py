"""Figures 1, 5, 6, 8, 9 and 10 of Veciana et al., Machines 12 (2024) 943, from tribodyn's own numbers.

python tools/veciana_figures.py pictures         # writes pictures/veciana-figure-*.png and the arrays behind

The mixed law is drawn in both readings: A as printed, B with Roelands' law at the greatest pressure and each
surface's own speed in the Péclet numbers. Dotted curves of cycloids have the motion of the contact along the
path in the rolling speeds, which the paper leaves out.
"""

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from tribodyn.efficiency.torque_ratio import UnitContact
from tribodyn.post.style import PALETTE, QUIET, house_style, mark_panel, new_figure, save
from tribodyn.tribology.friction import friction
from tribodyn.validation.veciana_study import (
    EFFECTIVE_MODULUS,
    LAWS,
    PINION_TEETH,
    Law,
    Study,
    contact_height,
    law_of,
)

CHOSEN = 0.17
CIRCLE = "$d_{g1}/d_1$", "$d_{g2}/d_1$"
COLOUR = dict(zip(LAWS, PALETTE, strict=False))


def figure_1(arrays: dict[str, np.ndarray]) -> Figure:
    """Friction coefficient against slide-to-roll ratio at R 5 mm, V_e 5 m/s, p_H 2 GPa (Table 2)."""
    ratio = np.linspace(0.0, 1.0, 401)
    radius, speed, pressure = 5e-3, 5.0, 2.0e9
    load = 2.0 * math.pi * radius * pressure**2 / EFFECTIVE_MODULUS
    slid = ratio * speed
    figure = new_figure(4.4, 3.0)
    axes = figure.subplots()
    arrays["ratio"] = ratio
    for law in LAWS:
        code, surfaces = law_of(law)
        rolled = speed + slid / 2, speed - slid / 2
        arrays[law] = friction(
            code, load + 0 * slid, 1 / radius + 0 * slid, speed + 0 * slid, slid, *rolled, surfaces
        )[0]
        axes.plot(ratio, arrays[law], color=COLOUR[law], label=law)
    axes.set_xlabel("Slide-to-roll ratio (–)")
    axes.set_ylabel("Friction coefficient µ (–)")
    axes.set_ylim(bottom=0)
    axes.legend()
    return figure


def surfaces(law: Law, arrays: dict[str, np.ndarray]) -> Figure:
    """Efficiency over both generating circles; the thick curve is where the involute is as good."""
    drives = [(1.0, 2e-3), (2.0, 2e-3), (3.0, 2e-3), (1.0, 2e-3), (1.0, 4e-3), (1.0, 6e-3)]
    circle = np.linspace(0.1, 0.4, 31)
    approach, recess = np.meshgrid(circle, circle, indexing="ij")
    arrays["circle"] = circle
    figure = new_figure(8.2, 5.0)
    panels = figure.subplots(2, 3, sharex=True, sharey=True)
    levels = []
    for ratio, module in drives:
        study = Study(ratio, module, law)
        key = f"i = {ratio:g}, m = {module * 1e3:g} mm"
        arrays[key] = 100.0 * study.cycloid(approach, recess)
        arrays[f"involute, {key}"] = np.array(100.0 * study.involute())
        levels += [arrays[key].min(), arrays[key].max()]
    steps = np.linspace(min(levels), max(levels), 15)
    filled: Any = None
    for letter, axes, (ratio, module) in zip("abcdef", panels.flat, drives, strict=True):
        key = f"i = {ratio:g}, m = {module * 1e3:g} mm"
        filled = axes.contourf(approach, recess, arrays[key], levels=steps, cmap="viridis")
        axes.contour(
            approach,
            recess,
            arrays[key],
            levels=[float(arrays[f"involute, {key}"])],
            colors=[PALETTE[1]],
            linewidths=2.0,
        )
        axes.set_title(key)
        axes.grid(False)
        mark_panel(axes, letter)
    for axes in panels[-1]:
        axes.set_xlabel(CIRCLE[0])
    for axes in panels[:, 0]:
        axes.set_ylabel(CIRCLE[1])
    bar = figure.colorbar(filled, ax=panels, shrink=0.8, format="%.2f")
    bar.set_label(f"Efficiency (%), {law}")
    return figure


def figure_8(arrays: dict[str, np.ndarray]) -> Figure:
    """Contact height of the pinion and greatest pressure angle against the generating circles."""
    study = Study(1.0, 2e-3, "EHL")
    half = math.pi / PINION_TEETH
    ends = np.array([-half, half]), np.array([0.5, 0.5])
    circle = np.linspace(0.1, 0.4, 121)
    arrays["circle"] = circle
    arrays["height"] = np.array([1e3 * contact_height(study.cycloid_pair(c, rotation=ends)) for c in circle])
    arrays["angle"] = np.degrees(half / (2.0 * circle))
    figure = new_figure(4.6, 3.0)
    axes = figure.subplots()
    other = axes.twinx()
    other.spines["right"].set_visible(True)
    other.grid(False)
    (height,) = axes.plot(circle, arrays["height"], color=PALETTE[0], label="contact height")
    (angle,) = other.plot(circle, arrays["angle"], color=PALETTE[1], label="greatest pressure angle")
    involute = 1e3 * contact_height(study.involute_pair(ends))
    axes.axhline(involute, color=PALETTE[0], linestyle=":", linewidth=0.9)
    other.axhline(20.0, color=PALETTE[1], linestyle=":", linewidth=0.9)
    axes.axvline(CHOSEN, color=QUIET, linestyle=":", linewidth=0.9)
    axes.set_xlabel("$d_{g1,2}/d_1$ (dotted: the involute, and 0.17)")
    axes.set_ylabel("Contact height (mm)")
    other.set_ylabel("Pressure angle α′ (°)")
    axes.legend(handles=[height, angle])
    return figure


def figure_9(arrays: dict[str, np.ndarray]) -> Figure:
    """Contact conditions along the path, i = 1, m = 2 mm, d_g = 0.17 d_1."""
    half = math.pi / PINION_TEETH
    psi = np.linspace(-half, half, 1200)  # an even number: not at the pitch point itself
    rotation = psi, np.full_like(psi, 1.0 / psi.size)
    degrees = np.degrees(psi)
    arrays["rotation"] = degrees
    study = Study(1.0, 2e-3, "EHL")
    pairs: dict[str, tuple[UnitContact, str]] = {
        "involute": (study.involute_pair(rotation), "-"),
        "cycloid": (study.cycloid_pair(CHOSEN, rotation=rotation), "--"),
        "cycloid, exact speeds": (study.cycloid_pair(CHOSEN, rotation=rotation, exact_speeds=True), ":"),
    }
    figure = new_figure(8.6, 6.0)
    a, b, c, d = figure.subplots(2, 2, sharex=True).flat
    right = a.twinx()
    right.grid(False)
    right.spines["right"].set_visible(True)
    for name, (pair, line) in pairs.items():
        speeds = study.pinion_speed * pair.pinion_speed, study.pinion_speed * pair.gear_speed
        for label, values, colour in (
            ("$V_r$", speeds[0] + speeds[1], PALETTE[0]),
            ("$V_s$", np.abs(speeds[0] - speeds[1]), PALETTE[2]),
        ):
            arrays[f"{label}, {name}"] = values
            a.plot(degrees, values, line, color=colour, label=f"{label} {name}")
        if line != ":":
            right.plot(degrees, 1e3 / pair.curvature, line, color=PALETTE[3], label=f"R {name}")
        for law in LAWS:
            state = Study(1.0, 2e-3, law).solve(pair)
            arrays[f"N, {law}, {name}"] = state.normal_load
            arrays[f"mu, {law}, {name}"] = state.friction_coefficient
            arrays[f"torque ratio, {law}, {name}"] = state.torque_ratio
            for axes, values in (
                (b, state.normal_load * 1e-3),
                (c, state.friction_coefficient),
                (d, state.torque_ratio),
            ):
                axes.plot(degrees, values, line, color=COLOUR[law], label=f"{law}, {name}")
    a.set_ylabel("Speeds $V_r$ (sum), $V_s$ (m/s)")
    right.set_ylabel("Radius R (mm)")
    right.set_ylim(0.0, 28.0)  # apart from the speeds
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


def figure_10(arrays: dict[str, np.ndarray]) -> Figure:
    """Efficiency of both profiles against module, for gear ratios 1 … 3."""
    modules, ratios = np.linspace(2e-3, 6e-3, 9), (1.0, 1.5, 2.0, 2.5, 3.0)
    arrays["module"] = modules
    figure = new_figure(8.6, 3.2)
    for letter, axes, law in zip("abc", figure.subplots(1, 3), LAWS, strict=True):
        for colour, ratio in zip(PALETTE, ratios, strict=False):
            studies = [Study(ratio, float(module), law) for module in modules]
            for name, line, values in (
                ("involute", "-", [study.involute() for study in studies]),
                ("cycloid", "--", [study.cycloid(CHOSEN) for study in studies]),
                (
                    "cycloid, exact speeds",
                    ":",
                    [study.cycloid(CHOSEN, exact_speeds=True) for study in studies],
                ),
            ):
                key = f"{law}, i = {ratio:g}, {name}"
                arrays[key] = 100.0 * np.array(values, dtype=float)
                axes.plot(modules * 1e3, arrays[key], line, color=colour, label=f"i = {ratio:g}, {name}")
        axes.set_title(law)
        axes.set_xlabel("Module (mm)")
        mark_panel(axes, letter)
    axes = figure.axes[0]
    axes.set_ylabel("Efficiency (%)")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=5, fontsize=6.5)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, nargs="?", default=Path("veciana"))
    folder: Path = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    drawings = {
        "1": figure_1,
        "5-ehl": lambda arrays: surfaces("EHL", arrays),
        "6-mehl-a": lambda arrays: surfaces("MEHL A", arrays),
        "6-mehl-b": lambda arrays: surfaces("MEHL B", arrays),
        "8": figure_8,
        "9": figure_9,
        "10": figure_10,
    }
    for name, draw in drawings.items():
        arrays: dict[str, np.ndarray] = {}
        with house_style():
            figure = draw(arrays)
        print(save(figure, folder / f"veciana-figure-{name}.png"))
        np.savez(folder / f"veciana-figure-{name}.npz", **arrays)  # pyright: ignore[reportArgumentType]


if __name__ == "__main__":
    main()
