"""Quantities of one run of a gearbox: of every mesh, of the power that passes, the worst of all meshes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.gears.by_standard import rated
from tribodyn.gears.motion.extremes import RunningExtremes
from tribodyn.gears.motion.running import MeshOfRun
from tribodyn.gears.motion.steady import LAST_ORDER, at_rest, mesh_quantities, power_quantities
from tribodyn.gears.prepare import contact_quantities, thermal_quantities
from tribodyn.gears.rating.margins import margins_of
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.drivetrain.mesh_groups import ALIKE, alike_of
from tribodyn.train.layout import work_of, work_of_mesh
from tribodyn.train.structure import (
    FRICTION,
    OUT,
    rotational_error,
)
from tribodyn.tribology.losses.pair import LOSSES

#: Numbers that an attribute of a record holds, and that a spectrum may have.
_LONGEST = 8000.0
#: Mesh cycles at the end of a run that means are of, at most.
WIDEST_WINDOW = 400
#: Mesh cycles at the end of a run by time below which the gears stand, and have no efficiency.
STANDS = 1e-2
#: Quantities of which the train's is the largest of its meshes' (1), or the smallest (−1).
WORST = {
    "transmission_error_rms": 1,
    "transmission_error_peak_to_peak": 1,
    "transmission_error_mean": 1,
    "dynamic_factor": 1,
    "dynamic_factor_iso": 1,
    "contact_loss_fraction": 1,
    "normal_load_max": 1,
    "hertz_pressure_max": 1,
    "film_min": -1,
    "film_parameter_min": -1,
    "flash_temperature_max": 1,
    "friction_coefficient_mean": 1,
    "contact_temperature_max": 1,
    "bulk_temperature": 1,
    "S_B": -1,
    "S_lambda": -1,
    "closure_in_range_fraction": -1,
    "friction_in_range_fraction": -1,
}
#: Of the mesh of a pair what it is of the whole gearbox.
_POWERS = ("power_in_mean", "power_friction_mean", "efficiency")
#: Losses besides those of the loaded meshes; the last is the sum of those without load.
IDLE = (*(f"power_{name}" for name in LOSSES), "power_load_independent")
_TOLD_ONCE = (*IDLE, "efficiency_with_losses", "losses_outside")
#: What a mesh says of its place in the train.
_NAMES = ("driver", "driven", ALIKE)
#: Of an order, not of a mesh's own cycles: not told where the window holds no whole number of them.
_BY_ORDER = ("transmission_error_harmonics", "spectrum_frequencies", "spectrum_amplitudes")


def window_of(cycles: int, period: int, fastest: float) -> int:
    """Reference cycles at the end of a run that its means are of.

    A quarter of them; whole common periods if the run has one. `fastest` is the largest rate of a mesh.
    """
    most = max(1, int(min(WIDEST_WINDOW, _LONGEST / (LAST_ORDER * fastest))))
    window = max(1, min(cycles // 4, most))
    if period > cycles:
        return window
    return max(window // period, 1) * period


def meshes_of_run(prepared: PreparedGearbox) -> list[MeshOfRun]:
    """The meshes, as the summary of a run sees them."""
    meshes = []
    for number, (mesh, tabulated, pair) in enumerate(
        zip(prepared.case.meshes, prepared.tables, prepared.warm_pairs, strict=True)
    ):
        phase = float(prepared.model.schedule.offset[0, number])  # under load
        oil = pair.lubricant.temperature
        place = number + 1 if prepared.case.named else None
        meshes.append(
            MeshOfRun(
                tabulated.cycle, tabulated.assembly, pair.drive.module, oil, float(mesh.rate), phase, place
            )
        )
    return meshes


def mesh_at_rest(prepared: PreparedGearbox, m: int) -> dict[str, Any]:
    """Quantities of a mesh that do not depend on its motion, and the names of its gears."""
    rest = at_rest(prepared.warm_pairs[m], prepared.tables[m]) | _by_standard(prepared, m)
    if not prepared.case.named:
        return rest
    driver, driven = (prepared.case.gears[gear].name for gear in prepared.case.meshes[m].gears)
    name = alike_of(prepared.case)[m]
    return {"driver": driver, "driven": driven} | ({ALIKE: name} if name else {}) | rest


def _by_standard(prepared: PreparedGearbox, m: int) -> dict[str, float]:
    """K_v by ISO 6336-1 of an involute mesh with a quality whose driver drives; nothing of others."""
    pair, tabulated = prepared.warm_pairs[m], prepared.tables[m]
    operating = pair.operating
    if pair.quality is None or not tabulated.assembly.family.involute or operating.gear_torque <= 0.0:
        return {}
    duty = operating.pinion_speed, operating.gear_torque
    iso = rated(tabulated.assembly, pair.materials, tabulated.masses, pair.quality, duty)
    return {"dynamic_factor_iso": iso.dynamic.factor, "resonance_ratio_iso": iso.dynamic.resonance_ratio}


def steady_quantities(
    windows: Sequence[Mapping[str, np.ndarray]],
    work: np.ndarray,
    prepared: PreparedGearbox,
    meshes: Sequence[MeshOfRun],
    samples: int,
    extremes: Sequence[RunningExtremes],
    *,
    changes: bool = False,
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Quantities of the gearbox, and of each mesh, over the last whole reference cycles of a run.

    `windows` have the datasets of every mesh over these cycles, last sample not included, so many `samples`
    in each; `work` is the change of the state over them. Where the speed `changes`, teeth also carry what
    accelerates the load.
    """
    case, model = prepared.case, prepared.model
    layout, operation = model.layout, model.operation
    cycles = len(windows[0]["normal_load"]) / samples
    nominal = float(operation.pitch_angle / operation.nominal_speed)
    if case.in_time:
        duration = cycles * nominal
        cycles = abs(duration - float(work[layout.lag])) / nominal
    else:  # by the actual rotation: a driven reference need not turn at its nominal speed
        duration = float(cycles * nominal + work[layout.lag])
    whole = {"averaging_cycles": int(cycles), "mesh_frequency": cycles / duration}
    whole |= power_quantities(work, duration, layout)
    stands = case.in_time and cycles < STANDS
    if stands:
        whole["efficiency"] = float("nan")
    each, idle = [], list[dict[str, Any]]()
    for m, (window, mesh, extreme) in enumerate(zip(windows, meshes, extremes, strict=True)):
        if case.is_pair and not changes and not case.in_time:
            force = _mean_force(prepared, work, cycles)
        else:
            arm = float(mesh.cycle.gear_sense * mesh.cycle.gear_pitch_radius)
            force = float(np.mean(window["driven_torque"])) / arm
        frequency = mesh.rate * cycles / duration
        quantities = mesh_quantities(window, mesh.cycle, extreme, force, frequency, samples, mesh.rate)
        if case.in_time or abs(cycles * mesh.rate - round(cycles * mesh.rate)) > 1e-6:
            quantities = {name: value for name, value in quantities.items() if name not in _BY_ORDER}
        if case.is_pair:
            quantities |= {name: whole[name] for name in _POWERS}
        else:
            quantities |= _powers_of_mesh(window, float(work[work_of_mesh(layout, m, FRICTION)]) / duration)
            if stands:
                quantities["efficiency"] = float("nan")
        put_in, efficiency = quantities["power_in_mean"], quantities["efficiency"]
        thermal = thermal_quantities(prepared.thermal[m], put_in, efficiency)
        if case.in_time:  # those of nominal speed
            thermal = {name: value for name, value in thermal.items() if name not in _TOLD_ONCE}
        if case.named:  # of shafts and gears of several meshes: told of all together
            idle.append({name: thermal.pop(name) for name in _TOLD_ONCE if name in thermal})
        quantities |= thermal
        each.append(quantities | extreme.values())
        each[-1] |= contact_quantities(prepared.warm_pairs[m].lubricant, each[-1])
        each[-1] |= margins_of(case.meshes[m].pair, mesh.assembly, window, each[-1])
    return whole | _idle_losses(whole, idle), each


def _mean_force(prepared: PreparedGearbox, work: np.ndarray, cycles: float) -> float:
    """Mean force of a pair along the pitch tangent, N, by its work over the gear's rotation.

    Neither depends on the sampling.
    """
    cycle, model = prepared.cycle, prepared.model
    turned = cycle.pinion_pitch_radius * cycle.pitch_angle * cycles
    turned = turned - float(rotational_error(work, 0, model))
    return float(work[work_of(model.layout, OUT)] / turned)


def _powers_of_mesh(window: Mapping[str, np.ndarray], lost: float) -> dict[str, float]:
    """Mean power that drives a mesh, what friction takes of it, W, and its efficiency."""
    through = float(np.mean(window["driven_power"]))
    put_in = through + lost if through > 0.0 else -through
    efficiency = 1.0 - lost / put_in if put_in > 0.0 else float("nan")
    return {"power_in_mean": put_in, "power_friction_mean": lost, "efficiency": efficiency}


def concluded(
    prepared: PreparedGearbox, whole: Mapping[str, Any], each: Sequence[Mapping[str, Any]]
) -> dict[str, Any]:
    """The summary of the gearbox: with what its only mesh has, or with the worst of several."""
    if not prepared.case.named:
        return {**each[0], **whole}
    if len(each) == 1:
        whole = {name: value for name, value in each[0].items() if name not in _NAMES} | dict(whole)
    else:
        whole = {name: value for name, value in whole.items() if name != "driving_gear"}
    return {**whole, **worst_of(each)}


def _idle_losses(whole: Mapping[str, Any], each: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Load-independent losses of all meshes together, and the efficiency with them; nothing without any."""
    names = [name for name in IDLE if any(name in of_mesh for of_mesh in each)]
    if not names:
        return {}
    totals: dict[str, Any] = {name: sum(float(of_mesh.get(name, 0.0)) for of_mesh in each) for name in names}
    put_in = float(whole["power_in_mean"])
    lost = totals[IDLE[-1]] + totals.get("power_bearings_under_load", 0.0)
    totals["efficiency_with_losses"] = whole["efficiency"] * put_in / (put_in + lost)
    outside = dict.fromkeys(of_mesh["losses_outside"] for of_mesh in each if "losses_outside" in of_mesh)
    return totals | ({"losses_outside": "; ".join(outside)} if outside else {})


def worst_of(meshes: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The worst of all meshes by quantity, and which mesh has it, its number from 1."""
    worst_by = {}
    for name, sign in WORST.items():
        values = [mesh.get(name) for mesh in meshes]
        pairs = [(sign * value, -m) for m, value in enumerate(values) if value is not None and value == value]
        if pairs:
            worst, place = max(pairs)
            worst_by[name] = sign * worst
            worst_by.setdefault("worst_mesh", {})[name] = 1 - place
            if name == "dynamic_factor_iso":
                worst_by["resonance_ratio_iso"] = meshes[-place]["resonance_ratio_iso"]
    return worst_by
