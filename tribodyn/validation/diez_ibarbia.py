"""Diez-Ibarbia et al., efficiency of spur gears with a shifting profile: what needs no load contact model."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.case import Case
from tribodyn.efficiency.loss_factor import exact, hoehn, tip_contact_ratios
from tribodyn.efficiency.shift import SCENARIOS, Scenario, shifted
from tribodyn.geometry.drive import Drive
from tribodyn.geometry.involute import FAMILY
from tribodyn.scenario.load import load_scenario
from tribodyn.surfaces import nominal_conditions
from tribodyn.tribology.mean_friction import niemann
from tribodyn.validation.rows import Row, compare, published

PAPER = "diez-ibarbia"
#: Operating conditions: power W, speed rpm.
CONDITIONS = {
    "OC1": (25e3, 1500.0),
    "OC2": (25e3, 6000.0),
    "OC3": (50e3, 3000.0),
    "OC4": (100e3, 1500.0),
    "OC5": (100e3, 6000.0),
}
NO_CONTACT_MODEL = "needs the finite-element load contact model, which is not in yet"


def mean_friction(condition: str) -> float:
    """Niemann's mean friction coefficient of the paper's pair at an operating condition."""
    power, rpm = CONDITIONS[condition]
    speed = rpm * math.pi / 30.0
    overrides = {
        "operating.pinion_speed": f"{speed!r} rad/s",
        "operating.gear_torque": f"{2.0 * power / speed!r} N*m",
    }
    return float(niemann(nominal_conditions(_case(overrides))))


def drive() -> Drive:
    """Return the paper's pair without shift."""
    return _case({}).drive


def _case(overrides: dict[str, str]) -> Case:
    case = load_scenario("involute-18-36", overrides)
    assert isinstance(case, Case)
    return case


def loss_factors(pair: Drive) -> tuple[float, float]:
    """H_v by Höhn's formula and by the integral behind it."""
    tips = tip_contact_ratios(FAMILY, pair)
    teeth, ratio = pair.pinion.teeth, pair.gear.teeth / pair.pinion.teeth
    return hoehn(*tips, teeth, ratio), exact(*tips, teeth, ratio)


def peak(scenario: Scenario) -> tuple[float, float]:
    """Shift at which Höhn's efficiency is greatest, and the shift beyond which it is below that without."""
    from scipy.optimize import brentq, minimize_scalar

    base = drive()

    def factor(shift: float) -> float:
        return loss_factors(shifted(base, scenario, shift))[0]

    best = float(minimize_scalar(factor, bounds=(0.0, 0.4), method="bounded").x)  # pyright: ignore
    start = factor(0.0)
    back = brentq(lambda shift: factor(shift) - start, best, 0.6)
    return best, float(back)  # pyright: ignore[reportArgumentType]


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows of the paper; those of its load contact model are reported as not computed."""
    base = drive()
    by_hoehn, by_integral = loss_factors(base)
    values: dict[str, tuple[Any, str]] = {
        "diez/contact-ratio": (sum(tip_contact_ratios(FAMILY, base)), ""),
    }
    efficiency = {}
    for count, name in enumerate(CONDITIONS):
        mu = mean_friction(name)
        efficiency[name] = 1.0 - mu * by_hoehn
        key = f"diez/{name.lower()}"
        values[f"{key}-hohn"] = (
            100.0 * efficiency[name],
            f"Höhn; by the integral {100.0 * (1.0 - mu * by_integral):.3f}; ours mu {mu:.5f}",
        )
        values[f"{key}-lcm"] = (None, NO_CONTACT_MODEL)
        if progress:
            progress((count + 1) / len(CONDITIONS))
    prefix = "diez/claim-"
    order = sorted(efficiency, key=lambda name: -efficiency[name])
    values[f"{prefix}efficiency-order-oc2-oc5-oc3-oc1-oc4"] = (
        order == ["OC2", "OC5", "OC3", "OC1", "OC4"],
        "by Höhn: " + " > ".join(f"{name} {100 * efficiency[name]:.2f}" for name in order),
    )
    values[f"{prefix}efficiency-falls-with-shift"] = _falls_with_shift(base)
    table = published(PAPER)
    return [compare(table[key], *values.get(key, (None, NO_CONTACT_MODEL))) for key in table]


def _falls_with_shift(base: Drive) -> tuple[bool, str]:
    falls, notes = [], []
    mu = mean_friction("OC1")
    for name in SCENARIOS:
        shifts = np.array([0.0, 0.1, 0.2] if name == "S1" else [0.0, 0.1, 0.3, 0.5, 0.7])
        factors = np.array([loss_factors(shifted(base, name, float(x))) for x in shifts])
        course = ", ".join(f"{100 * (1 - mu * value):.3f}" for value in factors[:, 0])
        falls.append(bool(np.all(np.diff(factors[:, 0]) > 0)))
        if name == "S1":
            notes.append(f"{name} OC1 {course}: tips and sliding unchanged, Höhn's value cannot move")
            continue
        best, back = peak(name)
        over = factors[-1, 0] / factors[-1, 1] - 1.0
        notes.append(
            f"{name} OC1 {course}: rises to x = {best:.3f} and is below x = 0 only beyond {back:.3f}; "
            f"at x = 0.7 Höhn's formula overstates the loss by {100 * over:.1f} %"
        )
    return all(falls), "by Höhn: " + "; ".join(notes)
