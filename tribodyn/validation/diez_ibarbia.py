"""Diez-Ibarbia et al., efficiency of spur gears with a shifting profile: by Höhn and by load contact."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.studies.efficiency.published import tip_contact_ratios
from tribodyn.validation.diez_ibarbia_study import (
    CONDITIONS,
    SHIFTS,
    Scenario,
    at_load,
    drive,
    elastic,
    equal_load_efficiencies,
    gear_torque,
    load_contact,
    loss_factors,
    mean_friction,
    peak,
)
from tribodyn.validation.rows import Row, compare_paper

PAPER = "diez-ibarbia"


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows of the paper."""
    base = drive()
    by_hoehn, by_integral = loss_factors(base)
    values: dict[str, tuple[Any, str]] = {"diez/contact-ratio": (sum(tip_contact_ratios(FAMILY, base)), "")}
    efficiency, at_load = {}, {}
    flexible = elastic(base)
    for count, name in enumerate(CONDITIONS):
        mu = mean_friction(name)
        efficiency[name] = 1.0 - mu * by_hoehn
        key = f"diez/{name.lower()}"
        values[f"{key}-hohn"] = (
            100.0 * efficiency[name],
            f"Höhn; by the integral {100.0 * (1.0 - mu * by_integral):.3f}; ours mu {mu:.5f}",
        )
        at_load[name] = load_contact(flexible, gear_torque(name), mu)
        values[f"{key}-lcm"] = (
            100.0 * at_load[name].efficiency,
            f"effective contact ratio {at_load[name].contact_ratio:.3f}",
        )
        if progress:
            progress(0.5 * (count + 1) / len(CONDITIONS))
    prefix = "diez/claim-"
    order = sorted(efficiency, key=lambda name: -efficiency[name])
    by_model = {name: cycle.efficiency for name, cycle in at_load.items()}
    values[f"{prefix}efficiency-order-oc2-oc5-oc3-oc1-oc4"] = (
        order == ["OC2", "OC5", "OC3", "OC1", "OC4"] == sorted(by_model, key=lambda name: -by_model[name]),
        "by Höhn: "
        + " > ".join(f"{name} {100 * efficiency[name]:.2f}" for name in order)
        + "; the same by the load contact model",
    )
    above = {name: 100.0 * (by_model[name] - efficiency[name]) for name in ("OC2", "OC1", "OC4")}
    values[f"{prefix}lcm-below-h-hn-at-637-n-m-near-it-at-159"] = (
        above["OC4"] < -0.05 and abs(above["OC1"]) < 0.03 and above["OC2"] > 0.0,
        "load contact model less Höhn: "
        + ", ".join(f"{name} {value:+.3f} points" for name, value in above.items()),
    )
    values[f"{prefix}a-step-of-the-load-sharing-at-the-pitch"] = _step_at_pitch_point(flexible)
    ratios = [at_load[name].contact_ratio for name in ("OC2", "OC1", "OC4")]
    theory = float(values["diez/contact-ratio"][0])
    values[f"{prefix}effective-contact-ratio-above-the-theore"] = (
        theory < ratios[0] < ratios[1] < ratios[2],
        " / ".join(f"{ratio:.3f}" for ratio in ratios) + f" at 40 / 159 / 637 N·m; theoretical {theory:.3f}",
    )
    values[f"{prefix}efficiency-falls-with-shift"] = _falls_with_shift(progress)
    return compare_paper(PAPER, values)


def _step_at_pitch_point(flexible: PairFlexibility) -> tuple[bool, str]:
    mu, torque = mean_friction("OC4"), gear_torque("OC4")
    path: Any = flexible.assembly.path
    angle = float(path.pressure_angle(0.0))
    full = torque / (path.gear_pitch_radius * math.cos(angle))
    beside = np.array([[-1e-7], [1e-7]])
    before, after = LoadedFlanks(flexible).share(beside, torque, mu).normal_load[:, 0] / full
    slope = mu * math.tan(angle)
    agree = bool(abs(before * (1.0 - slope) - 1.0) < 1e-4 and abs(after * (1.0 + slope) - 1.0) < 1e-4)
    return agree, f"OC4: {before:.4f} to {after:.4f}"


def _falls_with_shift(progress: Callable[[float], None] | None) -> tuple[bool, str]:
    falls, notes = [], []
    for count, scenario in enumerate(SHIFTS):
        notes += [_by_hoehn(scenario), *_by_load_contact(scenario)]
        for condition in CONDITIONS:
            falls += [np.all(np.diff(course) < 0.0) for course in _courses(scenario, condition)]
        if progress:
            progress(0.5 + 0.5 * (count + 1) / len(SHIFTS))
    return bool(all(falls)), "; ".join(notes)


def _courses(scenario: Scenario, condition: str) -> tuple[list[float], list[float]]:
    """Efficiency over the shifts by Höhn and by the load contact model."""
    shifts = SHIFTS[scenario]
    return (
        [equal_load_efficiencies(scenario, shift, condition)[0] for shift in shifts],
        [at_load(scenario, shift, condition).efficiency for shift in shifts],
    )


def _by_hoehn(scenario: Scenario) -> str:
    """Höhn's H_v is the same at every operating condition, and so is the course of his efficiency."""
    course = ", ".join(f"{100 * value:.3f}" for value in _courses(scenario, "OC1")[0])
    text = f"{scenario}, x = {', '.join(f'{shift:g}' for shift in SHIFTS[scenario])}, by Höhn OC1 {course}"
    if scenario == "S1":
        return f"{text}: tips and sliding unchanged, Höhn's value cannot move"
    best, back = peak(scenario)
    formula, integral = equal_load_efficiencies(scenario, SHIFTS[scenario][-1], "OC1")
    over = (1.0 - formula) / (1.0 - integral) - 1.0
    return (
        f"{text}: at every condition rises to x = {best:.3f} and is below x = 0 only beyond {back:.3f}; "
        f"at x = 0.7 Höhn's formula overstates the loss by {100 * over:.1f} %"
    )


def _by_load_contact(scenario: Scenario) -> list[str]:
    sentences = []
    for condition in CONDITIONS:
        _, values = _courses(scenario, condition)
        steps = np.diff(values)
        shifts = SHIFTS[scenario]
        course = "falls"
        if np.any(steps > 0.0):
            highest = int(np.argmax(values))
            course = "rises" if highest == len(shifts) - 1 else f"largest of these at {shifts[highest]:g}"
        efficiencies = ", ".join(f"{100 * value:.3f}" for value in values)
        sentences.append(f"{scenario} by load contact {condition} {efficiencies}: {course}")
    return sentences
