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
from tribodyn.validation.papers.diez_ibarbia_study import (
    CONDITIONS,
    SHIFTS,
    LoadContact,
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
#: The other reading of Table 1.
ON_GEAR = "Table 1's torque on the gear"
#: Share below which a difference of contact ratios, and of losses, is negligible: the tolerances of rows.
_EQUAL_RATIO, _EQUAL_LOSS = 0.01, 0.05


def rows(folder: Path, progress: Callable[[float], None]) -> list[Row]:
    """All rows of the paper."""
    base = drive()
    by_hoehn, by_integral = loss_factors(base)
    theory = sum(tip_contact_ratios(FAMILY, base))
    values: dict[str, tuple[Any, str]] = {"diez/contact-ratio": (theory, "")}
    flexible = elastic(base)
    cycles: dict[bool, dict[str, LoadContact]] = {False: {}, True: {}}
    for count, name in enumerate(CONDITIONS):
        for on_gear in cycles:
            mu = mean_friction(name, on_gear)
            cycles[on_gear][name] = load_contact(flexible, gear_torque(name, on_gear), mu)
        mu, key = mean_friction(name), f"diez/{name.lower()}"
        values[f"{key}-hohn"] = (
            100.0 * (1.0 - mu * by_hoehn),
            f"Höhn; by the integral {100.0 * (1.0 - mu * by_integral):.3f}; ours mu {mu:.5f}",
        )
        cycle = cycles[False][name]
        values[f"{key}-lcm"] = (
            100.0 * cycle.efficiency,
            f"effective contact ratio {cycle.contact_ratio:.3f}",
        )
        progress(0.5 * (count + 1) / len(CONDITIONS))
    on_pinion, on_gear = (_unshifted(cycles[side], theory, by_hoehn, side) for side in cycles)
    for key, (value, note) in on_pinion.items():
        values[key] = value, f"{note}; torque on the gear: {on_gear[key][1]}"
    values["diez/claim-a-step-of-the-load-sharing-at-the-pitch"] = _step_at_pitch_point(flexible)
    values |= _shifted(progress)
    return compare_paper(PAPER, values, {ON_GEAR: {key: value for key, (value, _) in on_gear.items()}})


def _unshifted(
    cycles: dict[str, LoadContact], theory: float, by_hoehn: float, on_gear: bool
) -> dict[str, tuple[bool, str]]:
    """Claims about the pair without shift, with Table 1's torques on the pinion or on the gear."""
    efficiency = {name: 1.0 - mean_friction(name, on_gear) * by_hoehn for name in CONDITIONS}
    order = sorted(efficiency, key=lambda name: -efficiency[name])
    by_model = {name: cycle.efficiency for name, cycle in cycles.items()}
    above = {name: 100.0 * (by_model[name] - efficiency[name]) for name in ("OC2", "OC1", "OC4")}
    ratios = [cycles[name].contact_ratio for name in above]
    longer = [ratio / theory - 1.0 for ratio in ratios]
    prefix = "diez/claim-"
    return {
        f"{prefix}efficiency-order-oc2-oc5-oc3-oc1-oc4": (
            order
            == ["OC2", "OC5", "OC3", "OC1", "OC4"]
            == sorted(by_model, key=lambda name: -by_model[name]),
            "by Höhn: "
            + " > ".join(f"{name} {100 * efficiency[name]:.2f}" for name in order)
            + ", the same by the load contact model",
        ),
        f"{prefix}lcm-below-h-hn-at-637-n-m-near-it-at-159": (
            above["OC4"] < 0.0 < above["OC2"] and abs(above["OC1"]) < 0.5 * abs(above["OC4"]),
            "load contact model less Höhn: "
            + ", ".join(f"{name} {value:+.3f} points" for name, value in above.items()),
        ),
        f"{prefix}effective-contact-ratio-above-the-theore": (
            theory < ratios[0] < ratios[1] < ratios[2],
            " / ".join(f"{ratio:.3f}" for ratio in ratios) + f" at OC2 / OC1 / OC4, theoretical {theory:.3f}",
        ),
        f"{prefix}contact-ratio-negligible-at-oc2": (
            longer[0] < _EQUAL_RATIO < longer[2],
            f"above the theoretical by {100 * longer[0]:.1f} % at OC2, {100 * longer[2]:.1f} % at OC4",
        ),
    }


def _step_at_pitch_point(flexible: PairFlexibility) -> tuple[bool, str]:
    mu, torque = mean_friction("OC4"), gear_torque("OC4")
    path: Any = flexible.assembly.path
    angle = float(path.pressure_angle(0.0))
    full = torque / (path.gear_pitch_radius * math.cos(angle))
    both_sides = np.array([[-1e-7], [1e-7]])
    before, after = LoadedFlanks(flexible).share(both_sides, torque, mu).normal_load[:, 0] / full
    slope = mu * math.tan(angle)
    agree = bool(abs(before * (1.0 - slope) - 1.0) < 1e-4 and abs(after * (1.0 + slope) - 1.0) < 1e-4)
    return agree, f"OC4: {before:.4f} to {after:.4f}"


def _shifted(progress: Callable[[float], None]) -> dict[str, tuple[bool, str]]:
    """Claims about shifted pairs, at all conditions and by both approaches."""
    courses, notes = {}, []
    for count, scenario in enumerate(SHIFTS):
        notes += [_by_hoehn(scenario), *_by_load_contact(scenario)]
        for name in CONDITIONS:
            courses[scenario, name] = np.array(_courses(scenario, name))  # (approach, shift)
        progress(0.5 + 0.5 * (count + 1) / len(SHIFTS))
    high = np.array(SHIFTS["S2"]) >= 0.3
    beyond = {key: course[:, high] < course[:, :1] for key, course in courses.items() if key[0] != "S1"}
    apart = {key: np.abs(course[1] - course[0]) for key, course in courses.items()}
    last = {name: [courses[scenario, name][:, -1] for scenario in ("S2", "S3")] for name in CONDITIONS}
    torque = [
        courses[s, less] > courses[s, more] for s in SHIFTS for less, more in (("OC1", "OC4"), ("OC2", "OC5"))
    ]
    speed = [
        courses[s, slow] < courses[s, fast] for s in SHIFTS for slow, fast in (("OC1", "OC3"), ("OC3", "OC5"))
    ]
    share = {name: np.max(apart["S3", name] / (1.0 - courses["S3", name][0])) for name in ("OC2", "OC4")}
    prefix = "diez/claim-"
    return {
        f"{prefix}approaches-negligibly-apart-at-oc2": (
            bool(share["OC2"] < _EQUAL_LOSS < share["OC4"]),
            f"apart by at most {100 * share['OC2']:.1f} % of Höhn's loss at OC2, "
            f"{100 * share['OC4']:.1f} % at OC4",
        ),
        f"{prefix}efficiency-falls-with-shift": (
            bool(all(np.all(np.diff(course) < 0.0) for course in courses.values())),
            "; ".join(notes),
        ),
        f"{prefix}lower-for-shifts-of-0.3-and-above": (
            bool(all(np.all(lower) for lower in beyond.values())),
            "S2 and S3, x = 0.3, 0.5, 0.7, by Höhn and by load contact, all conditions, below x = 0",
        ),
        f"{prefix}s3-below-s2-at-0.7": (
            bool(all(np.all(s3 < s2) for s2, s3 in last.values())),
            "S2, S3 by load contact: "
            + ", ".join(f"{name} {100 * s2[1]:.3f}, {100 * s3[1]:.3f}" for name, (s2, s3) in last.items()),
        ),
        f"{prefix}approaches-part-with-shift-s2": (
            bool(all(np.all(np.diff(apart["S2", name]) > 0.0) for name in CONDITIONS)),
            _parted(apart, "S2"),
        ),
        f"{prefix}approaches-part-most-in-s3": (
            bool(all(np.all(apart["S3", name][1:] > apart["S2", name][1:]) for name in CONDITIONS)),
            _parted(apart, "S3"),
        ),
        f"{prefix}more-torque-less-more-speed-more": (
            bool(np.all(np.concatenate([one.ravel() for one in (*torque, *speed)]))),
            "OC4 below OC1, OC5 below OC2; OC1 below OC3 below OC5, at every shift and by both approaches",
        ),
    }


def _parted(apart: dict[tuple[str, str], np.ndarray], scenario: str) -> str:
    return f"{scenario}, points over the shifts: " + ", ".join(
        f"{name} {' '.join(f'{100 * value:.3f}' for value in apart[scenario, name])}" for name in CONDITIONS
    )


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
