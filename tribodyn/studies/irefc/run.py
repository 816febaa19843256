"""From a case of the gear with rolling elements to its record."""

from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.cases.results import target, writer
from tribodyn.errors import InputError
from tribodyn.gears.check import with_unit
from tribodyn.record.trust import Judge
from tribodyn.studies.irefc.engagement import (
    ElementStates,
    element_angles,
    engage,
    pattern_period,
    published_angles,
)
from tribodyn.studies.irefc.geometry import (
    Array,
    RollingDrive,
    cam_outline,
    check_drive,
    crown_outline,
    element_radius_limits,
)
from tribodyn.studies.irefc.scenario import LAYOUT, RollingCase
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult, TextTable

#: Share of the maximum load below which an element counts as unloaded.
UNLOADED = 1e-9


def prepare(case: RollingCase) -> ElementStates:
    """Check the gear and resolve one cycle: an element takes its neighbour's place.

    Raises InputError where the gear cannot be made, or its friction would take all the power and lock it.
    """
    check_drive(case.drive)
    cycle = _engage(case, _shaft_angles(case)[: case.samples_per_cycle])
    _refuse_locking(case, cycle)
    return cycle


def run(
    case: RollingCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    It covers one revolution of the shaft.
    """
    path = target(case, output, force)
    first = prepare(case)
    angles = _shaft_angles(case)
    statistics = RevolutionStatistics()
    begun = perf_counter()
    scales = {"element": np.arange(1, first.element_angle.shape[-1] + 1)}
    groups = {"geometry": geometry_arrays(case)}
    with writer(case, path, LAYOUT, len(angles), groups=groups, scales=scales, force=force) as record:
        for start, part, state in _blocks(case, angles, statistics):
            over_time = {"time": part / case.input_speed, "input_angle": part}
            record.write(start, over_time | state._asdict() | {"power_friction": state.power_friction})
            if progress:
                progress((start + len(part)) / len(angles))
        summary = statistics.summary(case) | {"wall_time": perf_counter() - begun}
        return RunResult(record.finish(summary), "complete", "", summary)


def quantities_of(case: RollingCase) -> dict[str, Any]:
    """Quantities of a case without a record."""
    prepare(case)
    statistics = RevolutionStatistics()
    for _ in _blocks(case, _shaft_angles(case), statistics):
        pass
    return statistics.summary(case)


def geometry_arrays(case: RollingCase) -> dict[str, Any]:
    """Outlines and radii for a record's pictures, m."""
    drive = case.drive
    return {
        "cam_outline": cam_outline(drive),
        "crown_outline": crown_outline(drive),
        "pitch_radius": drive.pitch_radius,
        "centre_circle_radius": drive.displacement * drive.pitch_radius,
        "element_radius": drive.element_radius,
        "eccentricity": drive.eccentricity,
        "cam_pitch_radius": drive.cam_pitch_radius,
        "crown_pitch_radius": drive.crown_pitch_radius,
    }


def _shaft_angles(case: RollingCase) -> Array:
    """Rotations of the shaft at the samples: one revolution, or the start alone in the paper's position."""
    if case.mode == "as_published":
        return np.zeros(1)
    return np.linspace(0.0, 2.0 * np.pi, case.samples_per_cycle * (case.drive.elements + 1) + 1)


def _engage(case: RollingCase, angles: Array) -> ElementStates:
    published = case.mode == "as_published"
    elements = published_angles(case.drive) if published else element_angles(case.drive, angles)
    return engage(case.drive, elements, case.input_power, case.input_speed, case.friction, case.mode)


def _blocks(
    case: RollingCase, angles: Array, statistics: "RevolutionStatistics"
) -> Iterator[tuple[int, Array, ElementStates]]:
    """Go through the cycles: number of the first sample, rotations of the shaft, state."""
    for start in range(0, len(angles), case.samples_per_cycle):
        part = angles[start : start + case.samples_per_cycle]
        state = _engage(case, part)
        # of a whole revolution the last sample is the first one again
        statistics.add(state, whole=start + len(part) < len(angles) or len(angles) == 1)
        yield start, part, state


def _refuse_locking(case: RollingCase, cycle: ElementStates) -> None:
    worst = int(np.argmin(cycle.power_out))
    if cycle.power_out[worst] > 0.0:
        return
    rolling = 2.0 * float(np.sum(cycle.power_crown[worst]))
    sliding = float(cycle.power_friction[worst]) - rolling
    (arm, coefficient), power = case.friction, float(cycle.power_in[worst])
    rule = f"friction takes {rolling + sliding:.4g} W of the {power:.4g} W put in: the gear locks"
    if sliding < power:
        remedy = f"use less than {arm * (power - sliding) / rolling * 1e3:.3g} mm"
        raise InputError("friction.rolling_arm", f"{arm * 1e3:g} mm", rule, remedy)
    remedy = f"use less than {coefficient * power / sliding:.3g}"
    raise InputError("friction.sliding_coefficient", coefficient, rule, remedy)


class RevolutionStatistics:
    """Gathers what the summary reports, block by block."""

    def __init__(self) -> None:
        self.sums: dict[str, float] = defaultdict(float)
        self.maximum: dict[str, float] = defaultdict(float)
        self.count = 0
        self.loaded: set[int] = set()
        self.power_out: list[Array] = []
        self.efficiency: list[Array] = []

    def add(self, state: ElementStates, whole: bool) -> None:
        """Take in a block; without its last sample where that is the first one again."""
        part = slice(None) if whole else slice(None, -1)
        over_time = {
            "power_in": state.power_in,
            "power_out": state.power_out,
            "power_friction": state.power_friction,
            "power_cam": state.power_cam.sum(axis=-1),
            "power_crown": state.power_crown.sum(axis=-1),
        }
        for name, values in over_time.items():
            self.sums[name] += float(np.sum(values[part]))
        largest = {name: np.abs(getattr(state, name)) for name in ("normal_load", "slip_speed", "spin_speed")}
        for name, values in (largest | {"power_element": state.power_cam + state.power_crown}).items():
            self.maximum[name] = max(self.maximum[name], float(np.max(values)))
        loads = state.normal_load
        self.loaded |= {int(n) for n in np.sum(loads > UNLOADED * loads.max(), axis=-1)}
        self.count += len(state.power_in[part])
        self.power_out.append(state.power_out)
        self.efficiency.append(state.efficiency)

    def summary(self, case: RollingCase) -> dict[str, Any]:
        """Return the summary of the run."""
        mean = {name: total / self.count for name, total in self.sums.items()}
        by_energy = mean["power_out"] / mean["power_in"]
        lost = mean["power_in"] - mean["power_out"] - mean["power_friction"]
        torque = np.concatenate(self.power_out) * case.drive.ratio / case.input_speed
        published = case.mode == "as_published"
        efficiency = float(self.efficiency[0][0]) if published else by_energy
        judge = Judge()
        judge.take({"efficiency": efficiency})
        return {
            **judge.summary(),
            "mode": case.mode,
            "ratio": case.drive.ratio,
            "eccentricity": case.drive.eccentricity,
            "mesh_frequency": 1.0 / pattern_period(case.drive, case.input_speed),
            "elements_loaded_min": min(self.loaded),
            "elements_loaded_max": max(self.loaded),
            **{f"{name}_max": value for name, value in self.maximum.items()},
            "output_torque_mean": float(np.mean(torque)),
            "output_torque_peak_to_peak": float(np.ptp(torque)),
            "power_in_mean": mean["power_in"],
            "power_friction_mean": mean["power_friction"],
            "power_cam_mean": mean["power_cam"],
            "power_crown_mean": mean["power_crown"],
            "efficiency": efficiency,
            "efficiency_by_energy": by_energy,
            "energy_residual": lost / mean["power_in"],
        }


def check(case: RollingCase) -> CheckResult:
    """Check a case, and say what gear it describes."""
    prepare(case)
    sheet = geometry_sheet(case.drive)
    rows = [("mode", case.mode), *((name, with_unit(*value)) for name, value in sheet.items())]
    table = TextTable("Gear with rolling elements", ("quantity", "value"), rows)
    return CheckResult({"mode": case.mode, "geometry": sheet}, (table,))


def geometry_sheet(drive: RollingDrive) -> dict[str, tuple[float | int, str]]:
    """Return quantities by name, each a value and its unit, in the units of a drawing."""
    limits = {
        f"element radius at which {what}": (limit * 1e3, "mm")
        for what, limit in element_radius_limits(drive).items()
    }
    return {
        "rolling elements": (drive.elements, ""),
        "teeth of the cam": (drive.elements - 1, ""),
        "teeth of the crown": (drive.elements + 1, ""),
        "ratio of input to cam, which turns the other way": (drive.ratio, ""),
        "element radius": (drive.element_radius * 1e3, "mm"),
        "displacement coefficient": (drive.displacement, ""),
        "pitch radius of the cage": (drive.pitch_radius * 1e3, "mm"),
        "pitch radius of the cam": (drive.cam_pitch_radius * 1e3, "mm"),
        "pitch radius of the crown": (drive.crown_pitch_radius * 1e3, "mm"),
        "radius of the elements' centres": (drive.displacement * drive.pitch_radius * 1e3, "mm"),
        "eccentricity": (drive.eccentricity * 1e3, "mm"),
        **limits,
    }
