"""What an assessment was asked, and its numbers at a glance."""

import math
import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.gears.case import OiledCase
from tribodyn.gears.rating.standard import ZERO_CELSIUS
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import as_written
from tribodyn.input.names import under_one_name
from tribodyn.record.reader import MESHES
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.pages import first_page
from tribodyn.studies.assessment.pages.first_page import range_over

_RPM = 30.0 / math.pi


def asked(case: AssessmentCase, summary: Mapping[str, Any]) -> str:
    """The gears of every mesh, material, oil and duty."""
    groups: dict[str, list[OiledCase]] = {"": [case.own]} if case.own else {}
    if not case.own:
        for mesh in case.whole.meshes(case.gearbox.case):
            groups.setdefault(mesh.alike or mesh.name, []).append(mesh.pair)
    lines = []
    for group, pairs in groups.items():
        times = f", {len(pairs)} times" if len(pairs) > 1 else ""
        lines.append(f"{group}{times}: {_gears(pairs[0])}" if group else _gears(pairs[0]))
    materials = dict.fromkeys(one.name for pairs in groups.values() for one in pairs[0].materials)
    oil = case.oil
    rows = {
        "Gears": "; ".join(lines),
        "Material": " / ".join(materials),
        "Oil": first_page.oil_line(oil, float(oil.temperature), case.settings.lubrication),
        "Duty": _duty(case, summary),
    }
    return first_page.asked(rows)


def _gears(pair: OiledCase) -> str:
    drive, quality = as_written(family(pair.family), pair.drive), pair.quality
    given = drive.centre_distance
    centre = f", a {abs(given) * 1e3:.6g} mm" if given is not None else ""
    helix = f"β {math.degrees(drive.helix_angle):.6g}°, " if drive.helix_angle else ""
    grade = f"grade {quality.grade:g}, " if quality is not None else ""
    return (
        f"{pair.family} {drive.pinion.teeth:.0f}/{drive.gear.teeth:.0f}, module {drive.module * 1e3:.4g} mm, "
        f"{helix}x {drive.pinion.profile_shift:g}/{drive.gear.profile_shift:g}{centre}, "
        f"b {drive.pinion.face_width * 1e3:.4g}/{drive.gear.face_width * 1e3:.4g} mm, "
        f"{grade}Ra {pair.mean_roughness * 1e6:.3g} µm"
    )


#: How a scenario gives the load of a gearbox at its ends.
_LOADS = ("power", "input_torque", "output_torque")


def _duty(case: AssessmentCase, summary: Mapping[str, Any]) -> str:
    if case.own is None:
        typed = under_one_name(tomllib.loads(case.gearbox.case.toml).get("operating", {}))
        loads = [f"{name.replace('_', ' ')} {typed[name]}" for name in _LOADS if typed.get(name) is not None]
        turning = f"input at {case.speed * _RPM:.5g} rpm, ratio {summary['train_ratio']:.5g}"
        power = f"{summary['power_in_mean'] * 1e-3:.5g} kW"
        return f"{', '.join([*loads, turning])}; with the losses simulated {power} go in"
    drive, load = case.own.drive, case.own.operating.gear_torque
    torque = load / float(drive.gear.teeth / drive.pinion.teeth)
    return (
        f"{case.speed * torque * 1e-3:.4g} kW at {case.speed * _RPM:.5g} rpm of the pinion, "
        f"{torque:.4g} N m on the pinion, {load:.4g} N m on the gear"
    )


def tiles(summary: Mapping[str, Any]) -> str:
    """Numbers of the gearbox; which mesh has them, where there are several."""
    lost, named = summary.get("contact_loss_speed_from"), MESHES in summary
    samples, counts = summary.get("by_sample", {}), summary.get("sample_counts", {})
    shown: list[tuple[str, ...]] = []

    def tile(name: str, digits: str, unit: str, text: str, factor: float = 1.0, offset: float = 0.0) -> None:
        if summary.get(name) is not None:
            mesh = summary.get("worst_of", {}).get(name)
            value = factor * (float(summary[name]) + offset)
            where, samples_of = f", in {mesh}" if mesh else "", samples.get(name)
            ranges = range_over(samples_of, digits, factor, offset)
            shown.append((f"{value:{digits}} {unit}".rstrip(), f"{text}{where}", ranges))

    spread, highest, bulk = "", "", ""
    if "efficiency_lowest" in summary:
        ends = [f"{100.0 * summary[f'efficiency_{end}']:.2f}" for end in ("lowest", "highest")]
        spread = f"; {ends[0]} to {ends[1]} % by other laws"
    if "dynamic_factor_max" in summary:
        at = summary["dynamic_factor_max_speed"] * _RPM
        highest = f"; up to {summary['dynamic_factor_max']:.2f} at {at:.0f} rpm"
    if "theta_M" in summary.get("simulated", {}):
        bulk = f"; bulk {summary['simulated']['theta_M']['worst']:.0f} °C"
    alone, slow = " by tooth friction alone" * named, "slow rotation without K_A"
    tile("efficiency", ".2f", "%", f"efficiency{alone}{spread}", 100.0)
    tile("dynamic_factor", ".2f", "", f"dynamic factor at the duty{highest}")
    tile("mesh_load_factor", ".3f", "", "K_γ, load of the planet with most")
    tile("specific_film_min", ".2f", "", "minimum specific film λ_GF")
    tile("contact_temperature_max", ".0f", "°C", f"contact temperature{bulk}", 1.0, -ZERO_CELSIUS)
    pressed = "motion without K_A" if named else slow
    tile("hertz_pressure_max", ".2f", "GPa", f"maximum Hertz pressure, {pressed}", 1e-9)
    roots = [name for name in ("pinion_root_tension_max", "gear_root_tension_max") if name in summary]
    if roots:
        of_roots = [samples[name] for name in roots if name in samples]
        samples = {**samples, roots[0]: np.max(of_roots, axis=0)} if of_roots else samples
        most = max(roots, key=lambda name: summary[name])
        summary = {**summary, roots[0]: summary[most]}
        tile(roots[0], ".0f", "MPa", f"maximum root tension, {slow}", 1e-6)
    error = "loaded_transmission_error_peak_to_peak"
    tile(error, ".2f", "µm", "loaded transmission error, peak to peak", 1e6)
    turning = "input" if named else "pinion"
    shown.append(
        (
            "none" if lost is None else f"{lost * _RPM:.0f} rpm",
            "loss of contact over the speeds"
            if lost is None
            else f"contact is lost from this {turning} speed",
            f"{counts['contact_lost']} of {counts['samples']} samples lose it" if counts else "",
        )
    )
    return first_page.tiles(shown)
