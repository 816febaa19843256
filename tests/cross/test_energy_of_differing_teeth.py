"""The balance of energy closes where teeth differ, in every mesh and wherever the run ends."""

from typing import Any

import pytest

import tribodyn as td
from tests.support.planet_sets import planet_set
from tests.support.train_scenarios import REDUCER

RTOL = 1e-6
SHORT = {"solver": {"cycles": 7, "rtol": RTOL}, "output": {"samples_per_cycle": 16}}


@pytest.mark.parametrize(("table", "gear"), [(REDUCER, "wheel-2"), (planet_set(frame_forces=False), "ring")])
def test_run_out_of_any_gear_leaves_no_residual(table: dict[str, Any], gear: str):
    """The strain energy at the end is that of the teeth that meet there, not of those at the start.

    Seven cycles are no whole turn of either gear; with the first teeth at the end it is 1e-4. Forces of the
    carrier's frame leave a share of their own, see `dynamics.loads.frame_energy`.
    """
    run = td.run(table | SHORT, {f"gear.{gear}.eccentricity": "20 um"})
    assert abs(run.summary["energy_residual"]) < RTOL
