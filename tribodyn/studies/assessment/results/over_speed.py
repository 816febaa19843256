"""Simulated safeties against scuffing and micropitting of a mesh over the speed."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.gears.prepare import assembled
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.assessment.case import RatedPair
from tribodyn.studies.assessment.results.margins import local_of, scuffing_and_micropitting

#: What follows the speed as the steady states do.
_FOLLOWS = ("dynamic_factor", "power_friction_mean", "friction_coefficient_mean")
SAFETIES = ("S_B", "S_lambda")


def safeties_over_speed(
    case: RatedPair,
    along: Mapping[str, Any],
    quantities: Mapping[str, Any],
    curves: Mapping[str, Any],
    speeds: Float[Array, " speed"],
    duty: float,
) -> dict[str, Float[Array, " speed"]]:
    """S_B and S_λ at every speed of the input, NaN where they are not known; empty: there are no curves.

    Torque and pressures of slow rotation are those of the duty. K_v, loss and friction change as the steady
    states' do from it, the bulk rises above the oil as the loss.
    """
    if not all(name in curves for name in _FOLLOWS):
        return {}
    found = {name: np.full(len(speeds), np.nan) for name in SAFETIES}
    assembly, oil, at_duty = assembled(case), case.oil_temperature, int(np.argmin(np.abs(speeds - duty)))
    for number, speed in enumerate(speeds):
        share = {name: float(curves[name][number] / curves[name][at_duty]) for name in _FOLLOWS}
        if not all(np.isfinite(value) and value > 0.0 for value in share.values()):
            continue
        there = dict(quantities) | {name: quantities[name] * share[name] for name in _FOLLOWS}
        if quantities.get("bulk_temperature") is not None:
            rise = quantities["bulk_temperature"] - oil
            there["bulk_temperature"] = oil + rise * share["power_friction_mean"]
        turning = replace(case.operating, pinion_speed=case.operating.pinion_speed * float(speed) / duty)
        one = replace(case, operating=turning)
        try:
            margins = scuffing_and_micropitting(one, local_of(one, assembly, along, there))
        except SimulationError:
            continue
        for name in SAFETIES:
            found[name][number] = margins.get(name, np.nan)
    return found
