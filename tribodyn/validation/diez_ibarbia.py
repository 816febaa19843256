"""Diez-Ibarbia et al., efficiency of spur gears with a shifting profile: by Höhn and by load contact."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.case import Case
from tribodyn.compliance.load_sharing import PairFlexibility, flexibility, share_load
from tribodyn.efficiency.load_contact import load_contact
from tribodyn.efficiency.loss_factor import exact, hoehn, tip_contact_ratios
from tribodyn.efficiency.shift import SCENARIOS, Scenario, shifted
from tribodyn.geometry.assembly import assemble
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
# Mesh of the shifted pairs: efficiencies within 1e-5 of those of the finer one used without shift.
_LEVEL_OF_SHIFTED = 1


def mean_friction(condition: str) -> float:
    """Niemann's mean friction coefficient of the paper's pair at an operating condition."""
    power, rpm = CONDITIONS[condition]
    speed = rpm * math.pi / 30.0
    overrides = {
        "operating.pinion_speed": f"{speed!r} rad/s",
        "operating.gear_torque": f"{2.0 * power / speed!r} N*m",
    }
    return float(niemann(nominal_conditions(_case(overrides))))


def gear_torque(condition: str) -> float:
    """Torque on the gear at an operating condition, N m; the paper's torques are the pinion's."""
    power, rpm = CONDITIONS[condition]
    return 2.0 * power / (rpm * math.pi / 30.0)


def elastic(pair: Drive, level: int | None = None) -> PairFlexibility:
    """Finite elements of the paper's pair, shifted or not, of its material."""
    options = {} if level is None else {"level": level}
    return flexibility(assemble(FAMILY, pair), _case({}).materials, **options)


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
    """All rows of the paper."""
    base = drive()
    by_hoehn, by_integral = loss_factors(base)
    values: dict[str, tuple[Any, str]] = {
        "diez/contact-ratio": (sum(tip_contact_ratios(FAMILY, base)), ""),
    }
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
    values[f"{prefix}efficiency-falls-with-shift"] = _falls_with_shift(base, progress)
    table = published(PAPER)
    return [compare(table[key], *values[key]) for key in table]


def _step_at_pitch_point(flexible: PairFlexibility) -> tuple[bool, str]:
    mu, torque = mean_friction("OC4"), gear_torque("OC4")
    path: Any = flexible.assembly.path
    angle = float(path.pressure_angle(0.0))
    full = torque / (path.gear_pitch_radius * math.cos(angle))
    beside = np.array([[-1e-7], [1e-7]])
    before, after = share_load(flexible, beside, torque, mu).normal_load[:, 0] / full
    slope = mu * math.tan(angle)
    agree = bool(abs(before * (1.0 - slope) - 1.0) < 1e-4 and abs(after * (1.0 + slope) - 1.0) < 1e-4)
    return agree, f"OC4: {before:.4f} to {after:.4f}"


def _falls_with_shift(base: Drive, progress: Callable[[float], None] | None) -> tuple[bool, str]:
    falls, notes, by_model = [], [], []
    mu = mean_friction("OC1")
    for name in SCENARIOS:
        shifts = np.array([0.0, 0.1, 0.2] if name == "S1" else [0.0, 0.1, 0.3, 0.5, 0.7])
        factors = np.array([loss_factors(shifted(base, name, float(x))) for x in shifts])
        course = ", ".join(f"{100 * (1 - mu * value):.3f}" for value in factors[:, 0])
        falls.append(bool(np.all(np.diff(factors[:, 0]) > 0)))
        losses = [load_contact_efficiency(shifted(base, name, float(x)), "OC1") for x in shifts]
        by_model.append(f"{name} " + ", ".join(f"{100 * value:.3f}" for value in losses))
        falls.append(bool(np.all(np.diff(losses) < 0)))
        if progress:
            progress(0.5 + 0.5 * len(by_model) / len(SCENARIOS))
        if name == "S1":
            notes.append(f"{name} OC1 {course}: tips and sliding unchanged, Höhn's value cannot move")
            continue
        best, back = peak(name)
        over = factors[-1, 0] / factors[-1, 1] - 1.0
        notes.append(
            f"{name} OC1 {course}: rises to x = {best:.3f} and is below x = 0 only beyond {back:.3f}; "
            f"at x = 0.7 Höhn's formula overstates the loss by {100 * over:.1f} %"
        )
    return all(falls), "by Höhn: " + "; ".join(notes) + "; by the load contact model: " + "; ".join(by_model)


def load_contact_efficiency(pair: Drive, condition: str) -> float:
    """Efficiency of a shifted pair at an operating condition by the load contact model."""
    flexible = elastic(pair, _LEVEL_OF_SHIFTED)
    return load_contact(flexible, gear_torque(condition), mean_friction(condition)).efficiency
