"""Quantities of one run of a train: of every mesh, of the power that passes, and the worst of all meshes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.studies.gear_train.described.alike import ALIKE, alike_of
from tribodyn.studies.gear_train.prepare import PreparedTrain
from tribodyn.studies.gears.over_time.extremes import RunningExtremes
from tribodyn.studies.gears.over_time.running import MeshOfRun
from tribodyn.studies.gears.over_time.steady import LAST_ORDER, at_rest, mesh_quantities, power_quantities
from tribodyn.studies.gears.prepare import contact_quantities, thermal_quantities
from tribodyn.studies.gears.rated.margins import margins_of
from tribodyn.train.structure import FRICTION, work_of_mesh

#: Numbers that an attribute of a record holds, and that a spectrum may have.
_LONGEST = 8000.0
#: Mesh cycles at the end of a run that means are of, at most.
WIDEST_WINDOW = 400
#: Quantities of which the train's is the largest of its meshes' (1), or the smallest (−1).
WORST = {
    "transmission_error_rms": 1,
    "transmission_error_peak_to_peak": 1,
    "dynamic_factor": 1,
    "contact_loss_fraction": 1,
    "normal_load_max": 1,
    "hertz_pressure_max": 1,
    "film_min": -1,
    "film_parameter_min": -1,
    "flash_temperature_max": 1,
    "contact_temperature_max": 1,
    "bulk_temperature": 1,
    "S_B": -1,
    "S_lambda": -1,
    "closure_in_range_fraction": -1,
    "friction_in_range_fraction": -1,
}
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


def meshes_of_run(prepared: PreparedTrain) -> list[MeshOfRun]:
    """The meshes, as the summary of a run sees them."""
    found = []
    for number, (mesh, made, pair) in enumerate(
        zip(prepared.case.meshes, prepared.made, prepared.pairs, strict=True)
    ):
        phase = float(prepared.model.schedule.offset[0, number])  # under load
        oil = pair.lubricant.temperature
        found.append(
            MeshOfRun(made.cycle, made.assembly, pair.drive.module, oil, float(mesh.rate), phase, number + 1)
        )
    return found


def mesh_at_rest(prepared: PreparedTrain, m: int) -> dict[str, Any]:
    """Quantities of a mesh that do not depend on its motion, and the names of its gears."""
    driver, driven = (prepared.case.gears[gear].name for gear in prepared.case.meshes[m].gears)
    name = alike_of(prepared.case)[m]
    alike = {ALIKE: name} if name else {}
    return {"driver": driver, "driven": driven} | alike | at_rest(prepared.pairs[m], prepared.made[m])


def steady_quantities(
    windows: Sequence[Mapping[str, np.ndarray]],
    work: np.ndarray,
    prepared: PreparedTrain,
    meshes: Sequence[MeshOfRun],
    samples: int,
    extremes: Sequence[RunningExtremes],
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Quantities of the train, and of each mesh, over the last whole reference cycles of a run.

    `windows` have the datasets of every mesh over these cycles, last sample not included, so many `samples`
    in each; `work` is the change of the state over them.
    """
    model = prepared.model
    layout, operation = model.layout, model.operation
    cycles = len(windows[0]["normal_load"]) / samples
    duration = float(cycles * operation.pitch_angle / operation.nominal_speed + work[layout.lag])
    whole = {"averaging_cycles": int(cycles), "mesh_frequency": cycles / duration}
    whole |= power_quantities(work, duration, layout)
    del whole["driving_gear"]
    each = []
    for m, (window, mesh, found) in enumerate(zip(windows, meshes, extremes, strict=True)):
        arm = float(mesh.cycle.gear_sense * mesh.cycle.gear_pitch_radius)
        force = float(np.mean(window["driven_torque"])) / arm
        frequency = mesh.rate * cycles / duration
        lost = float(work[work_of_mesh(layout, m, FRICTION)]) / duration
        through = float(np.mean(window["driven_power"]))
        quantities = mesh_quantities(window, mesh.cycle, found, force, frequency, samples, mesh.rate)
        if abs(cycles * mesh.rate - round(cycles * mesh.rate)) > 1e-6:
            quantities = {name: value for name, value in quantities.items() if name not in _BY_ORDER}
        put_in = through + lost if through > 0.0 else -through
        quantities |= {
            "power_in_mean": put_in,
            "power_friction_mean": lost,
            "efficiency": 1.0 - lost / put_in if put_in > 0.0 else float("nan"),
        }
        quantities |= thermal_quantities(prepared.thermal[m], put_in, quantities["efficiency"])
        each.append(quantities | found.values())
        each[-1] |= contact_quantities(prepared.pairs[m].lubricant, each[-1])
        each[-1] |= margins_of(prepared.given.meshes[m].pair, mesh.assembly, window, each[-1])
    return whole, each


def worst_of(meshes: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The worst of all meshes by quantity, and which mesh has it, its number from 1."""
    found = {}
    for name, sign in WORST.items():
        values = [mesh.get(name) for mesh in meshes]
        known = [(sign * value, -m) for m, value in enumerate(values) if value is not None and value == value]
        if known:
            worst, place = max(known)
            found[name] = sign * worst
            found.setdefault("worst_mesh", {})[name] = 1 - place
    return found
