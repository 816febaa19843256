"""Quantities of one run of a pair, from those of its mesh and of the power that passes through."""

from typing import Any

import numpy as np

from tribodyn.studies.gear_pair.outputs import MESH
from tribodyn.studies.gear_pair.prepare import PreparedPair
from tribodyn.studies.gears.over_time.extremes import RunningExtremes
from tribodyn.studies.gears.over_time.running import MeshOfRun
from tribodyn.studies.gears.over_time.steady import mesh_quantities, power_quantities
from tribodyn.train.structure import OUT, rotational_error, work_of


def mesh_of_run(prepared: PreparedPair) -> MeshOfRun:
    """The pair's mesh, as the summary of a run sees it."""
    case = prepared.case
    return MeshOfRun(prepared.cycle, prepared.assembly, case.drive.module, case.lubricant.temperature)


def steady_quantities(
    window: dict[str, np.ndarray],
    work: np.ndarray,
    prepared: PreparedPair,
    samples: int,
    nominal_speed: float,
    extremes: RunningExtremes,
    *,
    changes: bool = False,
) -> dict[str, Any]:
    """Quantities of the last whole mesh cycles of a run.

    The `window` has the mesh's datasets over these cycles, last sample not included, so many `samples` in
    each. `work` is the change of the state over them. `nominal_speed` is the pinion's, rad/s. Where the speed
    `changes`, the teeth also carry what accelerates the load.
    """
    cycle, layout = prepared.cycle, prepared.model.layout
    cycles = len(window["normal_load"]) / samples
    # by the actual rotation: a driven pinion need not turn at its nominal speed
    duration = float(cycles * cycle.pitch_angle / nominal_speed + work[layout.lag])
    # the mean load by its work over the gear's rotation: neither depends on the sampling
    turned = cycle.pinion_pitch_radius * cycle.pitch_angle * cycles
    turned = turned - float(rotational_error(work, MESH, prepared.model))
    force = float(work[work_of(layout, OUT)] / turned)
    if changes:
        force = float(np.mean(window["driven_torque"]) / (cycle.gear_sense * cycle.gear_pitch_radius))
    return {
        "averaging_cycles": int(cycles),
        **mesh_quantities(window, cycle, extremes, force, cycles / duration, samples),
        **power_quantities(work, duration, layout),
    }
