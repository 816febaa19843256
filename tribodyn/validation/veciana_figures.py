"""Figures 1, 5, 6, 8, 9 and 10 of Veciana et al., Machines 12 (2024) 943.

The mixed law is drawn in both readings: A as printed, B with Roelands' law at the maximum pressure and each
surface's own speed in the Péclet numbers. Dotted curves of cycloids have the motion of the contact along the
path in the rolling speeds, which the paper leaves out.
"""

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.style import PALETTE, QUIET, mark_panel, new_figure
from tribodyn.studies.efficiency.published import UnitContact
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.surface_state import surface_state
from tribodyn.validation.veciana_study import (
    CHOSEN,
    DRIVES,
    EFFECTIVE_MODULUS,
    LAWS,
    PINION_TEETH,
    DriveUnderLaw,
    Law,
    closure_of,
    contact_height,
)

Arrays = dict[str, np.ndarray]

#: Drives of the panels of figures 5 and 6, and the gear ratios of figure 10.
PANELS = (*DRIVES[:3], DRIVES[0], *DRIVES[3:])
RATIOS = (1.0, 1.5, 2.0, 2.5, 3.0)


def drive_key(ratio: float, module: float) -> str:
    """Name of a drive in the arrays."""
    return f"i = {ratio:g}, m = {module * 1e3:g} mm"


def coefficients() -> Arrays:
    """Friction coefficient against slide-to-roll ratio at R 5 mm, V_e 5 m/s, p_H 2 GPa (Table 2)."""
    ratio = np.linspace(0.0, 1.0, 401)
    radius, speed, pressure = 5e-3, 5.0, 2.0e9
    load = 2.0 * math.pi * radius * pressure**2 / EFFECTIVE_MODULUS
    slid = ratio * speed
    rolled = speed + slid / 2, speed - slid / 2
    arrays = {"slide-to-roll ratio [1]": ratio}
    for law in LAWS:
        contact = local_contact(load + 0 * slid, 1 / radius + 0 * slid, speed + 0 * slid, slid, *rolled)
        arrays[f"{law} [1]"] = surface_state(contact, closure_of(law)).friction_coefficient
    return arrays


def efficiencies(law: Law) -> Arrays:
    """Efficiency over both generating circles, and the involute's."""
    circle = np.linspace(0.1, 0.4, 31)
    approach, recess = np.meshgrid(circle, circle, indexing="ij")
    arrays = {"circle over d_1 [1]": circle}
    for ratio, module in DRIVES:
        study = DriveUnderLaw(ratio, module, law)
        arrays[f"{drive_key(ratio, module)} [1]"] = study.cycloid(approach, recess)
        arrays[f"involute, {drive_key(ratio, module)} [1]"] = np.array(study.involute())
    return arrays


def heights() -> Arrays:
    """Contact height of the pinion and maximum pressure angle against the generating circles."""
    study = DriveUnderLaw(1.0, 2e-3, "EHL")
    half = math.pi / PINION_TEETH
    ends = np.array([-half, half]), np.array([0.5, 0.5])
    circle = np.linspace(0.1, 0.4, 121)
    return {
        "circle over d_1 [1]": circle,
        "height [m]": np.array([contact_height(study.cycloid_pair(c, rotation=ends)) for c in circle]),
        "involute height [m]": np.array(contact_height(study.involute_pair(ends))),
        "angle [rad]": half / (2.0 * circle),
    }


def conditions() -> Arrays:
    """Contact conditions along the path, i = 1, m = 2 mm, d_g = 0.17 d_1."""
    half = math.pi / PINION_TEETH
    psi = np.linspace(-half, half, 1200)  # an even number: not at the pitch point itself
    rotation = psi, np.full_like(psi, 1.0 / psi.size)
    study = DriveUnderLaw(1.0, 2e-3, "EHL")
    pairs: dict[str, UnitContact] = {
        "involute": study.involute_pair(rotation),
        "cycloid": study.cycloid_pair(CHOSEN, rotation=rotation),
        "cycloid, exact speeds": study.cycloid_pair(CHOSEN, rotation=rotation, exact_speeds=True),
    }
    arrays = {"rotation [rad]": psi}
    for name, pair in pairs.items():
        speeds = study.pinion_speed * pair.pinion_speed, study.pinion_speed * pair.gear_speed
        arrays[f"sum of speeds, {name} [m per s]"] = speeds[0] + speeds[1]
        arrays[f"sliding, {name} [m per s]"] = np.abs(speeds[0] - speeds[1])
        arrays[f"radius, {name} [m]"] = 1.0 / pair.curvature
        for law in LAWS:
            state = DriveUnderLaw(1.0, 2e-3, law).solve(pair)
            arrays[f"load, {law}, {name} [N]"] = state.normal_load
            arrays[f"friction, {law}, {name} [1]"] = state.friction_coefficient
            arrays[f"torque ratio, {law}, {name} [1]"] = state.torque_ratio
    return arrays


def by_module() -> Arrays:
    """Efficiency of both profiles against module, for gear ratios 1 … 3."""
    modules = np.linspace(2e-3, 6e-3, 9)
    arrays = {"module [m]": modules}
    for law in LAWS:
        for ratio in RATIOS:
            studies = [DriveUnderLaw(ratio, float(module), law) for module in modules]
            values = {
                "involute": [study.involute() for study in studies],
                "cycloid": [study.cycloid(CHOSEN) for study in studies],
                "cycloid, exact speeds": [study.cycloid(CHOSEN, exact_speeds=True) for study in studies],
            }
            for name, efficiency in values.items():
                arrays[f"{law}, i = {ratio:g}, {name} [1]"] = np.array(efficiency, dtype=float)
    return arrays


CIRCLE = "$d_{g1}/d_1$", "$d_{g2}/d_1$"
COLOUR = dict(zip(LAWS, PALETTE, strict=False))
PROFILES = {"involute": "-", "cycloid": "--", "cycloid, exact speeds": ":"}


class Plot(NamedTuple):
    """A figure: what computes its arrays, and what draws these."""

    compute: Callable[[], Arrays]
    draw: Callable[[Arrays], Figure]

    def __call__(self, _: Path) -> Figure:
        """Draw from fresh numbers; the study needs no record."""
        return self.draw(self.compute())


def figure_1(arrays: Arrays) -> Figure:
    """Friction coefficient against slide-to-roll ratio."""
    figure = new_figure(4.4, 3.0)
    axes = figure.subplots()
    for law in LAWS:
        axes.plot(arrays["slide-to-roll ratio [1]"], arrays[f"{law} [1]"], color=COLOUR[law], label=law)
    axes.set_xlabel("Slide-to-roll ratio (–)")
    axes.set_ylabel("Friction coefficient µ (–)")
    axes.set_ylim(bottom=0)
    axes.legend()
    return figure


def surfaces(law: Law, arrays: Arrays) -> Figure:
    """Draw the surfaces; the thick curve is where the involute is as good."""
    circle = arrays["circle over d_1 [1]"]
    approach, recess = np.meshgrid(circle, circle, indexing="ij")
    figure = new_figure(8.2, 5.0)
    panels = figure.subplots(2, 3, sharex=True, sharey=True)
    keys = [drive_key(*drive) for drive in PANELS]
    percentages = [100.0 * arrays[f"{key} [1]"] for key in keys]
    steps = np.linspace(min(map(np.min, percentages)), max(map(np.max, percentages)), 15)
    filled: Any = None
    for letter, axes, key, values in zip("abcdef", panels.flat, keys, percentages, strict=True):
        filled = axes.contourf(approach, recess, values, levels=steps, cmap="viridis")
        level = 100.0 * float(arrays[f"involute, {key} [1]"])
        axes.contour(approach, recess, values, levels=[level], colors=[PALETTE[1]], linewidths=2.0)
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


def figure_8(arrays: Arrays) -> Figure:
    """Contact height and pressure angle against the generating circles."""
    circle = arrays["circle over d_1 [1]"]
    figure = new_figure(4.6, 3.0)
    axes = figure.subplots()
    other = axes.twinx()
    other.spines["right"].set_visible(True)
    other.grid(False)
    (height,) = axes.plot(circle, 1e3 * arrays["height [m]"], color=PALETTE[0], label="contact height")
    angles = np.degrees(arrays["angle [rad]"])
    (angle,) = other.plot(circle, angles, color=PALETTE[1], label="maximum pressure angle")
    involute = 1e3 * float(arrays["involute height [m]"])
    axes.axhline(involute, color=PALETTE[0], linestyle=":", linewidth=0.9)
    other.axhline(20.0, color=PALETTE[1], linestyle=":", linewidth=0.9)
    axes.axvline(CHOSEN, color=QUIET, linestyle=":", linewidth=0.9)
    axes.set_xlabel("$d_{g1,2}/d_1$ (dotted: the involute, and 0.17)")
    axes.set_ylabel("Contact height (mm)")
    other.set_ylabel("Pressure angle α′ (°)")
    axes.legend(handles=[height, angle])
    return figure


def figure_9(arrays: Arrays) -> Figure:
    """Contact conditions along the path."""
    degrees = np.degrees(arrays["rotation [rad]"])
    figure = new_figure(8.6, 6.0)
    a, b, c, d = figure.subplots(2, 2, sharex=True).flat
    right = a.twinx()
    right.grid(False)
    right.spines["right"].set_visible(True)
    for name, line in PROFILES.items():
        for label, key, colour in (("$V_r$", "sum of speeds", PALETTE[0]), ("$V_s$", "sliding", PALETTE[2])):
            values = arrays[f"{key}, {name} [m per s]"]
            a.plot(degrees, values, line, color=colour, label=f"{label} {name}")
        if line != ":":
            radius = 1e3 * arrays[f"radius, {name} [m]"]
            right.plot(degrees, radius, line, color=PALETTE[3], label=f"R {name}")
        for law in LAWS:
            for axes, values in (
                (b, 1e-3 * arrays[f"load, {law}, {name} [N]"]),
                (c, arrays[f"friction, {law}, {name} [1]"]),
                (d, arrays[f"torque ratio, {law}, {name} [1]"]),
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


def figure_10(arrays: Arrays) -> Figure:
    """Efficiency against module for several gear ratios."""
    figure = new_figure(8.6, 3.2)
    for letter, axes, law in zip("abc", figure.subplots(1, 3), LAWS, strict=True):
        for colour, ratio in zip(PALETTE, RATIOS, strict=False):
            for name, line in PROFILES.items():
                values = 100.0 * arrays[f"{law}, i = {ratio:g}, {name} [1]"]
                label = f"i = {ratio:g}, {name}"
                axes.plot(1e3 * arrays["module [m]"], values, line, color=colour, label=label)
        axes.set_title(law)
        axes.set_xlabel("Module (mm)")
        mark_panel(axes, letter)
    axes = figure.axes[0]
    axes.set_ylabel("Efficiency (%)")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=5, fontsize=6.5)
    return figure


FIGURES: dict[str, Plot] = {
    "figure-1": Plot(coefficients, figure_1),
    "figure-5-ehl": Plot(partial(efficiencies, "EHL"), partial(surfaces, "EHL")),
    "figure-6-mehl-a": Plot(partial(efficiencies, "MEHL A"), partial(surfaces, "MEHL A")),
    "figure-6-mehl-b": Plot(partial(efficiencies, "MEHL B"), partial(surfaces, "MEHL B")),
    "figure-8": Plot(heights, figure_8),
    "figure-9": Plot(conditions, figure_9),
    "figure-10": Plot(by_module, figure_10),
}
