"""What a gear pair's dynamics hand over to be judged by the rules of `record.trust`."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.dynamics.recorded import pair_numbers
from tribodyn.geometry.assembly import Assembly, tip_clearance
from tribodyn.record.trust import Judge, heat_of
from tribodyn.studies.gear_pair.prepare import PreparedPair


def judge_block(
    judge: Judge,
    cycles: np.ndarray,
    block: Mapping[str, np.ndarray],
    prepared: PreparedPair,
    between_samples: bool = False,
) -> None:
    """Judge what is recorded of a block of states, at mesh cycles (n,) since the start."""
    if not len(cycles):
        return
    quantities = quantities_of(block, prepared.case.drive.module, smallest_clearance(prepared.assembly))
    quantities |= heat_of(block["flash_temperature_rise"], prepared.case.lubricant.temperature)
    places = {"time": block["time"], "mesh_cycle": cycles}
    numbers = pair_numbers(prepared.cycle.front_pairs, np.size(prepared.cycle.side))
    judge.take(quantities, places, numbers, between_samples)


def quantities_of(block: Mapping[str, np.ndarray], module: float, clearance: float) -> dict[str, np.ndarray]:
    """Quantities by name of their rule, (n, pairs) or (n,).

    The deflection of a pair is its load over its stiffness, both as recorded.
    """
    stiffness = np.where(block["mesh_stiffness"] > 0.0, block["mesh_stiffness"], np.nan)
    places = block["displacement"][:, :4].reshape(-1, 2, 2)
    moved = np.max(np.hypot(places[..., 0], places[..., 1]), axis=1)
    return {
        "deflection": block["normal_load"] / stiffness / module,
        "friction_coefficient": block["friction_coefficient"],
        "hertz_pressure": block["hertz_pressure"],
        "bearing_displacement": moved / clearance,
    }


def smallest_clearance(assembly: Assembly) -> float:
    """The smaller of the two distances between a tip and the mate's root, m."""
    return min(tip_clearance(assembly, "pinion"), tip_clearance(assembly, "gear"))


def judge_balance(judge: Judge, summary: Mapping[str, Any], rtol: float) -> None:
    """Judge the residual of the energy balance against the tolerance of the integration."""
    residual = summary.get("energy_residual")
    if residual is not None:
        judge.take({"energy_residual": abs(residual) / rtol})
